//! The kick that a damper pass follows.
//!
//! `(wrenches, diagonals) => change of velocity per body`.

use crate::body::{Diagonal, Fall, Increment};
use crate::forces::Wrench;
use crate::geometry::Geometry;
use crate::real::Real;
use crate::space::Space;

/// The kick that precedes a damper pass.
pub(crate) trait Kick<P: Geometry> {
    /// Whether there is one.
    const KNOWN: bool;
    /// The number of bodies in the kick, where it is stored.
    fn count(&self) -> Option<usize> {
        None
    }
    /// The change of velocity of the body in this row, `None` for the ground.
    fn of(&self, row: usize) -> Option<Increment<P::Space>>;
}

/// A damper pass without a preceding kick.
pub(crate) struct NoKick;

impl<P: Geometry> Kick<P> for NoKick {
    const KNOWN: bool = false;

    #[inline(always)]
    fn of(&self, _: usize) -> Option<Increment<P::Space>> {
        Some(Increment::default())
    }
}

/// The kick of half a step.
pub(crate) struct HalfKick<'s, S: Space> {
    pub(crate) wrenches: &'s [Wrench<S>],
    pub(crate) diagonals: &'s [Diagonal<S>],
    pub(crate) fall: Fall<S::Vector>,
}

impl<P: Geometry> Kick<P> for HalfKick<'_, P::Space> {
    const KNOWN: bool = true;

    #[inline(always)]
    fn of(&self, row: usize) -> Option<Increment<P::Space>> {
        let (wrench, diagonal) = (self.wrenches.get(row)?, self.diagonals.get(row)?);
        Some(diagonal.kick((wrench.force, wrench.torque), P::Real::HALF, self.fall))
    }
}

/// The kick of half a step, stored in place of the wrenches.
pub(crate) struct KeptKick<'s, S: Space> {
    pub(crate) kicks: &'s [Wrench<S>],
}

impl<P: Geometry> Kick<P> for KeptKick<'_, P::Space> {
    const KNOWN: bool = true;

    #[inline(always)]
    fn count(&self) -> Option<usize> {
        Some(self.kicks.len())
    }
    #[inline(always)]
    fn of(&self, row: usize) -> Option<Increment<P::Space>> {
        let kick = self.kicks.get(row)?;
        Some(Increment { linear: kick.force, angular: kick.torque })
    }
}
