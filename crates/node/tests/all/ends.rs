//! Every end does what its trait and its chip's data sheet say, on a rotor that is known exactly.

#[allow(dead_code, reason = "each test program uses a part of the rotor")]
use std::cell::RefCell;

use crate::shaft::{ANGLE, POINT, STEP, Shaft, TORQUE};
use dbd_kernel::F32;
use dbd_node::encoder::Counting as _;
use dbd_node::{
    Active, As5047p, BridgePin, Channel, ChipSelect, DutyEnd, Encoder, EncoderParameters,
    EncoderPin, EndStop, Fault, Ls7366r, Motor, MotorParameters, Node, NodeDelay, Probe,
    Shared as _, Side, Signal, SpiEnd, SpiWires, SwitchPin,
};
use embedded_hal::delay::DelayNs as _;
use embedded_hal::digital::{InputPin as _, OutputPin as _, StatefulOutputPin as _};
use embedded_hal::pwm::SetDutyCycle as _;
use embedded_hal::spi::{Operation, SpiBus, SpiDevice};

/// \[rad\] of a count of 14 bits.
const COUNT: f32 = core::f32::consts::TAU / 16_384.0;

fn encoder(counts: u32) -> Encoder<F32> {
    Encoder::new(Probe::scalar("angle", ANGLE), EncoderParameters::at_joint(counts))
}

/// A shaft that rests half a count beyond a number of counts.
fn resting(counts: i32) -> Shaft {
    Shaft { angle: (counts as f32 + 0.5) * COUNT, ..Shaft::default() }
}

#[test]
fn a_duty_turns_the_shaft_and_the_encoder_counts() {
    let motor = RefCell::new(Motor::new("drive", TORQUE, MotorParameters::ideal(2.0, 1000)));
    let encoder = RefCell::new(encoder(4096));
    let node = RefCell::new(Node::new(Shaft::default(), (&motor, &encoder)).unwrap());
    let mut duty = DutyEnd::new(&motor, Channel::Forwards).unwrap();
    let mut delay = NodeDelay::new(&node);
    assert_eq!(duty.max_duty_cycle(), 1000);
    duty.set_duty_cycle_percent(50).unwrap();
    delay.delay_ms(1000);
    // 1 N·m for a second: half a radian.
    assert_eq!(node.borrow().machine().steps, 1024);
    let angle = node.borrow().machine().angle;
    assert!((angle - 0.5).abs() < 1e-3);
    let counts = encoder.with(|encoder| encoder.counts()).unwrap();
    assert_eq!(counts, (angle / core::f32::consts::TAU * 4096.0) as i32);
    // Backwards, by the direction's pin and by the other channel; then off.
    let torque = || {
        node.borrow_mut().step().unwrap();
        node.borrow().machine().torque
    };
    let mut direction = BridgePin::direction(&motor).unwrap();
    direction.set_high().unwrap();
    assert!(direction.is_set_high().unwrap());
    assert_eq!(torque(), -1.0);
    direction.toggle().unwrap();
    assert_eq!(torque(), 1.0);
    DutyEnd::new(&motor, Channel::Backwards).unwrap().set_duty_cycle(750).unwrap();
    assert_eq!(torque(), -0.5);
    let mut enable = BridgePin::enable(&motor).unwrap();
    assert!(enable.is_set_high().unwrap());
    enable.set_low().unwrap();
    assert_eq!(torque(), 0.0);
    enable.set_high().unwrap();
    // More than all is refused and changes nothing.
    assert_eq!(duty.set_duty_cycle(1001), Err(Fault::Duty));
    assert_eq!(torque(), -0.5);
}

#[test]
fn waited_time_is_carried() {
    let node = RefCell::new(Node::new(Shaft::default(), ()).unwrap());
    let mut delay = NodeDelay::new(&node);
    let steps = || node.borrow().machine().steps;
    // 976562.5 ns are a step.
    delay.delay_ns(976_562);
    assert_eq!(steps(), 0);
    delay.delay_ns(1);
    assert_eq!(steps(), 1);
    for _ in 0..1_000_000 {
        delay.delay_ns(1_953);
    }
    // 1.953 s and 1.000000001 steps before it: 976563 ns.
    let waited = 1_953_000_000_u64 + 976_563;
    assert_eq!(steps(), waited * 1_024 / 1_000_000_000);
    assert!((node.borrow().time() - steps() as f64 * STEP).abs() < 1e-12);
    assert_eq!(delay.fault(), None);
}

/// Frames to an AS5047P, each in a chip select of its own, and the answers.
fn frames(spi: &mut impl SpiDevice<u16>, sent: &[u16]) -> Vec<u16> {
    let mut answers = Vec::new();
    for &frame in sent {
        let mut word = [frame];
        spi.transfer_in_place(&mut word).unwrap();
        answers.push(word[0]);
    }
    answers
}

const READ_ANGLE: u16 = 0xffff;
const NOP: u16 = 0xc000;
const READ_ERRORS: u16 = 0x4001;

