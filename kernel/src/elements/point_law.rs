//! What a law between two points owns: its energy, the directions in which its damper acts and its
//! share of the frequency bound.
//!
//! A law acts along the way from a point of A to a point of B; [`crate::forces`] holds the walk that
//! places its points.

use crate::real::Real as _;
use crate::space::Vector;

/// An element at a pose, world axes.
#[derive(Clone, Copy, Debug)]
pub struct Stretch<V: Vector> {
    /// \[m\] from its first point to its second; on a line from the foot to the point.
    pub displacement: V,
    /// \[1\] the direction of its line or axis; 0 where the law knows none.
    pub direction: V,
    /// \[1\] how much stiffer it is along its axis than across; of revolute joints alone.
    pub ratio: V::Real,
    /// \[m\] how far the axes of a joint are from how it holds them, at their lever.
    pub lean: V::Real,
}

impl<V: Vector> Stretch<V> {
    /// Of a law that knows neither line nor axis.
    #[inline(always)]
    pub fn of(displacement: V) -> Self {
        let zero = V::Real::ZERO;
        Self { displacement, direction: V::ZERO, ratio: zero, lean: zero }
    }
}

/// What energies, sweeps, read-outs and frequencies ask of a law.
pub trait PointLaw<V: Vector> {
    /// \[m\] how far the element is from its free length.
    fn extension(&self, stretch: &Stretch<V>) -> V::Real;

    /// \[J\] stored energy, beyond a clearance \[m\] if there is one.
    fn energy(&self, stretch: &Stretch<V>, clearance: Option<V::Real>) -> V::Real;

    /// The directions in which its damper acts, and how many of them there are.
    fn damped(stretch: &Stretch<V>) -> ([V; 3], usize);

    /// Its tangent as springs, `add(κ \[N/m\], direction)`, which act on a body at the end of `arm`
    /// \[m\]; returns \[N·m\] what its force does to a turn of the body, in any direction at most.
    fn tangent(&self, stretch: &Stretch<V>, arm: V, add: &mut impl FnMut(V::Real, V)) -> V::Real;
}

/// The tangent that a tension \[N\] adds to whatever it pulls along `displacement`: |T|/L along both
/// normals; returns |T|·|arm|.
#[inline(always)]
pub(crate) fn taut<V: Vector>(
    tension: V::Real,
    displacement: V,
    arm: V,
    add: &mut impl FnMut(V::Real, V),
) -> V::Real {
    let inverse = displacement.dot(displacement).sqrt().reciprocal_or_zero();
    for n in (displacement * inverse).normals() {
        add(tension * inverse, n);
    }
    tension * arm.dot(arm).sqrt()
}
