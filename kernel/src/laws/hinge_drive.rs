//! A rotor behind a gear that rotates one body relative to another: [`super::Rotor`] of the rotation.

use crate::force_pair::ForcePair;
use crate::geometry::Geometry;
use crate::laws::coordinate::TurnPose;
use crate::laws::end::Seen;
use crate::laws::gear::{Gear, Rotor};
use crate::laws::hinge::Turns;
use crate::laws::interaction::{Damper, Inner, Interaction, Quantity, Springs, Wrong};
use crate::laws::rotor::Geared;
use crate::laws::servo::Effort;
use crate::laws::shaft_friction::ShaftFriction;
use crate::real::Real;
use crate::words::{WordSource, WordVisitor, Words};

law! {
    /// A rotation of the second body relative to the first about an axis, driven by a rotor behind a gear.
    pub struct HingeDrive = "hinge-drive" {
        /// Axis of rotation; the angle is 0 at t = 0 and includes whole revolutions.
        axis: Axis,
        /// Input of the drive.
        input: Signal,
        /// Effort per unit of the input: 1 for a torque or a force, the motor constant for a current.
        gain: Number = 0.0,
        /// Stiffness of a position servo.
        servo_stiffness: Number("N·m/rad") = 0.0,
        /// Damping of a servo; for a winding constant² / resistance.
        servo_damping: Number("N·m·s/rad") = 0.0,
        /// Rate per unit of the input at which the servo's effort is 0: 1 for a velocity, 1 / constant for a voltage.
        feed: Number = 0.0,
        /// Largest effort.
        most: Number("N·m") = 1e30,
        /// Time constant of the effort; for a winding inductance / resistance.
        lag: Number("s") = 0.0,
        /// Inertia of the rotor times the square of the gear ratio.
        inertia: Number("kg·m²"),
        /// Stiffness of the gear at its output.
        stiffness: Number("N·m/rad"),
        /// Damping of the gear at its output.
        damping: Number("N·m·s/rad") = 0.0,
        /// Backlash of the gear at its output, from one flank to the other.
        play: Number("rad") = 0.0,
    }
}

law! {
    /// A rotation of the second body relative to the first about an axis, driven by a rotor with friction behind a gear.
    pub struct HingeDriveFriction = "hinge-drive-friction" {
        /// Axis of rotation; the angle is 0 at t = 0 and includes whole revolutions.
        axis: Axis,
        /// Input of the drive.
        input: Signal,
        /// Effort per unit of the input: 1 for a torque or a force, the motor constant for a current.
        gain: Number = 0.0,
        /// Stiffness of a position servo.
        servo_stiffness: Number("N·m/rad") = 0.0,
        /// Damping of a servo; for a winding constant² / resistance.
        servo_damping: Number("N·m·s/rad") = 0.0,
        /// Rate per unit of the input at which the servo's effort is 0: 1 for a velocity, 1 / constant for a voltage.
        feed: Number = 0.0,
        /// Largest effort.
        most: Number("N·m") = 1e30,
        /// Time constant of the effort; for a winding inductance / resistance.
        lag: Number("s") = 0.0,
        /// Inertia of the rotor times the square of the gear ratio.
        inertia: Number("kg·m²"),
        /// Stiffness of the gear at its output.
        stiffness: Number("N·m/rad"),
        /// Damping of the gear at its output.
        damping: Number("N·m·s/rad") = 0.0,
        /// Backlash of the gear at its output, from one flank to the other.
        play: Number("rad") = 0.0,
        /// Dry friction of the rotor times the gear ratio.
        coulomb: Number("N·m") = 0.0,
        /// Viscous friction of the rotor times the square of the gear ratio.
        viscous: Number("N·m·s/rad") = 0.0,
    }
}

/// The memory of a drive of a rotation.
#[derive(Clone, Copy)]
pub struct TurnRotor<P: Geometry> {
    /// The torsion angle.
    pub turn: TurnPose<P>,
    /// Its rotor.
    pub rotor: Rotor<P::Real>,
}

impl<P: Geometry> Default for TurnRotor<P> {
    fn default() -> Self {
        Self { turn: TurnPose::default(), rotor: Rotor::default() }
    }
}

impl<P: Geometry> Words for TurnRotor<P> {
    fn visit(&self, visitor: &mut impl WordVisitor) {
        self.turn.visit(visitor);
        self.rotor.visit(visitor);
    }
    fn fill(&mut self, source: &mut impl WordSource) {
        self.turn.fill(source);
        self.rotor.fill(source);
    }
}

