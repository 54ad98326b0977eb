//! Time-stepping schemes, one per file, behind one trait.

mod dbd;
mod leapfrog;

pub use dbd::{Dbd, DbdMemory};
pub use leapfrog::Leapfrog;

use crate::geometry::Geometry;
use crate::model::Terms;
use crate::status::Cause;
use crate::step::Stepper;

/// A one-step scheme of fixed cost.
pub trait Scheme: Copy {
    /// The name users give, also in summaries and golden tables.
    const NAME: &'static str;
    /// Order of convergence of a trajectory without dampers.
    const ORDER: u32;
    /// Largest stable `ω_max·h` of an undamped oscillator.
    const STABILITY_LIMIT: f64;
    /// Memory per body that the scheme needs within a step.
    type Memory<P: Geometry>: Copy + Default;

    /// Force evaluations per step, when nothing changes between steps.
    fn evaluations(&self) -> u32;

    /// One step of the size `stepper.h`. Ends with the state at the next step's start; the
    /// caller advances the counter and looks for non-finite velocities.
    ///
    /// # Errors
    /// The torsion spring whose twist is undefined; the state is then that of the stage.
    fn step<P: Geometry, T: Terms>(
        &self,
        stepper: &mut Stepper<'_, '_, P, T, Self::Memory<P>>,
    ) -> Result<(), Cause>;
}
