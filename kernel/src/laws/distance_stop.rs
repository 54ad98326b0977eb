//! Stops of a distance: a rope that becomes slack, spheres in contact, the ends of a shock absorber.
//!
//! Distance `|d| ↦ x = |d| − to` or `from − |d|`, force `k·x·(1 + a·ẋ)` back into the range, along the line of the two
//! points: the law of [`super::EndStop`].

use crate::force_pair::ForcePair;
use crate::geometry::Geometry;
use crate::laws::coordinate::Coordinate;
use crate::laws::end::Seen;
use crate::laws::interaction::{Damper, Interaction, NoStorage, Quantity, Springs, Wrong};
use crate::laws::stop::{Stopped, check};
use crate::real::Real;

law! {
    /// A range of the distance of two points: a rope (`to`), two spheres (`from`, the sum of their radii), or both.
    pub struct DistanceStop = "distance-stop" {
        /// A point of the first body and one of the second.
        points: Points,
        /// Smallest distance; 0 for no limit.
        from: Number("m") = 0.0,
        /// Largest distance; 1e30 for no limit.
        to: Number("m") = 1e30,
        /// Force per depth.
        stiffness: Number("N/m"),
        /// Hunt–Crossley coefficient a: the force is stiffness · depth · (1 + a · rate of the depth).
        dissipation: Number("s/m") = 0.0,
    }
}

impl<P: Geometry> DistanceStop<P> {
    #[inline(always)]
    fn stopped(&self, seen: &Seen<'_, P>) -> Stopped<P> {
        let distance = Coordinate::distance(seen, &self.points);
        Stopped::within(distance, [self.from, self.to], self.stiffness)
    }
}

impl<P: Geometry> Interaction<P> for DistanceStop<P> {
    type State = NoStorage;
    type Dampers = [(); 1];
    const QUANTITIES: &'static [Quantity] = &[Quantity { name: "depth", unit: "m" }];

    #[inline(always)]
    fn force_pair(&self, seen: &Seen<'_, P>, _: &NoStorage) -> Option<ForcePair<P::Space>> {
        let stopped = self.stopped(seen);
        // Coincident points have no direction for a force.
        let lost = stopped.coordinate.value == P::Real::ZERO && stopped.beyond != P::Real::ZERO;
        (!lost).then(|| stopped.force_pair(seen))
    }

    fn energy(&self, seen: &Seen<'_, P>, _: &NoStorage) -> P::Real {
        self.stopped(seen).energy()
    }

    fn tangent(&self, seen: &Seen<'_, P>, _: &NoStorage, visit: Springs<'_, P>) -> [P::Real; 2] {
        self.stopped(seen).tangent(seen, visit)
    }

    #[inline(always)]
    fn dampers(&self, seen: &Seen<'_, P>, _: &NoStorage, visit: &mut impl FnMut(Damper<P>)) {
        if self.dissipation == P::Real::ZERO {
            return visit(Damper::idle());
        }
        visit(self.stopped(seen).damper(seen, self.dissipation));
    }

    fn check(&self) -> Result<(), Wrong> {
        Wrong::unless(self.from >= P::Real::ZERO, "from", "is negative", "a distance ≥ 0")?;
        check([self.from, self.to], self.stiffness, self.dissipation)
    }

    fn read(&self, _: usize, seen: &Seen<'_, P>, _: &NoStorage) -> P::Real {
        self.stopped(seen).depth()
    }
}
