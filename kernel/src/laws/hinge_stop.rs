//! Stops of a turn about an axis: the law of [`super::EndStop`] at both ends of a range.
//!
//! Twist `θ ↦ x = θ − to` or `from − θ`, torque `k·x·(1 + a·ẋ)` back into the range, along the twist's gradient.

use crate::geometry::Geometry;
use crate::laws::end::Seen;
use crate::laws::hinge::Turns;
use crate::laws::interaction::{Damper, Interaction, Quantity, Springs, Wrong};
use crate::real::Real;
use crate::record::Direction;
use crate::record::Record;
use crate::space::Linear as _;

law! {
    /// Stops at both ends of a range of rotation of the second body relative to the first about an axis.
    pub struct HingeStop = "hinge-stop" {
        /// Axis of rotation; the angle is 0 at t = 0 and counts whole turns.
        axis: Axis,
        /// Lower end of the range.
        from: Number("rad"),
        /// Upper end of the range.
        to: Number("rad"),
        /// Torque per angle beyond the range.
        stiffness: Number("N·m/rad"),
        /// Hunt–Crossley coefficient a: the torque is stiffness · depth · (1 + a · rate of the depth).
        dissipation: Number("s/rad") = 0.0,
    }
}

struct Stopped<P: Geometry> {
    direction: Direction<P::Space>,
    /// \[rad\] beyond the range: above 0 at its upper end, below 0 at its lower one, 0 within.
    beyond: P::Real,
    /// \[1\] square of the gradient.
    square: P::Real,
}

impl<P: Geometry> HingeStop<P> {
    #[inline(always)]
    fn stopped(&self, seen: &Seen<'_, P>, turns: Turns) -> Option<Stopped<P>> {
        let (angle, gradient) = self.axis.seen(seen)?.angle(turns);
        let gradient = seen.a.moment_to_world(gradient);
        let (above, below, zero) = (angle - self.to, angle - self.from, P::Real::ZERO);
        let beyond = P::Real::pick(below.less_than(zero), below, zero);
        let beyond = P::Real::pick(zero.less_than(above), above, beyond);
        Some(Stopped { direction: seen.about(gradient), beyond, square: gradient.dot(gradient) })
    }
}

impl<P: Geometry> Interaction<P> for HingeStop<P> {
    type State = Turns;
    type Dampers = [(); 1];
    const QUANTITIES: &'static [Quantity] = &[Quantity { name: "depth", unit: "rad" }];

    #[inline(always)]
    fn settle(&self, seen: &Seen<'_, P>, turns: &mut Turns) {
        if let Some(twist) = self.axis.seen(seen) {
            twist.settle(turns);
        }
    }

    #[inline(always)]
    fn record(&self, seen: &Seen<'_, P>, turns: &Turns) -> Option<Record<P::Space>> {
        let Stopped { direction, beyond, .. } = self.stopped(seen, *turns)?;
        Some(seen.pull(&direction, self.stiffness * beyond))
    }

    fn energy(&self, seen: &Seen<'_, P>, turns: &Turns) -> P::Real {
        let Some(Stopped { beyond, .. }) = self.stopped(seen, *turns) else {
            return P::Real::ZERO;
        };
        P::Real::HALF * (self.stiffness * (beyond * beyond))
    }

    /// As if it were stopped.
    fn tangent(&self, seen: &Seen<'_, P>, turns: &Turns, visit: Springs<'_, P>) -> [P::Real; 2] {
        let Some(Stopped { direction, beyond, square }) = self.stopped(seen, *turns) else {
            return [P::Real::ZERO; 2];
        };
        visit(self.stiffness, &direction);
        let torque = (self.stiffness * beyond).abs();
        [P::Real::HALF * torque * square; 2]
    }

    #[inline(always)]
    fn dampers(&self, seen: &Seen<'_, P>, turns: &Turns, visit: &mut impl FnMut(Damper<P>)) {
        let Some(Stopped { direction, beyond, .. }) = self.stopped(seen, *turns) else { return };
        let (torque, zero) = (self.stiffness * beyond, P::Real::ZERO);
        let damper = Damper::new(self.dissipation * torque.abs(), direction);
        let [least, most] = damper.bounds();
        // Together with the spring it never pulls towards the stop.
        let upper = zero.less_than(torque);
        visit(
            damper
                .within(P::Real::pick(upper, -torque, least), P::Real::pick(upper, most, -torque)),
        );
    }

    fn check(&self) -> Result<(), Wrong> {
        let zero = P::Real::ZERO;
        Wrong::unless(self.to > self.from, "to", "is not above `from`", "a turn above `from`")?;
        Wrong::unless(self.stiffness > zero, "stiffness", "is not positive", "a stiffness > 0")?;
        Wrong::unless(self.dissipation >= zero, "dissipation", "is negative", "a number ≥ 0")
    }

    fn read(&self, _: usize, seen: &Seen<'_, P>, turns: &Turns) -> P::Real {
        self.stopped(seen, *turns).map_or(P::Real::ZERO, |stopped| stopped.beyond.abs())
    }
}
