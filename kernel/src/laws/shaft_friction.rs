//! Friction of a rotor on its shaft, with sticking: part of its kick and of its drive.
//!
//! `(rate v, its change without friction) => change with it`. Dry friction is an impulse within ±F·h/m that at most
//! stops the rotor, which is a single degree of freedom: it sticks exactly and needs no memory. What balances the gear
//! belongs to the kick, so that dampers do not see it; the rest follows the effort, of which a servo's damping makes up
//! for a part: the impulse is that over the response of the rate to it. Viscous friction is part of the flow of the
//! effort, see [`super::rotor`].

use crate::laws::gear::{Gear, Rotor};
use crate::laws::interaction::Wrong;
use crate::laws::servo::Effort;
use crate::real::Real;
use crate::schedule::Signal;

/// The constants of the friction of a rotor, at the side of the coordinate, in N, m or N·m, rad.
#[derive(Clone, Copy)]
pub(super) struct ShaftFriction<R> {
    /// F.
    pub(super) coulomb: R,
    pub(super) viscous: R,
}

/// A rate after a time, what else follows, as an effort, and the response of the rate to an impulse over inertia in that
/// time.
pub(super) struct Flow<R, T = R> {
    pub(super) rate: R,
    pub(super) after: T,
    pub(super) response: R,
}

#[inline(always)]
fn clamp<R: Real>(value: R, [least, most]: [R; 2]) -> R {
    let value = R::pick(most.less_than(value), most, value);
    R::pick(value.less_than(least), least, value)
}

impl<R: Real> ShaftFriction<R> {
    /// Without friction.
    pub(super) const NONE: Self = Self { coulomb: R::ZERO, viscous: R::ZERO };

    /// Refuses invalid constants.
    pub(super) fn check(&self) -> Result<(), Wrong> {
        let zero = R::ZERO;
        Wrong::unless(self.coulomb >= zero, "coulomb", "is negative", "a number ≥ 0")?;
        Wrong::unless(self.viscous >= zero, "viscous", "is negative", "a number ≥ 0")
    }

    /// \[W\] its loss.
    pub(super) fn loss(&self, rate: R) -> R {
        self.coulomb * rate.abs() + self.viscous * (rate * rate)
    }

    /// \[m/s, rad/s\] the bounds of its impulse over the inertia in the time `h` \[s\].
    #[inline(always)]
    fn bounds(&self, gear: &Gear<R>, h: R) -> [R; 2] {
        let most = h * self.coulomb / gear.inertia;
        [-most, most]
    }

    /// The kick less what friction takes of it and of the rate.
    #[inline(always)]
    pub(super) fn kick(&self, gear: &Gear<R>, (h, kick): (R, R), rotor: &Rotor<R>) -> R {
        kick - clamp(rotor.rate + kick, self.bounds(gear, h))
    }

    /// The rotor driven for the time `h` \[s\] after the kick that friction has reduced from `whole`.
    #[inline(always)]
    pub(super) fn drive(
        &self,
        gear: &Gear<R>,
        (effort, signal, place): (&Effort<R>, Signal<R>, R),
        ([h, kick], whole): ([R; 2], R),
        rotor: &mut Rotor<R>,
    ) {
        let driven = (effort, signal, place);
        (rotor.rate, rotor.effort) =
            self.stuck(gear, ([h, kick], whole), rotor.rate, |kick, rate| {
                self.flow(gear, driven, [h, kick], &Rotor { rate, ..*rotor })
            });
    }

    /// A rate and what else follows after the time `h` \[s\] and the kick that friction has reduced from `whole`;
    /// `flow(kick, rate)` is that without friction.
    #[inline(always)]
    pub(super) fn stuck<T>(
        &self,
        gear: &Gear<R>,
        ([h, kick], whole): ([R; 2], R),
        rate: R,
        flow: impl Fn(R, R) -> Flow<R, T>,
    ) -> (R, T) {
        let taken = whole - kick;
        let [least, most] = self.bounds(gear, h);
        let [least, most] = [least - taken, most - taken];
        let free = flow(kick, rate);
        let more = clamp(free.rate / free.response, [least, most]);
        let flow = flow(kick - more, rate - more);
        // A bounded effort responds otherwise, and the last digit of a stop.
        let last = clamp(flow.rate, [least - more, most - more]);
        (flow.rate - last, flow.after)
    }

