//! The plants that can be served: inputs and sensors as their scenes list them.

use dbd_kernel::readouts::Readout;
use dbd_kernel::{F32, InputIndex, Leapfrog, Plant};
use dbd_link::{KernelPlant, PlantEnd};

use crate::models::cart_pendulum::{
    CART_PENDULUM_F32, CART_PENDULUM_INPUT_DRIVE, CART_PENDULUM_READOUT_ANGLE_F32,
    CART_PENDULUM_READOUT_CART_POINT_F32, CART_PENDULUM_READOUT_CART_VELOCITY_F32,
    CART_PENDULUM_READOUT_RATE_F32, CART_PENDULUM_STEP, CartPendulumF32,
};
use crate::models::four_bar::{FOUR_BAR_F32, FOUR_BAR_STEP, FourBarF32};

/// \[bytes\] of the buffer for a snapshot.
pub const SNAPSHOT: usize = 4096;

/// The plant's end of a model with `I` inputs and `O` sensors.
pub type End<M, const I: usize, const O: usize> =
    PlantEnd<KernelPlant<&'static M, Leapfrog, I, O>, SNAPSHOT>;

/// Name of the cart-pendulum's scene.
pub const CART_PENDULUM: &str = "cart-pendulum";
/// Name of the four-bar's scene.
pub const FOUR_BAR: &str = "four-bar";

/// Inputs of the cart-pendulum.
pub const CART_PENDULUM_INPUTS: [InputIndex; 1] = [CART_PENDULUM_INPUT_DRIVE];
/// Sensors of the cart-pendulum.
pub const CART_PENDULUM_SENSORS: [Readout<F32>; 4] = [
    CART_PENDULUM_READOUT_CART_POINT_F32,
    CART_PENDULUM_READOUT_CART_VELOCITY_F32,
    CART_PENDULUM_READOUT_ANGLE_F32,
    CART_PENDULUM_READOUT_RATE_F32,
];

/// The cart-pendulum's end with a tick every `period` \[µs\]; 0 without a timer. The scene's step is accepted, so there is
/// one.
#[must_use]
pub fn cart_pendulum(period: u32) -> Option<End<CartPendulumF32, 1, 4>> {
    let plant = Plant::new(&CART_PENDULUM_F32, Leapfrog, CART_PENDULUM_STEP).ok()?;
    let (inputs, sensors) = (CART_PENDULUM_INPUTS, CART_PENDULUM_SENSORS);
    PlantEnd::new(KernelPlant::new(plant, CART_PENDULUM, inputs, sensors), period)
}

/// The four-bar's end, which has neither inputs nor sensors, with a tick every `period` \[µs\]; 0 without a timer.
#[must_use]
pub fn four_bar(period: u32) -> Option<End<FourBarF32, 0, 0>> {
    let plant = Plant::new(&FOUR_BAR_F32, Leapfrog, FOUR_BAR_STEP).ok()?;
    PlantEnd::new(KernelPlant::new(plant, FOUR_BAR, [], []), period)
}
