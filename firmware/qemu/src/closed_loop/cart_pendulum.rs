//! The cart-pendulum, balanced: 1 kHz, two steps in a tick, real time.
//!
//! Samples: the cart's position \[m\] and the pendulum's angle from upright \[rad\] as the controller sees
//! them, the force \[N\] that it asks for.

use core::cell::RefCell;

use dbd_kernel::{F32, Leapfrog, Plant};
use dbd_node::fault::{Problem, WiringError};
use dbd_node::{BridgePin, Channel, DutyEnd, Machine, Node, SpiEnd};

use super::{Loop, LoopError, Sample};
use crate::controllers::balance::{self, Balance};
use crate::models::cart_pendulum::{CART_PENDULUM_F32, CART_PENDULUM_STEP};
use crate::wiring;

/// Steps in a tick.
const STEPS: u64 = 2;

/// The loop.
#[derive(Clone, Copy, Debug, Default)]
pub struct CartPendulum;

impl Loop for CartPendulum {
    const NAME: &'static str = "cart-pendulum";
    const TICK: u32 = balance::TICK / 1_000;
    const PERIOD: u32 = Self::TICK;

    fn with(
        &self,
        ticks: impl FnOnce(
            &mut dyn FnMut() -> Result<(Sample, u64), LoopError>,
        ) -> Result<(), LoopError>,
    ) -> Result<(), LoopError> {
        let refused = WiringError { name: "plant", problem: Problem::Parameter("the step") };
        let plant = Plant::new(&CART_PENDULUM_F32, Leapfrog, CART_PENDULUM_STEP)
            .map_err(|_| LoopError::Wiring(refused))?;
        balanced(plant, Plant::hash, ticks)
    }
}

/// Wires motor, encoders and controller to a machine, in this image or at the far end of a line. `hash` is that of its
/// state.
///
/// # Errors
/// [`LoopError::Wiring`], and what `ticks` returns.
pub fn balanced<M: Machine<Real = f32, Precision = F32>>(
    machine: M,
    hash: impl Fn(&M) -> u64,
    ticks: impl FnOnce(&mut dyn FnMut() -> Result<(Sample, u64), LoopError>) -> Result<(), LoopError>,
) -> Result<(), LoopError> {
    let motor = RefCell::new(wiring::cart_motor());
    let cart = RefCell::new(wiring::cart_encoder());
    let pendulum = RefCell::new(wiring::pendulum_encoder());
    let mut node = Node::new(machine, (&motor, &cart, &pendulum)).map_err(LoopError::Wiring)?;
    let mut controller = Balance::new(
        SpiEnd::new(&cart).map_err(LoopError::Wiring)?,
        SpiEnd::new(&pendulum).map_err(LoopError::Wiring)?,
        DutyEnd::new(&motor, Channel::Forwards).map_err(LoopError::Wiring)?,
        BridgePin::direction(&motor).map_err(LoopError::Wiring)?,
        balance::Constants::IP02,
    );
    ticks(&mut || {
        node.advance(STEPS).map_err(LoopError::Plant)?;
        let seen = controller.tick().map_err(LoopError::Control)?;
        let sample = Sample::of([seen.cart, seen.axis_error, seen.force]);
        Ok((sample, hash(node.machine())))
    })
}
