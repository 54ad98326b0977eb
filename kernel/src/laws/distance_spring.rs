//! A spring between two points with a table of force over extension: progressive, one-sided, preloaded.
//!
//! Distance `|d| ↦ tension F(|d| − free_length)`, linear between knots and beyond them; its energy is the area.

use crate::force_pair::ForcePair;
use crate::geometry::Geometry;
use crate::laws::coordinate::Coordinate;
use crate::laws::end::Seen;
use crate::laws::interaction::{Interaction, NoStorage, Quantity, Springs, Wrong};
use crate::laws::tabled::{Spring, rising};
use crate::real::Real;

law! {
    /// A spring between two points with a table of force over extension: progressive, one-sided, preloaded.
    pub struct DistanceSpring = "distance-spring" {
        /// A point of the first body and one of the second.
        points: Points,
        /// Distance at which the extension is 0.
        free_length: Number("m") = 0.0,
        /// Tension over extension, non-decreasing; extrapolated linearly beyond the first and the last knot.
        force: Table<16>("m", "N"),
    }
}

impl<P: Geometry> DistanceSpring<P> {
    #[inline(always)]
    fn spring(&self, seen: &Seen<'_, P>) -> Spring<'_, P, 16> {
        Spring {
            coordinate: Coordinate::distance(seen, &self.points),
            rest: self.free_length,
            curve: &self.force,
        }
    }
}

impl<P: Geometry> Interaction<P> for DistanceSpring<P> {
    type State = NoStorage;
    type Dampers = [(); 0];
    const QUANTITIES: &'static [Quantity] = &[Quantity { name: "force", unit: "N" }];

    #[inline(always)]
    fn force_pair(&self, seen: &Seen<'_, P>, _: &NoStorage) -> Option<ForcePair<P::Space>> {
        let spring = self.spring(seen);
        // Coincident points have no direction for a force.
        let lost = spring.coordinate.value == P::Real::ZERO && spring.tension() != P::Real::ZERO;
        (!lost).then(|| spring.force_pair(seen))
    }

    fn energy(&self, seen: &Seen<'_, P>, _: &NoStorage) -> P::Real {
        self.spring(seen).energy()
    }

    fn tangent(&self, seen: &Seen<'_, P>, _: &NoStorage, visit: Springs<'_, P>) -> [P::Real; 2] {
        self.spring(seen).tangent(seen, visit)
    }

    fn check(&self) -> Result<(), Wrong> {
        let zero = P::Real::ZERO;
        Wrong::unless(self.free_length >= zero, "free_length", "is negative", "a distance ≥ 0")?;
        rising(&self.force, "force")
    }

    fn read(&self, _: usize, seen: &Seen<'_, P>, _: &NoStorage) -> P::Real {
        self.spring(seen).tension()
    }
}
