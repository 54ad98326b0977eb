//! How an orientation is stored and rotated, independent of the body's position.
//!
//! `(stored, rotation) => stored; stored => rotation matrix`. Each storage form is a type: the unit [`Quaternion`] and,
//! in the plane, [`Heading`] here, Euler angles in [`crate::euler`].

use core::fmt::Debug;

use crate::plane::Heading;
use crate::real::{Lanewise as _, Real};
use crate::space::Turn;
use crate::vector::{Quaternion, Rotation, Vec3};
use crate::words::Words;

/// The stored orientation of a body, body → world.
pub trait Attitude: Copy + Debug + Default + PartialEq + Send + Words + 'static {
    /// The number in which rotations are computed.
    type Real: Real;
    /// A relative orientation.
    type Turn: Turn<Real = Self::Real>;

    /// The name users give: `quaternion`.
    const NAME: &'static str;

    /// The rotation matrix.
    fn rotation(&self) -> Rotation<Self::Real>;
    /// The unit quaternion.
    fn quaternion(&self) -> Quaternion<Self::Real>;
    /// The rotation from the world's axes.
    fn since_world(&self) -> Self::Turn;
    /// Composes with a rotation given in body axes: `q ← q ∘ turn`.
    fn turn(&mut self, turn: Quaternion<Self::Real>);
    /// [`Self::turn`] about body axis `AXIS`, 0 to 2, by cosine and sine of half the angle.
    #[inline(always)]
    fn turn_about<const AXIS: usize>(&mut self, cos: Self::Real, sin: Self::Real) {
        let mut v = [Self::Real::ZERO; 3];
        v[AXIS] = sin;
        self.turn(Quaternion { w: cos, v: Vec3::new(v[0], v[1], v[2]) });
    }
    /// Restores `start` in the lanes selected by `resting`. With one lane the caller ensures that it is not selected.
    #[inline(always)]
    fn keep(&mut self, _resting: <Self::Real as Real>::Mask, _start: &Self) {}
    /// Restores unit length, or the range of angles, after the rotations of a step.
    fn renormalise(&mut self);
    /// Whether a rotation was not representable; the stored value is then not an orientation.
    #[inline(always)]
    fn is_lost(&self) -> bool {
        false
    }
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
    fn turn_about<const AXIS: usize>(&mut self, cos: R, sin: R) {
        *self = self.turned_about::<AXIS>(cos, sin);
    }
    #[inline(always)]
    fn keep(&mut self, resting: R::Mask, start: &Self) {
        *self = Quaternion::select(resting, *start, *self);
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

impl<R: Real> Attitude for Heading<R> {
    type Real = R;
    type Turn = Self;

    const NAME: &'static str = "heading";

    #[inline(always)]
    fn rotation(&self) -> Rotation<R> {
        Quaternion::from(*self).rotation()
    }
    #[inline(always)]
    fn quaternion(&self) -> Quaternion<R> {
        Quaternion::from(*self)
    }
    #[inline(always)]
    fn since_world(&self) -> Self {
        *self
    }
    /// Uses only the component about z.
    #[inline(always)]
    fn turn(&mut self, turn: Quaternion<R>) {
        *self = self.product(Heading::new(turn.w, turn.v.z));
    }
    #[inline(always)]
    fn renormalise(&mut self) {
        *self = self.renormalised();
    }
    fn from_f64(orientation: [f64; 4]) -> Self {
        Turn::from_f64(orientation)
    }
    fn to_f64(&self) -> [f64; 4] {
        Turn::to_f64(*self)
    }
}
