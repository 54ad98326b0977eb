//! A coupling of joints: a spring and a damper on a weighted sum of their coordinates.
//!
//! `xᵢ ↦ y = Σ aᵢ·xᵢ − offset`, tension `k·dead(y)`, dead the part of y beyond half of the backlash on either side, and
//! c times its rate; the tension acts on each coordinate by its factor, so that the power is tension times the rate of
//! y. A gear pair, a rack, a belt and a joint that mimics another have two coordinates, a differential three; one-sided
//! it is a tendon. The bearings of the axes take the difference of the moments. The damper acts along the whole sum, on
//! up to six bodies at once, bounded where teeth or a tendon may separate (Shardlow 2003 for two bodies).
//!
//! y is updated incrementally from step to step: in single precision a large revolution count would leave no digits for
//! the teeth.

use crate::force_pair::ForcePair;
use crate::geometry::Geometry;
use crate::index::BodyIndex;
use crate::laws::branch::Branch;
use crate::laws::coordinate::Coordinate;
use crate::laws::end::Seen;
use crate::laws::hinge::Turns;
use crate::laws::interaction::{Damper, Interaction, Quantity, Springs, Wrong};
use crate::laws::term::{CoordinateKind, MAX_TERMS, Term};
use crate::real::Real;
use crate::words::{WordSource, WordVisitor, Words};

law! {
    /// A spring on a weighted sum of coordinates of up to three joints: gears, racks, belts, differentials, tendons.
    pub struct Coupling = "coupling" {
        /// The coordinates, each with its factor in the sum.
        terms: Terms,
        /// The sum at which the tension is 0.
        offset: Number("rad") = 0.0,
        /// Tension per sum.
        stiffness: Number("N·m/rad"),
        /// Tension per rate of the sum.
        damping: Number("N·m·s/rad") = 0.0,
        /// Backlash of the sum, from one flank to the other.
        play: Number("rad") = 0.0,
        /// 1, or 0 where the coupling does not pull: a sum above the offset has no tension.
        pulls: Number = 1.0,
        /// 1, or 0 where the coupling does not push: a sum below the offset has no tension.
        pushes: Number = 1.0,
    }
}

/// The memory of a coupling: the sum at the end of the last step, and its coordinates then.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sum<R> {
    /// Half revolutions of each coordinate.
    pub turns: [Turns; MAX_TERMS],
    /// \[m, rad\] the coordinates, rotations within the last revolution.
    pub last: [R; MAX_TERMS],
    /// \[m, rad\] Σ aᵢ·xᵢ.
    pub sum: R,
}

impl<R: Real> Default for Sum<R> {
    fn default() -> Self {
        Self { turns: Default::default(), last: [R::ZERO; MAX_TERMS], sum: R::ZERO }
    }
}

impl<R: Real> Words for Sum<R> {
    fn visit(&self, visitor: &mut impl WordVisitor) {
        self.turns.iter().for_each(|turns| turns.visit(visitor));
        self.last.iter().chain([&self.sum]).for_each(|number| visitor.word(number.word()));
    }
    fn fill(&mut self, source: &mut impl WordSource) {
        self.turns.iter_mut().for_each(|turns| turns.fill(source));
        for number in self.last.iter_mut().chain([&mut self.sum]) {
            *number = R::from_words(source);
        }
    }
}

/// The coordinate of a term at a pose; `None` where it is undefined.
#[inline(always)]
fn of_term<P: Geometry>(term: &Term<P>, seen: &Seen<'_, P>, turns: Turns) -> Option<Coordinate<P>> {
    match &term.way {
        CoordinateKind::Turn(axis) => Coordinate::turn(seen, axis, turns),
        CoordinateKind::Travel { points, axis } => Some(Coordinate::travel(seen, points, *axis)),
    }
}

/// A coordinate with its factor and the state of its bodies.
struct Part<'s, P: Geometry> {
    bodies: [BodyIndex; 2],
    seen: Seen<'s, P>,
    factor: P::Real,
    coordinate: Coordinate<P>,
}

