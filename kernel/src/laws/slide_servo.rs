//! A servo that translates one body relative to another: [`super::servo`] of the translation, as a damper with bounds.

use crate::force_pair::ForcePair;
use crate::geometry::Geometry;
use crate::laws::coordinate::Coordinate;
use crate::laws::end::Seen;
use crate::laws::interaction::{Damper, Interaction, NoStorage, Quantity, Springs, Wrong};
use crate::laws::servo::{Effort, Servo};
use crate::real::Real;

law! {
    /// A translation of the second body relative to the first along an axis, driven by a servo without a rotor.
    pub struct SlideServo = "slide-servo" {
        /// A point of the first body and the driven point of the second body.
        points: Points,
        /// Axis of the translation.
        axis: Normal,
        /// Input of the servo.
        input: Signal,
        /// Stiffness of a position servo.
        servo_stiffness: Number("N/m") = 0.0,
        /// Damping of the servo.
        servo_damping: Number("N·s/m"),
        /// Rate per unit of the input at which the servo's effort is 0: 1 for a velocity.
        feed: Number = 0.0,
        /// Largest effort.
        most: Number("N") = 1e30,
    }
}

impl<P: Geometry> SlideServo<P> {
    #[inline(always)]
    fn effort(&self) -> Effort<P::Real> {
        let Self { servo_stiffness, servo_damping, feed, most, .. } = *self;
        let gain = P::Real::ZERO;
        Effort { gain, stiffness: servo_stiffness, damping: servo_damping, feed, most }
    }

    #[inline(always)]
    fn servo(&self, seen: &Seen<'_, P>) -> Servo<P> {
        let travel = Coordinate::travel(seen, &self.points, self.axis);
        Servo::new(travel, self.effort(), seen.signal(self.input))
    }
}

impl<P: Geometry> Interaction<P> for SlideServo<P> {
    type State = NoStorage;
    type Dampers = [(); 1];
    const DRIVES: bool = true;
    const QUANTITIES: &'static [Quantity] = &[Quantity { name: "effort", unit: "N" }];

    #[inline(always)]
    fn force_pair(&self, _: &Seen<'_, P>, _: &NoStorage) -> Option<ForcePair<P::Space>> {
        Some(ForcePair::ZERO)
    }

    fn energy(&self, _: &Seen<'_, P>, _: &NoStorage) -> P::Real {
        P::Real::ZERO
    }

    fn tangent(&self, seen: &Seen<'_, P>, _: &NoStorage, visit: Springs<'_, P>) -> [P::Real; 2] {
        let servo = self.servo(seen);
        servo.tangent(seen, visit)
    }

    #[inline(always)]
    fn dampers(&self, seen: &Seen<'_, P>, _: &NoStorage, visit: &mut impl FnMut(Damper<P>)) {
        let servo = self.servo(seen);
        visit(servo.damper(seen));
    }

    fn check(&self) -> Result<(), Wrong> {
        let drives = self.servo_damping > P::Real::ZERO;
        Wrong::unless(drives, "servo_damping", "is not positive", "a number > 0")?;
        self.effort().check()
    }

    fn read(&self, _: usize, seen: &Seen<'_, P>, _: &NoStorage) -> P::Real {
        let servo = self.servo(seen);
        servo.effort(seen)
    }
}
