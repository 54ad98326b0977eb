//! Explicit dampers in a scheme of kicks and drifts: the baseline for damper passes.
//!
//! `Explicit(Leapfrog)` adds the dampers' forces at the velocities of each evaluation, as plain steps in the literature
//! do, instead of the damper passes of [`crate::damping`]. First order with dampers; their forces are part of the
//! wrench, so no evaluation can be reused in the next step, and a damper of coefficient c on an effective mass μ alone
//! limits the step to about 2·μ/c. Without dampers the bits are those of the scheme itself. For comparison; not
//! recommended.

use crate::damping::Damping;
use crate::forces::{Dampers, ExplicitDampers};
use crate::geometry::Geometry;
use crate::keep::NoStorage;
use crate::model::Terms;
use crate::schemes::Scheme;
use crate::status::Cause;
use crate::step::Stepper;

/// A scheme whose dampers can be damper passes or, within its kicks, explicit forces. Schemes with negative substeps
/// are excluded: there a damper would add energy.
pub trait Kicked: Scheme {
    /// Evaluations per step with explicit dampers.
    const EXPLICIT_EVALUATIONS: u32;

    /// A step, with explicit dampers or damper passes, depending on `D`.
    ///
    /// # Errors
    /// As [`Scheme::step`].
    fn step_with<P: Geometry, T: Terms<P>, D: Dampers>(
        stepper: &mut Stepper<'_, '_, P, T, Self::Memory<P>>,
    ) -> Result<(), Cause>;
}

/// A scheme with explicit dampers in place of its damper passes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(all(feature = "defmt", target_os = "none"), derive(defmt::Format))]
pub struct Explicit<S>(pub S);

impl<S: Kicked> Scheme for Explicit<S> {
    const NAME: &'static str = S::NAME;
    const ORDER: u32 = S::ORDER;
    const ORDER_DAMPED: u32 = 1;
    const DAMPING: Damping = Damping::Explicit;
    const ADVANCES: bool = S::ADVANCES;
    const DRIVES: bool = S::DRIVES;
    type Memory<P: Geometry> = S::Memory<P>;
    type Storage = NoStorage;

    fn evaluations(&self) -> u32 {
        S::EXPLICIT_EVALUATIONS
    }

    fn stability_limit(&self) -> f64 {
        self.0.stability_limit()
    }

    #[inline(always)]
    fn step<P: Geometry, T: Terms<P>>(
        &self,
        stepper: &mut Stepper<'_, '_, P, T, S::Memory<P>>,
    ) -> Result<(), Cause> {
        S::step_with::<P, T, ExplicitDampers>(stepper)
    }
}