#[test]
fn the_as5047p_answers_in_the_next_frame() {
    let chip = RefCell::new(As5047p::new(encoder(16_384)));
    let node = RefCell::new(Node::new(resting(0x1234), &chip).unwrap());
    let mut spi = SpiEnd::new(&chip).unwrap();
    // 0x1234 has five ones: the parity bit makes six. NOP answers 0.
    assert_eq!(frames(&mut spi, &[READ_ANGLE, NOP, NOP]), [0, 0x9234, 0]);
    // The turn is left out: −1 is the last count.
    node.borrow_mut().machine_mut().angle = -0.5 * COUNT;
    node.borrow_mut().step().unwrap();
    assert_eq!(frames(&mut spi, &[READ_ANGLE, READ_ANGLE, NOP]), [0, 0x3fff, 0x3fff]);
    assert_eq!(chip.with(|chip| chip.counts()), Ok(-1));
    // What its magnet's and settings' registers hold: DIAAGC, SETTINGS1.
    assert_eq!(frames(&mut spi, &[0xfffc, 0xc018, NOP])[1..], [0x0180, 0x8001]);
}

#[test]
fn the_as5047p_tells_errors_until_they_are_read() {
    let chip = RefCell::new(As5047p::new(encoder(16_384)));
    let _node = Node::new(resting(5), &chip).unwrap();
    let mut spi = SpiEnd::new(&chip).unwrap();
    // Odd parity; then what was wrong, which reading clears.
    let answers = frames(&mut spi, &[READ_ANGLE ^ 1, READ_ERRORS, READ_ERRORS, NOP]);
    assert_eq!(answers[1..], [0xc000, 0x8004, 0]);
    // A register that is not there.
    let answers = frames(&mut spi, &[0x7000 | 0x8000, READ_ERRORS, NOP]);
    assert_eq!(answers[1..], [0xc000, 0x8002]);
    // Both: they gather until they are read. A write to what is only read is such a command, too.
    let answers = frames(&mut spi, &[READ_ANGLE ^ 1, 0x3fff, READ_ERRORS, NOP]);
    assert_eq!(answers[1..], [0xc000, 0xc000, 0x0006]);
    // A frame of three bytes, and one of one.
    for length in [3, 1] {
        SpiDevice::<u8>::write(&mut spi, &[0xff; 3][..length]).unwrap();
        assert_eq!(frames(&mut spi, &[READ_ERRORS, NOP]), [0xc000, 0x8001]);
    }
    assert_eq!(frames(&mut spi, &[READ_ANGLE, NOP])[1], 5);
}

#[test]
fn the_as5047p_turns_about_its_zero_position() {
    let chip = RefCell::new(As5047p::new(encoder(16_384)));
    let _node = Node::new(resting(0x1003), &chip).unwrap();
    let mut spi = SpiEnd::new(&chip).unwrap();
    // ZPOSM and ZPOSL: 0x40 and 0x03 are 0x1003; a write is answered by the old and the new content.
    let answers =
        frames(&mut spi, &[0x0016 | 0x8000, 0x0040 | 0x8000, 0x0017, 0x0003, READ_ANGLE, NOP]);
    assert_eq!(answers[1..], [0, 0x8040, 0, 0x0003, 0]);
    // The other direction: DIR of SETTINGS1, and a zero of 0x1002.
    frames(&mut spi, &[0x0018, 0x0005, 0x0017, 0x0002 | 0x8000]);
    assert_eq!(frames(&mut spi, &[READ_ANGLE, NOP])[1], 0x3fff);
}

#[test]
fn a_bus_with_chip_selects_carries_several_chips() {
    let near = RefCell::new(As5047p::new(encoder(16_384)));
    let far = RefCell::new(Ls7366r::new(encoder(4_096)));
    let node = RefCell::new(Node::new(resting(0x0102), (&near, &far)).unwrap());
    let bus = RefCell::new(SpiWires::new((&near, &far)));
    // Nobody is selected: all ones.
    let mut nothing = [0; 2];
    bus.borrow_mut().read(&mut nothing).unwrap();
    assert_eq!(nothing, [0xff; 2]);
    // Drivers that share a bus, as firmware has them.
    let delay = || NodeDelay::new(&node);
    let device = |pin| embedded_hal_bus::spi::RefCellDevice::new(&bus, pin, delay()).unwrap();
    let mut angle = device(ChipSelect::new(&near).unwrap());
    let mut count =
        embedded_hal_bus::spi::RefCellDevice::new(&bus, ChipSelect::new(&far).unwrap(), delay())
            .unwrap();
    let mut word = [0xff; 2];
    angle.transfer_in_place(&mut word).unwrap();
    // Four counts per period.
    count.write(&[0x88, 0x03]).unwrap();
    node.borrow_mut().machine_mut().angle += 400.0 * COUNT;
    node.borrow_mut().step().unwrap();
    let mut counts = [0x60, 0, 0, 0, 0];
    count.transfer_in_place(&mut counts).unwrap();
    assert_eq!(counts, [0, 0, 0, 0, 100]);
    angle.transaction(&mut [Operation::Write(&[0xc0, 0x00])]).unwrap();
    assert_eq!(word, [0, 0]);
    let mut word = [0xff; 2];
    angle.transfer_in_place(&mut word).unwrap();
    assert_eq!(word, [0, 0]);
}

