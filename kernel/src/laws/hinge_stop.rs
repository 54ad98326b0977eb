//! Stops of a rotation about an axis: the law of [`super::EndStop`] at both ends of a range.
//!
//! Torsion angle `θ ↦ x = θ − to` or `from − θ`, torque `k·x·(1 + a·ẋ)` back into the range, along the angle's
//! gradient.

use crate::force_pair::ForcePair;
use crate::geometry::Geometry;
use crate::laws::coordinate::TurnPose;
use crate::laws::end::Seen;
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
            fn stopped(&self, turn: &TurnPose<P>) -> Option<Stopped<P, $is_soft>> {
                let [.., soft] = [P::Real::ZERO $(, self.$soft)?];
                Some(Stopped::within(turn.coordinate()?, [self.from, self.to], [self.stiffness, soft]))
            }
        }

        impl<P: Geometry> Interaction<P> for $law<P> {
            type State = TurnPose<P>;
            type Dampers = [(); 1];
            const TURNS: bool = true;
            const KEEPS: bool = true;
            const QUANTITIES: &'static [Quantity] = &[Quantity { name: "depth", unit: "rad" }];

            #[inline(always)]
            fn settle(&self, seen: &Seen<'_, P>, turn: &mut TurnPose<P>) {
                turn.settle(seen, &self.axis, |turns| turns);
            }

            #[inline(always)]
            fn keep_pose(&self, seen: &Seen<'_, P>, turn: &mut TurnPose<P>) {
                turn.keep(seen, &self.axis, turn.turns);
            }

            #[inline(always)]
            fn is_idle(&self, turn: &TurnPose<P>) -> bool {
                self.stopped(turn).is_none_or(|stopped| stopped.is_free())
            }

            #[inline(always)]
            fn force_pair(
                &self,
                seen: &Seen<'_, P>,
                turn: &TurnPose<P>,
            ) -> Option<ForcePair<P::Space>> {
                Some(self.stopped(turn)?.force_pair(seen))
            }

            fn energy(&self, _: &Seen<'_, P>, turn: &TurnPose<P>) -> P::Real {
                self.stopped(turn).map_or(P::Real::ZERO, |stopped| stopped.energy())
            }

            fn tangent(
                &self,
                seen: &Seen<'_, P>,
                turn: &TurnPose<P>,
                visit: Springs<'_, P>,
            ) -> [P::Real; 2] {
                let Some(stopped) = self.stopped(turn) else { return [P::Real::ZERO; 2] };
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
                turn: &TurnPose<P>,
                visit: &mut impl FnMut(Damper<P>),
            ) {
                if !Interaction::<P>::is_damped(self) {
                    return visit(Damper::idle());
                }
                if let Some(stopped) = self.stopped(turn) {
                    visit(stopped.damper(seen, self.dissipation));
                }
            }

            fn check(&self) -> Result<(), Wrong> {
                $(check_soft(self.$soft)?;)?
                check([self.from, self.to], self.stiffness, self.dissipation)
            }

            fn read(&self, _: usize, _: &Seen<'_, P>, turn: &TurnPose<P>) -> P::Real {
                self.stopped(turn).map_or(P::Real::ZERO, |stopped| stopped.depth())
            }
        }
    };
}

stop!(HingeStop, false);
stop!(SoftHingeStop, true, soft);
