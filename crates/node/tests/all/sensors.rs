//! What a sensor does to the truth, by statistics and exactly; what a motor does, in closed form.

#[allow(dead_code, reason = "each test program uses a part of the rotor")]
use std::cell::RefCell;

use crate::shaft::{RATE, STEP, Shaft, TORQUE};
use dbd_kernel::random::Stream;
use dbd_node::motor::Bridge as _;
use dbd_node::{
    Channel, Errors, Motor, MotorParameters, Node, Number, Probe, Sensor, Shared as _, Supply,
};

/// Mean, deviation, skewness and excess kurtosis.
fn moments(values: &[f64]) -> [f64; 4] {
    let count = values.len() as f64;
    let mean = values.iter().sum::<f64>() / count;
    let moment = |power| values.iter().map(|x| (x - mean).powi(power)).sum::<f64>() / count;
    let deviation = moment(2).sqrt();
    [mean, deviation, moment(3) / deviation.powi(3), moment(4) / deviation.powi(4) - 3.0]
}

#[test]
fn normal_numbers_have_their_moments_and_are_exact_in_both_precisions() {
    const COUNT: usize = 200_000;
    let (mut double, mut single) = (Stream::new(7, "x", 0), Stream::new(7, "x", 0));
    let mut values = Vec::with_capacity(COUNT);
    for _ in 0..COUNT {
        let (x, y): (f64, f32) = (double.normal(), single.normal());
        assert_eq!(x, f64::from(y));
        assert!(x.abs() <= 6.0);
        values.push(x);
    }
    let [mean, deviation, skewness, kurtosis] = moments(&values);
    // Four standard errors of each: 1, √½, √6 and √24 over √COUNT.
    let error = 4.0 / (COUNT as f64).sqrt();
    assert!(mean.abs() < error, "{mean}");
    assert!((deviation - 1.0).abs() < error, "{deviation}");
    assert!(skewness.abs() < 2.45 * error, "{skewness}");
    assert!((kurtosis + 0.1).abs() < 4.9 * error, "{kurtosis}");
    // One draw tells nothing of the next.
    let pairs: f64 = values.windows(2).map(|pair| pair[0] * pair[1]).sum();
    assert!((pairs / COUNT as f64).abs() < error, "{pairs}");
    // As often beyond two deviations as the normal law has it, within what the sum of twelve lacks.
    let beyond = values.iter().filter(|x| x.abs() > 2.0).count() as f64 / COUNT as f64;
    assert!((beyond - 0.0455).abs() < 0.002, "{beyond}");
}

