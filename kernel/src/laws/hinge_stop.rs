//! Stops of a rotation about an axis: the law of [`super::EndStop`] at both ends of a range.
//!
//! Torsion angle `θ ↦ x = θ − to` or `from − θ`, torque `k·x·(1 + a·ẋ)` back into the range, along the angle's
//! gradient.

use crate::force_pair::ForcePair;
use crate::geometry::Geometry;
use crate::laws::coordinate::Coordinate;
use crate::laws::end::Seen;
use crate::laws::hinge::Turns;
use crate::laws::interaction::{Damper, Interaction, Quantity, Springs, Wrong};
use crate::laws::stop::{Stopped, check, check_soft};
use crate::real::Real;

law! {
    /// Stops at both ends of a range of rotation of the second body relative to the first about an axis.
    pub struct HingeStop = "hinge-stop" {
        /// Axis of rotation; the angle is 0 at t = 0 and includes whole revolutions.
        axis: Axis,
        /// Lower end of the range.
        from: Number("rad"),
        /// Upper end of the range.
        to: Number("rad"),
        /// Torque per angle beyond the range.
        stiffness: Number("N·m/rad"),
        /// Hunt–Crossley coefficient a: the torque is stiffness · depth · (1 + a · rate of the depth).
        dissipation: Number("s/rad") = 0.0,
    }
}

law! {
    /// Stops with a soft start at both ends of a range of rotation of the second body about an axis.
    pub struct SoftHingeStop = "soft-hinge-stop" {
        /// Axis of rotation; the angle is 0 at t = 0 and includes whole revolutions.
        axis: Axis,
        /// Lower end of the range.
        from: Number("rad"),
        /// Upper end of the range.
        to: Number("rad"),
        /// Torque per angle beyond the range.
        stiffness: Number("N·m/rad"),
        /// Depth within which the stiffness rises from 0 to its value.
        soft: Number("rad"),
        /// Hunt–Crossley coefficient a: the torque is that of the spring · (1 + a · rate of the depth).
        dissipation: Number("s/rad") = 0.0,
    }
}

/// The law, hard or soft.
macro_rules! stop {
    ($law:ident, $is_soft:literal $(, $soft:ident)?) => {
        impl<P: Geometry> $law<P> {
            #[inline(always)]
            fn stopped(&self, seen: &Seen<'_, P>, turns: Turns) -> Option<Stopped<P, $is_soft>> {
                let [.., soft] = [P::Real::ZERO $(, self.$soft)?];
                let turn = Coordinate::turn(seen, &self.axis, turns)?;
                Some(Stopped::within(turn, [self.from, self.to], [self.stiffness, soft]))
            }
        }

        impl<P: Geometry> Interaction<P> for $law<P> {
            type State = Turns;
            type Dampers = [(); 1];
            const QUANTITIES: &'static [Quantity] = &[Quantity { name: "depth", unit: "rad" }];

            #[inline(always)]
            fn settle(&self, seen: &Seen<'_, P>, turns: &mut Turns) {
                if let Some(torsion_angle) = self.axis.seen(seen) {
                    torsion_angle.settle(turns);
                }
            }

            #[inline(always)]
            fn force_pair(
                &self,
                seen: &Seen<'_, P>,
                turns: &Turns,
            ) -> Option<ForcePair<P::Space>> {
                Some(self.stopped(seen, *turns)?.force_pair(seen))
            }

            fn energy(&self, seen: &Seen<'_, P>, turns: &Turns) -> P::Real {
                self.stopped(seen, *turns).map_or(P::Real::ZERO, |stopped| stopped.energy())
            }

            fn tangent(
                &self,
                seen: &Seen<'_, P>,
                turns: &Turns,
                visit: Springs<'_, P>,
            ) -> [P::Real; 2] {
                let Some(stopped) = self.stopped(seen, *turns) else { return [P::Real::ZERO; 2] };
                stopped.tangent(seen, visit)
            }

            #[inline(always)]
            fn is_damped(&self) -> bool {
                self.dissipation != P::Real::ZERO
            }

            #[inline(always)]
            fn dampers(
                &self,
                seen: &Seen<'_, P>,
                turns: &Turns,
                visit: &mut impl FnMut(Damper<P>),
            ) {
                if !Interaction::<P>::is_damped(self) {
                    return visit(Damper::idle());
                }
                if let Some(stopped) = self.stopped(seen, *turns) {
                    visit(stopped.damper(seen, self.dissipation));
                }
            }

            fn check(&self) -> Result<(), Wrong> {
                $(check_soft(self.$soft)?;)?
                check([self.from, self.to], self.stiffness, self.dissipation)
            }

            fn read(&self, _: usize, seen: &Seen<'_, P>, turns: &Turns) -> P::Real {
                self.stopped(seen, *turns).map_or(P::Real::ZERO, |stopped| stopped.depth())
            }
        }
    };
}

stop!(HingeStop, false);
stop!(SoftHingeStop, true, soft);
