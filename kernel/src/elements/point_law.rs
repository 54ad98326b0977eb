//! The law between two points: its energy, the directions of its damper and its part of the frequency bound.
//!
//! A law acts along the displacement from a point of A to a point of B; [`crate::forces`] contains the loop that
//! computes its points.

use crate::real::Real as _;
use crate::space::Vector;

/// An element at a pose, world axes.
#[derive(Clone, Copy, Debug)]
pub struct Deformation<V: Vector> {
    /// \[m\] from its first point to its second; for a line from the foot to the point.
    pub displacement: V,
    /// \[1\] the direction of its line or axis; 0 where the law has none.
    pub direction: V,
    /// \[1\] excess of the axial over the radial stiffness; revolute joints only.
    pub ratio: V::Real,
    /// \[m\] the axis error of a joint, at its lever arm.
    pub axis_error: V::Real,
}

impl<V: Vector> Deformation<V> {
    /// For a law without a line or an axis.
    #[inline(always)]
    pub fn of(displacement: V) -> Self {
        let zero = V::Real::ZERO;
        Self { displacement, direction: V::ZERO, ratio: zero, axis_error: zero }
    }
}

/// What energies, damper passes, sensors and frequencies need from a law.
pub trait PointLaw<V: Vector> {
    /// \[m\] the difference to the element's free length.
    fn extension(&self, deformation: &Deformation<V>) -> V::Real;

    /// \[J\] stored energy, beyond a clearance \[m\] if there is one.
    fn energy(&self, deformation: &Deformation<V>, clearance: Option<V::Real>) -> V::Real;

    /// The directions in which its damper acts, and their number.
    fn damped(deformation: &Deformation<V>) -> ([V; 3], usize);

    /// Its tangent as springs, `add(κ \[N/m\], direction)`, that act on a body at the end of `arm` \[m\], and the
    /// effect of its force on a rotation of the body.
    fn tangent(
        &self,
        deformation: &Deformation<V>,
        arm: V,
        add: &mut impl FnMut(V::Real, V),
    ) -> Turning<V>;
}

/// The effect of an element's force on a rotation of a body.
#[derive(Clone, Copy, Debug)]
pub struct Turning<V: Vector> {
    /// \[N\] the part of the force on A, world axes, that acts on a point of the body.
    pub force: V,
    /// \[N·m/rad\] an upper bound of the remaining stiffness, about any axis.
    pub rest: V::Real,
}

impl<V: Vector> Turning<V> {
    /// A force on a point of the body only.
    pub(crate) fn of_force(force: V) -> Self {
        Self { force, rest: V::Real::ZERO }
    }

    /// A stiffness about any axis.
    pub(crate) fn about_any_axis(rest: V::Real) -> Self {
        Self { force: V::ZERO, rest }
    }
}

/// The geometric stiffness of a tension \[N\] along `displacement`: |T|/L along both normals, and the effect of its
/// force on a rotation.
#[inline(always)]
pub(crate) fn geometric_stiffness<V: Vector>(
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