#[test]
fn the_ls7366r_counts_from_where_it_was_switched_on() {
    let chip = RefCell::new(Ls7366r::new(encoder(16_384)));
    let node = RefCell::new(Node::new(resting(1_000), &chip).unwrap());
    let mut spi = SpiEnd::new(&chip).unwrap();
    let to = |counts: i32| {
        node.borrow_mut().machine_mut().angle = resting(counts).angle;
        node.borrow_mut().step().unwrap();
    };
    let mut read = |instruction, bytes: usize| {
        let mut words = [instruction, 0_u8, 0, 0, 0];
        spi.transfer_in_place(&mut words[..=bytes]).unwrap();
        words[1..=bytes].iter().fold(0_u32, |value, &byte| value << 8 | u32::from(byte))
    };
    // As it is switched on: power was lost, counting is enabled, upwards; no quadrature.
    assert_eq!(read(0x70, 1), 0b1110);
    to(1_000 + 400);
    assert_eq!(read(0x60, 4), 100);
    let write = |bytes: &[u8]| {
        let mut spi = SpiEnd::new(&chip).unwrap();
        SpiDevice::<u8>::write(&mut spi, bytes).unwrap();
    };
    // Four per period; the counter cleared; the power's bit cleared.
    write(&[0x88, 0x03]);
    write(&[0x20]);
    write(&[0x30]);
    to(1_000);
    assert_eq!(read(0x60, 4) as i32, -400);
    assert_eq!(read(0x70, 1), 0b1001);
    // Two bytes wide: MDR1; a counter loaded from DTR; it wraps.
    write(&[0x90, 0x02]);
    write(&[0x98, 0xff, 0xf0]);
    write(&[0xe0]);
    assert_eq!(read(0x60, 2), 0xfff0);
    to(1_032);
    assert_eq!(read(0x60, 2), 0x0010);
    // What was read last is in OTR; disabled, nothing is counted.
    write(&[0x90, 0x06]);
    to(2_000);
    assert_eq!([read(0x68, 2), read(0x60, 2)], [0x0010, 0x0010]);
    write(&[0x90, 0x02]);
    to(1_999);
    assert_eq!(read(0x60, 2), 0x000f);
}

#[test]
fn quadrature_pins_tell_direction_and_turn() {
    let encoder = RefCell::new(encoder(16));
    let node = RefCell::new(Node::new(Shaft::default(), &encoder).unwrap());
    let [mut a, mut b, mut index] = [Signal::A, Signal::B, Signal::Index]
        .map(|signal| EncoderPin::new(&encoder, signal).unwrap());
    let mut at = |count: i32| {
        node.borrow_mut().machine_mut().angle =
            (count as f32 + 0.5) * core::f32::consts::TAU / 16.0;
        node.borrow_mut().step().unwrap();
        [a.is_high(), b.is_high(), index.is_high()].map(Result::unwrap).map(u8::from)
    };
    let up: Vec<_> = (0..5).map(&mut at).collect();
    assert_eq!(up, [[0, 0, 1], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 0]]);
    // A decoder's table on the pins gives the way back, over the turn's end.
    let (mut state, mut decoded) = (at(20), 20);
    for count in (-20..20).rev() {
        let next = at(count);
        let gray = |[a, b, _]: [u8; 3]| (a ^ b) | b << 1;
        decoded += match gray(next).wrapping_sub(gray(state)) & 3 {
            1 => 1,
            3 => -1,
            other => panic!("{other} counts at once"),
        };
        assert_eq!((decoded, next[2] == 1), (count, count % 16 == 0));
        state = next;
    }
    assert!(a.is_low().unwrap() != a.is_high().unwrap());
}

#[test]
fn an_end_stop_closes_at_its_threshold_and_opens_beyond_its_hysteresis() {
    let along = || Probe::along("stop", POINT, [0.0, 1.0, 0.0]);
    let right = RefCell::new(EndStop::new(along(), Side::Above, 0.5, 0.125));
    let left = RefCell::new(EndStop::new(along(), Side::Below, -0.5, 0.0));
    let node = RefCell::new(Node::new(Shaft::default(), (&right, &left)).unwrap());
    let mut right = SwitchPin::new(&right, Active::Low).unwrap();
    let mut left = SwitchPin::new(&left, Active::High).unwrap();
    let mut at = |angle: f32| {
        node.borrow_mut().machine_mut().angle = angle;
        node.borrow_mut().step().unwrap();
        [right.is_low(), left.is_high()].map(Result::unwrap)
    };
    for (angle, closed) in [
        (0.0, [false, false]),
        (0.49, [false, false]),
        (0.5, [true, false]),
        (0.376, [true, false]),
        (0.375, [true, false]),
        (0.374, [false, false]),
        (0.49, [false, false]),
        (0.6, [true, false]),
        (-0.5, [false, true]),
        (-0.49, [false, false]),
    ] {
        assert_eq!(at(angle), closed, "{angle}");
    }
}
