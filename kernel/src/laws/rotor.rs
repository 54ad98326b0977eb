//! A rotor behind an elastic gear: an internal degree of freedom in a drive's memory.
//!
//! At the side of the coordinate x, with `y = x + δ` the rotor's angle, v its rate, m its inertia times the square of
//! the gear ratio: the gear acts on x with `k·dead(δ) + c·(v − ẋ)`, dead the part of δ beyond half of the backlash on
//! either side, and on the rotor with the opposite, `m·v̇ = τ − k·dead(δ) − c·(v − ẋ)` (Nordin, Galić & Gutman, Int. J.
//! Adapt. Control Signal Process. 11 (1997) 49). Force and moment are a pair between the two bodies: the reaction of
//! the rotor's own angular momentum on its housing, 1/ratio of it, is left out, as for an armature.
//!
//! δ and v are integrated with the bodies: both are kicked by half of the force of a pose before and after a drift,
//! dampers act in the damper passes like those of bodies. With a lag T the effort follows `T·τ̇ = τ_c − τ`, for an
//! inductance `T = L/R`; the pair (v, τ) then advances half a step by the (0,2) Padé approximant of its matrix, stable
//! at any step.

use crate::force_pair::ForcePair;
use crate::geometry::Geometry;
use crate::laws::coordinate::Coordinate;
use crate::laws::end::Seen;
use crate::laws::interaction::{Damper, Inner, Springs, Wrong};
use crate::laws::servo::Effort;
use crate::laws::shaft_friction::ShaftFriction;
use crate::real::Real;
use crate::schedule::Signal;
use crate::words::{Word, WordSource, WordVisitor, Words};

/// A drive's memory of its rotor, at the side of the coordinate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rotor<R> {
    /// \[m, rad\] the coordinate at the end of the last step.
    pub last: R,
    /// \[m, rad\] δ, the rotor's lead over it.
    pub ahead: R,
    /// \[m/s, rad/s\] its rate v.
    pub rate: R,
    /// \[N, N·m\] the effort τ.
    pub effort: R,
    /// Whether its rate is initialised: at first it equals that of the coordinate.
    pub begun: bool,
}

impl<R: Real> Default for Rotor<R> {
    fn default() -> Self {
        let zero = R::ZERO;
        Self { last: zero, ahead: zero, rate: zero, effort: zero, begun: false }
    }
}

impl<R: Real> Rotor<R> {
    /// \[W\] the power of the effort.
    pub(super) fn supply(&self) -> R {
        self.effort * self.rate
    }
}

impl<R: Real> Words for Rotor<R> {
    fn visit(&self, visitor: &mut impl WordVisitor) {
        let numbers = [self.last, self.ahead, self.rate, self.effort];
        numbers.iter().for_each(|number| visitor.word(number.word()));
        visitor.word(Word::I32(i32::from(self.begun)));
    }
    fn fill(&mut self, source: &mut impl WordSource) {
        for number in [&mut self.last, &mut self.ahead, &mut self.rate, &mut self.effort] {
            *number = R::from_words(source);
        }
        self.begun = source.take(4) != 0;
    }
}

/// The constants of a gear with the rotor behind it, in N, m or N·m, rad.
#[derive(Clone, Copy)]
pub(super) struct Gear<R> {
    /// m.
    pub(super) inertia: R,
    /// k.
    pub(super) stiffness: R,
    /// c.
    pub(super) damping: R,
    pub(super) play: R,
    /// \[s\] T.
    pub(super) lag: R,
}

impl<R: Real> Gear<R> {
    /// Refuses invalid constants.
    pub(super) fn check(&self) -> Result<(), Wrong> {
        let zero = R::ZERO;
        Wrong::unless(self.inertia > zero, "inertia", "is not positive", "an inertia > 0")?;
        Wrong::unless(self.stiffness > zero, "stiffness", "is not positive", "a stiffness > 0")?;
        Wrong::unless(self.damping >= zero, "damping", "is negative", "a number ≥ 0")?;
        Wrong::unless(self.play >= zero, "play", "is negative", "a number ≥ 0")?;
        Wrong::unless(self.lag >= zero, "lag", "is negative", "a time ≥ 0")
    }

    /// The rotor as a degree of freedom; `kick` \[m/s, rad/s\] is its change by the kick.
    #[inline(always)]
    pub(super) fn inner(&self, rotor: &Rotor<R>, kick: R) -> Inner<R> {
        Inner { rate: rotor.rate, kick, inverse_inertia: R::ONE / self.inertia }
    }

