//! Dry friction of a turn about an axis, which sticks.
//!
//! `z = θ − s ↦ torque −k·z` along the twist's gradient, `k = F/give`; where `|k·z|` exceeds the limit F(v), s follows
//! θ (Prandtl 1928; Dupont, Hayward, Armstrong, Altpeter, IEEE TAC 47 (2002) 787). What a boundary returns to the
//! limit is lost: it takes energy at any step, holds still at rest, and remembers s. The limit is
//! `F(v) = coulomb + (breakaway − coulomb)/(1 + (v/stribeck)²)` (Hess & Soom, J. Tribology 112 (1990) 147) at the mean
//! rate of the step before.

use crate::geometry::Geometry;
use crate::laws::end::Seen;
use crate::laws::hinge::Turns;
use crate::laws::interaction::{Damper, Interaction, Quantity, Springs, Wrong};
use crate::real::Real;
use crate::record::Direction;
use crate::record::Record;
use crate::space::Linear as _;
use crate::words::{WordSource, WordVisitor, Words};

law! {
    /// Dry friction between two bodies that turn about an axis.
    pub struct HingeFriction = "hinge-friction" {
        /// Axis of rotation.
        axis: Axis,
        /// Torque of sliding friction at high rates.
        coulomb: Number("N·m"),
        /// Torque at which sliding begins from rest, at least as large.
        breakaway: Number("N·m"),
        /// Rate at which the torque is midway between `breakaway` and `coulomb`.
        stribeck: Number("rad/s") = 0.05,
        /// Elastic rotation at the torque of breakaway.
        give: Number("rad") = 0.001,
        /// Damping of the elastic rotation; with it the torque stays within the limit.
        damping: Number("N·m·s/rad") = 0.0,
        /// Viscous friction.
        viscous: Number("N·m·s/rad") = 0.0,
    }
}

/// What friction remembers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slip<R> {
    /// Half windings of the twist.
    pub turns: Turns,
    /// \[rad\] the twist at which its give is 0.
    pub rest: R,
    /// \[rad\] the twist at the end of the step before.
    pub last: R,
    /// \[1\] the part of the difference of breakaway and Coulomb torque that is in the limit.
    pub more: R,
}

impl<R: Real> Default for Slip<R> {
    fn default() -> Self {
        Self { turns: Turns(0), rest: R::ZERO, last: R::ZERO, more: R::ONE }
    }
}

impl<R: Real> Words for Slip<R> {
    fn visit(&self, visitor: &mut impl WordVisitor) {
        self.turns.visit(visitor);
        [self.rest, self.last, self.more].iter().for_each(|number| visitor.word(number.word()));
    }
    fn fill(&mut self, source: &mut impl WordSource) {
        self.turns.fill(source);
        for number in [&mut self.rest, &mut self.last, &mut self.more] {
            *number = R::from_words(source);
        }
    }
}

struct Rubbing<P: Geometry> {
    direction: Direction<P::Space>,
    angle: P::Real,
    /// \[N·m\] of its give.
    torque: P::Real,
    /// \[N·m\]
    limit: P::Real,
    square: P::Real,
}

impl<P: Geometry> HingeFriction<P> {
    #[inline(always)]
    fn stiffness(&self) -> P::Real {
        self.breakaway / self.give
    }

    #[inline(always)]
    fn rubbing(&self, seen: &Seen<'_, P>, slip: &Slip<P::Real>) -> Option<Rubbing<P>> {
        let (angle, gradient) = self.axis.seen(seen)?.angle(slip.turns);
        let gradient = seen.a.moment_to_world(gradient);
        Some(Rubbing {
            direction: seen.about(gradient),
            angle,
            torque: self.stiffness() * (angle - slip.rest),
            limit: self.coulomb + (self.breakaway - self.coulomb) * slip.more,
            square: gradient.dot(gradient),
        })
    }
}

