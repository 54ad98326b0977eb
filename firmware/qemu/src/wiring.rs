//! The motors and encoders between the shipped plants and their controllers' drivers.
//!
//! `() => parts of a node`. Cart and pendulum have the motor of the Quanser IP02 (User Manual 2002, table
//! 4: 2.6 Ω, 7.67 mN·m/A, planetary gear 3.71, pinion of 6.35 mm, encoder pinion of 14.83 mm) at
//! 12 V. The delta's servo drives hold their current; encoders sit on the motors, before gears of
//! 20. All encoders are AS5047P, whose noise is 0.068° r.m.s. at most by its data sheet; a third of it
//! is taken here.

use core::f64::consts::TAU;

use dbd_kernel::readouts::Readout;
use dbd_kernel::{F32, InputIndex};
use dbd_node::as5047p::COUNTS;
use dbd_node::{
    As5047p, Encoder, EncoderParameters, Errors, Motor, MotorParameters, Probe, Supply,
};

use crate::models::cart_pendulum::{
    CART_PENDULUM_INPUT_DRIVE, CART_PENDULUM_READOUT_ANGLE_F32,
    CART_PENDULUM_READOUT_CART_POINT_F32, CART_PENDULUM_READOUT_CART_VELOCITY_F32,
};
use crate::models::delta_pick_and_place as delta;

/// Of all sensors' noise.
pub const SEED: u64 = 14;
/// \[rad\] of an encoder's shaft.
const NOISE: f64 = 0.068 / 3.0 * TAU / 360.0;
/// \[m\].
const PINION: f64 = 6.35e-3;
const CART_TURN: f64 = TAU * 0.01483;
const PLANETARY: f64 = 3.71;
/// Turns of a motor of the delta per turn of its arm.
const GEAR: f64 = 20.0;

/// An encoder with its chip, on time.
pub type Chip = As5047p<Encoder<F32>>;

/// A chip that samples at a fixed number of steps: once per tick of its controller.
fn chip(probe: Probe<F32>, turn: f64, noise: f64, every: u32) -> Chip {
    let errors = Errors { noise, seed: SEED, ..Errors::NONE };
    As5047p::new(Encoder::new(probe, EncoderParameters { counts: COUNTS, turn, every, errors }))
}

/// The cart's motor, on the input `drive`.
#[must_use]
pub fn cart_motor() -> Motor<F32> {
    let constant = 7.67e-3;
    let parameters = MotorParameters {
        supply: Supply::Voltage { full: 12.0, resistance: 2.6, back_emf: constant },
        torque_constant: constant,
        most_current: 5.0,
        // 0.18 mH.
        lag: 0.18e-3 / 2.6,
        friction: 0.0,
        friction_speed: 1.0,
        ratio: PLANETARY / PINION,
        most_duty: 1_000,
    };
    let speed = CART_PENDULUM_READOUT_CART_VELOCITY_F32;
    Motor::new("drive", CART_PENDULUM_INPUT_DRIVE, parameters).with_speed(Probe::along(
        "cart_velocity",
        speed,
        [1.0, 0.0, 0.0],
    ))
}

/// The cart's encoder, on the read-out `cart_point`.
#[must_use]
pub fn cart_encoder() -> Chip {
    let probe = Probe::along("cart_point", CART_PENDULUM_READOUT_CART_POINT_F32, [1.0, 0.0, 0.0]);
    chip(probe, CART_TURN, NOISE * CART_TURN / TAU, 2)
}

/// The pendulum's encoder, on the read-out `angle`.
#[must_use]
pub fn pendulum_encoder() -> Chip {
    chip(Probe::scalar("angle", CART_PENDULUM_READOUT_ANGLE_F32), TAU, NOISE, 2)
}

/// The delta's inputs and read-outs of the angles, by their names.
const ARMS: [(&str, InputIndex, &str, Readout<F32>); 3] = [
    (
        "drive1",
        delta::DELTA_PICK_AND_PLACE_INPUT_DRIVE1,
        "angle1",
        delta::DELTA_PICK_AND_PLACE_READOUT_ANGLE1_F32,
    ),
    (
        "drive2",
        delta::DELTA_PICK_AND_PLACE_INPUT_DRIVE2,
        "angle2",
        delta::DELTA_PICK_AND_PLACE_READOUT_ANGLE2_F32,
    ),
    (
        "drive3",
        delta::DELTA_PICK_AND_PLACE_INPUT_DRIVE3,
        "angle3",
        delta::DELTA_PICK_AND_PLACE_READOUT_ANGLE3_F32,
    ),
];

/// The motors of the delta's arms, of 40 N·m at full duty.
#[must_use]
pub fn delta_motors() -> [Motor<F32>; 3] {
    let parameters = MotorParameters {
        supply: Supply::Current { full: 40.0 },
        torque_constant: 1.0,
        most_current: 40.0,
        lag: 0.5e-3,
        friction: 0.0,
        friction_speed: 1.0,
        ratio: GEAR,
        most_duty: 4_000,
    };
    ARMS.map(|(name, input, ..)| Motor::new(name, input, parameters))
}

/// The encoders on those motors' shafts.
#[must_use]
pub fn delta_encoders() -> [Chip; 3] {
    ARMS.map(|(.., name, angle)| chip(Probe::scalar(name, angle), TAU / GEAR, NOISE / GEAR, 5))
}
