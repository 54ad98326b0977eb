//! A rotor behind a gear that translates one body relative to another: [`super::Rotor`] of the translation.

use crate::force_pair::ForcePair;
use crate::geometry::Geometry;
use crate::laws::coordinate::Coordinate;
use crate::laws::end::Seen;
use crate::laws::gear::{Gear, Rotor};
use crate::laws::interaction::{Damper, Inner, Interaction, Quantity, Springs, Wrong};
use crate::laws::rotor::Geared;
use crate::laws::servo::Effort;
use crate::laws::shaft_friction::ShaftFriction;

law! {
    /// A translation of the second body relative to the first along an axis, driven by a rotor behind a gear.
    pub struct SlideDrive = "slide-drive" {
        /// A point of the first body and the driven point of the second body.
        points: Points,
        /// Axis of the translation.
        axis: Normal,
        /// Input of the drive.
        input: Signal,
        /// Effort per unit of the input: 1 for a torque or a force, the motor constant for a current.
        gain: Number = 0.0,
        /// Stiffness of a position servo.
        servo_stiffness: Number("N/m") = 0.0,
        /// Damping of a servo; for a winding constant² / resistance.
        servo_damping: Number("N·s/m") = 0.0,
        /// Rate per unit of the input at which the servo's effort is 0: 1 for a velocity, 1 / constant for a voltage.
        feed: Number = 0.0,
        /// Largest effort.
        most: Number("N") = 1e30,
        /// Time constant of the effort; for a winding inductance / resistance.
        lag: Number("s") = 0.0,
        /// Inertia of the rotor times the square of the gear ratio.
        inertia: Number("kg"),
        /// Stiffness of the gear at its output.
        stiffness: Number("N/m"),
        /// Damping of the gear at its output.
        damping: Number("N·s/m") = 0.0,
        /// Backlash of the gear at its output, from one flank to the other.
        play: Number("m") = 0.0,
    }
}

law! {
    /// A translation of the second body relative to the first along an axis, driven by a rotor with friction behind a gear.
    pub struct SlideDriveFriction = "slide-drive-friction" {
        /// A point of the first body and the driven point of the second body.
        points: Points,
        /// Axis of the translation.
        axis: Normal,
        /// Input of the drive.
        input: Signal,
        /// Effort per unit of the input: 1 for a torque or a force, the motor constant for a current.
        gain: Number = 0.0,
        /// Stiffness of a position servo.
        servo_stiffness: Number("N/m") = 0.0,
        /// Damping of a servo; for a winding constant² / resistance.
        servo_damping: Number("N·s/m") = 0.0,
        /// Rate per unit of the input at which the servo's effort is 0: 1 for a velocity, 1 / constant for a voltage.
        feed: Number = 0.0,
        /// Largest effort.
        most: Number("N") = 1e30,
        /// Time constant of the effort; for a winding inductance / resistance.
        lag: Number("s") = 0.0,
        /// Inertia of the rotor times the square of the gear ratio.
        inertia: Number("kg"),
        /// Stiffness of the gear at its output.
        stiffness: Number("N/m"),
        /// Damping of the gear at its output.
        damping: Number("N·s/m") = 0.0,
        /// Backlash of the gear at its output, from one flank to the other.
        play: Number("m") = 0.0,
        /// Dry friction of the rotor times the gear ratio.
        coulomb: Number("N") = 0.0,
        /// Viscous friction of the rotor times the square of the gear ratio.
        viscous: Number("N·s/m") = 0.0,
    }
}

