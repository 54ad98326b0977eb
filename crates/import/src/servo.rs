//! Actuators whose force is linear in control, coordinate and rate.
//!
//! `shortcuts of classes and element => gear·(gain·u + b0 + b1·gear·q + b2·gear·q')`, as in MuJoCo's compiler: each
//! shortcut writes into the same gains and biases, those of classes first.

use crate::coordinate::Law;
use crate::defaults::{Attributes, Defaults, MAIN};
use crate::error::Fault;

/// Supported shortcuts.
const READ: &[&str] = &["motor", "position", "velocity", "general"];
/// Shortcuts with one control each.
const ONE_CONTROL: &[&str] = &[
    "motor",
    "position",
    "velocity",
    "general",
    "intvelocity",
    "damper",
    "cylinder",
    "muscle",
    "adhesion",
];

/// The law of an actuator.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Servo {
    gains: Vec<f64>,
    biases: Vec<f64>,
    gain_type: String,
    bias_type: String,
    dynamics: String,
    gear: f64,
    /// The form written last.
    form: String,
}

/// Whether an actuator has exactly one control, so that later controls can be indexed.
pub(crate) fn has_one_control(name: &str) -> bool {
    ONE_CONTROL.contains(&name)
}

impl Servo {
    /// Reads an actuator; `Err`: why its force is not linear.
    pub(crate) fn read(
        given: &Attributes<'_>,
        defaults: &Defaults,
    ) -> Result<Result<Self, String>, Fault> {
        let element = given.element;
        if !READ.contains(&element.name.as_str()) {
            let why = match element.name.as_str() {
                "intvelocity" => {
                    "integrates its control: integrate in the caller and drive a <position>"
                }
                "damper" => "multiplies its control by a rate: give a fixed damping at the joint",
                _ => "is not linear in its control, coordinate and rate",
            };
            return Ok(Err(why.to_owned()));
        }
        let mut servo = Self::with_gear(given.numbers("gear", 1, 6)?.map_or(1.0, |gear| gear[0]));
        for one in defaults.shortcuts(element.text("class").unwrap_or(MAIN)) {
            servo.write(&Attributes::own(one))?;
        }
        servo.write(&Attributes::own(element))?;
        Ok(match servo.lack() {
            Some(why) => Err(why),
            None => Ok(servo),
        })
    }

    /// A motor.
    fn with_gear(gear: f64) -> Self {
        Self {
            gains: vec![1.0, 0.0, 0.0],
            biases: vec![0.0; 3],
            gain_type: "fixed".into(),
            bias_type: "none".into(),
            dynamics: "none".into(),
            gear,
            form: "general".into(),
        }
    }

    /// Applies the attributes of an actuator element. A form other than that of the defaults starts from MuJoCo's
    /// default values, except `general`.
    fn write(&mut self, given: &Attributes<'_>) -> Result<(), Fault> {
        let form = given.element.name.as_str();
        if form != "general" && self.form != "general" && self.form != form {
            *self = Self::with_gear(self.gear);
        }
        form.clone_into(&mut self.form);
        if form != "general" {
            self.gain_type = "fixed".into();
            self.bias_type = if form == "motor" { "none" } else { "affine" }.into();
        }
        match form {
            "motor" => {
                (self.gains, self.biases) = (vec![1.0, 0.0, 0.0], vec![0.0; 3]);
                self.dynamics = "none".into();
            }
            "position" => {
                self.gains[0] = given.magnitude("kp", self.gains[0])?;
                (self.biases[0], self.biases[1]) = (0.0, -self.gains[0]);
                match (given.number("kv")?, given.number("dampratio")?) {
                    (Some(_), Some(_)) => {
                        let place = given.place("dampratio");
                        return Err(Fault::at(
                            place,
                            "`kv` conflicts with `dampratio`",
                            "give only one of them",
                        ));
                    }
                    (Some(_), None) => self.biases[2] = -given.magnitude("kv", 0.0)?,
                    (None, Some(_)) => self.biases[2] = given.magnitude("dampratio", 0.0)?,
                    (None, None) => {}
                }
                if given.number("timeconst")?.is_some() {
                    let filters = given.magnitude("timeconst", 0.0)? > 0.0;
                    self.dynamics = if filters { "filterexact" } else { "none" }.into();
                }
            }
            "velocity" => {
                self.gains[0] = given.magnitude("kv", self.gains[0])?;
                self.biases = vec![0.0, 0.0, -self.gains[0]];
                self.dynamics = "none".into();
            }
            "general" => {
                for (name, kept) in [("gainprm", &mut self.gains), ("biasprm", &mut self.biases)] {
                    for (i, value) in
                        given.numbers(name, 1, 20)?.unwrap_or_default().iter().enumerate()
                    {
                        if kept.len() <= i {
                            kept.resize(i + 1, 0.0);
                        }
                        kept[i] = *value;
                    }
                }
                let word = |name: &str, kept: &mut String| {
                    given.text(name).into_iter().for_each(|text| *kept = text.to_owned());
                };
                word("gaintype", &mut self.gain_type);
                word("biastype", &mut self.bias_type);
                word("dyntype", &mut self.dynamics);
            }
            _ => {}
        }
        Ok(())
    }

    /// Why its law is not linear.
    fn lack(&self) -> Option<String> {
        let affine = self.gain_type == "affine" && self.gains[1..].iter().all(|gain| *gain == 0.0);
        if self.dynamics != "none" {
            return Some(format!(
                "has an internal state, dyntype {}: filter in the caller",
                self.dynamics
            ));
        }
        if self.gain_type != "fixed" && !affine {
            return Some(format!("has a gain that is not constant, gaintype {}", self.gain_type));
        }
        match self.bias_type.as_str() {
            "none" => None,
            "affine" if self.biases[1] > 0.0 => Some("has a negative stiffness".into()),
            "affine" if self.biases[2] > 0.0 && self.gains[0] != -self.biases[1] => {
                Some("has a negative damping".into())
            }
            "affine" => None,
            other => Some(format!("has a nonlinear bias, biastype {other}")),
        }
    }

    /// Its gear.
    pub(crate) fn gear(&self) -> f64 {
        self.gear
    }

    /// \[N·m, N\] force per unit of control.
    pub(crate) fn per_control(&self) -> f64 {
        self.gear * self.gains[0]
    }

    /// Its law without control. `start`: initial coordinate; `inertia`: driven inertia, if known, for a damping ratio.
    pub(crate) fn law(&self, start: f64, inertia: Option<f64>) -> Option<Law> {
        if self.bias_type == "none" {
            return Some(Law::default());
        }
        let (g, stiffness) = (self.gear, -self.biases[1]);
        let damping = match self.biases[2] {
            ratio if ratio > 0.0 => 2.0 * ratio * (stiffness * inertia? / (g * g)).sqrt(),
            rate => -rate,
        };
        Some(Law {
            stiffness: g * g * stiffness,
            damping: g * g * damping,
            rest: 0.0 - start,
            bias: g * self.biases[0],
        })
    }
}
