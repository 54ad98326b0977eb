//! Torsion spring about an axis of its first body, with preload and damping.
//!
//! `(relative rotation, revolution count) => torsion angle θ, gradient g`; energy `½·k·θ² − preload·θ`; torque on B
//! `−U′(θ)·g − c·(ω_rel·g)·g` in A's axes, on A the opposite.
//!
//! With the rotation (w, v) of B in A since t = 0 and the axis n: `θ = 2·atan2(v·n, w)`, the angle of the swing–twist
//! decomposition; `ω_rel·g = θ̇`, hence `g = (w²·n + w·v×n + (v·n)·v)/(w² + (v·n)²)`, which is n while B rotates about
//! n.
//!
//! The angle is unwrapped by an integer per spring: with m half revolutions, `θ = 2π·m + 2·atan2(σs, σw)`,
//! `σ = (−1)^m`. The branch cut is half a revolution away from where m is updated, so no stage of a step meets it.

use crate::arctangent::atan2;
use crate::index::{BodyIndex, DamperIndex};
use crate::real::{Real, choose};
use crate::space::{Linear, Space, Turn as _};

/// The constants of a torsion spring.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TorsionSpring<S: Space> {
    /// First body; the axis is fixed in it.
    pub a: BodyIndex,
    /// Second body; its torsion angle is measured.
    pub b: BodyIndex,
    /// \[1\] unit axis in A's axes.
    pub axis: S::Moment,
    /// \[1\] inverse of B's orientation in A at t = 0.
    pub reference: S::Turn,
    /// \[N·m/rad\] stiffness k, ≥ 0.
    pub stiffness: S::Real,
    /// \[N·m\] torque on B at θ = 0.
    pub preload: S::Real,
    /// Its damping coefficient \[N·m·s/rad\] among the model's dampers, if it has one.
    pub damper: DamperIndex,
}

/// A torsion angle and its gradient.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TorsionAngle<S: Space> {
    /// \[rad\] unwrapped torsion angle θ of B in A since t = 0.
    pub angle: S::Real,
    /// \[1\] gradient g of the angle with respect to a rotation of B, A's axes.
    pub gradient: S::Moment,
}

/// The smallest `w² + (v·n)²` at which a torsion angle is defined: B is then rotated by almost half a revolution about
/// an axis normal to n, and the length of the gradient is about a thousand.
pub const LEAST_TORSION_ANGLE_NORM: f64 = 1e-6;

/// \[1\] [`TorsionAngle::gradient`] from the unit axis in A and in B, in any common axes: `(n + m)/(1 + n·m)`. Where it is
/// undefined its length is limited.
#[inline(always)]
pub(crate) fn gradient_between<M: Linear>(of_a: M, of_b: M) -> M {
    let least = M::Real::from_f64(2.0 * LEAST_TORSION_ANGLE_NORM);
    let norm = M::Real::ONE + of_a.dot(of_b);
    let norm = M::Real::pick(norm.less_than(least), least, norm);
    (of_a + of_b) * (M::Real::ONE / norm)
}

/// The rotation of B in A since t = 0.
#[derive(Clone, Copy, Debug)]
pub struct SinceStart<S: Space> {
    turn: S::Turn,
    /// w.
    w: S::Real,
    /// `v·n`.
    s: S::Real,
    /// `w² + (v·n)²`.
    norm: S::Real,
}

impl<S: Space> SinceStart<S> {
    /// (w, v·n) with the sign of the revolution count.
    #[inline(always)]
    fn wound(&self, turns: <S::Real as Real>::Count) -> (S::Real, S::Real) {
        choose!(S::Real, S::Real::is_odd(turns), (-self.w, -self.s), (self.w, self.s))
    }

