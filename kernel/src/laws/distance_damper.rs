//! A damper between two points with a table of force over rate: digressive, or different in bump and rebound.
//!
//! Rate of the distance `v ↦ tension F(v)`, linear between knots and beyond them; see `tabled`.

use crate::force_pair::ForcePair;
use crate::geometry::Geometry;
use crate::laws::coordinate::Coordinate;
use crate::laws::end::Seen;
use crate::laws::interaction::{Damper, Interaction, NoStorage, Quantity, Springs, Wrong};
use crate::laws::tabled::{brake, braking};
use crate::real::Real;

law! {
    /// A damper between two points with a table of force over rate: digressive, or different in bump and rebound.
    pub struct DistanceDamper = "distance-damper" {
        /// A point of the first body and one of the second.
        points: Points,
        /// Tension over the rate at which the points separate, non-decreasing and 0 at rest.
        force: Table<16>("m/s", "N"),
    }
}

impl<P: Geometry> Interaction<P> for DistanceDamper<P> {
    type State = NoStorage;
    type Dampers = [(); 1];
    const QUANTITIES: &'static [Quantity] = &[Quantity { name: "force", unit: "N" }];

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
        visit(brake(seen, &Coordinate::distance(seen, &self.points), &self.force));
    }

    fn check(&self) -> Result<(), Wrong> {
        braking(&self.force, "force")
    }

    fn read(&self, _: usize, seen: &Seen<'_, P>, _: &NoStorage) -> P::Real {
        let distance = Coordinate::distance(seen, &self.points);
        self.force.at(seen.rate(&distance.direction(seen))).0
    }
}