    /// The flow of effort and viscous friction, without dry friction.
    #[inline(always)]
    fn flow(
        &self,
        gear: &Gear<R>,
        (effort, signal, place): (&Effort<R>, Signal<R>, R),
        [h, kick]: [R; 2],
        rotor: &Rotor<R>,
    ) -> Flow<R> {
        let (zero, one) = (R::ZERO, R::ONE);
        let Gear { inertia, lag, .. } = *gear;
        let (inverse, towards) = (one / inertia, effort.towards(signal, place));
        if lag != zero {
            return self.lagging(gear, (effort, signal, towards), [h, kick], rotor);
        }
        if effort.damping == zero {
            // The effort is part of the kick.
            let (rate, _, response) = damped([rotor.rate, kick], [self.viscous, zero], h, inverse);
            return Flow { rate, after: rotor.effort, response };
        }
        let sum = effort.damping + self.viscous;
        let target = effort.damping * towards / sum;
        let (rate, mean, response) = damped([rotor.rate, kick], [sum, target], h, inverse);
        let constant = effort.gain * signal.value;
        let asked = constant + effort.damping * (towards - mean);
        let given = effort.bounded(asked);
        if given == asked {
            return Flow { rate: rate + h * constant * inverse, after: given, response };
        }
        let push = h * given * inverse;
        let pushed = [rotor.rate + push, kick + push];
        let (rate, _, response) = damped(pushed, [self.viscous, zero], h, inverse);
        Flow { rate, after: given, response }
    }

    /// The flow with a lag: `(v, τ)' = (kick/h + (τ − b·v)/m, (gain·u + d·(r₀ − v) − τ)/T)`.
    #[inline(always)]
    fn lagging(
        &self,
        gear: &Gear<R>,
        (effort, signal, towards): (&Effort<R>, Signal<R>, R),
        [h, kick]: [R; 2],
        rotor: &Rotor<R>,
    ) -> Flow<R> {
        let (one, half) = (R::ONE, R::HALF);
        let (down, across) = (h / gear.lag, h / gear.inertia);
        let (back, brake) = (down * effort.damping, across * self.viscous);
        let asked = down * (effort.gain * signal.value + effort.damping * towards);
        // b − ½·A·b and I − A + ½·A², A = [−brake, across; −back, −down].
        let right_rate = rotor.rate + half * (brake * kick - across * asked);
        let right_effort = rotor.effort + asked + half * (back * kick + down * asked);
        let (sum, turn) = (one + half * (brake + down), across * back);
        let (a, b) = (one + brake + half * (brake * brake - turn), -(across * sum));
        let (c, d) = (back * sum, one + down + half * (down * down - turn));
        let inverse = one / (a * d - b * c);
        let rate = (d * right_rate - b * right_effort) * inverse;
        let given = effort.bounded((a * right_effort - c * right_rate) * inverse);
        let response = (d * (one + half * brake) - b * (half * back)) * inverse;
        Flow { rate, after: given, response }
    }
}

/// `[rate, kick]` after a damper `[coefficient, target rate]` that has acted for `h`: the rate, the mean rate in the
/// damper, the response to an impulse.
#[inline(always)]
fn damped<R: Real>([rate, kick]: [R; 2], [damping, target]: [R; 2], h: R, inverse: R) -> (R, R, R) {
    let one = R::ONE;
    let x = h * damping * inverse;
    let half = one + R::HALF * x;
    let (before, part) = (one / (R::TWO + x), half / (one + x * half));
    let off = part * (rate - kick * before - target);
    (rate - x * off, target + off, one - (one - before) * (x * part))
}
