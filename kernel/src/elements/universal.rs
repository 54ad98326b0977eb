//! A universal joint without a spider: a point bushing, and two axes that are held perpendicular.
//!
//! `(d, q, v_rel, q̇) => force on A = k·d + c·v_rel, torque on A = (k·q + c·q̇)·m`; on B the opposite.
//! `q = l·n` is how far the axes lean from square \[m\]: n the unit axis of B, l that of A, as long as its
//! lever. `m = n × l` is what q gains for a small turn of B, `q̇ = m·(ω_B − ω_A)`.
//! Energy `½·k·(d·d + q²)`, so the lever ℓ makes a stiffness k·ℓ² against turns about l × n.
//! Smooth everywhere, without a root or a division. As of a point bushing, the damper's `c·v_rel`
//! keeps angular momentum as far as d vanishes.

use crate::elements::point_law::{PointLaw, Stretch};
use crate::real::Real;
use crate::vector::Vec3;

/// The constants of a universal joint.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Universal<R> {
    /// \[N/m\] stiffness in every direction, ≥ 0.
    pub stiffness: R,
    /// \[m\] axis of the first body in its axes, as long as its lever.
    pub lever: Vec3<R>,
    /// \[1\] unit axis of the second body in its axes.
    pub axis: Vec3<R>,
}

/// How two axes lean, world.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Lean<R> {
    /// \[m\] `l·n`.
    pub(crate) by: R,
    /// \[m\] `n × l`.
    pub(crate) gradient: Vec3<R>,
}

impl<R: Real> Lean<R> {
    #[inline(always)]
    pub(crate) fn new(lever: Vec3<R>, axis: Vec3<R>) -> Self {
        Self { by: lever.dot(axis), gradient: axis.cross(lever) }
    }
}

impl<R: Real> Universal<R> {
    /// Each constant rounded once from double precision.
    pub fn from_f64(stiffness: f64, lever: [f64; 3], axis: [f64; 3]) -> Self {
        let stiffness = R::from_f64(stiffness);
        Self { stiffness, lever: Vec3::from_f64(lever), axis: Vec3::from_f64(axis) }
    }

    /// The same constants in another precision.
    pub fn convert<Q: Real>(&self) -> Universal<Q> {
        let (lever, axis) = (self.lever.to_f64(), self.axis.to_f64());
        Universal::from_f64(self.stiffness.to_f64(), lever, axis)
    }
}

impl<R: Real> PointLaw<R> for Universal<R> {
    /// \[m\] of point and axes together, `√(d·d + q²)`.
    #[inline]
    fn extension(&self, stretch: &Stretch<R>) -> R {
        let (d, q) = (stretch.displacement, stretch.lean);
        (d.dot(d) + q * q).sqrt()
    }

    /// A universal joint has no clearance.
    #[inline]
    fn energy(&self, stretch: &Stretch<R>, _: Option<R>) -> R {
        let (d, q) = (stretch.displacement, stretch.lean);
        R::HALF * self.stiffness * (d.dot(d) + q * q)
    }

    /// Along the world's axes; the one that holds the axes only turns and is visited beside these.
    #[inline(always)]
    fn damped(_: &Stretch<R>) -> ([Vec3<R>; 3], usize) {
        (Vec3::axes(), 3)
    }

    /// k in every direction, the force on a turning arm, and the torque of a lean on turning axes. What
    /// holds the axes is added beside this, for it only turns.
    fn tangent(&self, stretch: &Stretch<R>, arm: Vec3<R>, add: &mut impl FnMut(R, Vec3<R>)) -> R {
        for u in Vec3::axes() {
            add(self.stiffness, u);
        }
        let d = stretch.displacement;
        let lever = self.lever.dot(self.lever).sqrt();
        let turned = d.dot(d).sqrt() * arm.dot(arm).sqrt() + R::TWO * stretch.lean.abs() * lever;
        self.stiffness * turned
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::vector::Quaternion;

    /// What the energy gains for a small turn of the second axis is the torque on it.
    #[test]
    fn the_gradient_of_the_lean_is_that_of_its_energy() {
        let universal = Universal::<f64>::from_f64(50.0, [0.2, 0.0, 0.0], [0.6, 0.0, 0.8]);
        let energy = |axis: Vec3<f64>| {
            let lean = Lean::new(universal.lever, axis).by;
            universal.energy(&Stretch { lean, ..Stretch::default() }, None)
        };
        let Lean { by, gradient } = Lean::new(universal.lever, universal.axis);
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
        let stretch = Stretch { displacement, lean: 0.04, ..Stretch::default() };
        assert!((universal.extension(&stretch) - 0.05).abs() < 1e-16);
        assert!((universal.energy(&stretch, None) - 0.5 * 50.0 * 0.0025).abs() < 1e-16);
    }
}
