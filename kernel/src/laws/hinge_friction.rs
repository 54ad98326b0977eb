//! Dry friction of a rotation about an axis, with sticking: [`super::Slip`] of its torsion angle.

use crate::force_pair::ForcePair;
use crate::geometry::Geometry;
use crate::laws::coordinate::Coordinate;
use crate::laws::end::Seen;
use crate::laws::hinge::Turns;
use crate::laws::interaction::{Damper, Interaction, Quantity, Springs, Wrong};
use crate::laws::slip::{Friction, Rubbing, Slip};
use crate::real::Real;
use crate::words::{WordSource, WordVisitor, Words};

law! {
    /// Dry friction between two bodies that rotate about an axis.
    pub struct HingeFriction = "hinge-friction" {
        /// Axis of rotation.
        axis: Axis,
        /// Torque of sliding friction at high rates.
        coulomb: Number("N·m"),
        /// Torque at which sliding begins from rest, not below `coulomb`.
        breakaway: Number("N·m"),
        /// Rate at which the torque is midway between `breakaway` and `coulomb`.
        stribeck: Number("rad/s") = 0.05,
        /// Elastic rotation at the breakaway torque.
        give: Number("rad") = 0.001,
        /// Damping of the elastic rotation; the torque with damping stays within the friction limit.
        damping: Number("N·m·s/rad") = 0.0,
        /// Viscous friction.
        viscous: Number("N·m·s/rad") = 0.0,
    }
}

/// Its memory.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TurnSlip<R> {
    /// Half revolutions of the torsion angle.
    pub turns: Turns,
    /// The slip of the torsion angle.
    pub slip: Slip<R>,
}

impl<R: Real> Default for TurnSlip<R> {
    fn default() -> Self {
        Self { turns: Turns(0), slip: Slip::default() }
    }
}

impl<R: Real> Words for TurnSlip<R> {
    fn visit(&self, visitor: &mut impl WordVisitor) {
        self.turns.visit(visitor);
        self.slip.visit(visitor);
    }
    fn fill(&mut self, source: &mut impl WordSource) {
        self.turns.fill(source);
        self.slip.fill(source);
    }
}

impl<P: Geometry> HingeFriction<P> {
    #[inline(always)]
    fn friction(&self) -> Friction<P::Real> {
        let Self { coulomb, breakaway, stribeck, give, damping, viscous, .. } = *self;
        Friction { coulomb, breakaway, stribeck, give, damping, viscous }
    }

    #[inline(always)]
    fn rubbing(&self, seen: &Seen<'_, P>, memory: &TurnSlip<P::Real>) -> Option<Rubbing<P>> {
        let turn = Coordinate::turn(seen, &self.axis, memory.turns)?;
        Some(Rubbing::new(turn, self.friction(), &memory.slip))
    }
}

impl<P: Geometry> Interaction<P> for HingeFriction<P> {
    type State = TurnSlip<P::Real>;
    type Dampers = [(); 2];
    const ADVANCES: bool = true;
    const QUANTITIES: &'static [Quantity] = &[Quantity { name: "slip", unit: "rad" }];

    #[inline(always)]
    fn advance(&self, seen: &Seen<'_, P>, h: P::Real, memory: &mut TurnSlip<P::Real>) {
        self.settle(seen, memory);
        if let Some(rubbing) = self.rubbing(seen, memory) {
            rubbing.advance(h, &mut memory.slip);
        }
    }

    #[inline(always)]
    fn settle(&self, seen: &Seen<'_, P>, memory: &mut TurnSlip<P::Real>) {
        let Some(torsion_angle) = self.axis.seen(seen) else { return };
        torsion_angle.settle(&mut memory.turns);
        if let Some(rubbing) = self.rubbing(seen, memory) {
            rubbing.settle(&mut memory.slip);
        }
    }

    #[inline(always)]
    fn force_pair(
        &self,
        seen: &Seen<'_, P>,
        memory: &TurnSlip<P::Real>,
    ) -> Option<ForcePair<P::Space>> {
        Some(self.rubbing(seen, memory)?.force_pair(seen))
    }

    fn energy(&self, seen: &Seen<'_, P>, memory: &TurnSlip<P::Real>) -> P::Real {
        self.rubbing(seen, memory).map_or(P::Real::ZERO, |rubbing| rubbing.energy(&memory.slip))
    }

    fn tangent(
        &self,
        seen: &Seen<'_, P>,
        memory: &TurnSlip<P::Real>,
        visit: Springs<'_, P>,
    ) -> [P::Real; 2] {
        let rubbing = self.rubbing(seen, memory);
        rubbing.map_or([P::Real::ZERO; 2], |rubbing| rubbing.tangent(seen, visit))
    }

    #[inline(always)]
    fn dampers(
        &self,
        seen: &Seen<'_, P>,
        memory: &TurnSlip<P::Real>,
        visit: &mut impl FnMut(Damper<P>),
    ) {
        if let Some(rubbing) = self.rubbing(seen, memory) {
            rubbing.dampers(seen, visit);
        }
    }

    fn check(&self) -> Result<(), Wrong> {
        self.friction().check()
    }

    fn read(&self, _: usize, seen: &Seen<'_, P>, memory: &TurnSlip<P::Real>) -> P::Real {
        self.rubbing(seen, memory).map_or(P::Real::ZERO, |rubbing| rubbing.give(&memory.slip))
    }
}
