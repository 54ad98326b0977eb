//! Point on line: a point of B constrained by a spring to a line of A (Franco & Degani 2026, section 2.4.3).
//!
//! `(d, n, v_rel) => (force on A, slide)`, `d` from a point of the line to the point of B, n the line's unit direction.
//! The slide is `s = d·n`, the foot point is s along the line, and `e = d − s·n` is the deflection, `ė` the part of
//! `v_rel` normal to n, `v_rel` between the material points of both bodies at the foot and at the point. Force on A at
//! the foot `k·(|e| − L0)·e/|e| + c·ė`, on B at the point the opposite; with `L0 = 0` simply `k·e + c·ė`, smooth on the
//! line. Energy `½·k·(|e| − L0)²`. A clearance changes `|e| − L0` and c, see [`crate::elements::clearance`]. A damper
//! whose `ė` is not along e conserves angular momentum only up to e.

use crate::elements::clearance::{beyond, engaged};
use crate::elements::point_law::{Deformation, PointLaw, Turning};
use crate::real::{Real, choose};
use crate::space::{Linear as _, Space, Vector};

/// The constants of a point on a line.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PointOnLine<S: Space> {
    /// \[1\] unit direction of the line in A's axes.
    pub direction: S::Vector,
    /// \[N/m\] stiffness normal to the line, ≥ 0.
    pub stiffness: S::Real,
    /// \[m\] free distance from the line, ≥ 0.
    pub free_length: S::Real,
}

/// A point relative to its line, world axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Projection<V: Vector> {
    /// Along the line from its defining point to the foot.
    pub(crate) slide: V::Real,
    /// From the foot to the point.
    pub(crate) deflection: V,
}

impl<V: Vector> Projection<V> {
    /// Projects `d` on the unit direction `n`.
    #[inline(always)]
    pub(crate) fn new(d: V, n: V) -> Self {
        let slide = d.dot(n);
        Self { slide, deflection: d - n * slide }
    }
}

impl<S: Space> PointOnLine<S> {
    /// Each constant rounded once from double precision.
    pub fn from_f64(direction: [f64; 3], stiffness: f64, free_length: f64) -> Self {
        Self {
            direction: S::Vector::from_f64(direction),
            stiffness: S::Real::from_f64(stiffness),
            free_length: S::Real::from_f64(free_length),
        }
    }

    /// The same constants in another precision.
    pub fn convert<Q: Space>(&self) -> PointOnLine<Q> {
        PointOnLine::from_f64(
            self.direction.to_f64(),
            self.stiffness.to_f64(),
            self.free_length.to_f64(),
        )
    }

    #[inline(always)]
    fn beyond_free(&self, e: S::Vector) -> S::Real {
        e.dot(e).sqrt() - self.free_length
    }

    /// Force on A \[N\] for the deflection `e` without damping, beyond a clearance \[m\] if there
    /// is one.
    #[inline(always)]
    pub fn force(&self, e: S::Vector, clearance: Option<S::Real>) -> S::Vector {
        let smooth = S::Real::mask(clearance.is_none()) & self.free_length.equals(S::Real::ZERO);
        choose!(S::Real, smooth, e * self.stiffness, {
            let length = e.dot(e).sqrt();
            let tension = self.stiffness * beyond(length - self.free_length, clearance);
            e * (tension * length.reciprocal_or_zero())
        })
    }

    /// Force on A \[N\] including the damper: `damping` in N·s/m, `rate` is `ė`.
    #[inline(always)]
    pub fn damped_force(
        &self,
        damping: S::Real,
        e: S::Vector,
        rate: S::Vector,
        clearance: Option<S::Real>,
    ) -> S::Vector {
        let damping = engaged(damping, self.beyond_free(e), clearance);
        self.force(e, clearance) + rate * damping
    }
}

impl<S: Space> PointLaw<S::Vector> for PointOnLine<S> {
    /// `|e| − L0` \[m\].
    #[inline(always)]
    fn extension(&self, deformation: &Deformation<S::Vector>) -> S::Real {
        self.beyond_free(deformation.displacement)
    }

