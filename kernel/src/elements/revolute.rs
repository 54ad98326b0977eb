//! A revolute joint of bushings: a coincident point and an aligned axis of each body.
//!
//! `(d, l, l', v_rel, ω_rel) => force on A = k·w(d) + c·w(v_rel), torque on A = k·l×l' + c·l×(ω_rel×l)`,
//! `w(x) = x + α·(l·x)·l`; on B the opposite. l and l' are the axes of A and B with the length of their lever arm; the
//! force acts on both bodies at the point of B, `v_rel` is between their material points there. Energy
//! `½·k·(d·w(d) + |l' − l|²)`: with α = 0 that of two point bushings of k/2 at the ends of both axes, at lower cost.
//! Smooth everywhere, without a root or a division; linear and angular momentum are conserved, damped or not.

use crate::elements::point_law::{Deformation, PointLaw, Turning};
use crate::real::Real;
use crate::space::{Linear as _, Moment as _, Space, Vector};

/// The constants of a revolute joint.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Revolute<S: Space> {
    /// \[N/m\] radial stiffness, ≥ 0.
    pub stiffness: S::Real,
    /// \[1/m²\] α: the axial stiffness is 1 + α·l² times the radial one, ≥ 0.
    pub along: S::Real,
    /// \[m\] axis of each body in its own axes, with the length of its lever arm.
    pub levers: [S::Vector; 2],
}

/// `x + α·(l·x)·l`.
#[inline(always)]
fn weighed<V: Vector>(x: V, lever: V, along: V::Real) -> V {
    x + lever * (along * lever.dot(x))
}

impl<S: Space> Revolute<S> {
    /// Each constant rounded once from double precision.
    pub fn from_f64(stiffness: f64, along: f64, levers: [[f64; 3]; 2]) -> Self {
        Self {
            stiffness: S::Real::from_f64(stiffness),
            along: S::Real::from_f64(along),
            levers: levers.map(S::Vector::from_f64),
        }
    }

    /// The same constants in another precision.
    pub fn convert<Q: Space>(&self) -> Revolute<Q> {
        let levers = self.levers.map(|lever| lever.to_f64());
        Revolute::from_f64(self.stiffness.to_f64(), self.along.to_f64(), levers)
    }

    /// Force on A \[N\] without damping, `lever` that of A in world axes.
    #[inline(always)]
    pub fn force(&self, d: S::Vector, lever: S::Vector) -> S::Vector {
        weighed(d, lever, self.along) * self.stiffness
    }

    /// Force on A \[N\] including the damper, `damping` in N·s/m, radial.
    #[inline(always)]
    pub fn damped_force(
        &self,
        damping: S::Real,
        d: S::Vector,
        v_rel: S::Vector,
        lever: S::Vector,
    ) -> S::Vector {
        weighed(d * self.stiffness + v_rel * damping, lever, self.along)
    }

    /// Torque on A \[N·m\] without damping, levers in world axes.
    #[inline(always)]
    pub fn torque(&self, [a, b]: [S::Vector; 2]) -> S::Moment {
        a.cross(b) * self.stiffness
    }

    /// Torque on A \[N·m\] of the damper: `damping` in N·s/m, `spin` of B relative to A \[rad/s\].
    #[inline(always)]
    pub fn damping_torque(&self, damping: S::Real, spin: S::Moment, lever: S::Vector) -> S::Moment {
        lever.cross(spin.cross(lever)) * damping
    }

    /// \[m\] its lever arm.
    fn lever(&self) -> S::Real {
        self.levers[0].dot(self.levers[0]).sqrt()
    }
}

impl<S: Space> PointLaw<S::Vector> for Revolute<S> {
    /// \[m\] of the point and the axes together, `√(d·d + |l' − l|²)`.
    #[inline]
    fn extension(&self, deformation: &Deformation<S::Vector>) -> S::Real {
        let (d, axis_error) = (deformation.displacement, deformation.axis_error);
        (d.dot(d) + axis_error * axis_error).sqrt()
    }

    /// A revolute joint of bushings has no clearance.
    #[inline]
    fn energy(&self, deformation: &Deformation<S::Vector>, _: Option<S::Real>) -> S::Real {
        let Deformation { displacement: d, direction: n, ratio, axis_error } = *deformation;
        let along = n.dot(d);
        let squares = d.dot(d) + (ratio - S::Real::ONE) * (along * along) + axis_error * axis_error;
        S::Real::HALF * self.stiffness * squares
    }

