//! Alike runs in lockstep, one per SIMD lane, which the feature `lanes` brings.
//!
//! `(method, scenes, plan) => samples to each observer, endings`. Each run has the bits of a run by itself. What lanes
//! cannot step, and what fails on its way, is left to [`simulate`](super::simulate); without the feature that is
//! every run.

#[cfg(feature = "lanes")]
mod lockstep;

use dbd_scene::Scene;

use super::run::Observer;

#[cfg(feature = "lanes")]
pub use lockstep::{lanes, simulate_together};
#[cfg(not(feature = "lanes"))]
pub use one_by_one::{lanes, simulate_together};

/// One of several runs.
pub struct Member<'m> {
    /// Its scene.
    pub scene: &'m Scene,
    /// Hears of its samples; of those of a run that is left to itself, too.
    pub observer: &'m mut dyn Observer,
}

#[cfg(not(feature = "lanes"))]
mod one_by_one {
    use dbd_plant::{Method, Plan};

    use super::Member;
    use crate::simulate::{Ending, SimulationError};

    /// How many runs of a method go in lockstep: without the feature `lanes` each runs by itself.
    #[must_use]
    pub fn lanes(_: &Method) -> usize {
        1
    }

    /// `None` for every member: each runs by itself.
    ///
    /// # Errors
    /// None.
    pub fn simulate_together(
        _: &Method,
        _: &Plan,
        members: &mut [Member<'_>],
    ) -> Result<Vec<Option<Ending>>, SimulationError> {
        Ok(members.iter().map(|_| None).collect())
    }
}
