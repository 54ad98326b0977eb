//! Rollouts of several plants without SIMD lanes.
//!
//! `(plants, held inputs) => outputs after each hold`, one plant after the other.

use std::sync::Mutex;
use std::sync::atomic::AtomicBool;

use dbd_plant::instance::Instance;

use crate::rollout::{Course, Stop};

impl Course {
    /// Number of neighbouring plants that run together.
    pub(crate) fn group(&self, _: &[&Mutex<Instance>], _: usize) -> usize {
        1
    }

    /// The rows of each plant of a group.
    pub(crate) fn run_group(
        &self,
        plants: &[&Mutex<Instance>],
        held: &[&[f64]],
        ended: &AtomicBool,
    ) -> Vec<Result<Vec<f64>, Stop>> {
        self.run_each(plants, held, ended)
    }
}
