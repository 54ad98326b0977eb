//! What lanes step, and steps of a large scene in them, its joints and bodies beside one another.
//!
//! `(plant, steps) => plant`, with the bits that the plant has by itself. Scenes that lanes do not step, and small
//! ones, are stepped by their plant; so are steps on which lanes fail, and all after them.

use dbd_ensemble::{AnyLarge, lanes_in_f64, large_in_f32, large_in_f64};
use dbd_kernel::Status;
use dbd_plant::{AnyPlant, Method, Plan, PrecisionName};
use dbd_scene::Scene;

/// The fewest bodies that lanes step.
pub(super) const FEWEST: usize = 100;

/// How many runs of a method go in lockstep on this machine; 1 where lanes do not step it.
#[must_use]
pub fn lanes(method: &Method) -> usize {
    let leapfrog = Method::default();
    match method.precision() {
        PrecisionName::F64 if *method == leapfrog => lanes_in_f64(),
        PrecisionName::F32 if *method == leapfrog.with_precision(PrecisionName::F32) => {
            2 * lanes_in_f64()
        }
        _ => 1,
    }
}

/// The fewest steps between two looks that are worth the state's way from lanes to its plant.
const FEWEST_STEPS: u64 = 16;

/// A scene in lanes, where it is one for them.
pub(super) struct Rows {
    large: Option<Box<dyn AnyLarge>>,
    /// Steps made in lanes.
    steps: u64,
}

impl Rows {
    /// Of a run at its start, with as many steps between two looks.
    pub(super) fn new(scene: &Scene, method: &Method, plan: &Plan, steps: u64) -> Self {
        // Lanes that are not optimised, as in a build for tests, are slower than the plant.
        let is_slow = cfg!(debug_assertions) || steps < FEWEST_STEPS;
        if is_slow { Self::none() } else { Self::of(scene, method, plan.step) }
    }

    /// No lanes.
    pub(super) fn none() -> Self {
        Self { large: None, steps: 0 }
    }

    /// Of a run whatever its looks.
    pub(super) fn of(scene: &Scene, method: &Method, step: f64) -> Self {
        let is_large = scene.planar.is_none() && scene.model.bodies.len() >= FEWEST;
        let large = match method.precision() {
            _ if !is_large || lanes(method) == 1 => None,
            PrecisionName::F32 => large_in_f32(&scene.model, step),
            _ => large_in_f64(&scene.model, step),
        };
        Self { large, steps: 0 }
    }

    /// Whether there are any.
    #[cfg(test)]
    pub(super) fn are_there(&self) -> bool {
        self.large.is_some()
    }

    /// `steps` steps of `plant`, or as many as succeed.
    pub(super) fn advance(&mut self, plant: &mut dyn AnyPlant, steps: u64) -> Status {
        if let Some(large) = &mut self.large {
            if large.advance(steps).is_running() && plant.set_state(&large.state()).is_ok() {
                self.steps += steps;
                return Status::Running;
            }
            self.large = None;
        }
        plant.advance(steps)
    }

    /// The force evaluations of a run from t = 0 on, as its plant by itself makes them: the first step has two.
    pub(super) fn evaluations(&self, plant: &dyn AnyPlant) -> u64 {
        match (self.steps, plant.evaluations()) {
            (0, evaluations) => evaluations,
            (steps, 0) => steps + 1,
            (steps, evaluations) => steps + evaluations,
        }
    }
}
