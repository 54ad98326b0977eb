//! A rotor with windings in rotor axes behind a gear that rotates one body relative to another: the drive of
//! [`super::HingeDriveFriction`] with the effort of [`super::machine`].

use crate::force_pair::ForcePair;
use crate::geometry::Geometry;
use crate::index::InputIndex;
use crate::laws::end::Seen;
use crate::laws::hinge_drive::{HingeDriveFriction, TurnRotor};
use crate::laws::interaction::{Damper, Inner, Interaction, Quantity, Springs, Wrong};
use crate::laws::machine::{Currents, Machine};
use crate::real::Real;
use crate::schedule::Signal;
use crate::words::{WordSource, WordVisitor, Words};

law! {
    /// A rotation of the second body relative to the first about an axis, driven by a permanent-magnet synchronous machine behind a gear.
    pub struct HingeDriveDq = "hinge-drive-dq" {
        /// Axis of rotation; the angle is 0 at t = 0 and includes whole revolutions.
        axis: Axis,
        /// Input of the voltage q, or of the current q.
        input: Signal,
        /// Input of the voltage d, or of the current d.
        d_input: Signal,
        /// Resistance of a phase; 0 where the inputs are the currents.
        resistance: Number("ohm") = 0.0,
        /// Inductance along the magnets.
        inductance_d: Number("H"),
        /// Inductance a quarter of a period ahead.
        inductance_q: Number("H"),
        /// Flux linkage of the magnets.
        flux: Number("V·s"),
        /// Pole pairs times the gear ratio.
        poles: Number,
        /// Largest amplitude of the currents.
        most_current: Number("A") = 1e15,
        /// Time constant of the effort where the inputs are the currents.
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

/// The memory of a drive of a rotation with windings in rotor axes.
#[derive(Clone, Copy)]
pub struct WoundRotor<P: Geometry> {
    /// Its rotor.
    pub rotor: TurnRotor<P>,
    /// The currents of its windings.
    pub currents: Currents<P::Real>,
}

impl<P: Geometry> Default for WoundRotor<P> {
    fn default() -> Self {
        Self { rotor: TurnRotor::default(), currents: Currents::default() }
    }
}

impl<P: Geometry> Words for WoundRotor<P> {
    fn visit(&self, visitor: &mut impl WordVisitor) {
        self.rotor.visit(visitor);
        self.currents.visit(visitor);
    }
    fn fill(&mut self, source: &mut impl WordSource) {
        self.rotor.fill(source);
        self.currents.fill(source);
    }
}

impl<P: Geometry> HingeDriveDq<P> {
    /// The drive without its windings.
    #[inline(always)]
    fn geared_drive(&self) -> HingeDriveFriction<P> {
        let Self { bodies, axis, input, lag, inertia, stiffness, damping, play, .. } = *self;
        HingeDriveFriction {
            bodies,
            axis,
            input,
            gain: P::Real::ONE,
            servo_stiffness: P::Real::ZERO,
            servo_damping: P::Real::ZERO,
            feed: P::Real::ZERO,
            most: P::Real::from_f64(1e30),
            lag,
            inertia,
            stiffness,
            damping,
            play,
            coulomb: self.coulomb,
            viscous: self.viscous,
        }
    }

    #[inline(always)]
    fn machine(&self) -> Machine<P::Real> {
        let Self { resistance, inductance_d, inductance_q, flux, poles, most_current, .. } = *self;
        let inductances = [inductance_d, inductance_q];
        Machine { resistance, inductances, flux, poles, most_current }
    }

    /// Voltages or currents of d and q.
    #[inline(always)]
    fn inputs(&self, seen: &Seen<'_, P>) -> [P::Real; 2] {
        [self.d_input, self.input].map(|input: InputIndex| seen.input(input))
    }

    /// The effort of the currents that its inputs are, and these.
    #[inline(always)]
    fn fed(&self, seen: &Seen<'_, P>) -> (Signal<P::Real>, Currents<P::Real>) {
        let machine = self.machine();
        let currents = machine.bounded(self.inputs(seen));
        (Signal { value: machine.effort(currents), rate: P::Real::ZERO }, currents)
    }
}

impl<P: Geometry> Interaction<P> for HingeDriveDq<P> {
    type State = WoundRotor<P>;
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
        Quantity { name: "current_d", unit: "A" },
        Quantity { name: "current_q", unit: "A" },
    ];

    #[inline(always)]
    fn advance(&self, seen: &Seen<'_, P>, h: P::Real, memory: &mut WoundRotor<P>) {
        self.geared_drive().advance(seen, h, &mut memory.rotor);
    }

    #[inline(always)]
    fn settle(&self, seen: &Seen<'_, P>, memory: &mut WoundRotor<P>) {
        self.geared_drive().settle(seen, &mut memory.rotor);
    }

    #[inline(always)]
    fn keep_pose(&self, seen: &Seen<'_, P>, memory: &mut WoundRotor<P>) {
        self.geared_drive().keep_pose(seen, &mut memory.rotor);
    }

    #[inline(always)]
    fn force_pair(
        &self,
        seen: &Seen<'_, P>,
        memory: &WoundRotor<P>,
    ) -> Option<ForcePair<P::Space>> {
        self.geared_drive().force_pair(seen, &memory.rotor)
    }

    fn energy(&self, seen: &Seen<'_, P>, memory: &WoundRotor<P>) -> P::Real {
        self.geared_drive().energy(seen, &memory.rotor)
    }

    fn tangent(
        &self,
        seen: &Seen<'_, P>,
        memory: &WoundRotor<P>,
        visit: Springs<'_, P>,
    ) -> [P::Real; 2] {
        self.geared_drive().tangent(seen, &memory.rotor, visit)
    }

    #[inline(always)]
    fn dampers(
        &self,
        seen: &Seen<'_, P>,
        memory: &WoundRotor<P>,
        visit: &mut impl FnMut(Damper<P>),
    ) {
        self.geared_drive().dampers(seen, &memory.rotor, visit);
    }

    #[inline(always)]
    fn kick(&self, seen: &Seen<'_, P>, h: P::Real, memory: &mut WoundRotor<P>) -> P::Real {
        let TurnRotor { turn, rotor } = &mut memory.rotor;
        let drive = self.geared_drive();
        let Some(geared) = drive.geared(turn) else { return P::Real::ZERO };
        if self.machine().is_fed() {
            let (effort, _) = self.fed(seen);
            return geared.kick((&drive.effort(), effort), h, rotor);
        }
        geared.kick_wound(h, rotor)
    }

    #[inline(always)]
    fn drive(&self, seen: &Seen<'_, P>, time: [P::Real; 2], memory: &mut WoundRotor<P>) {
        let WoundRotor { rotor: TurnRotor { turn, rotor }, currents } = memory;
        let (drive, machine) = (self.geared_drive(), self.machine());
        let Some(geared) = drive.geared(turn) else { return };
        if machine.is_fed() {
            let effort;
            (effort, *currents) = self.fed(seen);
            return geared.drive((&drive.effort(), effort), P::Real::ZERO, time, rotor);
        }
        geared.drive_wound((&machine, self.inputs(seen)), time, rotor, currents);
    }

    #[inline(always)]
    fn inner(&self, memory: &WoundRotor<P>, kick: P::Real) -> Inner<P::Real> {
        self.geared_drive().inner(&memory.rotor, kick)
    }

    #[inline(always)]
    fn set_inner(&self, rate: P::Real, memory: &mut WoundRotor<P>) {
        memory.rotor.rotor.rate = rate;
    }

    fn inner_square(&self) -> P::Real {
        self.geared_drive().inner_square()
    }

    fn supply(&self, seen: &Seen<'_, P>, memory: &WoundRotor<P>) -> P::Real {
        self.geared_drive().supply(seen, &memory.rotor)
    }

    fn loss(&self, memory: &WoundRotor<P>) -> P::Real {
        self.geared_drive().loss(&memory.rotor)
    }

    fn check(&self) -> Result<(), Wrong> {
        self.machine().check()?;
        self.geared_drive().check()
    }

    fn read(&self, quantity: usize, seen: &Seen<'_, P>, memory: &WoundRotor<P>) -> P::Real {
        match quantity {
            4 => memory.currents.d,
            5 => memory.currents.q,
            _ => self.geared_drive().read(quantity, seen, &memory.rotor),
        }
    }
}