#[test]
fn a_further_sensor_changes_no_others_bits() {
    let bits = |seed, name, lane| {
        let mut stream = Stream::new(seed, name, lane);
        [stream.bits(), stream.bits(), stream.bits(), stream.bits()]
    };
    let first = bits(1, "angle", 0);
    assert_eq!(first, bits(1, "angle", 0));
    let others = [
        bits(2, "angle", 0),
        bits(1, "angle", 1),
        bits(1, "angle1", 0),
        bits(1, "", 0),
        bits(1, "angle\0", 0),
        bits(1, "a longer name than eight bytes", 0),
    ];
    for (i, other) in others.iter().enumerate() {
        assert_ne!(*other, first, "{i}");
        assert!(others[..i].iter().all(|earlier| earlier != other), "{i}");
    }
    // Of the reference sequence: xoshiro128++ from SplitMix64 of the hash, written out here.
    let mut hash = 0xcbf2_9ce4_8422_2325_u64;
    let words = [1, u64::from_le_bytes(*b"angle\0\0\0"), 5, 0];
    for byte in words.iter().flat_map(|word: &u64| word.to_le_bytes()) {
        hash = (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3);
    }
    let mut split = || {
        hash = hash.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (hash ^ hash >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ z >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ z >> 31
    };
    let [low, high] = [split(), split()];
    let mut s = [low as u32, (low >> 32) as u32, high as u32, (high >> 32) as u32];
    for bits in first {
        assert_eq!(bits, s[0].wrapping_add(s[3]).rotate_left(7).wrapping_add(s[0]));
        let t = s[1] << 9;
        s[2] ^= s[0];
        s[3] ^= s[1];
        s[1] ^= s[2];
        s[0] ^= s[3];
        s[2] ^= t;
        s[3] = s[3].rotate_left(11);
    }
}

fn shown<R: Number, const DELAY: usize>(errors: Errors, truths: &[f64]) -> Vec<f64> {
    let mut sensor = Sensor::<R, DELAY>::new("s", 0, errors, STEP).unwrap();
    truths.iter().map(|&truth| sensor.sample(R::from_f64(truth)).to_f64()).collect()
}

#[test]
fn noise_and_bias_are_what_the_parameters_say() {
    let errors = Errors { noise: 0.25, bias: 3.0, seed: 5, ..Errors::NONE };
    let [mean, deviation, ..] = moments(&shown::<f64, 0>(errors, &[10.0; 40_000]));
    assert!((mean - 13.0).abs() < 4.0 * 0.25 / 200.0, "{mean}");
    assert!((deviation - 0.25).abs() < 4.0 * 0.25 / 283.0, "{deviation}");
    // A sensor without errors shows the truth, to the bit.
    let truths = [0.1, -7.3, 1e-30, 1e30];
    assert_eq!(shown::<f64, 0>(Errors::NONE, &truths), truths);
}

#[test]
fn a_walk_spreads_with_the_root_of_time() {
    // After a second and after four, of many sensors.
    let errors = |seed| Errors { walk: 0.5, seed, ..Errors::NONE };
    let ends = |seconds: usize| {
        let walk =
            |seed| shown::<f64, 0>(errors(seed), &vec![0.0; 1_024 * seconds])[1_024 * seconds - 1];
        moments(&(0..400).map(walk).collect::<Vec<_>>())
    };
    for (seconds, expected) in [(1, 0.5), (4, 1.0)] {
        let [mean, deviation, ..] = ends(seconds);
        assert!(mean.abs() < 4.0 * expected / 20.0, "{seconds}: {mean}");
        assert!((deviation / expected - 1.0).abs() < 4.0 / 28.0, "{seconds}: {deviation}");
    }
}

#[test]
fn what_is_shown_is_a_multiple_of_the_resolution_within_the_range() {
    let errors = Errors { resolution: 0.125, range: [-1.0, 1.5], ..Errors::NONE };
    let truths = [0.0, 0.0624, 0.0625, 0.0626, 0.1875, -0.0626, 1.49, 7.0, -0.99, -7.0];
    // Half goes to the even multiple.
    let expected = [0.0, 0.0, 0.0, 0.125, 0.25, -0.125, 1.5, 1.5, -1.0, -1.0];
    assert_eq!(shown::<f64, 0>(errors, &truths), expected);
    assert_eq!(shown::<f32, 0>(errors, &truths), expected);
    // The error of a fine one is uniform: deviation 1/√12 of the resolution.
    let truths: Vec<f64> = (0..10_000).map(|i| f64::from(i) * 1.234_567e-4).collect();
    let fine = Errors { resolution: 0.01, ..Errors::NONE };
    let seen = shown::<f64, 0>(fine, &truths);
    let off: Vec<f64> = seen.iter().zip(&truths).map(|(seen, truth)| seen - truth).collect();
    assert!(off.iter().all(|off| off.abs() <= 0.005 + 1e-12));
    let [mean, deviation, ..] = moments(&off);
    assert!(mean.abs() < 1e-4 && (deviation / 0.01 * 12_f64.sqrt() - 1.0).abs() < 0.02);
}

#[test]
fn a_delay_is_whole_samples_and_begins_with_the_first() {
    let truths = [5.0, 6.0, 7.0, 8.0, 9.0];
    assert_eq!(shown::<f64, 0>(Errors::NONE, &truths), truths);
    assert_eq!(shown::<f64, 1>(Errors::NONE, &truths), [5.0, 5.0, 6.0, 7.0, 8.0]);
    assert_eq!(shown::<f32, 3>(Errors::NONE, &truths), [5.0, 5.0, 5.0, 5.0, 6.0]);
}

#[test]
fn a_sensor_that_begins_again_shows_the_same() {
    let errors = Errors { noise: 1.0, walk: 1.0, seed: 9, ..Errors::NONE };
    let mut sensor = Sensor::<f32, 2>::new("s", 0, errors, STEP).unwrap();
    let mut run = || (0..50).map(|i| sensor.sample(i as f32)).collect::<Vec<_>>();
    let first = run();
    let on = run();
    assert_ne!(first, on);
    sensor.reset();
    let again: Vec<f32> = (0..50).map(|i| sensor.sample(i as f32)).collect();
    assert_eq!(first, again);
}

const MOTOR: MotorParameters = MotorParameters {
    supply: Supply::Voltage { full: 12.0, resistance: 2.0, back_emf: 0.0 },
    torque_constant: 0.5,
    most_current: f64::INFINITY,
    lag: 0.0,
    friction: 0.0,
    friction_speed: 1.0,
    ratio: 3.0,
    most_duty: 100,
};

/// Current \[A\] and torque at the joint \[N·m\] of the steps at a duty; the shaft is as given.
fn driven(parameters: MotorParameters, shaft: Shaft, duty: u16, steps: usize) -> Vec<[f64; 2]> {
    let motor =
        RefCell::new(Motor::new("m", TORQUE, parameters).with_speed(Probe::scalar("w", RATE)));
    let mut node = Node::new(shaft, &motor).unwrap();
    motor.with(|motor| motor.set_duty(Channel::Forwards, duty)).unwrap();
    let step = |_| {
        node.step().unwrap();
        let seen = motor.with(|motor| [motor.current(), motor.output()]).unwrap();
        assert_eq!(seen[1], node.machine().torque);
        seen.map(f64::from)
    };
    (0..steps).map(step).collect()
}

#[test]
fn a_motor_turns_a_duty_into_torque() {
    // Half of 12 V on 2 Ω, 0.5 N·m/A, a gear of 3.
    assert_eq!(driven(MOTOR, Shaft::default(), 50, 1), [[3.0, 4.5]]);
    let limited = MotorParameters { most_current: 2.0, ..MOTOR };
    assert_eq!(driven(limited, Shaft::default(), 50, 1), [[2.0, 3.0]]);
    // The motor turns three times as fast as the joint; 0.5 V·s/rad take 1.5 V of 6 V at 1 rad/s.
    let supply = Supply::Voltage { full: 12.0, resistance: 2.0, back_emf: 0.5 };
    let turning = || Shaft { rate: 1.0, ..Shaft::default() };
    assert_eq!(driven(MotorParameters { supply, ..MOTOR }, turning(), 50, 1), [[2.25, 3.375]]);
    // Friction is whole from its speed on and holds back; at half that speed it is half.
    let rubbing = MotorParameters { friction: 0.1, friction_speed: 3.0, ..MOTOR };
    let torque = driven(rubbing, turning(), 0, 1)[0][1];
    assert!((torque + 0.3).abs() < 1e-6, "{torque}");
    let half = Shaft { rate: -0.5, ..Shaft::default() };
    let torque = driven(rubbing, half, 0, 1)[0][1];
    assert!((torque - 0.15).abs() < 1e-6, "{torque}");
    // A drive that holds its current.
    let held = MotorParameters { supply: Supply::Current { full: 8.0 }, ..MOTOR };
    assert_eq!(driven(held, Shaft::default(), 25, 1), [[2.0, 3.0]]);
}

#[test]
fn a_lag_is_the_exponential_and_its_impulse_is_exact() {
    // Steps longer, as long and far shorter than the time constant.
    for lag in [STEP / 4.0, STEP, 20.0 * STEP, 5_000.0 * STEP] {
        let seen = driven(MotorParameters { lag, ..MOTOR }, Shaft::default(), 50, 200);
        let mut impulse = 0.0;
        for (i, [current, torque]) in seen.iter().enumerate() {
            let time = STEP * (i + 1) as f64;
            let left = (-time / lag).exp();
            assert!((current - 3.0 * (1.0 - left)).abs() < 1e-5, "{lag} {time}: {current}");
            impulse += torque * STEP;
            let exact = 4.5 * (time - lag * (1.0 - left));
            assert!(
                (impulse - exact).abs() < 1e-5 * exact + 1e-9,
                "{lag} {time}: {impulse} {exact}"
            );
        }
    }
}

#[test]
fn a_bridge_that_is_off_lets_the_current_die() {
    let motor = RefCell::new(Motor::new("m", TORQUE, MotorParameters { lag: STEP, ..MOTOR }));
    let mut node = Node::new(Shaft::default(), &motor).unwrap();
    let mut at = |forwards, backwards, reversed, enabled| {
        motor
            .with(|motor| {
                motor.set_duty(Channel::Forwards, forwards);
                motor.set_duty(Channel::Backwards, backwards);
                motor.set_reversed(reversed);
                motor.set_enabled(enabled);
            })
            .unwrap();
        node.advance(40).unwrap();
        motor.with(|motor| motor.current()).unwrap()
    };
    let mut is = |expected: f32, [forwards, backwards]: [u16; 2], reversed, enabled| {
        let current = at(forwards, backwards, reversed, enabled);
        assert!((current - expected).abs() < 1e-6, "{expected}: {current}");
    };
    is(6.0, [100, 0], false, true);
    is(-6.0, [100, 0], true, true);
    is(-6.0, [0, 100], false, true);
    is(0.0, [100, 100], false, true);
    is(3.0, [75, 25], false, true);
    is(0.0, [75, 25], false, false);
}
