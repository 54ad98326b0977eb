//! The two bodies of a damper during its impulse.
//!
//! `(direction and moments, rate, kick's rate, coefficient, time) => impulse on both`.

use crate::damping::kick::Kick;
use crate::damping::moving::Moving;
use crate::force_pair::Direction;
use crate::geometry::Geometry;
use crate::laws::Inner;
use crate::model::{ModelRef, Terms};
use crate::real::{Mask as _, Real};
use crate::space::{Linear as _, Moment as _, Space};

/// The constants of a damper apart from its direction.
#[derive(Clone, Copy)]
pub(super) struct Damper<R> {
    /// \[N·s/m\] or \[N·m·s/rad\] coefficient.
    pub(super) coefficient: R,
    /// Its weight among the dampers that act on a common force.
    pub(super) own: R,
    /// The weight of the dampers that act after it.
    pub(super) later: R,
    /// \[s\] the duration of its action.
    pub(super) h: R,
}

/// The limits of a damper's impulse: its target rate, its smallest and its largest impulse \[N·s\], and whether it is
/// limited to stopping the rate.
pub(super) type Limits<R> = (R, [R; 2], bool);

impl<R: Real> Damper<R> {
    /// `(h·c/μ, impulse per relative velocity μ·s/(1 + s))`, `s = x + x²/2` and `x = h·c/μ`, from `1/μ > 0`: a fraction
    /// of μ in \[0, 1\].
    ///
    /// Written as `1/((1/μ)·(1 + 1/s))`, which neither cancels for small x nor fails where s overflows; without a
    /// coefficient the result is 0.
    #[inline(always)]
    fn impulse_per_rate(&self, inverse: R) -> (R, R) {
        let x = self.h * self.coefficient * inverse;
        let s = x + R::HALF * (x * x);
        (x, R::ONE / (inverse * (R::ONE + R::ONE / s)))
    }

    /// The part of the last kick that this damper has not yet acted on: the whole weight of the dampers after it, and
    /// `1/(2 + x)` of its own. Dampers that act on one rate one after the other then leave `rate/D + kick·(1 − 1/D)/X`,
    /// `D = Π(1 + s)`, `X = Σx`: the flow of `ṙ = a − (c/μ)·r`.
    #[inline(always)]
    fn unmet(&self, x: R) -> R {
        self.later + self.own / (R::TWO + x)
    }

    /// Its impulse from `[1/μ, rate, the kick's rate]`: towards the target rate, within the bounds \[N·s\], and, if it
    /// brakes, at most the impulse that stops the rate.
    #[inline(always)]
    pub(super) fn impulse(
        &self,
        kicked: bool,
        [inverse, rate, kick]: [R; 3],
        (towards, [least, most], brakes): Limits<R>,
    ) -> R {
        let (x, impulse_per_rate) = self.impulse_per_rate(inverse);
        let rate = if kicked { rate - kick * self.unmet(x) } else { rate };
        let impulse = impulse_per_rate * (rate - towards);
        let impulse = R::pick(most.less_than(impulse), most, impulse);
        let impulse = R::pick(impulse.less_than(least), least, impulse);
        if !brakes {
            return impulse;
        }
        let (whole, zero) = (rate / inverse, R::ZERO);
        let backward = whole.less_than(zero);
        let (least, most) = (R::pick(backward, whole, zero), R::pick(backward, zero, whole));
        let impulse = R::pick(most.less_than(impulse), most, impulse);
        R::pick(impulse.less_than(least), least, impulse)
    }
}

/// One of a pair's bodies during its dampers' impulses.
#[derive(Clone, Copy)]
struct Side<S: Space> {
    inverse_inertia: S::Moment,
    /// \[rad/s\] angular velocity before the pass, body axes.
    spin: S::Moment,
    /// \[rad/s\] its change by the kick.
    kick: S::Moment,
    /// \[rad/s\] its change by the dampers so far.
    turn: S::Moment,
}

/// The body in a row with its inverse mass, velocity and the velocity's change by the kick.
#[inline(always)]
#[allow(clippy::type_complexity)]
fn side<P: Geometry, T: Terms<P>, K: Kick<P>>(
    model: &ModelRef<'_, P, T>,
    row: usize,
    moving: &Moving<'_, P>,
    kick: &K,
) -> Option<(Side<P::Space>, P::Real, P::Vector, P::Vector)> {
    let (body, (velocity, spin)) = (model.bodies.get(row)?, moving.velocities(row)?);
    let kick = kick.of(row)?;
    let side = Side {
        inverse_inertia: body.inverse_inertia,
        spin,
        kick: kick.angular,
        turn: P::Moment::ZERO,
    };
    Some((side, body.inverse_mass, velocity, kick.linear))
}