impl<P: Geometry> Interaction<P> for HingeFriction<P> {
    type State = Slip<P::Real>;
    type Dampers = [(); 2];
    const ADVANCES: bool = true;
    const QUANTITIES: &'static [Quantity] = &[Quantity { name: "slip", unit: "rad" }];

    #[inline(always)]
    fn advance(&self, seen: &Seen<'_, P>, h: P::Real, slip: &mut Slip<P::Real>) {
        self.settle(seen, slip);
        let Some(Rubbing { angle, .. }) = self.rubbing(seen, slip) else { return };
        let ratio = (angle - slip.last) / (h * self.stribeck);
        slip.last = angle;
        slip.more = P::Real::ONE / (P::Real::ONE + ratio * ratio);
    }

    #[inline(always)]
    fn settle(&self, seen: &Seen<'_, P>, slip: &mut Slip<P::Real>) {
        let Some(twist) = self.axis.seen(seen) else { return };
        twist.settle(&mut slip.turns);
        let Some(Rubbing { angle, torque, limit, .. }) = self.rubbing(seen, slip) else { return };
        let give = limit / self.stiffness();
        slip.rest = P::Real::pick(limit.less_than(torque), angle - give, slip.rest);
        slip.rest = P::Real::pick(torque.less_than(-limit), angle + give, slip.rest);
    }

    #[inline(always)]
    fn record(&self, seen: &Seen<'_, P>, slip: &Slip<P::Real>) -> Option<Record<P::Space>> {
        let Rubbing { direction, torque, .. } = self.rubbing(seen, slip)?;
        Some(seen.pull(&direction, torque))
    }

    fn energy(&self, seen: &Seen<'_, P>, slip: &Slip<P::Real>) -> P::Real {
        let Some(Rubbing { angle, torque, .. }) = self.rubbing(seen, slip) else {
            return P::Real::ZERO;
        };
        P::Real::HALF * (torque * (angle - slip.rest))
    }

    fn tangent(
        &self,
        seen: &Seen<'_, P>,
        slip: &Slip<P::Real>,
        visit: Springs<'_, P>,
    ) -> [P::Real; 2] {
        let Some(Rubbing { direction, torque, square, .. }) = self.rubbing(seen, slip) else {
            return [P::Real::ZERO; 2];
        };
        visit(self.stiffness(), &direction);
        [P::Real::HALF * torque.abs() * square; 2]
    }

    #[inline(always)]
    fn dampers(&self, seen: &Seen<'_, P>, slip: &Slip<P::Real>, visit: &mut impl FnMut(Damper<P>)) {
        let Some(Rubbing { direction, torque, limit, .. }) = self.rubbing(seen, slip) else {
            return;
        };
        // Give and its damping together stay within the limit.
        visit(Damper::new(self.damping, direction).within(-limit - torque, limit - torque));
        visit(Damper::new(self.viscous, direction));
    }

    fn check(&self) -> Result<(), Wrong> {
        let zero = P::Real::ZERO;
        Wrong::unless(self.coulomb >= zero, "coulomb", "is negative", "a torque ≥ 0")?;
        let enough = self.breakaway >= self.coulomb && self.breakaway > zero;
        let least = "a torque > 0, at least as large as `coulomb`";
        Wrong::unless(enough, "breakaway", "is too small", least)?;
        Wrong::unless(self.stribeck > zero, "stribeck", "is not positive", "a rate > 0")?;
        Wrong::unless(self.give > zero, "give", "is not positive", "a turn > 0")?;
        Wrong::unless(self.damping >= zero, "damping", "is negative", "a number ≥ 0")?;
        Wrong::unless(self.viscous >= zero, "viscous", "is negative", "a number ≥ 0")
    }

    fn read(&self, _: usize, seen: &Seen<'_, P>, slip: &Slip<P::Real>) -> P::Real {
        self.rubbing(seen, slip).map_or(P::Real::ZERO, |rubbing| rubbing.angle - slip.rest)
    }
}
