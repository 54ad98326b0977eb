//! The kick that a damper pass follows.
//!
//! `(wrenches, diagonals) => change of velocity per body`.

use crate::body::{Diagonal, Increment};
use crate::forces::Wrench;
use crate::geometry::Geometry;
use crate::real::Real;
use crate::space::Space;

/// The kick that a sweep follows.
pub(crate) trait Kick<P: Geometry> {
    /// Whether there is one.
    const KNOWN: bool;
    /// Of how many bodies it knows, where it counts them.
    fn count(&self) -> Option<usize> {
        None
    }
    /// What it gave to the body in this row, `None` of the ground.
    fn of(&self, row: usize) -> Option<Increment<P::Space>>;
}

/// A sweep by itself: no kick came before.
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
    /// \[m/s\] by what bodies fall, `None` where their weights are among the wrenches.
    pub(crate) fall: Option<S::Vector>,
}

impl<P: Geometry> Kick<P> for HalfKick<'_, P::Space> {
    const KNOWN: bool = true;

    #[inline(always)]
    fn of(&self, row: usize) -> Option<Increment<P::Space>> {
        let (wrench, diagonal) = (self.wrenches.get(row)?, self.diagonals.get(row)?);
        let mut kick = diagonal.increment(wrench.force, wrench.torque, P::Real::HALF);
        if let Some(fall) = self.fall {
            kick.linear = kick.linear + fall;
        }
        Some(kick)
    }
}

/// The kick of half a step that stands in place of the wrenches.
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