impl<S: Space> Side<S> {
    #[inline(always)]
    fn rate(&self, moment: S::Moment) -> S::Real {
        moment.dot(self.spin + self.turn)
    }

    /// Adds the response to an impulsive moment.
    #[inline(always)]
    fn turn(&mut self, response: S::Moment) {
        self.turn = self.turn + response;
    }
}

/// What a pair opposes to an impulse.
struct Met<S: Space> {
    /// The direction.
    along: S::Vector,
    /// Changes of angular velocity per impulse, of the first body and of the second.
    responses: [S::Moment; 2],
    /// 1/μ.
    inverse: S::Real,
    /// \[m/s\] or \[rad/s\] the rate, and the part of it that is the kick's.
    rate: S::Real,
    kick: S::Real,
    /// The lanes without an impulse.
    idle: <S::Real as Real>::Mask,
}

/// The two bodies of a pair during its dampers' impulses. Impulses are summed separately from the velocities, which are
/// rounded once per pair, not once per damper: a fast body's velocity in single precision cannot resolve the impulse of
/// a single damper of its joint. With `TURNS` all impulses are moments: translations are left out.
pub(super) struct Pair<S: Space, const TURNS: bool = false> {
    rows: [usize; 2],
    sides: [Option<Side<S>>; 2],
    inverse_masses: [S::Real; 2],
    /// \[m/s\] of the second body minus that of the first, moved ground included, before the pass.
    velocity: S::Vector,
    /// \[m/s\] its change by the kick.
    kick: S::Vector,
    /// \[N·s\] on the first body so far, the second's reversed.
    impulse: S::Vector,
    /// \[1/kg\] of both bodies together.
    inverse_mass: S::Real,
}

impl<S: Space, const TURNS: bool> Pair<S, TURNS> {
    /// The bodies in two rows; the ground has none.
    #[inline(always)]
    pub(super) fn new<
        P: Geometry<Space = S, Real = S::Real, Vector = S::Vector, Moment = S::Moment>,
        T: Terms<P>,
        K: Kick<P>,
    >(
        model: &ModelRef<'_, P, T>,
        rows: [usize; 2],
        moving: &Moving<'_, P>,
        ground_rate: S::Vector,
        kick: &K,
    ) -> Self {
        let [a, b] = rows;
        let (a, b) = (side(model, a, moving, kick), side(model, b, moving, kick));
        let mut velocity = ground_rate;
        let mut pushed = S::Vector::ZERO;
        let mut inverse_masses = [S::Real::ZERO; 2];
        if let Some((_, inverse_mass, linear, kick)) = b
            && !TURNS
        {
            velocity = velocity + linear;
            pushed = kick;
            inverse_masses[1] = inverse_mass;
        }
        if let Some((_, inverse_mass, linear, kick)) = a
            && !TURNS
        {
            velocity = velocity - linear;
            pushed = pushed - kick;
            inverse_masses[0] = inverse_mass;
        }
        Self {
            rows,
            sides: [a.map(|a| a.0), b.map(|b| b.0)],
            inverse_masses,
            velocity,
            kick: pushed,
            impulse: S::Vector::ZERO,
            inverse_mass: inverse_masses[0] + inverse_masses[1],
        }
    }

    /// Whether the first or the second end is a body.
    #[inline(always)]
    pub(super) fn has(&self, end: usize) -> bool {
        matches!(self.sides.get(end), Some(Some(_)))
    }

    /// Applies one damper, except in lanes where it is idle.
    #[inline(always)]
    pub(super) fn damp<
        P: Geometry<Space = S, Real = S::Real, Vector = S::Vector, Moment = S::Moment>,
        K: Kick<P>,
    >(
        &mut self,
        direction: &Direction<S>,
        damper: Damper<S::Real>,
        idle: <S::Real as Real>::Mask,
    ) {
        let Some(met) = self.meet::<P, K>(direction, idle, None) else { return };
        let (x, impulse_per_rate) = damper.impulse_per_rate(met.inverse);
        let rate = if K::KNOWN { met.rate - met.kick * damper.unmet(x) } else { met.rate };
        self.push(&met, impulse_per_rate * rate, None);
    }

