//! A servo that rotates one body relative to another: [`super::servo`] of the rotation, as a damper with bounds.

use crate::force_pair::ForcePair;
use crate::geometry::Geometry;
use crate::laws::coordinate::TurnPose;
use crate::laws::end::Seen;
use crate::laws::interaction::{Damper, Interaction, Quantity, Springs, Wrong};
use crate::laws::servo::{Effort, Servo};
use crate::real::Real;

law! {
    /// A rotation of the second body relative to the first about an axis, driven by a servo without a rotor.
    pub struct HingeServo = "hinge-servo" {
        /// Axis of rotation; the angle is 0 at t = 0 and includes whole revolutions.
        axis: Axis,
        /// Input of the servo.
        input: Signal,
        /// Stiffness of a position servo.
        servo_stiffness: Number("N·m/rad") = 0.0,
        /// Damping of the servo.
        servo_damping: Number("N·m·s/rad"),
        /// Rate per unit of the input at which the servo's effort is 0: 1 for a velocity.
        feed: Number = 0.0,
        /// Largest effort.
        most: Number("N·m") = 1e30,
    }
}

impl<P: Geometry> HingeServo<P> {
    #[inline(always)]
    fn effort(&self) -> Effort<P::Real> {
        let Self { servo_stiffness, servo_damping, feed, most, .. } = *self;
        let gain = P::Real::ZERO;
        Effort { gain, stiffness: servo_stiffness, damping: servo_damping, feed, most }
    }

    #[inline(always)]
    fn servo(&self, seen: &Seen<'_, P>, turn: &TurnPose<P>) -> Option<Servo<P>> {
        Some(Servo::new(turn.coordinate()?, self.effort(), seen.signal(self.input)))
    }
}

impl<P: Geometry> Interaction<P> for HingeServo<P> {
    type State = TurnPose<P>;
    type Dampers = [(); 1];
    const TURNS: bool = true;
    const KEEPS: bool = true;
    const DRIVES: bool = true;
    const QUANTITIES: &'static [Quantity] = &[Quantity { name: "effort", unit: "N·m" }];

    #[inline(always)]
    fn settle(&self, seen: &Seen<'_, P>, turn: &mut TurnPose<P>) {
        turn.settle(seen, &self.axis, |turns| turns);
    }

    #[inline(always)]
    fn keep_pose(&self, seen: &Seen<'_, P>, turn: &mut TurnPose<P>) {
        turn.keep(seen, &self.axis, turn.turns);
    }

    #[inline(always)]
    fn force_pair(&self, seen: &Seen<'_, P>, turn: &TurnPose<P>) -> Option<ForcePair<P::Space>> {
        self.servo(seen, turn).map(|_| ForcePair::ZERO)
    }

    fn energy(&self, _: &Seen<'_, P>, _: &TurnPose<P>) -> P::Real {
        P::Real::ZERO
    }

    fn tangent(
        &self,
        seen: &Seen<'_, P>,
        turn: &TurnPose<P>,
        visit: Springs<'_, P>,
    ) -> [P::Real; 2] {
        let Some(servo) = self.servo(seen, turn) else { return [P::Real::ZERO; 2] };
        servo.tangent(seen, visit)
    }

    #[inline(always)]
    fn dampers(&self, seen: &Seen<'_, P>, turn: &TurnPose<P>, visit: &mut impl FnMut(Damper<P>)) {
        let Some(servo) = self.servo(seen, turn) else { return };
        visit(servo.damper(seen));
    }

    fn check(&self) -> Result<(), Wrong> {
        let drives = self.servo_damping > P::Real::ZERO;
        Wrong::unless(drives, "servo_damping", "is not positive", "a number > 0")?;
        self.effort().check()
    }

    fn read(&self, _: usize, seen: &Seen<'_, P>, turn: &TurnPose<P>) -> P::Real {
        let Some(servo) = self.servo(seen, turn) else { return P::Real::ZERO };
        servo.effort(seen)
    }
}
