//! The delta robot, its tool led along a circle: 4 kHz, five steps in a tick.
//!
//! Samples: what each arm is behind \[rad\] as the controller sees it. A Cortex-M4F does not step this plant in
//! real time: a tick of 250 µs is given [`Loop::PERIOD`].

use core::cell::RefCell;

use dbd_kernel::{Leapfrog, Plant};
use dbd_node::fault::{Problem, WiringError};
use dbd_node::{BridgePin, Channel, DutyEnd, Node, SpiEnd};

use super::{Loop, LoopError, Sample};
use crate::controllers::follow::{self, Follow};
use crate::models::delta_pick_and_place as scene;
use crate::wiring;

/// Steps in a tick.
const STEPS: u64 = 5;

/// The loop.
#[derive(Clone, Copy, Debug, Default)]
pub struct Delta;

impl Loop for Delta {
    const NAME: &'static str = "delta-pick-and-place";
    const TICK: u32 = follow::TICK / 1_000;
    const PERIOD: u32 = 20 * Self::TICK;

    fn with(
        &self,
        ticks: impl FnOnce(
            &mut dyn FnMut() -> Result<(Sample, u64), LoopError>,
        ) -> Result<(), LoopError>,
    ) -> Result<(), LoopError> {
        let motors = wiring::delta_motors().map(RefCell::new);
        let encoders = wiring::delta_encoders().map(RefCell::new);
        let refused = WiringError { name: "plant", problem: Problem::Parameter("the step") };
        let model = &scene::DELTA_PICK_AND_PLACE_F32;
        let plant = Plant::new(model, Leapfrog, scene::DELTA_PICK_AND_PLACE_STEP)
            .map_err(|_| LoopError::Wiring(refused))?;
        let parts = (motors.each_ref(), encoders.each_ref());
        let mut node = Node::new(plant, parts).map_err(LoopError::Wiring)?;
        let [first, second, third] = [0, 1, 2].map(|arm| {
            Ok((
                SpiEnd::new(&encoders[arm])?,
                DutyEnd::new(&motors[arm], Channel::Forwards)?,
                BridgePin::direction(&motors[arm])?,
            ))
        });
        let arms = [
            first.map_err(LoopError::Wiring)?,
            second.map_err(LoopError::Wiring)?,
            third.map_err(LoopError::Wiring)?,
        ];
        let mut controller = Follow::new(arms, follow::Constants::DELTA);
        ticks(&mut || {
            node.advance(STEPS).map_err(LoopError::Plant)?;
            let seen = controller.tick().map_err(LoopError::Control)?;
            Ok((Sample::of(seen.off), node.machine().hash()))
        })
    }
}