    /// \[rad²/s²\] the square of the rotor's natural frequency with a fixed coordinate, including the stiffness of a
    /// servo.
    pub(super) fn square(&self, servo: R) -> R {
        (self.stiffness + servo) / self.inertia
    }

    /// The part of δ beyond half of the backlash.
    #[inline(always)]
    fn dead(&self, ahead: R) -> R {
        let half = R::HALF * self.play;
        let (above, below) = (ahead - half, ahead + half);
        let beyond = R::pick(R::ZERO.less_than(above), above, R::ZERO);
        R::pick(below.less_than(R::ZERO), below, beyond)
    }
}

/// A coordinate that a rotor drives.
pub(super) struct Geared<P: Geometry, const RUBS: bool> {
    /// Its value is precise near that at the end of the last step, not unwrapped.
    coordinate: Coordinate<P>,
    gear: Gear<P::Real>,
    /// Unused where it does not rub.
    friction: ShaftFriction<P::Real>,
}

impl<P: Geometry, const RUBS: bool> Geared<P, RUBS> {
    #[inline(always)]
    pub(super) fn new(
        coordinate: Coordinate<P>,
        gear: Gear<P::Real>,
        friction: ShaftFriction<P::Real>,
    ) -> Self {
        Self { coordinate, gear, friction }
    }

    /// δ at this pose.
    #[inline(always)]
    fn ahead(&self, rotor: &Rotor<P::Real>) -> P::Real {
        rotor.ahead - (self.coordinate.value - rotor.last)
    }

    /// \[N, N·m\] the force of the gear on the coordinate, and its opposite on the rotor.
    #[inline(always)]
    fn pull(&self, rotor: &Rotor<P::Real>) -> P::Real {
        self.gear.stiffness * self.gear.dead(self.ahead(rotor))
    }

    /// The rate of the rotor; at first that of the coordinate.
    #[inline(always)]
    fn rate(&self, seen: &Seen<'_, P>, rotor: &Rotor<P::Real>) -> P::Real {
        if rotor.begun { rotor.rate } else { seen.rate(&self.coordinate.direction(seen)) }
    }

    /// Updates the rotor at this pose; the coordinate's value is `next` for the following poses.
    #[inline(always)]
    pub(super) fn settle(&self, seen: &Seen<'_, P>, next: P::Real, rotor: &mut Rotor<P::Real>) {
        rotor.ahead = self.ahead(rotor);
        rotor.rate = self.rate(seen, rotor);
        rotor.last = next;
        rotor.begun = true;
    }

    #[inline(always)]
    pub(super) fn force_pair(
        &self,
        seen: &Seen<'_, P>,
        rotor: &Rotor<P::Real>,
    ) -> ForcePair<P::Space> {
        seen.pull(&self.coordinate.direction(seen), -self.pull(rotor))
    }

    /// \[J\] the energy of gear and rotor.
    pub(super) fn energy(&self, seen: &Seen<'_, P>, rotor: &Rotor<P::Real>) -> P::Real {
        let (beyond, rate) = (self.gear.dead(self.ahead(rotor)), self.rate(seen, rotor));
        let twice = self.gear.stiffness * (beyond * beyond) + self.gear.inertia * (rate * rate);
        P::Real::HALF * twice
    }

    pub(super) fn tangent(
        &self,
        seen: &Seen<'_, P>,
        rotor: &Rotor<P::Real>,
        visit: Springs<'_, P>,
    ) -> [P::Real; 2] {
        visit(self.gear.stiffness, &self.coordinate.direction(seen));
        self.coordinate.bent(seen, self.pull(rotor).abs(), visit)
    }

    /// The damper of the gear, which never pulls its teeth apart.
    #[inline(always)]
    pub(super) fn damper(&self, seen: &Seen<'_, P>, rotor: &Rotor<P::Real>) -> Damper<P> {
        let (pull, zero) = (self.pull(rotor), P::Real::ZERO);
        if self.gear.damping == zero || (self.gear.play > zero && pull == zero) {
            return Damper::idle();
        }
        let damper = Damper::new(self.gear.damping, self.coordinate.direction(seen));
        let damper = damper.with_inner(-P::Real::ONE);
        if self.gear.play == zero {
            return damper;
        }
        let [least, most] = damper.bounds();
        let forward = zero.less_than(pull);
        damper.within(P::Real::pick(forward, least, pull), P::Real::pick(forward, pull, most))
    }

