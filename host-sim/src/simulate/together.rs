//! Similar runs in lockstep, one per SIMD lane, with the feature `lanes`.
//!
//! `(method, scenes, plan) => samples to each observer, endings`. Each run is bit-identical to a single run. Runs that
//! lanes cannot step, and runs that fail, are left to [`simulate`](super::simulate); without the feature these are
//! all runs.

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
    /// Receives its samples, also if it runs alone.
    pub observer: &'m mut dyn Observer,
}

#[cfg(not(feature = "lanes"))]
mod one_by_one {
    use dbd_plant::{Method, Plan};

    use super::Member;
    use crate::simulate::{Ending, SimulationError};

    /// Number of runs of a method in lockstep: 1 without the feature `lanes`.
    #[must_use]
    pub fn lanes(_: &Method) -> usize {
        1
    }

    /// `None` for every member: each runs alone.
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