impl<P: Geometry> Part<'_, P> {
    /// Its direction, of the length of its factor.
    #[inline(always)]
    fn branch(&self, tension: P::Real) -> Branch<P> {
        let direction = self.coordinate.direction(&self.seen).scaled(self.factor);
        Branch { bodies: self.bodies, direction, tension }
    }

    /// \[N·m\] the effect of a tension on a rotation of its bodies.
    fn bent(&self, tension: P::Real, visit: Springs<'_, P>) -> [P::Real; 2] {
        self.coordinate.bent(&self.seen, (tension * self.factor).abs(), visit)
    }
}

impl<P: Geometry> Coupling<P> {
    /// A term by its index, its angle near that of the last step.
    #[inline(always)]
    fn part<'s>(
        &self,
        term: usize,
        seen: &Seen<'s, P>,
        memory: &Sum<P::Real>,
    ) -> Option<Part<'s, P>> {
        let known = self.terms.get(term)?.as_ref()?;
        let bodies = known.bodies;
        let seen = seen.between(bodies)?;
        let coordinate = of_term(known, &seen, memory.turns.get(term)?.odd())?;
        Some(Part { bodies, seen, factor: known.factor, coordinate })
    }

    /// Σ aᵢ·xᵢ; `None` where a coordinate is undefined.
    #[inline(always)]
    fn sum(&self, seen: &Seen<'_, P>, memory: &Sum<P::Real>) -> Option<P::Real> {
        let mut sum = memory.sum;
        for (term, (known, last)) in self.terms.iter().zip(memory.last).enumerate() {
            if known.is_some() {
                let part = self.part(term, seen, memory)?;
                sum = sum + part.factor * (part.coordinate.value - last);
            }
        }
        Some(sum)
    }

    /// \[m, rad\] the extension of its spring.
    #[inline(always)]
    fn deformation(&self, sum: P::Real) -> P::Real {
        let (half, zero) = (P::Real::HALF * self.play, P::Real::ZERO);
        let y = sum - self.offset;
        let (above, below) = (y - half, y + half);
        let deformation = P::Real::pick(zero.less_than(above), self.pulls * above, zero);
        P::Real::pick(below.less_than(zero), self.pushes * below, deformation)
    }

    /// \[N, N·m\] the tension of its spring.
    #[inline(always)]
    fn tension(&self, seen: &Seen<'_, P>, memory: &Sum<P::Real>) -> Option<P::Real> {
        Some(self.stiffness * self.deformation(self.sum(seen, memory)?))
    }

    /// Whether teeth or a tendon may separate.
    #[inline(always)]
    fn parts(&self) -> bool {
        let zero = P::Real::ZERO;
        zero < self.play || self.pulls == zero || self.pushes == zero
    }
}

impl<P: Geometry> Interaction<P> for Coupling<P> {
    type State = Sum<P::Real>;
    type Dampers = [(); 1];
    const BRANCHES: usize = MAX_TERMS - 1;
    const QUANTITIES: &'static [Quantity] =
        &[Quantity { name: "load", unit: "N·m" }, Quantity { name: "stretch", unit: "rad" }];

    #[inline(always)]
    fn settle(&self, seen: &Seen<'_, P>, memory: &mut Sum<P::Real>) {
        let Some(sum) = self.sum(seen, memory) else { return };
        memory.sum = sum;
        for (term, known) in self.terms.iter().enumerate() {
            let Some(known) = known else { continue };
            let (Some(seen), Some(turns)) =
                (seen.between(known.bodies), memory.turns.get_mut(term))
            else {
                continue;
            };
            if let CoordinateKind::Turn(axis) = &known.way
                && let Some(torsion_angle) = axis.seen(&seen)
            {
                torsion_angle.settle(turns);
            }
            if let (Some(next), Some(last)) =
                (of_term(known, &seen, turns.odd()), memory.last.get_mut(term))
            {
                *last = next.value;
            }
        }
    }

    #[inline(always)]
    fn force_pair(&self, seen: &Seen<'_, P>, memory: &Sum<P::Real>) -> Option<ForcePair<P::Space>> {
        let tension = self.tension(seen, memory)?;
        let branch = self.part(0, seen, memory)?.branch(tension);
        Some(seen.pull(&branch.direction, tension))
    }

    fn branch_bodies(&self, visit: &mut dyn FnMut([BodyIndex; 2])) {
        self.terms.iter().flatten().skip(1).for_each(|term| visit(term.bodies));
    }