/// The law, with or without friction of the rotor.
macro_rules! drive {
    ($law:ident, $rubs:literal $(, $friction:ident)?) => {
        impl<P: Geometry> $law<P> {
            #[inline(always)]
            pub(super) fn effort(&self) -> Effort<P::Real> {
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

            /// Uses an angle near that of the last step: in single precision a large revolution count would leave no digits for
            /// the gear.
            #[inline(always)]
            pub(super) fn geared(&self, turn: &TurnPose<P>) -> Option<Geared<P, $rubs>> {
                Some(Geared::new(turn.coordinate()?, self.gear(), self.friction()))
            }
        }

        impl<P: Geometry> Interaction<P> for $law<P> {
            type State = TurnRotor<P>;
            type Dampers = [(); 1];
            const TURNS: bool = true;
            const ADVANCES: bool = true;
            const INNER: bool = true;
            const KEEPS: bool = true;
            const QUANTITIES: &'static [Quantity] = &[
                Quantity { name: "load", unit: "N·m" },
                Quantity { name: "effort", unit: "N·m" },
                Quantity { name: "ahead", unit: "rad" },
                Quantity { name: "rate", unit: "rad/s" },
            ];

            #[inline(always)]
            fn advance(&self, _: &Seen<'_, P>, h: P::Real, memory: &mut TurnRotor<P>) {
                memory.rotor.advance(h);
            }

            #[inline(always)]
            fn settle(&self, seen: &Seen<'_, P>, memory: &mut TurnRotor<P>) {
                let Some(turn) = memory.turn.settle(seen, &self.axis, Turns::odd) else { return };
                let Some(next) = memory.turn.coordinate() else { return };
                let geared = Geared::<P, $rubs>::new(turn, self.gear(), self.friction());
                geared.settle(seen, next.value, &mut memory.rotor);
            }

            #[inline(always)]
            fn keep_pose(&self, seen: &Seen<'_, P>, memory: &mut TurnRotor<P>) {
                memory.turn.keep(seen, &self.axis, memory.turn.turns.odd());
            }

            #[inline(always)]
            fn force_pair(
                &self,
                seen: &Seen<'_, P>,
                memory: &TurnRotor<P>,
            ) -> Option<ForcePair<P::Space>> {
                Some(self.geared(&memory.turn)?.force_pair(seen, &memory.rotor))
            }

            fn energy(&self, seen: &Seen<'_, P>, memory: &TurnRotor<P>) -> P::Real {
                let Some(geared) = self.geared(&memory.turn) else { return P::Real::ZERO };
                geared.energy(seen, &memory.rotor)
            }

            fn tangent(
                &self,
                seen: &Seen<'_, P>,
                memory: &TurnRotor<P>,
                visit: Springs<'_, P>,
            ) -> [P::Real; 2] {
                let Some(geared) = self.geared(&memory.turn) else {
                    return [P::Real::ZERO; 2];
                };
                geared.tangent(seen, &memory.rotor, visit)
            }

            #[inline(always)]
            fn dampers(
                &self,
                seen: &Seen<'_, P>,
                memory: &TurnRotor<P>,
                visit: &mut impl FnMut(Damper<P>),
            ) {
                let Some(geared) = self.geared(&memory.turn) else { return };
                visit(geared.damper(seen, &memory.rotor));
            }

            #[inline(always)]
            fn kick(
                &self,
                seen: &Seen<'_, P>,
                h: P::Real,
                memory: &mut TurnRotor<P>,
            ) -> P::Real {
                let Some(geared) = self.geared(&memory.turn) else { return P::Real::ZERO };
                let driven = (&self.effort(), seen.signal(self.input));
                geared.kick(driven, h, &mut memory.rotor)
            }

            #[inline(always)]
            fn drive(
                &self,
                seen: &Seen<'_, P>,
                time: [P::Real; 2],
                memory: &mut TurnRotor<P>,
            ) {
                let Some(geared) = self.geared(&memory.turn) else { return };
                let driven = (&self.effort(), seen.signal(self.input));
                let place = geared.place(&memory.rotor) + memory.turn.turns.whole();
                geared.drive(driven, place, time, &mut memory.rotor);
            }

            #[inline(always)]
            fn inner(&self, memory: &TurnRotor<P>, kick: P::Real) -> Inner<P::Real> {
                self.gear().inner(&memory.rotor, kick)
            }

            #[inline(always)]
            fn set_inner(&self, rate: P::Real, memory: &mut TurnRotor<P>) {
                memory.rotor.rate = rate;
            }

            fn inner_square(&self) -> P::Real {
                self.gear().square(self.servo_stiffness)
            }

            fn supply(&self, _: &Seen<'_, P>, memory: &TurnRotor<P>) -> P::Real {
                memory.rotor.supply()
            }

            fn loss(&self, memory: &Self::State) -> P::Real {
                self.friction().loss(memory.rotor.rate)
            }

            fn check(&self) -> Result<(), Wrong> {
                self.effort().check()?;
                self.friction().check()?;
                self.gear().check()
            }

            fn read(
                &self,
                quantity: usize,
                _: &Seen<'_, P>,
                memory: &TurnRotor<P>,
            ) -> P::Real {
                let Some(geared) = self.geared(&memory.turn) else { return P::Real::ZERO };
                geared.read(quantity, &memory.rotor)
            }
        }
    };
}

impl<P: Geometry> HingeDriveFriction<P> {
    #[inline(always)]
    fn of_shaft(&self) -> ShaftFriction<P::Real> {
        ShaftFriction { coulomb: self.coulomb, viscous: self.viscous }
    }
}

drive!(HingeDrive, false);
drive!(HingeDriveFriction, true, of_shaft);