/// The law, with or without friction of the rotor.
macro_rules! drive {
    ($law:ident, $rubs:literal $(, $friction:ident)?) => {
        impl<P: Geometry> $law<P> {
            #[inline(always)]
            fn effort(&self) -> Effort<P::Real> {
                let Self { gain, servo_stiffness, servo_damping, feed, most, .. } = *self;
                Effort { gain, stiffness: servo_stiffness, damping: servo_damping, feed, most }
            }

            #[inline(always)]
            fn friction(&self) -> ShaftFriction<P::Real> {
                let [.., friction] = [ShaftFriction::NONE $(, self.$friction())?];
                friction
            }

            #[inline(always)]
            fn gear(&self) -> Gear<P::Real> {
                let Self { inertia, stiffness, damping, play, lag, .. } = *self;
                Gear { inertia, stiffness, damping, play, lag }
            }

            #[inline(always)]
            fn geared(&self, seen: &Seen<'_, P>) -> Geared<P, $rubs> {
                let travel = Coordinate::travel(seen, &self.points, self.axis);
                Geared::new(travel, self.gear(), self.friction())
            }
        }

        impl<P: Geometry> Interaction<P> for $law<P> {
            type State = Rotor<P::Real>;
            type Dampers = [(); 1];
            const ADVANCES: bool = true;
            const INNER: bool = true;
            const QUANTITIES: &'static [Quantity] = &[
                Quantity { name: "load", unit: "N" },
                Quantity { name: "effort", unit: "N" },
                Quantity { name: "ahead", unit: "m" },
                Quantity { name: "rate", unit: "m/s" },
            ];

            #[inline(always)]
            fn advance(&self, _: &Seen<'_, P>, h: P::Real, memory: &mut Rotor<P::Real>) {
                memory.advance(h);
            }

            #[inline(always)]
            fn settle(&self, seen: &Seen<'_, P>, memory: &mut Rotor<P::Real>) {
                let geared = self.geared(seen);
                geared.settle(seen, geared.value(), memory);
            }

            #[inline(always)]
            fn force_pair(
                &self,
                seen: &Seen<'_, P>,
                memory: &Rotor<P::Real>,
            ) -> Option<ForcePair<P::Space>> {
                Some(self.geared(seen).force_pair(seen, memory))
            }

            fn energy(&self, seen: &Seen<'_, P>, memory: &Rotor<P::Real>) -> P::Real {
                let geared = self.geared(seen);
                geared.energy(seen, memory)
            }

            fn tangent(
                &self,
                seen: &Seen<'_, P>,
                memory: &Rotor<P::Real>,
                visit: Springs<'_, P>,
            ) -> [P::Real; 2] {
                let geared = self.geared(seen);
                geared.tangent(seen, memory, visit)
            }

            #[inline(always)]
            fn dampers(
                &self,
                seen: &Seen<'_, P>,
                memory: &Rotor<P::Real>,
                visit: &mut impl FnMut(Damper<P>),
            ) {
                let geared = self.geared(seen);
                visit(geared.damper(seen, memory));
            }

            #[inline(always)]
            fn kick(&self, seen: &Seen<'_, P>, h: P::Real, memory: &mut Rotor<P::Real>) -> P::Real {
                let geared = self.geared(seen);
                let driven = (&self.effort(), seen.signal(self.input));
                geared.kick(driven, h, memory)
            }

            #[inline(always)]
            fn drive(&self, seen: &Seen<'_, P>, time: [P::Real; 2], memory: &mut Rotor<P::Real>) {
                let geared = self.geared(seen);
                let driven = (&self.effort(), seen.signal(self.input));
                let place = geared.place(memory);
                geared.drive(driven, place, time, memory);
            }

            #[inline(always)]
            fn inner(&self, memory: &Rotor<P::Real>, kick: P::Real) -> Inner<P::Real> {
                self.gear().inner(memory, kick)
            }

            #[inline(always)]
            fn set_inner(&self, rate: P::Real, memory: &mut Rotor<P::Real>) {
                memory.rate = rate;
            }

            fn inner_square(&self) -> P::Real {
                self.gear().square(self.servo_stiffness)
            }

            fn supply(&self, _: &Seen<'_, P>, memory: &Rotor<P::Real>) -> P::Real {
                memory.supply()
            }

            fn loss(&self, memory: &Self::State) -> P::Real {
                self.friction().loss(memory.rate)
            }

            fn check(&self) -> Result<(), Wrong> {
                self.effort().check()?;
                self.friction().check()?;
                self.gear().check()
            }

            fn read(
                &self,
                quantity: usize,
                seen: &Seen<'_, P>,
                memory: &Rotor<P::Real>,
            ) -> P::Real {
                let geared = self.geared(seen);
                geared.read(quantity, memory)
            }
        }
    };
}

impl<P: Geometry> SlideDriveFriction<P> {
    #[inline(always)]
    fn of_shaft(&self) -> ShaftFriction<P::Real> {
        ShaftFriction { coulomb: self.coulomb, viscous: self.viscous }
    }
}

drive!(SlideDrive, false);
drive!(SlideDriveFriction, true, of_shaft);
