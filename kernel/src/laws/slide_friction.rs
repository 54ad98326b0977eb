//! Dry friction of a translation along an axis, with sticking: [`super::Slip`] of the translation.

use crate::force_pair::ForcePair;
use crate::geometry::Geometry;
use crate::laws::coordinate::Coordinate;
use crate::laws::end::Seen;
use crate::laws::interaction::{Damper, Interaction, Quantity, Springs, Wrong};
use crate::laws::slip::{Friction, Rubbing, Slip};
use crate::real::Real as _;

law! {
    /// Dry friction between two bodies that slide along an axis.
    pub struct SlideFriction = "slide-friction" {
        /// A point of the first body and the sliding point of the second body.
        points: Points,
        /// Axis of the translation.
        axis: Normal,
        /// Force of sliding friction at high rates.
        coulomb: Number("N"),
        /// Force at which sliding begins from rest, not below `coulomb`.
        breakaway: Number("N"),
        /// Rate at which the force is midway between `breakaway` and `coulomb`.
        stribeck: Number("m/s") = 0.01,
        /// Elastic displacement at the breakaway force.
        give: Number("m") = 1e-4,
        /// Damping of the elastic displacement; the force with damping stays within the friction limit.
        damping: Number("N·s/m") = 0.0,
        /// Viscous friction.
        viscous: Number("N·s/m") = 0.0,
    }
}

impl<P: Geometry> SlideFriction<P> {
    #[inline(always)]
    fn friction(&self) -> Friction<P::Real> {
        let Self { coulomb, breakaway, stribeck, give, damping, viscous, .. } = *self;
        Friction { coulomb, breakaway, stribeck, give, damping, viscous }
    }

    #[inline(always)]
    fn rubbing(&self, seen: &Seen<'_, P>, slip: &Slip<P::Real>) -> Rubbing<P> {
        let travel = Coordinate::travel(seen, &self.points, self.axis);
        Rubbing::new(travel, self.friction(), slip)
    }
}

impl<P: Geometry> Interaction<P> for SlideFriction<P> {
    type State = Slip<P::Real>;
    type Dampers = [(); 2];
    const ADVANCES: bool = true;
    const ADVANCE_SETTLES: bool = true;
    const QUANTITIES: &'static [Quantity] = &[Quantity { name: "slip", unit: "m" }];

    #[inline(always)]
    fn advance(&self, seen: &Seen<'_, P>, h: P::Real, slip: &mut Slip<P::Real>) {
        self.rubbing(seen, slip).advance(h, slip);
    }

    #[inline(always)]
    fn settle(&self, seen: &Seen<'_, P>, slip: &mut Slip<P::Real>) {
        self.rubbing(seen, slip).settle(slip);
    }

    #[inline(always)]
    fn force_pair(&self, seen: &Seen<'_, P>, slip: &Slip<P::Real>) -> Option<ForcePair<P::Space>> {
        Some(self.rubbing(seen, slip).force_pair(seen))
    }

    fn energy(&self, seen: &Seen<'_, P>, slip: &Slip<P::Real>) -> P::Real {
        self.rubbing(seen, slip).energy(slip)
    }

    fn tangent(
        &self,
        seen: &Seen<'_, P>,
        slip: &Slip<P::Real>,
        visit: Springs<'_, P>,
    ) -> [P::Real; 2] {
        self.rubbing(seen, slip).tangent(seen, visit)
    }

    #[inline(always)]
    fn is_damped(&self) -> bool {
        self.damping != P::Real::ZERO || self.viscous != P::Real::ZERO
    }

    #[inline(always)]
    fn dampers(&self, seen: &Seen<'_, P>, slip: &Slip<P::Real>, visit: &mut impl FnMut(Damper<P>)) {
        self.rubbing(seen, slip).dampers(seen, visit);
    }

    fn check(&self) -> Result<(), Wrong> {
        self.friction().check()
    }

    fn read(&self, _: usize, seen: &Seen<'_, P>, slip: &Slip<P::Real>) -> P::Real {
        self.rubbing(seen, slip).give(slip)
    }
}
