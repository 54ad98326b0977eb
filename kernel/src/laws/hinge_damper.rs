//! A damper about an axis with a table of torque over rate.
//!
//! Rate of the torsion angle `ω ↦ torque T(ω)` against it, along the angle's gradient; see `tabled`.

use crate::force_pair::ForcePair;
use crate::geometry::Geometry;
use crate::laws::coordinate::Coordinate;
use crate::laws::end::Seen;
use crate::laws::hinge::Turns;
use crate::laws::interaction::{Damper, Interaction, NoStorage, Quantity, Springs, Wrong};
use crate::laws::tabled::{brake, braking};
use crate::real::Real;

law! {
    /// A damper about an axis with a table of torque over rate.
    pub struct HingeDamper = "hinge-damper" {
        /// Axis of rotation.
        axis: Axis,
        /// Torque against the rate, non-decreasing and 0 at rest.
        torque: Table<16>("rad/s", "N·m"),
    }
}

impl<P: Geometry> HingeDamper<P> {
    /// Only its gradient is used: no revolution count.
    #[inline(always)]
    fn turn(&self, seen: &Seen<'_, P>) -> Option<Coordinate<P>> {
        Coordinate::turn(seen, &self.axis, Turns(0))
    }
}

impl<P: Geometry> Interaction<P> for HingeDamper<P> {
    type State = NoStorage;
    type Dampers = [(); 1];
    const TURNS: bool = true;
    const QUANTITIES: &'static [Quantity] = &[Quantity { name: "torque", unit: "N·m" }];

    #[inline(always)]
    fn force_pair(&self, _: &Seen<'_, P>, _: &NoStorage) -> Option<ForcePair<P::Space>> {
        Some(ForcePair::ZERO)
    }

    fn energy(&self, _: &Seen<'_, P>, _: &NoStorage) -> P::Real {
        P::Real::ZERO
    }

    fn tangent(&self, _: &Seen<'_, P>, _: &NoStorage, _: Springs<'_, P>) -> [P::Real; 2] {
        [P::Real::ZERO; 2]
    }

    #[inline(always)]
    fn dampers(&self, seen: &Seen<'_, P>, _: &NoStorage, visit: &mut impl FnMut(Damper<P>)) {
        visit(match self.turn(seen) {
            Some(turn) => brake(seen, &turn, &self.torque),
            None => Damper::idle(),
        });
    }

    fn check(&self) -> Result<(), Wrong> {
        braking(&self.torque, "torque")
    }

    fn read(&self, _: usize, seen: &Seen<'_, P>, _: &NoStorage) -> P::Real {
        let rate = |turn: Coordinate<P>| self.torque.at(seen.rate(&turn.direction(seen))).0;
        self.turn(seen).map_or(P::Real::ZERO, rate)
    }
}