    /// Applies one damper towards a target rate, its impulse within the bounds \[N·s\] and, if it brakes, at most the
    /// impulse that stops the rate.
    #[inline(always)]
    pub(super) fn damp_within<
        P: Geometry<Space = S, Real = S::Real, Vector = S::Vector, Moment = S::Moment>,
        K: Kick<P>,
    >(
        &mut self,
        direction: &Direction<S>,
        damper: Damper<S::Real>,
        limits: Limits<S::Real>,
        inner: Option<(S::Real, &mut Inner<S::Real>)>,
    ) {
        let known = inner.as_ref().map(|(part, inner)| (*part, &**inner));
        let idle = S::Real::mask(false);
        let Some(met) = self.meet::<P, K>(direction, idle, known) else { return };
        let impulse = damper.impulse(K::KNOWN, [met.inverse, met.rate, met.kick], limits);
        self.push(&met, impulse, inner);
    }

    /// What the pair, and a law's internal degree of freedom, oppose to an impulse along a direction; `None` where every
    /// lane is idle.
    #[inline(always)]
    fn meet<
        P: Geometry<Space = S, Real = S::Real, Vector = S::Vector, Moment = S::Moment>,
        K: Kick<P>,
    >(
        &self,
        direction: &Direction<S>,
        idle: <S::Real as Real>::Mask,
        inner: Option<(S::Real, &Inner<S::Real>)>,
    ) -> Option<Met<S>> {
        let Direction { along: u, moments: [moment_a, moment_b] } = *direction;
        let [a, b] = &self.sides;
        let [mut inverse, mut rate, mut kick] = [S::Real::ZERO; 3];
        if !TURNS {
            inverse = u.dot(u) * self.inverse_mass;
            rate = u.dot(self.velocity - self.impulse * self.inverse_mass);
            kick = if K::KNOWN { u.dot(self.kick) } else { kick };
        }
        let (mut response_a, mut response_b) = (S::Moment::ZERO, S::Moment::ZERO);
        if let Some(b) = b {
            response_b = moment_b.scale(b.inverse_inertia);
            inverse = inverse + moment_b.dot(response_b);
            rate = rate + b.rate(moment_b);
            if K::KNOWN {
                kick = kick + moment_b.dot(b.kick);
            }
        }
        if let Some(a) = a {
            response_a = moment_a.scale(a.inverse_inertia);
            inverse = inverse + moment_a.dot(response_a);
            rate = rate - a.rate(moment_a);
            if K::KNOWN {
                kick = kick - moment_a.dot(a.kick);
            }
        }
        if let Some((part, inner)) = inner {
            inverse = inverse + part * (part * inner.inverse_inertia);
            rate = rate + part * inner.rate;
            if K::KNOWN {
                kick = kick + part * inner.kick;
            }
        }
        // Without a direction (coincident points) there is no impulse.
        let idle = idle | inverse.equals(S::Real::ZERO);
        let responses = [response_a, response_b];
        (!idle.all()).then_some(Met { along: u, responses, inverse, rate, kick, idle })
    }

    /// Applies an impulse, except in lanes where it is idle.
    #[inline(always)]
    fn push(
        &mut self,
        met: &Met<S>,
        impulse: S::Real,
        inner: Option<(S::Real, &mut Inner<S::Real>)>,
    ) {
        let Met { along, responses: [response_a, response_b], idle, .. } = *met;
        let [a, b] = &mut self.sides;
        if !TURNS {
            self.impulse = self.impulse + (along * impulse).unless(idle);
        }
        if let Some((part, inner)) = inner {
            inner.rate = inner.rate - part * (inner.inverse_inertia * impulse);
        }
        if let Some(a) = a {
            a.turn((response_a * impulse).unless(idle));
        }
        if let Some(b) = b {
            b.turn((response_b * -impulse).unless(idle));
        }
    }

