//! Dampers joint by joint in a scheme of kicks and drifts.
//!
//! `JointWise(Leapfrog)` replaces a joint's three to nine dampers by at most six damping modes, which are mutually
//! independent (see [`crate::damping`]): fewer, and constant for a joint to the ground. They are constant in the axes
//! of the joint's second body, as at the start: the damping law differs from that of the single dampers by the rotation
//! of their directions with the joint's deflection. Order, limits and conserved quantities are those of damper passes.
//! Without dampers the bits are those of the scheme itself.

use crate::damping::Damping;
use crate::forces::DampersOfJoints;
use crate::geometry::Geometry;
use crate::keep::DampingModes;
use crate::model::Terms;
use crate::schemes::{Kicked, Scheme};
use crate::status::Cause;
use crate::step::Stepper;

/// A scheme whose dampers act joint by joint in place of its damper passes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(all(feature = "defmt", target_os = "none"), derive(defmt::Format))]
pub struct JointWise<S>(pub S);

impl<S: Kicked> Scheme for JointWise<S> {
    const NAME: &'static str = S::NAME;
    const ORDER: u32 = S::ORDER;
    const ORDER_DAMPED: u32 = S::ORDER_DAMPED;
    const DAMPING: Damping = Damping::JointWise;
    const ADVANCES: bool = S::ADVANCES;
    const DRIVES: bool = S::DRIVES;
    type Memory<P: Geometry> = S::Memory<P>;
    type Storage = DampingModes;

    fn evaluations(&self) -> u32 {
        self.0.evaluations()
    }

    fn stability_limit(&self) -> f64 {
        self.0.stability_limit()
    }

    #[inline]
    fn step<P: Geometry, T: Terms<P>>(
        &self,
        stepper: &mut Stepper<'_, '_, P, T, S::Memory<P>>,
    ) -> Result<(), Cause> {
        S::step_with::<P, T, DampersOfJoints>(stepper)
    }
}
