//! `[[input]]` of the type `drive`: a motor at a joint, as a law about or along its axis.
//!
//! `(table of an input, joints) => law, its constants, unit of the input`. Quantities at the input of a gear are
//! converted to its output here, in double precision: inertia times the square of the ratio, constant times the
//! ratio.

use crate::error::SceneError;
use crate::interaction::common::{Constants, InputName, Mode};
use crate::interaction::of_windings::{AxesWinding, Winding, has_axes};
use crate::joints::JointPlace;
use crate::known::freedom;
use crate::target::Elements;
use crate::text::{Choice, Number, Table};

/// The name of the type.
pub(crate) const TYPE: &str = "drive";

/// The keys of a drive.
pub(crate) const KEYS: &[&str] = &[
    "target", "freedom", "mode", "kp", "kd", "most", "lag", "winding", "d_input", "rotor", "ratio",
    "gear", "friction",
];

/// The keys of the friction of its rotor.
pub(crate) const SHAFT_FRICTION: &[&str] = &["coulomb", "viscous"];

/// The keys of its gear.
pub(crate) const GEAR: &[&str] = &["stiffness", "damping", "play"];

/// Names and types of all inputs, in the scene's order.
pub(super) struct OtherInputs {
    pub(super) names: Vec<String>,
    pub(super) types: Vec<String>,
}

/// Units of a drive about or along an axis.
struct Units {
    place: &'static str,
    rate: &'static str,
    effort: &'static str,
    stiffness: &'static str,
    damping: &'static str,
}

const TURN: Units = Units {
    place: "rad",
    rate: "rad/s",
    effort: "N·m",
    stiffness: "N·m/rad",
    damping: "N·m·s/rad",
};

const TRAVEL: Units =
    Units { place: "m", rate: "m/s", effort: "N", stiffness: "N/m", damping: "N·s/m" };

/// The joint coordinate and mode of a drive.
pub(crate) struct Driven<'j> {
    /// Its joint.
    pub(super) place: &'j JointPlace,
    turns: bool,
    mode: Mode,
}

impl<'j> Driven<'j> {
    /// Reads `target`, `freedom` and `mode`.
    pub(crate) fn read(
        table: &Table<'_>,
        places: &'j [JointPlace],
        elements: &Elements,
    ) -> Result<Self, SceneError> {
        let (place, turns) = freedom(table, "target", (places, elements), "a drive")?;
        let names = if turns { Mode::TURN } else { Mode::TRAVEL };
        let mode = Mode::ALL[table.required("mode", Choice(&names))?];
        Ok(Self { place, turns, mode })
    }