    /// Adds the dampers' impulses to the bodies.
    #[inline(always)]
    pub(super) fn store<
        P: Geometry<Space = S, Real = S::Real, Vector = S::Vector, Moment = S::Moment>,
    >(
        self,
        moving: &mut Moving<'_, P>,
    ) {
        let [row_a, row_b] = self.rows;
        let [a, b] = self.sides;
        let [inverse_a, inverse_b] = self.inverse_masses;
        let sides = [(row_a, a, inverse_a), (row_b, b, -inverse_b)];
        for (row, side, inverse_mass) in sides {
            if let Some(side) = side {
                if !TURNS {
                    moving.accelerate(row, self.impulse * inverse_mass);
                }
                moving.spin_up(row, side.turn);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::Increment;
    use crate::geometry::F32;
    use crate::vector::Vec3;

    /// A damper with h·c/μ = x for 1/μ = `inverse`.
    fn damper<R: Real>(x: f64, inverse: f64) -> Damper<R> {
        let coefficient = R::from_f64(x) / R::from_f64(inverse);
        Damper { coefficient, own: R::ONE, later: R::ZERO, h: R::ONE }
    }

    /// The fraction of a relative velocity that a damper removes.
    fn removed<R: Real>(x: f64, inverse: f64) -> f64 {
        let inverse_real = R::from_f64(inverse);
        (damper::<R>(x, inverse).impulse_per_rate(inverse_real).1 * inverse_real).to_f64()
    }

    #[test]
    fn light_and_strong_dampers_lose_no_digits() {
        for exponent in -12..=12 {
            let x = 10_f64.powi(exponent);
            let exact = (x + 0.5 * x * x) / (1.0 + x + 0.5 * x * x);
            for inverse in [1e-6, 0.7, 1e6] {
                let (double, single) = (removed::<f64>(x, inverse), removed::<f32>(x, inverse));
                assert!((double / exact - 1.0).abs() < 1e-15, "{x}: {double} of {exact}");
                assert!((single / exact - 1.0).abs() < 5e-7, "{x}: {single} of {exact}");
            }
        }
    }

    /// Angular velocities after two dampers of a rotation, as of a pair that leaves translations out or not.
    fn turned<const TURNS: bool>() -> [Vec3<f32>; 2] {
        let vector = |x: f64, y: f64, z: f64| Vec3::from_f64([x, y, z]);
        let side = |spin| Side {
            inverse_inertia: vector(3.0, 0.7, 11.0),
            spin,
            kick: vector(0.01, -0.02, 0.03),
            turn: Vec3::ZERO,
        };
        let mut pair = Pair::<f32, TURNS> {
            rows: [0, 1],
            sides: [Some(side(vector(0.3, -0.2, 0.9))), Some(side(vector(-0.7, 0.1, 0.4)))],
            inverse_masses: [0.5, 2.0],
            velocity: vector(0.2, 0.3, -0.1),
            kick: vector(0.02, 0.01, 0.03),
            impulse: Vec3::ZERO,
            inverse_mass: 2.5,
        };
        for coefficient in [0.3, 5.0] {
            let moments = [vector(0.1, 0.2, 0.97), vector(-0.2, 0.3, 0.93)];
            let direction = Direction { along: Vec3::ZERO, moments };
            let known = Damper { coefficient, own: 0.6, later: 0.4, h: 1e-3 };
            let limits = (0.1, [-1e-4, 1.0], false);
            pair.damp_within::<F32, AnyKick>(&direction, known, limits, None);
        }
        assert_eq!(pair.impulse, Vec3::ZERO);
        pair.sides.map(|side| side.unwrap().turn)
    }

    struct AnyKick;

    impl Kick<F32> for AnyKick {
        const KNOWN: bool = true;
        fn of(&self, _: usize) -> Option<Increment<f32>> {
            None
        }
    }

    #[test]
    fn dampers_of_rotations_have_the_same_bits_without_translations() {
        let [first, second] = turned::<true>();
        assert!(first.dot(first) > 0.0 && second.dot(second) > 0.0);
        assert_eq!([first, second], turned::<false>());
    }

    #[test]
    fn no_coefficient_takes_nothing_and_none_more_than_all() {
        assert_eq!(removed::<f32>(0.0, 0.7), 0.0);
        assert_eq!(removed::<f64>(0.0, 0.7), 0.0);
        // Beyond 1e19 the square overflows in single precision, beyond 1e154 in double.
        for x in [1e15, 1e19, 1e25, 1e30, 3e38] {
            assert!((removed::<f32>(x, 1.0) - 1.0).abs() < 1e-6, "{x}");
        }
        for x in [1e100, 1e160, 1e300] {
            assert_eq!(removed::<f64>(x, 1.0), 1.0);
        }
    }
}
