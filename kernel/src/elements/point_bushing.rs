//! Point bushing: a TSDA of zero free length, isotropic, without a root or a division.
//!
//! `(d, v_rel) => force on A = k·d + c·v_rel`; the force on B is the opposite. Energy `½·k·d·d`. Smooth where the
//! points coincide. The damper's force need not be along d: while the points are apart the pair has a torque
//! `d × c·v_rel`, so a damped bushing conserves linear momentum, but angular momentum only up to d.

use crate::elements::point_law::{Deformation, PointLaw, Turning};
use crate::real::Real;
use crate::space::{Linear, Vector};

/// The constants of a point bushing.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(all(feature = "defmt", target_os = "none"), derive(defmt::Format))]
pub struct PointBushing<R> {
    /// \[N/m\] stiffness in every direction, ≥ 0.
    pub stiffness: R,
}

impl<R: Real> PointBushing<R> {
    /// The constant rounded once from double precision.
    pub fn from_f64(stiffness: f64) -> Self {
        Self { stiffness: R::from_f64(stiffness) }
    }

    /// The same constant in another precision.
    pub fn convert<Q: Real>(&self) -> PointBushing<Q> {
        PointBushing::from_f64(self.stiffness.to_f64())
    }

    /// Force on A \[N\] without damping.
    #[inline(always)]
    pub fn force<V: Linear<Real = R>>(&self, d: V) -> V {
        d * self.stiffness
    }

    /// Force on A \[N\] including the damper, `damping` in N·s/m.
    #[inline(always)]
    pub fn damped_force<V: Linear<Real = R>>(&self, damping: R, d: V, v_rel: V) -> V {
        d * self.stiffness + v_rel * damping
    }
}

impl<V: Vector> PointLaw<V> for PointBushing<V::Real> {
    /// `|d|` \[m\].
    #[inline(always)]
    fn extension(&self, deformation: &Deformation<V>) -> V::Real {
        let d = deformation.displacement;
        d.dot(d).sqrt()
    }

    /// A point bushing has no clearance.
    #[inline]
    fn energy(&self, deformation: &Deformation<V>, _: Option<V::Real>) -> V::Real {
        let d = deformation.displacement;
        V::Real::HALF * self.stiffness * d.dot(d)
    }

    /// Along the world's axes.
    #[inline(always)]
    fn damped(_: &Deformation<V>) -> ([V; 3], usize) {
        (V::axes(), V::DIMENSION)
    }

    /// k in every direction, and the effect of the force on a rotating lever arm.
    fn tangent(
        &self,
        deformation: &Deformation<V>,
        _: V,
        add: &mut impl FnMut(V::Real, V),
    ) -> Turning<V> {
        for u in V::axes().into_iter().take(V::DIMENSION) {
            add(self.stiffness, u);
        }
        Turning::of_force(deformation.displacement * self.stiffness)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::vector::Vec3;

    #[test]
    fn the_law_is_linear_in_displacement_and_rate() {
        let bushing = PointBushing { stiffness: 40.0 };
        let d = Vec3::new(0.1, -0.2, 0.3);
        assert_eq!(bushing.force(d), Vec3::new(4.0, -8.0, 12.0));
        let f = bushing.damped_force(2.0, d, Vec3::new(1.0, 0.0, -1.0));
        assert_eq!(f, Vec3::new(6.0, -8.0, 10.0));
        assert!((bushing.energy(&Deformation::of(d), None) - 0.5 * 40.0 * 0.14).abs() < 1e-15);
    }
}
