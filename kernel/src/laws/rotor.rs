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
use crate::laws::gear::{Gear, Rotor};
use crate::laws::interaction::{Damper, Springs};
use crate::laws::machine::{Currents, Machine};
use crate::laws::servo::Effort;
use crate::laws::shaft_friction::ShaftFriction;
use crate::real::Real;
use crate::schedule::Signal;

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
        self.coordinate.pull(seen, -self.pull(rotor))
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

    /// [`Self::drive`] by windings at voltages of d and q.
    #[inline(always)]
    pub(super) fn drive_wound(
        &self,
        (machine, volts): (&Machine<P::Real>, [P::Real; 2]),
        [h, kick]: [P::Real; 2],
        rotor: &mut Rotor<P::Real>,
        currents: &mut Currents<P::Real>,
    ) {
        let Self { gear, friction, .. } = self;
        let from = *currents;
        let flow =
            |kick, rate| machine.flow((gear, friction.viscous), volts, ([h, kick], rate), from);
        (rotor.rate, *currents) = if friction.coulomb == P::Real::ZERO {
            let flow = flow(kick, rotor.rate);
            (flow.rate, flow.after)
        } else {
            friction.stuck(gear, ([h, kick], self.pulled(h, rotor)), rotor.rate, flow)
        };
        rotor.effort = machine.effort(*currents);
    }

    /// The kick of the gear alone.
    #[inline(always)]
    fn pulled(&self, h: P::Real, rotor: &Rotor<P::Real>) -> P::Real {
        h * -self.pull(rotor) / self.gear.inertia
    }

    /// [`Self::kick`] without an effort: that of windings follows their currents.
    #[inline(always)]
    pub(super) fn kick_wound(&self, h: P::Real, rotor: &mut Rotor<P::Real>) -> P::Real {
        let kick = self.friction.kick(&self.gear, (h, self.pulled(h, rotor)), rotor);
        rotor.rate = rotor.rate + kick;
        kick
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