    /// The revolution count updated to the half revolution nearest to the pose, which a step does near its boundary.
    #[inline(always)]
    #[must_use]
    pub fn settled(&self, turns: <S::Real as Real>::Count) -> <S::Real as Real>::Count {
        let (w, s) = self.wound(turns);
        let zero = S::Real::ZERO;
        S::Real::recount(turns, w.less_than(zero), zero.less_than(s))
    }

    /// \[1\] The gradient of the torsion angle about `axis` with respect to a rotation of B, A's axes.
    #[inline(always)]
    #[must_use]
    pub fn gradient(&self, axis: S::Moment) -> S::Moment {
        self.turn.gradient(axis, self.s, self.norm)
    }
}

impl<S: Space> TorsionSpring<S> {
    /// The same spring in another precision.
    pub fn convert<Q: Space>(&self) -> TorsionSpring<Q> {
        TorsionSpring {
            a: self.a,
            b: self.b,
            axis: Q::Moment::from_f64(self.axis.to_f64()),
            reference: Q::Turn::from_f64(self.reference.to_f64()),
            stiffness: Q::Real::from_f64(self.stiffness.to_f64()),
            preload: Q::Real::from_f64(self.preload.to_f64()),
            damper: self.damper,
        }
    }

    /// The rotation since t = 0 for B's orientation `relative` in A's axes, or `None` where its torsion angle is
    /// undefined.
    #[inline(always)]
    pub fn since_start(&self, relative: S::Turn) -> Option<SinceStart<S>> {
        let turn = relative.product(self.reference);
        let (w, s) = turn.about(self.axis);
        let norm = w * w + s * s;
        // Written so that NaN is undefined, too.
        let norm = norm.only_where(S::Real::from_f64(LEAST_TORSION_ANGLE_NORM).at_most(norm))?;
        Some(SinceStart { turn, w, s, norm })
    }

    /// The torsion angle of a rotation with the revolution count `turns`.
    #[inline(always)]
    pub fn torsion_angle(
        &self,
        since: &SinceStart<S>,
        turns: <S::Real as Real>::Count,
    ) -> TorsionAngle<S> {
        let (w, s) = since.wound(turns);
        let two = S::Real::TWO;
        let principal = two * atan2(s, w);
        let angle = choose!(
            S::Real,
            S::Real::is_nil(turns),
            principal,
            S::Real::from_count(turns) * (two * S::Real::PI) + principal
        );
        TorsionAngle { angle, gradient: since.gradient(self.axis) }
    }

    /// Torque on B \[N·m\] in A's axes without damping.
    #[inline(always)]
    pub fn torque(&self, torsion_angle: &TorsionAngle<S>) -> S::Moment {
        torsion_angle.gradient * (self.preload - self.stiffness * torsion_angle.angle)
    }

    /// Torque on B \[N·m\] in A's axes including the damper; `rate` is `ω_B − ω_A` in A's axes.
    #[inline(always)]
    pub fn damped_torque(
        &self,
        damping: S::Real,
        torsion_angle: &TorsionAngle<S>,
        rate: S::Moment,
    ) -> S::Moment {
        let spring = self.preload - self.stiffness * torsion_angle.angle;
        torsion_angle.gradient * (spring - damping * rate.dot(torsion_angle.gradient))
    }

    /// \[N·m\] an upper bound of the effect of its torque on a rotation of either body, in any direction, `½·|τ|·|g|²`
    /// with the gradient g in any axes: its part of the frequency bound in addition to the stiffness along g.
    #[inline]
    pub fn turning(&self, angle: S::Real, gradient: S::Moment) -> S::Real {
        let torque = (self.preload - self.stiffness * angle).abs();
        S::Real::HALF * torque * gradient.dot(gradient)
    }

