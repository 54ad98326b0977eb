//! The controllers' own source against mocks: every byte, duty and level that they give.

use embedded_hal_mock::eh1::MockError;
use embedded_hal_mock::eh1::delay::{CheckedDelay, Transaction as Wait};
use embedded_hal_mock::eh1::digital::{Mock as Pin, State, Transaction as Level};
use embedded_hal_mock::eh1::pwm::{Mock as Pwm, Transaction as Duty};
use embedded_hal_mock::eh1::spi::{Mock as Spi, Transaction as Bus};
use firmware::controllers::balance::{self, Balance};
use firmware::controllers::follow::{self, Follow};
use firmware::controllers::{ControlError, ReadError};

use std::f64::consts::TAU;

/// One frame: its chip select, its two bytes and the answer.
fn frame(sent: [u8; 2], answer: u16) -> [Bus<u8>; 3] {
    let exchange = Bus::transfer_in_place(sent.to_vec(), answer.to_be_bytes().to_vec());
    [Bus::transaction_start(), exchange, Bus::transaction_end()]
}

/// An angle is asked for and answered in the next frame, with even parity.
fn angle(counts: u16) -> Vec<Bus<u8>> {
    let answer = counts | (counts.count_ones() as u16 & 1) << 15;
    [frame([0xff, 0xff], 0), frame([0xc0, 0x00], answer)].concat()
}

/// A level and a duty of `most`.
fn drive(high: bool, duty: u16, most: u16) -> (Level, [Duty; 2]) {
    let state = if high { State::High } else { State::Low };
    (Level::set(state), [Duty::max_duty_cycle(most), Duty::set_duty_cycle(duty)])
}

/// \[N\] of one count of the pendulum.
fn force_of(axis_error: f64, cart: f64, spin: f64, speed: f64) -> f64 {
    -(-20.0 * cart + 88.97 * axis_error - 18.33 * speed + 17.54 * spin)
}

#[test]
fn the_balancer_says_what_it_should_to_its_drivers() {
    let constants = balance::Constants::IP02;
    // First the pendulum leans by 100 counts; then cart and pendulum have moved by 50 and −4 counts.
    let axis_error = |counts: f64| counts * TAU / 16_384.0;
    let cart = 50.0 * 0.093_18 / 16_384.0;
    let first = force_of(axis_error(100.0), 0.0, 0.0, 0.0) / 20.68;
    let speed = 0.2 * cart / 1e-3;
    let second = force_of(axis_error(96.0), cart, 0.2 * axis_error(-4.0) / 1e-3, speed);
    let second = (second + 7.725 * speed) / 20.68;
    assert!(first < -0.1 && second > 0.1 && second < 0.9, "{first} {second}");
    // Third it is over on the other side, faster than the motor can follow; fourth it has fallen.
    let steps =
        [(100, 16_256, first), (150, 16_252, second), (150, 15_000, 1.0), (150, 12_000, 0.0)];
    let (mut carts, mut angles, mut levels, mut duties) = (vec![], vec![], vec![], vec![]);
    let mut waits = vec![];
    for (cart, pendulum, part) in steps {
        carts.extend(angle(cart));
        angles.extend(angle(pendulum));
        let (level, duty) = drive(part < 0.0, (part.abs() * 1_000.0).round() as u16, 1_000);
        levels.push(level);
        duties.extend(duty);
        waits.push(Wait::delay_ns(1_000_000));
    }
    let (mut cart, mut pendulum) = (Spi::new(&carts), Spi::new(&angles));
    let (mut duty, mut direction) = (Pwm::new(&duties), Pin::new(&levels));
    let mut delay = CheckedDelay::new(&waits);
    let mut controller =
        Balance::new(cart.clone(), pendulum.clone(), duty.clone(), direction.clone(), constants);
    let mut seen = Vec::new();
    controller.run(&mut delay, 4, |tick| seen.push(tick.cart)).unwrap();
    assert_eq!(seen[0], 0.0);
    assert!((f64::from(seen[1]) - 50.0 * 0.093_18 / 16_384.0).abs() < 1e-9);
    cart.done();
    pendulum.done();
    duty.done();
    direction.done();
    delay.done();
}

#[test]
fn a_faulty_frame_is_told_and_nothing_is_driven() {
    // What comes back, the error, and the frames that follow.
    let cleared = [frame([0x40, 0x01], 0), frame([0xc0, 0x00], 0x8001)].concat();
    for (answer, error, further) in
        [(0x0001, ReadError::Parity, vec![]), (0xc000, ReadError::Frame, cleared)]
    {
        let asked = [frame([0xff, 0xff], 0), frame([0xc0, 0x00], answer)].concat();
        let mut cart = Spi::new(&angle(100));
        let mut pendulum = Spi::new(&[asked, further].concat());
        let (mut duty, mut direction) = (Pwm::new(&[]), Pin::new(&[]));
        let constants = balance::Constants::IP02;
        let mut controller = Balance::new(
            cart.clone(),
            pendulum.clone(),
            duty.clone(),
            direction.clone(),
            constants,
        );
        assert_eq!(controller.tick(), Err(ControlError::Encoder(1, error)));
        cart.done();
        pendulum.done();
        duty.done();
        direction.done();
    }
}

