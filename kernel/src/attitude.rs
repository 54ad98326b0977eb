//! How an orientation is stored and turned, apart from where its body is.
//!
//! `(stored, turn) => stored; stored => rotation matrix`. A way of storing is one type: the unit
//! [`Quaternion`] here, Euler angles in [`crate::euler`].

use core::fmt::Debug;

use crate::real::Real;
use crate::space::Turn;
use crate::vector::{Quaternion, Rotation};
use crate::words::Words;

/// The stored orientation of a body, body → world.
pub trait Attitude: Copy + Debug + Default + PartialEq + Words + 'static {
    /// The number in which rotations are computed.
    type Real: Real;
    /// How one orientation stands to another.
    type Turn: Turn<Real = Self::Real>;

    /// The name users give: `quaternion`.
    const NAME: &'static str;

    /// The rotation matrix.
    fn rotation(&self) -> Rotation<Self::Real>;
    /// The unit quaternion.
    fn quaternion(&self) -> Quaternion<Self::Real>;
    /// The turn from the world's axes.
    fn since_world(&self) -> Self::Turn;
    /// Composes with a turn given in body axes: `q ← q ∘ turn`.
    fn turn(&mut self, turn: Quaternion<Self::Real>);
    /// Restores unit length, or the range of angles, after the turns of a step.
    fn renormalise(&mut self);
    /// Rounds a unit quaternion once, scalar first.
    fn from_f64(orientation: [f64; 4]) -> Self;
    /// The unit quaternion in double precision, scalar first.
    fn to_f64(&self) -> [f64; 4];

    /// The orientation of the second body in the axes of the first; `None` is the world.
    #[inline(always)]
    fn relative(first: Option<&Self>, second: Option<&Self>) -> Self::Turn {
        match (first, second) {
            (Some(a), Some(b)) => a.since_world().conjugate().product(b.since_world()),
            (Some(a), None) => a.since_world().conjugate(),
            (None, Some(b)) => b.since_world(),
            (None, None) => Self::Turn::default(),
        }
    }
}

impl<R: Real> Attitude for Quaternion<R> {
    type Real = R;
    type Turn = Self;

    const NAME: &'static str = "quaternion";

    #[inline(always)]
    fn rotation(&self) -> Rotation<R> {
        Quaternion::rotation(*self)
    }
    #[inline(always)]
    fn quaternion(&self) -> Quaternion<R> {
        *self
    }
    #[inline(always)]
    fn since_world(&self) -> Self {
        *self
    }
    #[inline(always)]
    fn turn(&mut self, turn: Quaternion<R>) {
        *self = self.product(turn);
    }
    #[inline(always)]
    fn renormalise(&mut self) {
        *self = self.renormalised();
    }
    fn from_f64(orientation: [f64; 4]) -> Self {
        Quaternion::from_f64(orientation)
    }
    fn to_f64(&self) -> [f64; 4] {
        Quaternion::to_f64(*self)
    }
}
