//! Axial bushing: a TSDA of zero free length that is stiffer, or softer, along an axis of A.
//!
//! `(d, n, v_rel) => force on A = k·w(d) + c·w(v_rel)`, `w(x) = x + (ρ − 1)·(n·x)·n`, n the axis; the
//! force on B is the opposite. Both act at the point of B, and `v_rel` is between the material points
//! of both bodies there: linear and angular momentum are kept, damped or not.
//! Energy `½·k·d·w(d)`. Smooth where the points coincide, without a root or a division.

use crate::elements::point_law::{PointLaw, Stretch};
use crate::real::Real;
use crate::space::{Linear as _, Space, Vector};

/// The constants of an axial bushing.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct AxialBushing<S: Space> {
    /// \[1\] unit direction of the axis in A's axes.
    pub axis: S::Vector,
    /// \[N/m\] stiffness across the axis, ≥ 0.
    pub stiffness: S::Real,
    /// \[1\] stiffness and damping along the axis over those across it, ≥ 0.
    pub ratio: S::Real,
}

/// `x + (ρ − 1)·(n·x)·n`.
#[inline(always)]
fn weighed<V: Vector>(x: V, n: V, ratio: V::Real) -> V {
    x + n * ((ratio - V::Real::ONE) * n.dot(x))
}

impl<S: Space> AxialBushing<S> {
    /// Each constant rounded once from double precision.
    pub fn from_f64(axis: [f64; 3], stiffness: f64, ratio: f64) -> Self {
        Self {
            axis: S::Vector::from_f64(axis),
            stiffness: S::Real::from_f64(stiffness),
            ratio: S::Real::from_f64(ratio),
        }
    }

    /// The same constants in another precision.
    pub fn convert<Q: Space>(&self) -> AxialBushing<Q> {
        AxialBushing::from_f64(self.axis.to_f64(), self.stiffness.to_f64(), self.ratio.to_f64())
    }

    /// Force on A \[N\] without damping, `n` the axis in the world.
    #[inline(always)]
    pub fn force(&self, d: S::Vector, n: S::Vector) -> S::Vector {
        weighed(d, n, self.ratio) * self.stiffness
    }

    /// Force on A \[N\] with the damper's share, `damping` in N·s/m across the axis.
    #[inline(always)]
    pub fn damped_force(
        &self,
        damping: S::Real,
        d: S::Vector,
        v_rel: S::Vector,
        n: S::Vector,
    ) -> S::Vector {
        weighed(d * self.stiffness + v_rel * damping, n, self.ratio)
    }
}

impl<S: Space> PointLaw<S::Vector> for AxialBushing<S> {
    /// `|d|` \[m\].
    #[inline]
    fn extension(&self, stretch: &Stretch<S::Vector>) -> S::Real {
        stretch.displacement.dot(stretch.displacement).sqrt()
    }

    /// An axial bushing has no clearance.
    #[inline]
    fn energy(&self, stretch: &Stretch<S::Vector>, _: Option<S::Real>) -> S::Real {
        let d = stretch.displacement;
        S::Real::HALF * self.stiffness * d.dot(weighed(d, stretch.direction, self.ratio))
    }

    /// Along the axis, as long as makes it as strong there as it is, and along its normals.
    #[inline(always)]
    fn damped(stretch: &Stretch<S::Vector>) -> ([S::Vector; 3], usize) {
        let [n, m] = stretch.direction.normals();
        ([stretch.direction * stretch.ratio.sqrt(), n, m], S::Vector::DIMENSION)
    }

    /// k across the axis and ρ·k along it, the force on a turning arm, and what is stiffer along the axis
    /// trades a turn of it against a shift, as a line does: both get a spring, with the arm as the
    /// length that weighs one against the other.
    fn tangent(
        &self,
        stretch: &Stretch<S::Vector>,
        arm: S::Vector,
        add: &mut impl FnMut(S::Real, S::Vector),
    ) -> S::Real {
        let (d, axis) = (stretch.displacement, stretch.direction);
        let reach = arm.dot(arm).sqrt();
        let tension = (self.stiffness * (self.ratio - S::Real::ONE) * axis.dot(d)).abs();
        for n in axis.normals() {
            add(self.stiffness + tension * reach.reciprocal_or_zero(), n);
        }
        add(self.stiffness * self.ratio, axis);
        let length = d.dot(d).sqrt();
        self.stiffness * length * reach + tension * (S::Real::TWO * reach + length)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::vector::Vec3;

    fn stretch(d: Vec3<f64>, bushing: &AxialBushing<f64>) -> Stretch<Vec3<f64>> {
        let (direction, ratio) = (bushing.axis, bushing.ratio);
        Stretch { direction, ratio, ..Stretch::of(d) }
    }

    #[test]
    fn the_force_is_the_gradient_of_the_energy() {
        let bushing = AxialBushing::<f64>::from_f64([0.0, 0.6, 0.8], 40.0, 3.0);
        let d = Vec3::new(0.1, -0.2, 0.3);
        let force = bushing.force(d, bushing.axis).to_f64();
        for (axis, force) in Vec3::axes().into_iter().zip(force) {
            let energy = |by: f64| bushing.energy(&stretch(d + axis * by, &bushing), None);
            let gradient = (energy(1e-6) - energy(-1e-6)) / 2e-6;
            assert!((gradient - force).abs() < 1e-8, "{gradient} {force}");
        }
        let along = bushing.force(bushing.axis * 0.5, bushing.axis);
        assert!((along.dot(bushing.axis) - 60.0).abs() < 1e-12);
        let isotropic = AxialBushing { ratio: 1.0, ..bushing };
        assert_eq!(isotropic.force(d, bushing.axis), d * 40.0);
    }

    #[test]
    fn directions_of_the_damper_add_up_to_its_force() {
        let bushing = AxialBushing::<f64>::from_f64([0.0, 0.6, 0.8], 0.0, 3.0);
        let v = Vec3::new(1.0, 2.0, -0.5);
        let (directions, count) = AxialBushing::<f64>::damped(&stretch(Vec3::ZERO, &bushing));
        let sum = directions[..count].iter().fold(Vec3::ZERO, |sum, u| sum + *u * (7.0 * u.dot(v)));
        let gap = sum - bushing.damped_force(7.0, Vec3::ZERO, v, bushing.axis);
        assert!(gap.dot(gap) < 1e-24, "{gap:?}");
    }
}