    /// Stored energy \[J\]; 0 at θ = 0.
    #[inline]
    pub fn energy(&self, angle: S::Real) -> S::Real {
        S::Real::HALF * self.stiffness * angle * angle - self.preload * angle
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::vector::{Quaternion, Vec3};

    fn spring(axis: [f64; 3]) -> TorsionSpring<f64> {
        TorsionSpring {
            a: BodyIndex::WORLD,
            b: BodyIndex(0),
            axis: Vec3::from_f64(axis),
            reference: Quaternion::IDENTITY,
            stiffness: 3.0,
            preload: 0.5,
            damper: DamperIndex::NONE,
        }
    }

    fn turned(axis: [f64; 3], angle: f64) -> Quaternion<f64> {
        let (s, c) = libm::sincos(angle / 2.0);
        Quaternion::new(c, s * axis[0], s * axis[1], s * axis[2])
    }

    #[test]
    fn many_turns_are_counted_both_ways() {
        let spring = spring([0.0, 0.0, 1.0]);
        for direction in [1.0, -1.0] {
            let mut turns = 0;
            for i in 0..4_000 {
                let angle = direction * 0.01 * f64::from(i);
                // Between two updates of the count a stage may be well ahead without meeting the cut.
                let stage = turned([0.0, 0.0, 1.0], angle + direction * 2.5);
                let looked = spring.torsion_angle(&spring.since_start(stage).unwrap(), turns);
                assert!((looked.angle - angle - direction * 2.5).abs() < 1e-12);
                let pose = turned([0.0, 0.0, 1.0], angle);
                let since = spring.since_start(pose).unwrap();
                turns = since.settled(turns);
                let torsion_angle = spring.torsion_angle(&since, turns);
                assert!(
                    (torsion_angle.angle - angle).abs() < 1e-12,
                    "{} {angle}",
                    torsion_angle.angle
                );
                assert!((torsion_angle.gradient.z - 1.0).abs() < 1e-12);
            }
            assert_eq!(turns, if direction > 0.0 { 6 } else { -6 });
        }
    }

    #[test]
    fn the_gradient_is_the_rate_of_the_twist() {
        let n = [0.6, 0.0, 0.8];
        let spring = spring(n);
        let pose = turned([0.6, 0.64, 0.48], 1.1).product(turned(n, 0.4));
        let since = spring.since_start(pose).unwrap();
        let torsion_angle = spring.torsion_angle(&since, since.settled(0));
        for axis in [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]] {
            // A rotation of B by a small vector in A's axes multiplies from the left.
            let at = |e: f64| {
                let since = spring.since_start(turned(axis, e).product(pose)).unwrap();
                spring.torsion_angle(&since, since.settled(0)).angle
            };
            let rate = (at(1e-5) - at(-1e-5)) / 2e-5;
            let along = Vec3::from_f64(axis).dot(torsion_angle.gradient);
            assert!((rate - along).abs() < 1e-9, "{rate} {along}");
        }
    }

    #[test]
    fn half_a_turn_about_a_normal_axis_has_no_twist() {
        let spring = spring([0.0, 0.0, 1.0]);
        let flipped = turned([1.0, 0.0, 0.0], core::f64::consts::PI);
        assert!(spring.since_start(flipped).is_none());
        let broken = Quaternion::new(f64::NAN, 0.0, 0.0, 0.0);
        assert!(spring.since_start(broken).is_none());
    }

    #[test]
    fn torque_and_energy_agree() {
        let spring = spring([0.0, 0.0, 1.0]);
        let mut turns = 0;
        let pose = turned([0.0, 0.0, 1.0], 0.7);
        let since = spring.since_start(pose).unwrap();
        turns = since.settled(turns);
        let torsion_angle = spring.torsion_angle(&since, turns);
        let slope = (spring.energy(0.7 + 1e-6) - spring.energy(0.7 - 1e-6)) / 2e-6;
        assert!((spring.torque(&torsion_angle).z + slope).abs() < 1e-8);
        let damped = spring.damped_torque(2.0, &torsion_angle, Vec3::new(9.0, 9.0, 0.25));
        assert!((damped.z - (spring.torque(&torsion_angle).z - 0.5)).abs() < 1e-12);
    }
}
