//! A damper between two points with a table of force over rate: digressive, or different in bump and rebound.
//!
//! Rate of the distance `v ↦ tension F(v)`, linear between knots and beyond them; see `tabled`.

use crate::geometry::Geometry;
use crate::laws::coordinate::Coordinate;
use crate::laws::end::Seen;
use crate::laws::interaction::{Damper, Interaction, Nothing, Quantity, Springs, Wrong};
use crate::laws::tabled::{brake, braking};
use crate::real::Real;
use crate::record::Record;

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
    type State = Nothing;
    type Dampers = [(); 1];
    const QUANTITIES: &'static [Quantity] = &[Quantity { name: "force", unit: "N" }];

    #[inline(always)]
    fn record(&self, _: &Seen<'_, P>, _: &Nothing) -> Option<Record<P::Space>> {
        Some(Record::ZERO)
    }

    fn energy(&self, _: &Seen<'_, P>, _: &Nothing) -> P::Real {
        P::Real::ZERO
    }

    fn tangent(&self, _: &Seen<'_, P>, _: &Nothing, _: Springs<'_, P>) -> [P::Real; 2] {
        [P::Real::ZERO; 2]
    }

    #[inline(always)]
    fn dampers(&self, seen: &Seen<'_, P>, _: &Nothing, visit: &mut impl FnMut(Damper<P>)) {
        visit(brake(seen, &Coordinate::distance(seen, &self.points), &self.force));
    }

    fn check(&self) -> Result<(), Wrong> {
        braking(&self.force, "force")
    }

    fn read(&self, _: usize, seen: &Seen<'_, P>, _: &Nothing) -> P::Real {
        let distance = Coordinate::distance(seen, &self.points);
        self.force.at(seen.rate(&distance.direction(seen))).0
    }
}
