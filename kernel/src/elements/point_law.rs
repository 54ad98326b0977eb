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
    /// \[m\], and what its force does to a turn of the body.
    fn tangent(&self, stretch: &Stretch<V>, arm: V, add: &mut impl FnMut(V::Real, V))
    -> Turning<V>;
}

/// What the force of an element does to a turn of a body.
#[derive(Clone, Copy, Debug)]
pub struct Turning<V: Vector> {
    /// \[N\] the part of the force on A, world axes, that acts on a point of the body.
    pub force: V,
    /// \[N·m/rad\] the stiffness of all else, about any axis at most.
    pub rest: V::Real,
}

impl<V: Vector> Turning<V> {
    /// A force on a point of the body alone.
    pub(crate) fn of_force(force: V) -> Self {
        Self { force, rest: V::Real::ZERO }
    }

    /// A stiffness about any axis.
    pub(crate) fn about_any_axis(rest: V::Real) -> Self {
        Self { force: V::ZERO, rest }
    }
}

/// The tangent that a tension \[N\] adds to whatever it pulls along `displacement`: |T|/L along both
/// normals, and what its force does to a turn.
#[inline(always)]
pub(crate) fn taut<V: Vector>(
    tension: V::Real,
    displacement: V,
    add: &mut impl FnMut(V::Real, V),
) -> Turning<V> {
    let inverse = displacement.dot(displacement).sqrt().reciprocal_or_zero();
    let along = displacement * inverse;
    if tension != V::Real::ZERO {
        for n in along.normals() {
            add(tension.abs() * inverse, n);
        }
    }
    Turning::of_force(along * tension)
}