    fn units(&self) -> &'static Units {
        if self.turns { &TURN } else { &TRAVEL }
    }

    /// The unit of its input.
    pub(crate) fn unit(&self) -> &'static str {
        match self.mode {
            Mode::Position => self.units().place,
            Mode::Velocity => self.units().rate,
            Mode::Torque => self.units().effort,
            Mode::Current => "A",
            Mode::Voltage => "V",
        }
    }

    /// Its law and that law's constants.
    pub(super) fn law(
        &self,
        table: &Table<'_>,
        inputs: &OtherInputs,
    ) -> Result<(&'static str, Constants), SceneError> {
        let mut constants = Constants::default();
        let has_rotor = table.has("rotor");
        if !has_rotor && table.has("friction") {
            let help = "it is that of the motor's shaft: give its inertia as `rotor`, or use the \
                `friction` of the joint";
            return Err(table.refuse_key("friction", "requires a `rotor`", help));
        }
        for (key, why) in [("ratio", "ratio"), ("gear", "gear")] {
            if !has_rotor && table.has(key) && !(key == "ratio" && self.mode.is_wound()) {
                let help = format!(
                    "give the inertia of the motor as `rotor`: a {why} connects it to the joint"
                );
                return Err(table.refuse_key(key, "requires a `rotor`", &help));
            }
        }
        let ratio = self.ratio(table, has_rotor)?;
        self.compatible(table)?;
        if has_axes(table)? {
            self.axes(table, (ratio, inputs), &mut constants)?;
            self.rotor(table, ratio, &mut constants)?;
            self.friction(table, ratio, &mut constants)?;
            return Ok(("hinge-drive-dq", constants));
        }
        if table.has("d_input") {
            let help =
                "remove it: only a winding with `inductance_d` and `inductance_q` has a voltage d";
            return Err(table.refuse_key("d_input", "is not compatible with this `winding`", help));
        }
        self.effort(table, ratio, has_rotor, &mut constants)?;
        if has_rotor {
            self.rotor(table, ratio, &mut constants)?;
        }
        let rubs = self.friction(table, ratio, &mut constants)?;
        let law = match (self.turns, has_rotor) {
            (true, true) if rubs => "hinge-drive-friction",
            (true, true) => "hinge-drive",
            (true, false) => "hinge-servo",
            (false, true) if rubs => "slide-drive-friction",
            (false, true) => "slide-drive",
            (false, false) => "slide-servo",
        };
        Ok((law, constants))
    }

    /// Rotation of the rotor per rotation of the joint, or \[rad/m\] per translation; 1 by default.
    fn ratio(&self, table: &Table<'_>, has_rotor: bool) -> Result<f64, SceneError> {
        let unit = if self.turns { "" } else { "rad/m" };
        let given = table.optional("ratio", Number::any(unit))?;
        if given == Some(0.0) {
            return Err(table.refuse_value(
                "ratio",
                "is 0",
                "give the rotation of the rotor per motion of the joint",
            ));
        }
        if given.is_none() && !self.turns && has_rotor && self.mode.is_wound() {
            let help = "give the rotation of the rotor per travel as `ratio` in rad/m";
            return Err(table.refuse_key("winding", "requires a `ratio`", help));
        }
        Ok(given.unwrap_or(1.0))
    }

    /// Rejects keys of other modes.
    fn compatible(&self, table: &Table<'_>) -> Result<(), SceneError> {
        let own = match self.mode {
            Mode::Position => &["kp", "kd", "lag"][..],
            Mode::Velocity => &["kd", "lag"],
            Mode::Torque => &["lag"],
            Mode::Current => &["winding", "lag"],
            Mode::Voltage => &["winding"],
        };
        for key in ["kp", "kd", "lag", "winding"] {
            if table.has(key) && !own.contains(&key) {
                let help = match key {
                    "kp" => "`kp` is the stiffness of the mode \"position\"",
                    "kd" => "`kd` is the damping of the modes \"position\" and \"velocity\"",
                    "lag" => {
                        "in the mode \"voltage\" the `inductance` of the winding determines the lag"
                    }
                    _ => "`winding` belongs to the modes \"voltage\" and \"current\"",
                };
                return Err(table.refuse_key(key, "is not compatible with this `mode`", help));
            }
        }
        Ok(())
    }

    /// A winding in rotor axes.
    fn axes(
        &self,
        table: &Table<'_>,
        (ratio, inputs): (f64, &OtherInputs),
        constants: &mut Constants,
    ) -> Result<(), SceneError> {
        if !self.turns {
            let help = "use a winding with a `constant`: one in rotor axes drives a rotation";
            return Err(table.refuse_key("winding", "is in rotor axes", help));
        }
        if table.has("most") {
            let help =
                "give `most_current` of the winding, which limits the amplitude of both currents";
            return Err(table.refuse_key("most", "is not compatible with rotor axes", help));
        }
        if !table.has("rotor") {
            return Err(table.missing("rotor", "the inertia of the motor's rotor in kg·m²"));
        }
        table.required("winding", AxesWinding(self.mode))?.add_to(ratio, constants);
        let d_input = table.optional("d_input", InputName(&inputs.names))?;
        if let Some(row) = d_input
            && inputs.types.get(row as usize).map(String::as_str) != Some("signal")
        {
            let help =
                "name an input of the type \"signal\", the voltage d in V or the current d in A";
            return Err(table.refuse_value("d_input", "is not of the type \"signal\"", help));
        }
        // No input has the other index: 0.
        constants.add("d_input", d_input.map_or(u16::MAX.into(), f64::from));
        let lag = table.optional("lag", Number::not_negative("s"))?;
        constants.add("lag", lag.unwrap_or(0.0));
        Ok(())
    }

    /// Control law and effort limit.
    fn effort(
        &self,
        table: &Table<'_>,
        ratio: f64,
        has_rotor: bool,
        constants: &mut Constants,
    ) -> Result<(), SceneError> {
        let units = self.units();
        let mut most = table.optional("most", Number::positive(units.effort))?;
        let mut lag = table.optional("lag", Number::not_negative("s"))?.unwrap_or(0.0);
        if self.mode.is_servo() {
            constants.add("servo_damping", table.required("kd", Number::positive(units.damping))?);
        }
        match self.mode {
            Mode::Position => {
                let stiffness = table.required("kp", Number::not_negative(units.stiffness))?;
                constants.add("servo_stiffness", stiffness);
            }
            Mode::Velocity => constants.add("feed", 1.0),
            Mode::Torque => constants.add("gain", 1.0),
            Mode::Current | Mode::Voltage => {
                let winding = table.required("winding", Winding(self.mode))?;
                let constant = winding.constant * ratio;
                let bound = winding.most_current.map(|current| current * constant.abs());
                most = [most, bound].into_iter().flatten().reduce(f64::min);
                if self.mode == Mode::Current {
                    constants.add("gain", constant);
                } else {
                    constants.add("servo_damping", constant * constant / winding.resistance);
                    constants.add("feed", 1.0 / constant);
                    lag = winding.inductance / winding.resistance;
                }
            }
        }
        if !has_rotor {
            if matches!(self.mode, Mode::Torque | Mode::Current) {
                let help = format!(
                    "the inertia of the motor's rotor in {}; without a rotor use an input of the type \"{}\"",
                    if self.turns {
                        "kg·m²"
                    } else {
                        "kg, or in kg·m² with a `ratio` in rad/m"
                    },
                    if self.turns { "joint_torque" } else { "joint_force" },
                );
                return Err(table.missing("rotor", &help));
            }
            if lag > 0.0 {
                let key = if table.has("lag") { "lag" } else { "winding" };
                let help = "add a `rotor` with a `gear`, on which a lagging effort acts";
                return Err(table.refuse_key(key, "causes a lag, which requires a `rotor`", help));
            }
        } else {
            constants.add("lag", lag);
        }
        if let Some(most) = most {
            constants.add("most", most);
        }
        Ok(())
    }

    /// Rotor and gear.
    fn rotor(
        &self,
        table: &Table<'_>,
        ratio: f64,
        constants: &mut Constants,
    ) -> Result<(), SceneError> {
        let units = self.units();
        let turns = self.turns || table.has("ratio");
        let inertia =
            table.required("rotor", Number::positive(if turns { "kg·m²" } else { "kg" }))?;
        constants.add("inertia", inertia * (ratio * ratio));
        let expected = format!(
            "{{ stiffness = … }} in {} at its output; a rotor behind a rigid gear would couple the joints of a chain",
            units.stiffness
        );
        let Some(value) = table.value("gear") else { return Err(table.missing("gear", &expected)) };
        let gear = value.table(&expected)?;
        gear.only(&[GEAR])?;
        constants.add("stiffness", gear.required("stiffness", Number::positive(units.stiffness))?);
        let damping = gear.optional("damping", Number::not_negative(units.damping))?;
        constants.add("damping", damping.unwrap_or(0.0));
        let play = gear.optional("play", Number::not_negative(units.place))?;
        constants.add("play", play.unwrap_or(0.0));
        Ok(())
    }
}

impl Driven<'_> {
    /// Friction of the rotor at its shaft; whether it has any.
    fn friction(
        &self,
        table: &Table<'_>,
        ratio: f64,
        constants: &mut Constants,
    ) -> Result<bool, SceneError> {
        let Some(value) = table.value("friction") else { return Ok(false) };
        let shaft = if self.turns || table.has("ratio") { &TURN } else { &TRAVEL };
        let friction = value.table("{ coulomb = …, viscous = … } of the motor's shaft")?;
        friction.only(&[SHAFT_FRICTION])?;
        let read = |key: &str, unit| {
            Ok(friction.optional(key, Number::not_negative(unit))?.unwrap_or(0.0))
        };
        let coulomb: f64 = read("coulomb", shaft.effort)? * ratio.abs();
        let viscous: f64 = read("viscous", shaft.damping)? * (ratio * ratio);
        constants.add("coulomb", coulomb);
        constants.add("viscous", viscous);
        Ok(coulomb > 0.0 || viscous > 0.0)
    }
}