    /// Applies the gear, and the effort without damping and lag, to the rotor for the time `h` \[s\]; returns the
    /// change.
    #[inline(always)]
    pub(super) fn kick(
        &self,
        (effort, signal): (&Effort<P::Real>, Signal<P::Real>),
        h: P::Real,
        rotor: &mut Rotor<P::Real>,
    ) -> P::Real {
        let mut kick = self.whole_kick((effort, signal), h, rotor);
        if RUBS {
            kick = self.friction.kick(&self.gear, (h, kick), rotor);
        }
        rotor.rate = rotor.rate + kick;
        kick
    }

    /// The kick without friction.
    #[inline(always)]
    fn whole_kick(
        &self,
        (effort, signal): (&Effort<P::Real>, Signal<P::Real>),
        h: P::Real,
        rotor: &mut Rotor<P::Real>,
    ) -> P::Real {
        let mut force = -self.pull(rotor);
        if effort.damping == P::Real::ZERO && self.gear.lag == P::Real::ZERO {
            rotor.effort = effort.bounded(effort.gain * signal.value);
            force = force + rotor.effort;
        }
        h * force / self.gear.inertia
    }

    /// Drives and damps the rotor for the time `h` \[s\], including the kick: the flow of `m·v̇ = m·kick/h + τ`.
    /// `place` is the rotor's angle.
    #[inline(always)]
    pub(super) fn drive(
        &self,
        (effort, signal): (&Effort<P::Real>, Signal<P::Real>),
        place: P::Real,
        [h, kick]: [P::Real; 2],
        rotor: &mut Rotor<P::Real>,
    ) {
        if RUBS {
            let whole = self.whole_kick((effort, signal), h, rotor);
            let driven = (effort, signal, place);
            return self.friction.drive(&self.gear, driven, ([h, kick], whole), rotor);
        }
        let one = P::Real::ONE;
        let Gear { inertia, lag, .. } = self.gear;
        let (inverse, towards) = (one / inertia, effort.towards(signal, place));
        if lag == P::Real::ZERO {
            if effort.damping == P::Real::ZERO {
                return;
            }
            let x = h * effort.damping * inverse;
            let s = x + P::Real::HALF * (x * x);
            let rate = rotor.rate - kick / (P::Real::TWO + x) - towards;
            let damped = rate / (inverse * (one + one / s) * h);
            rotor.effort = effort.bounded(effort.gain * signal.value - damped);
            rotor.rate = rotor.rate + h * rotor.effort * inverse;
            return;
        }
        // (v, τ)' = (kick/h + τ/m, (gain·u + d·(r₀ − v) − τ)/T), both in units of the time h.
        let (down, across) = (h / lag, h * inverse);
        let back = down * effort.damping;
        let asked = effort.gain * signal.value + effort.damping * towards;
        let (of_rate, of_effort) = (kick, down * asked);
        // b − ½·A·b, A = [0, across; −back, −down].
        let half = P::Real::HALF;
        let right_rate = (rotor.rate - kick) + of_rate - half * (across * of_effort);
        let right_effort = rotor.effort + of_effort + half * (back * of_rate + down * of_effort);
        // I − A + ½·A².
        let turn = across * back;
        let (a, b) = (one - half * turn, -(across + half * (across * down)));
        let (c, d) = (back + half * (down * back), one + down + half * (down * down - turn));
        let inverse = one / (a * d - b * c);
        rotor.rate = (d * right_rate - b * right_effort) * inverse;
        rotor.effort = effort.bounded((a * right_effort - c * right_rate) * inverse);
    }

    /// The coordinate.
    #[inline(always)]
    pub(super) fn value(&self) -> P::Real {
        self.coordinate.value
    }

    /// \[m, rad\] the rotor's angle.
    #[inline(always)]
    pub(super) fn place(&self, rotor: &Rotor<P::Real>) -> P::Real {
        self.coordinate.value + self.ahead(rotor)
    }

    /// Advances the rotor by `h` \[s\].
    #[inline(always)]
    pub(super) fn advance(&self, h: P::Real, rotor: &mut Rotor<P::Real>) {
        rotor.ahead = rotor.ahead + h * rotor.rate;
    }

    /// Its outputs: torque of the gear, effort, torsion angle, rate of the rotor.
    pub(super) fn read(&self, quantity: usize, rotor: &Rotor<P::Real>) -> P::Real {
        match quantity {
            0 => self.pull(rotor),
            1 => rotor.effort,
            2 => self.ahead(rotor),
            _ => rotor.rate,
        }
    }
}
