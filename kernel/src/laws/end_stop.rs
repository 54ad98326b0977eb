//! End stops of a translation: one or two planes of A that stop a point of B.
//!
//! Displacement `n·d ↦ F = k·x·(1 + a·ẋ)` along the normal n, x beyond the range (Hunt & Crossley, J. Appl. Mech. 42
//! (1975) 440, with exponent 1). The spring is a force with the energy `½·k·x²`; the rest is a damper `a·k·x` whose
//! tension never exceeds the spring's: it never pulls.

use crate::force_pair::ForcePair;
use crate::geometry::Geometry;
use crate::laws::coordinate::Coordinate;
use crate::laws::end::Seen;
use crate::laws::interaction::{Damper, Interaction, NoStorage, Quantity, Springs, Wrong};
use crate::laws::stop::{Stopped, check, check_soft};
use crate::real::Real;

law! {
    /// A point of the second body stopped by planes of the first body.
    pub struct EndStop = "end-stop" {
        /// A point of the first body and the stopped point; the range applies to their distance along the normal.
        points: Points,
        /// Normal of the planes; without a range the point is free on its side of the first body's point.
        normal: Normal,
        /// Lower end of the range.
        from: Number("m") = 0.0,
        /// Upper end of the range; 1e30 for no limit.
        to: Number("m") = 1e30,
        /// Force per depth.
        stiffness: Number("N/m"),
        /// Hunt–Crossley coefficient a: the force is stiffness · depth · (1 + a · rate of the depth).
        dissipation: Number("s/m") = 0.0,
    }
}

law! {
    /// A point of the second body stopped by planes of the first body, with a soft start.
    pub struct SoftEndStop = "soft-end-stop" {
        /// A point of the first body and the stopped point; the range applies to their distance along the normal.
        points: Points,
        /// Normal of the planes; without a range the point is free on its side of the first body's point.
        normal: Normal,
        /// Lower end of the range.
        from: Number("m") = 0.0,
        /// Upper end of the range; 1e30 for no limit.
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
                let travel = Coordinate::travel(seen, &self.points, self.normal);
                Stopped::within(travel, [self.from, self.to], [self.stiffness, soft])
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
                Some(self.stopped(seen).force_pair(seen))
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
                $(check_soft(self.$soft)?;)?
                check([self.from, self.to], self.stiffness, self.dissipation)
            }

            fn read(&self, _: usize, seen: &Seen<'_, P>, _: &NoStorage) -> P::Real {
                self.stopped(seen).depth()
            }
        }
    };
}

stop!(EndStop, false);
stop!(SoftEndStop, true, soft);
