//! A universal joint without a spider: a point bushing, and two axes kept perpendicular by a spring.
//!
//! `(d, q, v_rel, q̇) => force on A = k·d + c·v_rel, torque on A = (k·q + c·q̇)·m`; on B the opposite. `q = l·n` is the
//! axis error \[m\], 0 for perpendicular axes: n the unit axis of B, l that of A with the length of its lever arm.
//! `m = n × l` is the derivative of q with respect to a small rotation of B, `q̇ = m·(ω_B − ω_A)`. Energy
//! `½·k·(d·d + q²)`, so the lever arm ℓ makes a stiffness k·ℓ² against rotation about l × n. Smooth everywhere, without
//! a root or a division. As for a point bushing, the damper's `c·v_rel` conserves angular momentum only up to d.

use crate::elements::point_law::{Deformation, PointLaw, Turning};
use crate::real::Real as _;
use crate::space::{Linear as _, Space, Vector as _};

/// The constants of a universal joint.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Universal<S: Space> {
    /// \[N/m\] stiffness in every direction, ≥ 0.
    pub stiffness: S::Real,
    /// \[m\] axis of the first body in its axes, with the length of its lever arm.
    pub lever: S::Vector,
    /// \[1\] unit axis of the second body in its axes.
    pub axis: S::Vector,
}

/// The axis error of two axes, world.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct AxisError<S: Space> {
    /// \[m\] `l·n`.
    pub(crate) by: S::Real,
    /// \[m\] `n × l`.
    pub(crate) gradient: S::Moment,
}

impl<S: Space> AxisError<S> {
    #[inline(always)]
    pub(crate) fn new(lever: S::Vector, axis: S::Vector) -> Self {
        Self { by: lever.dot(axis), gradient: axis.cross(lever) }
    }
}

impl<S: Space> Universal<S> {
    /// Each constant rounded once from double precision.
    pub fn from_f64(stiffness: f64, lever: [f64; 3], axis: [f64; 3]) -> Self {
        Self {
            stiffness: S::Real::from_f64(stiffness),
            lever: S::Vector::from_f64(lever),
            axis: S::Vector::from_f64(axis),
        }
    }

    /// The same constants in another precision.
    pub fn convert<Q: Space>(&self) -> Universal<Q> {
        let (lever, axis) = (self.lever.to_f64(), self.axis.to_f64());
        Universal::from_f64(self.stiffness.to_f64(), lever, axis)
    }
}

impl<S: Space> PointLaw<S::Vector> for Universal<S> {
    /// \[m\] of the point and the axes together, `√(d·d + q²)`.
    #[inline]
    fn extension(&self, deformation: &Deformation<S::Vector>) -> S::Real {
        let (d, q) = (deformation.displacement, deformation.axis_error);
        (d.dot(d) + q * q).sqrt()
    }

    /// A universal joint has no clearance.
    #[inline]
    fn energy(&self, deformation: &Deformation<S::Vector>, _: Option<S::Real>) -> S::Real {
        let (d, q) = (deformation.displacement, deformation.axis_error);
        S::Real::HALF * self.stiffness * (d.dot(d) + q * q)
    }

    /// Along the world's axes; the damper that holds the axes is a moment and is visited separately.
    #[inline(always)]
    fn damped(_: &Deformation<S::Vector>) -> ([S::Vector; 3], usize) {
        (S::Vector::axes(), S::Vector::DIMENSION)
    }

    /// k in every direction, the effect of the force on a rotating lever arm, and of the axis error's torque on
    /// rotating axes. The stiffness that holds the axes is added separately as a moment.
    fn tangent(
        &self,
        deformation: &Deformation<S::Vector>,
        _: S::Vector,
        add: &mut impl FnMut(S::Real, S::Vector),
    ) -> Turning<S::Vector> {
        for u in S::Vector::axes() {
            add(self.stiffness, u);
        }
        let lever = self.lever.dot(self.lever).sqrt();
        let rest = self.stiffness * (S::Real::TWO * deformation.axis_error.abs() * lever);
        Turning { force: deformation.displacement * self.stiffness, rest }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::vector::{Quaternion, Vec3};

    /// The derivative of the energy with respect to a small rotation of the second axis is the torque on it.
    #[test]
    fn the_gradient_of_the_lean_is_that_of_its_energy() {
        let universal = Universal::<f64>::from_f64(50.0, [0.2, 0.0, 0.0], [0.6, 0.0, 0.8]);
        let energy = |axis: Vec3<f64>| {
            let axis_error = AxisError::<f64>::new(universal.lever, axis).by;
            universal.energy(&Deformation { axis_error, ..Deformation::of(Vec3::ZERO) }, None)
        };
        let AxisError { by, gradient } = AxisError::<f64>::new(universal.lever, universal.axis);
        assert!((by - 0.12).abs() < 1e-15);
        for (axis, slope) in Vec3::axes().into_iter().zip((gradient * (50.0 * by)).to_f64()) {
            let turned = |angle: f64| {
                let v = axis * (0.5 * angle);
                energy(Quaternion { w: 1.0, v }.rotation().to_world(universal.axis))
            };
            let measured = (turned(1e-6) - turned(-1e-6)) / 2e-6;
            assert!((measured - slope).abs() < 1e-8, "{measured} {slope}");
        }
    }

    #[test]
    fn a_lean_is_an_extension_at_its_lever() {
        let universal = Universal::<f64>::from_f64(50.0, [0.2, 0.0, 0.0], [0.0, 0.0, 1.0]);
        let displacement = Vec3::new(0.0, 0.03, 0.0);
        let deformation = Deformation { axis_error: 0.04, ..Deformation::of(displacement) };
        assert!((universal.extension(&deformation) - 0.05).abs() < 1e-16);
        assert!((universal.energy(&deformation, None) - 0.5 * 50.0 * 0.0025).abs() < 1e-16);
    }
}
