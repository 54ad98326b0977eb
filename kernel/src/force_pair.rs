//! Forces on two bodies: wrenches, records, directions.
//!
//! `force_pair => wrenches of its two bodies`.

use crate::space::{Linear as _, Space};

/// The force on a body and its torque.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Wrench<S: Space> {
    /// \[N\] force, world axes.
    pub force: S::Vector,
    /// \[N·m\] torque about the centre of mass, body axes once the evaluation is complete.
    pub torque: S::Moment,
    filler: S::Filler,
}

impl<S: Space> Wrench<S> {
    /// A force \[N\], world axes, and a torque \[N·m\].
    #[inline(always)]
    pub fn new(force: S::Vector, torque: S::Moment) -> Self {
        Self { force, torque, filler: Default::default() }
    }
}

/// The force pair of a group, world axes: force and torque on A, and the opposite of the torque on B; the force on B is
/// the opposite of A's.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ForcePair<S: Space> {
    /// \[N\] force on A.
    pub force: S::Vector,
    /// \[N·m\] torque on A about its centre of mass.
    pub torque_a: S::Moment,
    /// \[N·m\] the opposite of the torque on B about its centre of mass.
    pub torque_b: S::Moment,
}

impl<S: Space> ForcePair<S> {
    pub(crate) const ZERO: Self =
        Self { force: S::Vector::ZERO, torque_a: S::Moment::ZERO, torque_b: S::Moment::ZERO };

    /// The sum of this and another.
    #[inline(always)]
    pub(crate) fn with(&self, other: &Self) -> Self {
        Self {
            force: self.force + other.force,
            torque_a: self.torque_a + other.torque_a,
            torque_b: self.torque_b + other.torque_b,
        }
    }
}

/// A direction of relative motion of two bodies: a unit force along u on the second and the opposite on the first.
#[derive(Clone, Copy, Debug)]
pub struct Direction<S: Space> {
    /// u, world axes; 0 for moments only.
    pub along: S::Vector,
    /// The moments `r × u` of a unit force along u on both bodies, each in its body's axes; 0 for the ground.
    pub moments: [S::Moment; 2],
}

impl<S: Space> Direction<S> {
    /// The direction whose rate is the sum of the rates of this and another.
    #[inline(always)]
    #[must_use]
    pub fn with(&self, other: &Self) -> Self {
        let ([a, b], [c, d]) = (self.moments, other.moments);
        Self { along: self.along + other.along, moments: [a + c, b + d] }
    }

    /// The direction scaled so that the rate is `by` times as large.
    #[inline(always)]
    #[must_use]
    pub fn scaled(&self, by: S::Real) -> Self {
        Self { along: self.along * by, moments: self.moments.map(|moment| moment * by) }
    }
}

/// Adds a record to its two bodies; the world is skipped.
#[inline(always)]
pub(crate) fn apply<S: Space>(
    wrenches: &mut [Wrench<S>],
    a: usize,
    b: usize,
    force_pair: &ForcePair<S>,
) {
    if let Some(wrench) = wrenches.get_mut(a) {
        wrench.force = wrench.force + force_pair.force;
        wrench.torque = wrench.torque + force_pair.torque_a;
    }
    if let Some(wrench) = wrenches.get_mut(b) {
        wrench.force = wrench.force - force_pair.force;
        wrench.torque = wrench.torque - force_pair.torque_b;
    }
}