    #[inline(always)]
    fn branches(
        &self,
        seen: &Seen<'_, P>,
        memory: &Sum<P::Real>,
        visit: &mut impl FnMut(Branch<P>),
    ) {
        let Some(tension) = self.tension(seen, memory) else { return };
        for term in 1..MAX_TERMS {
            if let Some(part) = self.part(term, seen, memory) {
                visit(part.branch(tension));
            }
        }
    }

    fn energy(&self, seen: &Seen<'_, P>, memory: &Sum<P::Real>) -> P::Real {
        let Some(sum) = self.sum(seen, memory) else { return P::Real::ZERO };
        let deformation = self.deformation(sum);
        P::Real::HALF * (self.stiffness * (deformation * deformation))
    }

    /// As if its teeth were in contact.
    fn tangent(
        &self,
        seen: &Seen<'_, P>,
        memory: &Sum<P::Real>,
        visit: Springs<'_, P>,
    ) -> [P::Real; 2] {
        let known = self.tension(seen, memory).zip(self.part(0, seen, memory));
        let Some((tension, part)) = known else { return [P::Real::ZERO; 2] };
        visit(self.stiffness, &part.branch(tension).direction);
        part.bent(tension, visit)
    }

    fn branch_tangent(
        &self,
        branch: usize,
        seen: &Seen<'_, P>,
        memory: &Sum<P::Real>,
        visit: Springs<'_, P>,
    ) -> [P::Real; 2] {
        let known = self.tension(seen, memory).zip(self.part(branch + 1, seen, memory));
        let Some((tension, part)) = known else { return [P::Real::ZERO; 2] };
        part.bent(tension, visit)
    }

    #[inline(always)]
    fn is_damped(&self) -> bool {
        self.damping != P::Real::ZERO
    }

    #[inline(always)]
    fn dampers(
        &self,
        seen: &Seen<'_, P>,
        memory: &Sum<P::Real>,
        visit: &mut impl FnMut(Damper<P>),
    ) {
        let zero = P::Real::ZERO;
        if !Interaction::<P>::is_damped(self) {
            return visit(Damper::idle());
        }
        let known = self.tension(seen, memory).zip(self.part(0, seen, memory));
        let Some((tension, part)) = known else { return };
        if self.parts() && tension == zero {
            return visit(Damper::idle());
        }
        let damper = Damper::new(self.damping, part.branch(tension).direction);
        if !self.parts() {
            return visit(damper);
        }
        let [least, most] = damper.bounds();
        let pulls = zero.less_than(tension);
        visit(
            damper.within(
                P::Real::pick(pulls, -tension, least),
                P::Real::pick(pulls, most, -tension),
            ),
        );
    }

    fn check(&self) -> Result<(), Wrong> {
        let zero = P::Real::ZERO;
        for term in self.terms.iter().flatten() {
            Wrong::unless(term.factor != zero, "factor", "is 0", "a factor other than 0")?;
        }
        let any = self.terms.iter().flatten().next().is_some();
        Wrong::unless(any, "terms", "has no coordinate", "one to three coordinates")?;
        Wrong::unless(self.stiffness > zero, "stiffness", "is not positive", "a stiffness > 0")?;
        Wrong::unless(self.damping >= zero, "damping", "is negative", "a number ≥ 0")?;
        Wrong::unless(self.play >= zero, "play", "is negative", "a number ≥ 0")?;
        sides(self.pulls, self.pushes)
    }

    fn read(&self, quantity: usize, seen: &Seen<'_, P>, memory: &Sum<P::Real>) -> P::Real {
        let Some(sum) = self.sum(seen, memory) else { return P::Real::ZERO };
        if quantity == 0 { self.stiffness * self.deformation(sum) } else { sum - self.offset }
    }
}

/// Refuses `pulls` and `pushes` other than 0 or 1, or both 0.
pub(super) fn sides<R: Real>(pulls: R, pushes: R) -> Result<(), Wrong> {
    let (zero, one) = (R::ZERO, R::ONE);
    for (name, number) in [("pulls", pulls), ("pushes", pushes)] {
        Wrong::unless(number == zero || number == one, name, "is neither 0 nor 1", "0 or 1")?;
    }
    let acts = pulls == one || pushes == one;
    Wrong::unless(acts, "pulls", "is 0, and so is `pushes`", "1 unless `pushes` is 1")
}
