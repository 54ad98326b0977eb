//! Dry friction of a coordinate, with sticking: a spring that slips.
//!
//! `z = q − s ↦ tension k·z`, `k = F/give`; where `|k·z|` exceeds the limit F(v), s follows the coordinate q (Prandtl
//! 1928; Dupont, Hayward, Armstrong, Altpeter, IEEE TAC 47 (2002) 787). The energy above the limit is dissipated at a
//! boundary: it dissipates at any step, holds without creep at rest, and its memory is s. The limit is
//! `F(v) = coulomb + (breakaway − coulomb)/(1 + (v/stribeck)²)` (Hess & Soom, J. Tribology 112 (1990) 147) at the mean
//! rate of the last step.

use crate::force_pair::ForcePair;
use crate::geometry::Geometry;
use crate::laws::coordinate::Coordinate;
use crate::laws::end::Seen;
use crate::laws::interaction::{Damper, Springs, Wrong};
use crate::real::Real;
use crate::words::{WordSource, WordVisitor, Words};

/// The memory of friction on its coordinate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slip<R> {
    /// \[m, rad\] the value at which its elastic deflection is 0.
    pub rest: R,
    /// \[m, rad\] the value at the end of the last step.
    pub last: R,
    /// \[1\] the fraction of the difference of breakaway and Coulomb friction in the limit.
    pub more: R,
}

impl<R: Real> Default for Slip<R> {
    fn default() -> Self {
        Self { rest: R::ZERO, last: R::ZERO, more: R::ONE }
    }
}

impl<R: Real> Words for Slip<R> {
    fn visit(&self, visitor: &mut impl WordVisitor) {
        [self.rest, self.last, self.more].iter().for_each(|number| visitor.word(number.word()));
    }
    fn fill(&mut self, source: &mut impl WordSource) {
        for number in [&mut self.rest, &mut self.last, &mut self.more] {
            *number = R::from_words(source);
        }
    }
}

/// The constants of friction, in N, m or N·m, rad.
#[derive(Clone, Copy)]
pub(super) struct Friction<R> {
    pub(super) coulomb: R,
    pub(super) breakaway: R,
    pub(super) stribeck: R,
    pub(super) give: R,
    pub(super) damping: R,
    pub(super) viscous: R,
}

impl<R: Real> Friction<R> {
    /// Refuses invalid constants.
    pub(super) fn check(&self) -> Result<(), Wrong> {
        let zero = R::ZERO;
        Wrong::unless(self.coulomb >= zero, "coulomb", "is negative", "a number ≥ 0")?;
        let enough = self.breakaway >= self.coulomb && self.breakaway > zero;
        let least = "a number > 0, at least as large as `coulomb`";
        Wrong::unless(enough, "breakaway", "is too small", least)?;
        Wrong::unless(self.stribeck > zero, "stribeck", "is not positive", "a rate > 0")?;
        Wrong::unless(self.give > zero, "give", "is not positive", "a number > 0")?;
        Wrong::unless(self.damping >= zero, "damping", "is negative", "a number ≥ 0")?;
        Wrong::unless(self.viscous >= zero, "viscous", "is negative", "a number ≥ 0")
    }
}

/// A coordinate with friction.
pub(super) struct Rubbing<P: Geometry> {
    coordinate: Coordinate<P>,
    friction: Friction<P::Real>,
    stiffness: P::Real,
    /// \[N, N·m\] of its elastic deflection.
    tension: P::Real,
    /// \[N, N·m\]
    limit: P::Real,
}

impl<P: Geometry> Rubbing<P> {
    #[inline(always)]
    pub(super) fn new(
        coordinate: Coordinate<P>,
        friction: Friction<P::Real>,
        slip: &Slip<P::Real>,
    ) -> Self {
        let stiffness = friction.breakaway / friction.give;
        let tension = stiffness * (coordinate.value - slip.rest);
        let limit = friction.coulomb + (friction.breakaway - friction.coulomb) * slip.more;
        Self { coordinate, friction, stiffness, tension, limit }
    }

    /// Limits the deflection.
    #[inline(always)]
    pub(super) fn settle(&self, slip: &mut Slip<P::Real>) {
        let (value, give) = (self.coordinate.value, self.limit / self.stiffness);
        slip.rest = P::Real::pick(self.limit.less_than(self.tension), value - give, slip.rest);
        slip.rest = P::Real::pick(self.tension.less_than(-self.limit), value + give, slip.rest);
    }

    /// Limits the deflection, advances the limit by a step of `h` \[s\], and limits the deflection by the new one.
    #[inline(always)]
    pub(super) fn advance(self, h: P::Real, slip: &mut Slip<P::Real>) {
        self.settle(slip);
        let value = self.coordinate.value;
        let ratio = (value - slip.last) / (h * self.friction.stribeck);
        slip.last = value;
        slip.more = P::Real::ONE / (P::Real::ONE + ratio * ratio);
        Self::new(self.coordinate, self.friction, slip).settle(slip);
    }

    #[inline(always)]
    pub(super) fn force_pair(&self, seen: &Seen<'_, P>) -> ForcePair<P::Space> {
        self.coordinate.pull(seen, self.tension)
    }

    /// \[J\]
    pub(super) fn energy(&self, slip: &Slip<P::Real>) -> P::Real {
        P::Real::HALF * (self.tension * self.give(slip))
    }

    pub(super) fn tangent(&self, seen: &Seen<'_, P>, visit: Springs<'_, P>) -> [P::Real; 2] {
        visit(self.stiffness, &self.coordinate.direction(seen));
        self.coordinate.bent(seen, self.tension.abs(), visit)
    }

    /// The damper of the elastic deflection and the viscous one.
    #[inline(always)]
    pub(super) fn dampers(&self, seen: &Seen<'_, P>, visit: &mut impl FnMut(Damper<P>)) {
        let (tension, limit) = (self.tension, self.limit);
        let direction = self.coordinate.direction(seen);
        // The spring and damper forces together stay within the limit.
        let of_give = Damper::new(self.friction.damping, direction);
        visit(of_give.within(-limit - tension, limit - tension));
        visit(Damper::new(self.friction.viscous, direction));
    }

    /// \[m, rad\] the elastic part of the motion.
    pub(super) fn give(&self, slip: &Slip<P::Real>) -> P::Real {
        self.coordinate.value - slip.rest
    }
}
