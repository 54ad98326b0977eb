//! Every end does what its trait and its chip's datasheet say, on a rotor that is known exactly.

mod shaft;

use std::cell::RefCell;

use dbd_node::{
    Channel, DutyEnd, Encoder, EncoderParameters, Fault, Motor, MotorParameters, Node, NodeDelay,
    Probe, Shared,
};
use embedded_hal::delay::DelayNs as _;
use embedded_hal::pwm::SetDutyCycle as _;
use shaft::{ANGLE, Shaft, TORQUE};

#[test]
fn a_duty_turns_the_shaft_and_the_encoder_counts() {
    let motor = RefCell::new(Motor::new("drive", TORQUE, MotorParameters::ideal(2.0, 1000)));
    let encoder =
        Encoder::<_, 0>::new(Probe::scalar("angle", ANGLE), EncoderParameters::at_joint(4096));
    let encoder = RefCell::new(encoder);
    let node = RefCell::new(Node::new(Shaft::default(), (&motor, &encoder)).unwrap());
    let mut duty = DutyEnd::new(&motor, Channel::Forwards).unwrap();
    let mut delay = NodeDelay::new(&node);
    assert_eq!(duty.max_duty_cycle(), 1000);
    duty.set_duty_cycle(500).unwrap();
    delay.delay_ms(1000);
    // 1 N·m for a second: half a radian.
    let node = node.borrow();
    assert_eq!(node.machine().steps, 1024);
    assert!((node.machine().angle - 0.5).abs() < 1e-3);
    use dbd_node::encoder::Counting as _;
    let counts = encoder.with(|encoder| encoder.counts()).unwrap();
    assert_eq!(counts, (node.machine().angle / core::f32::consts::TAU * 4096.0) as i32);
    assert_eq!(duty.set_duty_cycle(1001), Err(Fault::Duty));
}
