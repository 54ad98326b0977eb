//! `[[input]]` of the type `drive`: a motor at a joint, as a law about or along its axis.
//!
//! `(table of an input, joints) => law, its constants, unit of the input`. Quantities at the input of a gear are
//! converted to its output here, in double precision: inertia times the square of the ratio, constant times the
//! ratio.

use crate::error::SceneError;
use crate::joints::JointPlace;
use crate::known::freedom;
use crate::target::Elements;
use crate::text::{Choice, Number, Table};

/// The name of the type.
pub(crate) const TYPE: &str = "drive";

/// The keys of a drive.
pub(crate) const KEYS: &[&str] = &[
    "target", "freedom", "mode", "kp", "kd", "most", "lag", "winding", "rotor", "ratio", "gear",
    "friction",
];

/// The keys of the friction of its rotor.
pub(crate) const SHAFT_FRICTION: &[&str] = &["coulomb", "viscous"];

/// The keys of its gear.
pub(crate) const GEAR: &[&str] = &["stiffness", "damping", "play"];

/// The keys of its winding.
pub(crate) const WINDING: &[&str] = &["resistance", "inductance", "constant", "most_current"];

/// The quantity of its input.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Mode {
    Position,
    Velocity,
    Torque,
    Current,
    Voltage,
}

impl Mode {
    const ALL: [Self; 5] =
        [Self::Position, Self::Velocity, Self::Torque, Self::Current, Self::Voltage];
    const TURN: [&str; 5] = ["position", "velocity", "torque", "current", "voltage"];
    const TRAVEL: [&str; 5] = ["position", "velocity", "force", "current", "voltage"];

    fn is_wound(self) -> bool {
        matches!(self, Self::Current | Self::Voltage)
    }

    fn is_servo(self) -> bool {
        matches!(self, Self::Position | Self::Velocity)
    }
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
    pub(super) fn law(&self, table: &Table<'_>) -> Result<(&'static str, Constants), SceneError> {
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

    /// Control law and effort limit.
    fn effort(
        &self,
        table: &Table<'_>,
        ratio: f64,
        has_rotor: bool,
        constants: &mut Constants,
    ) -> Result<(), SceneError> {
        let units = self.units();
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

/// Constants of a law by field; the others have the defaults of the law.
#[derive(Default)]
pub(super) struct Constants(Vec<(&'static str, f64)>);

impl Constants {
    pub(super) fn add(&mut self, field: &'static str, number: f64) {
        self.0.push((field, number));
    }

    /// The constant of a field.
    pub(super) fn get(&self, field: &str) -> Option<f64> {
        self.0.iter().find(|(known, _)| *known == field).map(|(_, number)| *number)
    }
}

/// The winding of a motor, at its shaft.
struct OfWinding {
    /// \[Ω\]
    resistance: f64,
    /// \[H\]
    inductance: f64,
    /// \[N·m/A, V·s\]
    constant: f64,
    /// \[A\]
    most_current: Option<f64>,
}

struct Winding(Mode);

impl crate::text::Kind for Winding {
    type Output = OfWinding;

    fn expected(&self) -> String {
        "{ resistance = …, inductance = …, constant = … } in ohm, H and N·m/A".into()
    }

    fn read(&self, value: &crate::text::Value<'_>) -> Result<OfWinding, SceneError> {
        let table = value.table(&self.expected())?;
        table.only(&[WINDING])?;
        let constant = table.required("constant", Number::any("N·m/A"))?;
        if constant == 0.0 {
            let help = "give the torque at the motor's shaft per current in N·m/A";
            return Err(table.refuse_value("constant", "is 0", help));
        }
        let most_current = table.optional("most_current", Number::positive("A"))?;
        if self.0 == Mode::Current {
            for key in ["resistance", "inductance"] {
                if table.has(key) {
                    let help =
                        "remove it: only in the mode \"voltage\" does the current depend on it";
                    return Err(table.refuse_key(
                        key,
                        "has no effect in the mode \"current\"",
                        help,
                    ));
                }
            }
            return Ok(OfWinding { resistance: 0.0, inductance: 0.0, constant, most_current });
        }
        Ok(OfWinding {
            resistance: table.required("resistance", Number::positive("ohm"))?,
            inductance: table.optional("inductance", Number::not_negative("H"))?.unwrap_or(0.0),
            constant,
            most_current,
        })
    }
}