    #[inline]
    fn energy(&self, deformation: &Deformation<S::Vector>, clearance: Option<S::Real>) -> S::Real {
        let extension = beyond(self.extension(deformation), clearance);
        S::Real::HALF * self.stiffness * extension * extension
    }

    /// Along the line's normals.
    #[inline(always)]
    fn damped(deformation: &Deformation<S::Vector>) -> ([S::Vector; 3], usize) {
        let [n, m] = deformation.direction.normals();
        ([n, m, S::Vector::ZERO], S::Vector::DIMENSION - 1)
    }

    /// k along e and, where the law is isotropic, across it; otherwise the force over |e| there. On a loaded line that
    /// rotates, rotation and slide are coupled: both get a spring, with the lever arm as the weighting length.
    fn tangent(
        &self,
        deformation: &Deformation<S::Vector>,
        arm: S::Vector,
        add: &mut impl FnMut(S::Real, S::Vector),
    ) -> Turning<S::Vector> {
        let (e, line) = (deformation.displacement, deformation.direction);
        let inverse = e.dot(e).sqrt().reciprocal_or_zero();
        let force = (self.stiffness * self.extension(deformation)).abs();
        let isotropic = self.free_length == S::Real::ZERO;
        let [n, m] =
            if isotropic { line.normals() } else { [e * inverse, line.across(e * inverse)] };
        add(self.stiffness, n);
        add(if isotropic { self.stiffness } else { force * inverse }, m);
        let elongation = arm.dot(arm).sqrt();
        if force > S::Real::ZERO {
            add(force * elongation.reciprocal_or_zero(), line);
        }
        Turning::about_any_axis(S::Real::TWO * force * elongation)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::vector::Vec3;

    #[test]
    fn sliding_along_the_line_costs_nothing() {
        let n = Vec3::new(0.0, 0.6, 0.8);
        let line = PointOnLine::<f64>::from_f64(n.to_f64(), 500.0, 0.0);
        let projection = Projection::new(n * 3.0, n);
        assert!((projection.slide - 3.0).abs() < 1e-15);
        assert!(line.energy(&Deformation::of(projection.deflection), None) < 1e-27);
        let aside = Projection::new(n * 3.0 + Vec3::new(0.2, 0.0, 0.0), n);
        assert!((line.force(aside.deflection, None).x - 100.0).abs() < 1e-12);
        assert!((line.energy(&Deformation::of(aside.deflection), None) - 10.0).abs() < 1e-12);
    }

    #[test]
    fn the_force_is_the_gradient_of_the_energy_beyond_a_free_distance() {
        let n = Vec3::new(1.0, 0.0, 0.0);
        let line = PointOnLine::<f64>::from_f64(n.to_f64(), 500.0, 0.01);
        let d = Vec3::new(0.7, 0.012, -0.005);
        let at =
            |d: Vec3<f64>| line.energy(&Deformation::of(Projection::new(d, n).deflection), None);
        let force = line.force(Projection::new(d, n).deflection, None).to_f64();
        for (axis, force) in force.into_iter().enumerate() {
            let mut step = [0.0; 3];
            step[axis] = 1e-7;
            let step = Vec3::from_f64(step);
            let gradient = (at(d + step) - at(d - step)) / 2e-7;
            assert!((gradient - force).abs() < 1e-5, "{gradient} {force}");
        }
        assert_eq!(line.force(Vec3::ZERO, None), Vec3::ZERO);
    }

    #[test]
    fn the_damper_acts_in_every_direction_of_its_rate() {
        let line = PointOnLine::<f64>::from_f64([1.0, 0.0, 0.0], 0.0, 0.01);
        let rate = Vec3::new(0.0, 2.0, -1.0);
        let force = line.damped_force(3.0, Vec3::new(0.0, 0.02, 0.0), rate, None);
        assert_eq!(force, Vec3::new(0.0, 6.0, -3.0));
    }
}