#[test]
fn a_driver_that_fails_is_told_by_its_axis() {
    let fails = MockError::Io(std::io::ErrorKind::NotConnected);
    let mut spis = [(); 2].map(|()| Spi::new(&angle(16_156)));
    let mut duty =
        Pwm::new(&[Duty::max_duty_cycle(1_000), Duty::set_duty_cycle(0).with_error(fails)]);
    let mut direction = Pin::new(&[Level::set(State::Low)]);
    let constants = balance::Constants::IP02;
    let [cart, pendulum] = spis.clone();
    let mut controller = Balance::new(cart, pendulum, duty.clone(), direction.clone(), constants);
    let error = controller.tick().unwrap_err();
    assert!(matches!(error, ControlError::Duty(0, _)), "{error:?}");
    spis.iter_mut().for_each(Spi::done);
    duty.done();
    direction.done();
}

#[test]
fn the_follower_says_what_it_should_to_its_drivers() {
    // Two ticks: at rest at home, then each motor has turned on by some counts.
    let arms = [[0.0_f32, 1.0], [0.866_025_4, -0.5], [-0.866_025_4, -0.5]];
    let moved = [3_i32, -2, 1];
    let mut expected = [[0.0; 3]; 2];
    for (axis, direction) in arms.into_iter().enumerate() {
        let knot = |n: i32| f64::from(follow::arm(follow::path(n as f32 * 2.5e-3), direction));
        let [a, b, c, d] = [-1, 0, 1, 2].map(knot);
        let torque = |along: f64, last: f64, turned: f64| {
            // The cubic by its values and slopes at both knots, as its basis has it.
            let (s, s2, s3) = (along, along * along, along.powi(3));
            let slopes = [0.5 * (c - a), 0.5 * (d - b)];
            let value = (2.0 * s3 - 3.0 * s2 + 1.0) * b
                + (s3 - 2.0 * s2 + s) * slopes[0]
                + (3.0 * s2 - 2.0 * s3) * c
                + (s3 - s2) * slopes[1];
            let rate = (6.0 * s2 - 6.0 * s) * (b - c)
                + (3.0 * s2 - 4.0 * s + 1.0) * slopes[0]
                + (3.0 * s2 - 2.0 * s) * slopes[1];
            let bend = (1.0 - s) * (a - 2.0 * b + c) + s * (b - 2.0 * c + d);
            let off = value - turned * TAU / 16_384.0 / 20.0;
            let rising = 0.5 * (off - last) / 2.5e-4;
            let known = 400.0 * value + 60.0 * rate / 2.5e-3 + 11.0 * bend / 6.25e-6;
            (known + 1e4 * off + 100.0 * rising, off)
        };
        let (first, off) = torque(0.0, 0.0, 0.0);
        // At the first look there is no rate.
        let first = first - 100.0 * 0.5 * off / 2.5e-4;
        let (second, _) = torque(0.1, off, f64::from(moved[axis]));
        expected[0][axis] = first / 800.0;
        expected[1][axis] = second / 800.0;
    }
    let mut mocks = Vec::new();
    for axis in 0..3 {
        // Over the end of a turn, too: the second starts one count below it.
        let starts = [5_000_u16, 1, 16_383];
        let next = (i32::from(starts[axis]) + moved[axis]).rem_euclid(16_384) as u16;
        let frames = [angle(starts[axis]), angle(next)].concat();
        let mut levels = vec![];
        let mut duties = vec![];
        for tick in expected {
            let (level, duty) =
                drive(tick[axis] < 0.0, (tick[axis].abs() * 4_000.0).round() as u16, 4_000);
            levels.push(level);
            duties.extend(duty);
        }
        mocks.push((Spi::new(&frames), Pwm::new(&duties), Pin::new(&levels)));
    }
    let arms = [0, 1, 2].map(|axis| mocks[axis].clone());
    let mut delay = CheckedDelay::new(&[Wait::delay_ns(250_000), Wait::delay_ns(250_000)]);
    let mut controller = Follow::new(arms, follow::Constants::DELTA);
    controller.run(&mut delay, 2, |_| {}).unwrap();
    delay.done();
    for (mut spi, mut duty, mut direction) in mocks {
        spi.done();
        duty.done();
        direction.done();
    }
}