    /// Along the axis, with a length that gives the axial strength, and along its normals; the dampers that align the
    /// axis are moments and are visited separately.
    #[inline(always)]
    fn damped(deformation: &Deformation<S::Vector>) -> ([S::Vector; 3], usize) {
        let [n, m] = deformation.direction.normals();
        ([deformation.direction * deformation.ratio.sqrt(), n, m], S::Vector::DIMENSION)
    }

    /// k radially and (1 + α·l²)·k axially, and the effect of the force on a rotating lever arm. The larger axial
    /// stiffness couples a rotation of the axis with a shift, as for a line: both get a spring, with the lever arm as
    /// the weighting length. The stiffness that aligns the axes is added separately as a moment; misaligned axes add
    /// their torque.
    fn tangent(
        &self,
        deformation: &Deformation<S::Vector>,
        arm: S::Vector,
        add: &mut impl FnMut(S::Real, S::Vector),
    ) -> Turning<S::Vector> {
        let Deformation { displacement: d, direction: axis, ratio, axis_error } = *deformation;
        let elongation = arm.dot(arm).sqrt();
        let tension = (self.stiffness * (ratio - S::Real::ONE) * axis.dot(d)).abs();
        for n in axis.normals() {
            add(self.stiffness + tension * elongation.reciprocal_or_zero(), n);
        }
        add(self.stiffness * ratio, axis);
        let length = d.dot(d).sqrt();
        let turned = length * elongation + axis_error * self.lever();
        let rest = self.stiffness * turned + tension * (S::Real::TWO * elongation + length);
        Turning::about_any_axis(rest)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::vector::{Quaternion, Vec3};

    /// Lever arm 0.5 m, axially four times as stiff.
    fn revolute() -> Revolute<f64> {
        Revolute::from_f64(40.0, 12.0, [[0.0, 0.3, 0.4], [0.0, 0.3, 0.4]])
    }

    fn deformation(d: Vec3<f64>, levers: [Vec3<f64>; 2]) -> Deformation<Vec3<f64>> {
        let [a, b] = levers;
        let axis_error = (b - a).dot(b - a).sqrt();
        Deformation { direction: a * 2.0, ratio: 4.0, axis_error, ..Deformation::of(d) }
    }

    #[test]
    fn the_force_is_the_gradient_of_the_energy() {
        let revolute = revolute();
        let (levers, d) = (revolute.levers, Vec3::new(0.1, -0.2, 0.3));
        let force = revolute.force(d, levers[0]).to_f64();
        for (axis, force) in Vec3::axes().into_iter().zip(force) {
            let energy = |by: f64| revolute.energy(&deformation(d + axis * by, levers), None);
            let gradient = (energy(1e-6) - energy(-1e-6)) / 2e-6;
            assert!((gradient - force).abs() < 1e-7, "{gradient} {force}");
        }
        let along = revolute.force(levers[0], levers[0]);
        assert!((along.dot(levers[0]) - 4.0 * 40.0 * 0.25).abs() < 1e-12);
    }

    #[test]
    fn the_torque_is_what_the_energy_loses_by_a_turn_of_the_first_axis() {
        let revolute = revolute();
        let levers = [revolute.levers[0], Vec3::new(0.3, 0.0, 0.4)];
        for (axis, torque) in Vec3::axes().into_iter().zip(revolute.torque(levers).to_f64()) {
            let energy = |angle: f64| {
                let turn = Quaternion { w: 1.0, v: axis * (0.5 * angle) };
                let turned = [turn.rotation().to_world(levers[0]), levers[1]];
                revolute.energy(&deformation(Vec3::ZERO, turned), None)
            };
            let gradient = (energy(1e-6) - energy(-1e-6)) / 2e-6;
            assert!((gradient + torque).abs() < 1e-7, "{gradient} {torque}");
        }
    }

    #[test]
    fn directions_of_the_damper_add_up_to_its_force() {
        let revolute = revolute();
        let (v, lever) = (Vec3::new(1.0, 2.0, -0.5), revolute.levers[0]);
        let at_rest = deformation(Vec3::ZERO, revolute.levers);
        let (directions, count) = Revolute::<f64>::damped(&at_rest);
        let sum = directions[..count].iter().fold(Vec3::ZERO, |sum, u| sum + *u * (7.0 * u.dot(v)));
        let gap = sum - revolute.damped_force(7.0, Vec3::ZERO, v, lever);
        assert!(gap.dot(gap) < 1e-24, "{gap:?}");
        // Rotation about the axis is free.
        assert_eq!(revolute.damping_torque(7.0, lever, lever), Vec3::ZERO);
    }
}
