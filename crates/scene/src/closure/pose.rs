//! Poses of bodies, and rotation vectors.
//!
//! A rotation is a rotation vector in world axes, angle times axis; it acts from the left: `q ← exp(φ) ∘ q`.

use dbd_kernel::vector::Rotation;
use dbd_kernel::{Quaternion, Vec3};

use crate::orientation::settled;

/// Pose of a body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Pose {
    /// \[m\] centre of mass, world.
    pub(crate) position: Vec3<f64>,
    /// Body → world.
    pub(crate) orientation: Quaternion<f64>,
    rotation: Rotation<f64>,
}

impl Pose {
    /// Pose of the ground.
    pub(crate) const WORLD: Self = Self {
        position: Vec3::ZERO,
        orientation: Quaternion::IDENTITY,
        rotation: Rotation::IDENTITY,
    };

    /// A pose from a position and a unit quaternion.
    pub(crate) fn new(position: Vec3<f64>, orientation: Quaternion<f64>) -> Self {
        Self { position, orientation, rotation: orientation.rotation() }
    }

    /// A point of the body in the world.
    pub(crate) fn place(&self, point_b: Vec3<f64>) -> Vec3<f64> {
        self.position + self.rotation.to_world(point_b)
    }

    /// A vector of the body in the world.
    pub(crate) fn turned(&self, vector_b: Vec3<f64>) -> Vec3<f64> {
        self.rotation.to_world(vector_b)
    }

    /// The pose after a translation \[m\] and a rotation \[rad\], both world.
    pub(crate) fn moved(&self, shift: Vec3<f64>, turn: Vec3<f64>) -> Self {
        let turned = exponential(turn).product(self.orientation).to_f64();
        Self::new(self.position + shift, Quaternion::from_f64(settled(turned)))
    }

    /// The translation \[m\] and rotation \[rad\] from another pose to this one.
    pub(crate) fn since(&self, other: &Self) -> [Vec3<f64>; 2] {
        let turn = self.orientation.product(other.orientation.conjugate());
        [self.position - other.position, logarithm(turn)]
    }
}

/// The unit quaternion of a rotation vector \[rad\].
pub(crate) fn exponential(turn: Vec3<f64>) -> Quaternion<f64> {
    let half = turn * 0.5;
    let angle = length(half);
    let (sine, cosine) = libm::sincos(angle);
    let share = if angle > 0.0 { sine / angle } else { 1.0 };
    Quaternion { w: cosine, v: half * share }
}

/// The rotation vector \[rad\] of a unit quaternion, of length at most π.
pub(crate) fn logarithm(q: Quaternion<f64>) -> Vec3<f64> {
    let q = if q.w < 0.0 { Quaternion { w: -q.w, v: -q.v } } else { q };
    let sine = length(q.v);
    // If the square of the sine underflows, the angle is twice the vector.
    let share = if sine > 1e-150 { 2.0 * libm::atan2(sine, q.w) / sine } else { 2.0 };
    q.v * share
}

/// \[as the vector\] its length.
pub(crate) fn length(v: Vec3<f64>) -> f64 {
    libm::sqrt(v.dot(v))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_turn_of_any_size_is_the_logarithm_of_its_exponential() {
        let axis = Vec3::new(0.36, -0.48, 0.8);
        for angle in [0.0, 1e-200, 1e-12, 1e-3, 1.0, 3.0, 3.1] {
            let turn = axis * angle;
            let found = logarithm(exponential(turn));
            assert!(length(found - turn) <= 1e-15 * (1.0 + 10.0 * angle), "{angle:e}");
        }
        // Beyond 180° the result is the shorter rotation.
        assert!(
            length(logarithm(exponential(axis * 4.0)) - axis * (4.0 - core::f64::consts::TAU))
                < 1e-14
        );
    }

    #[test]
    fn what_leads_from_one_pose_to_another_leads_there() {
        let [first, second] = [[0.3, -1.0, 0.5], [2.0, 0.7, -0.4]]
            .map(|turn| Pose::new(Vec3::new(1.0, -2.0, 3.0), exponential(Vec3::from_f64(turn))));
        let second = Pose { position: Vec3::new(0.5, 0.25, -1.0), ..second };
        let [shift, turn] = second.since(&first);
        let there = first.moved(shift, turn);
        assert!(length(there.position - second.position) < 1e-15);
        let rest = there.orientation.product(second.orientation.conjugate());
        assert!(length(rest.v) < 1e-15);
    }
}
