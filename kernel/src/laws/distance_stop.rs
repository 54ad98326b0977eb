//! Stops of a distance: a rope that becomes slack, spheres in contact, the ends of a shock absorber.
//!
//! Distance `|d| ↦ x = |d| − to` or `from − |d|`, force `k·x·(1 + a·ẋ)` back into the range, along the line of the two
//! points: the law of [`super::EndStop`].

use crate::force_pair::ForcePair;
use crate::geometry::Geometry;
use crate::laws::coordinate::Coordinate;
use crate::laws::end::Seen;
use crate::laws::interaction::{Damper, Interaction, NoStorage, Quantity, Springs, Wrong};
use crate::laws::stop::{Stopped, check, check_soft};
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

law! {
    /// A range of the distance of two points with a soft start of its stops.
    pub struct SoftDistanceStop = "soft-distance-stop" {
        /// A point of the first body and one of the second.
        points: Points,
        /// Smallest distance; 0 for no limit.
        from: Number("m") = 0.0,
        /// Largest distance; 1e30 for no limit.
        to: Number("m") = 1e30,
        /// Force per depth.
        stiffness: Number("N/m"),
        /// Depth within which the stiffness rises from 0 to its value.
        soft: Number("m"),
        /// Hunt–Crossley coefficient a: the force is that of the spring · (1 + a · rate of the depth).
        dissipation: Number("s/m") = 0.0,
    }
}

/// The law, hard or soft.
macro_rules! stop {
    ($law:ident, $is_soft:literal $(, $soft:ident)?) => {
        impl<P: Geometry> $law<P> {
            #[inline(always)]
            fn stopped(&self, seen: &Seen<'_, P>) -> Stopped<P, $is_soft> {
                let [.., soft] = [P::Real::ZERO $(, self.$soft)?];
                let distance = Coordinate::distance(seen, &self.points);
                Stopped::within(distance, [self.from, self.to], [self.stiffness, soft])
            }
        }

        impl<P: Geometry> Interaction<P> for $law<P> {
            type State = NoStorage;
            type Dampers = [(); 1];
            const QUANTITIES: &'static [Quantity] = &[Quantity { name: "depth", unit: "m" }];

            #[inline(always)]
            fn force_pair(
                &self,
                seen: &Seen<'_, P>,
                _: &NoStorage,
            ) -> Option<ForcePair<P::Space>> {
                let stopped = self.stopped(seen);
                // Coincident points have no direction for a force.
                let zero = P::Real::ZERO;
                let lost = stopped.coordinate.value == zero && stopped.beyond != zero;
                (!lost).then(|| stopped.force_pair(seen))
            }

            fn energy(&self, seen: &Seen<'_, P>, _: &NoStorage) -> P::Real {
                self.stopped(seen).energy()
            }

            fn tangent(
                &self,
                seen: &Seen<'_, P>,
                _: &NoStorage,
                visit: Springs<'_, P>,
            ) -> [P::Real; 2] {
                self.stopped(seen).tangent(seen, visit)
            }

            #[inline(always)]
            fn is_damped(&self) -> bool {
                self.dissipation != P::Real::ZERO
            }

            #[inline(always)]
            fn dampers(
                &self,
                seen: &Seen<'_, P>,
                _: &NoStorage,
                visit: &mut impl FnMut(Damper<P>),
            ) {
                if !Interaction::<P>::is_damped(self) {
                    return visit(Damper::idle());
                }
                visit(self.stopped(seen).damper(seen, self.dissipation));
            }

            fn check(&self) -> Result<(), Wrong> {
                Wrong::unless(self.from >= P::Real::ZERO, "from", "is negative", "a distance ≥ 0")?;
                $(check_soft(self.$soft)?;)?
                check([self.from, self.to], self.stiffness, self.dissipation)
            }

            fn read(&self, _: usize, seen: &Seen<'_, P>, _: &NoStorage) -> P::Real {
                self.stopped(seen).depth()
            }
        }
    };
}

stop!(DistanceStop, false);
stop!(SoftDistanceStop, true, soft);
