//! Dry friction of a rotation about an axis, with sticking: [`super::Slip`] of its torsion angle.

use crate::force_pair::ForcePair;
use crate::geometry::Geometry;
use crate::laws::coordinate::TurnPose;
use crate::laws::end::Seen;
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
#[derive(Clone, Copy)]
pub struct TurnSlip<P: Geometry> {
    /// The torsion angle.
    pub turn: TurnPose<P>,
    /// The slip of the torsion angle.
    pub slip: Slip<P::Real>,
}

impl<P: Geometry> Default for TurnSlip<P> {
    fn default() -> Self {
        Self { turn: TurnPose::default(), slip: Slip::default() }
    }
}

impl<P: Geometry> Words for TurnSlip<P> {
    fn visit(&self, visitor: &mut impl WordVisitor) {
        self.turn.visit(visitor);
        self.slip.visit(visitor);
    }
    fn fill(&mut self, source: &mut impl WordSource) {
        self.turn.fill(source);
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
    fn rubbing(&self, memory: &TurnSlip<P>) -> Option<Rubbing<P>> {
        Some(Rubbing::new(memory.turn.coordinate()?, self.friction(), &memory.slip))
    }
}

impl<P: Geometry> Interaction<P> for HingeFriction<P> {
    type State = TurnSlip<P>;
    type Dampers = [(); 2];
    const TURNS: bool = true;
    const ADVANCES: bool = true;
    const ADVANCE_SETTLES: bool = true;
    const KEEPS: bool = true;
    const QUANTITIES: &'static [Quantity] = &[Quantity { name: "slip", unit: "rad" }];

    #[inline(always)]
    fn advance(&self, seen: &Seen<'_, P>, h: P::Real, memory: &mut TurnSlip<P>) {
        memory.turn.settle(seen, &self.axis, |turns| turns);
        if let Some(rubbing) = self.rubbing(memory) {
            rubbing.advance(h, &mut memory.slip);
        }
    }

    #[inline(always)]
    fn settle(&self, seen: &Seen<'_, P>, memory: &mut TurnSlip<P>) {
        memory.turn.settle(seen, &self.axis, |turns| turns);
        if let Some(rubbing) = self.rubbing(memory) {
            rubbing.settle(&mut memory.slip);
        }
    }

    #[inline(always)]
    fn keep_pose(&self, seen: &Seen<'_, P>, memory: &mut TurnSlip<P>) {
        memory.turn.keep(seen, &self.axis, memory.turn.turns);
    }

    #[inline(always)]
    fn force_pair(&self, seen: &Seen<'_, P>, memory: &TurnSlip<P>) -> Option<ForcePair<P::Space>> {
        Some(self.rubbing(memory)?.force_pair(seen))
    }

    fn energy(&self, _: &Seen<'_, P>, memory: &TurnSlip<P>) -> P::Real {
        self.rubbing(memory).map_or(P::Real::ZERO, |rubbing| rubbing.energy(&memory.slip))
    }

    fn tangent(
        &self,
        seen: &Seen<'_, P>,
        memory: &TurnSlip<P>,
        visit: Springs<'_, P>,
    ) -> [P::Real; 2] {
        let rubbing = self.rubbing(memory);
        rubbing.map_or([P::Real::ZERO; 2], |rubbing| rubbing.tangent(seen, visit))
    }

    #[inline(always)]
    fn is_damped(&self) -> bool {
        self.damping != P::Real::ZERO || self.viscous != P::Real::ZERO
    }

    #[inline(always)]
    fn dampers(&self, seen: &Seen<'_, P>, memory: &TurnSlip<P>, visit: &mut impl FnMut(Damper<P>)) {
        if let Some(rubbing) = self.rubbing(memory) {
            rubbing.dampers(seen, visit);
        }
    }

    fn check(&self) -> Result<(), Wrong> {
        self.friction().check()
    }

    fn read(&self, _: usize, _: &Seen<'_, P>, memory: &TurnSlip<P>) -> P::Real {
        self.rubbing(memory).map_or(P::Real::ZERO, |rubbing| rubbing.give(&memory.slip))
    }
}
