//! What a law between two points owns: its energy, the directions in which its damper acts and its
//! share of the frequency bound.
//!
//! A law acts along the way from a point of A to a point of B; [`crate::forces`] holds the walk that
//! places its points.

use crate::real::Real;
use crate::vector::Vec3;

/// An element at a pose, world axes.
#[derive(Clone, Copy, Debug, Default)]
pub struct Stretch<R> {
    /// \[m\] from its first point to its second; on a line from the foot to the point.
    pub displacement: Vec3<R>,
    /// \[1\] the direction of its line or axis; \[m\] of a universal joint what its lean gains for a
    /// small turn of the second body; 0 where the law knows none.
    pub direction: Vec3<R>,
    /// \[1\] how much stiffer it is along its axis than across; of axial bushings alone.
    pub ratio: R,
    /// \[m\] how far its axes lean from square, at their lever; of universal joints alone.
    pub lean: R,
}

impl<R: Real> Stretch<R> {
    /// Of a law that knows no line.
    pub fn of(displacement: Vec3<R>) -> Self {
        let (direction, zero) = (Vec3::ZERO, R::ZERO);
        Self { displacement, direction, ratio: zero, lean: zero }
    }
}

/// What energies, sweeps, read-outs and frequencies ask of a law.
pub trait PointLaw<R: Real> {
    /// \[m\] how far the element is from its free length.
    fn extension(&self, stretch: &Stretch<R>) -> R;

    /// \[J\] stored energy, beyond a clearance \[m\] if there is one.
    fn energy(&self, stretch: &Stretch<R>, clearance: Option<R>) -> R;

    /// The directions in which its damper acts, and how many of them there are.
    fn damped(stretch: &Stretch<R>) -> ([Vec3<R>; 3], usize);

    /// Its tangent as springs, `add(κ \[N/m\], direction)`, which act on a body at the end of `arm`
    /// \[m\]; returns \[N·m\] what its force does to a turn of the body, in any direction at most.
    fn tangent(&self, stretch: &Stretch<R>, arm: Vec3<R>, add: &mut impl FnMut(R, Vec3<R>)) -> R;
}

/// The tangent that a tension \[N\] adds to whatever it pulls along `displacement`: |T|/L along both
/// normals; returns |T|·|arm|.
#[inline(always)]
pub(crate) fn taut<R: Real>(
    tension: R,
    displacement: Vec3<R>,
    arm: Vec3<R>,
    add: &mut impl FnMut(R, Vec3<R>),
) -> R {
    let inverse = displacement.dot(displacement).sqrt().reciprocal_or_zero();
    for n in (displacement * inverse).normals() {
        add(tension * inverse, n);
    }
    tension * arm.dot(arm).sqrt()
}
