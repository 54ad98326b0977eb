//! Actuators whose force is linear in control, coordinate and rate.
//!
//! `shortcuts of classes and element => gear·(gain·u + b0 + b1·gear·q + b2·gear·q')`, as MuJoCo's compiler
//! makes it: each shortcut writes into the same gains and biases, those of classes first.

use crate::coordinate::Law;
use crate::defaults::{Attributes, Defaults, MAIN};
use crate::error::Fault;

/// Shortcuts that are read.
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

/// What an actuator does.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Servo {
    gains: Vec<f64>,
    biases: Vec<f64>,
    gain_type: String,
    bias_type: String,
    dynamics: String,
    gear: f64,
    /// The form that was written last.
    form: String,
}

/// Whether an actuator has one control, so that those after it can be counted.
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
                    "integrates its control: a caller that sums it up drives a <position>"
                }
                "damper" => {
                    "multiplies its control with a rate: a stated damping is one of the joint"
                }
                _ => "is no linear law of its control, its coordinate and its rate",
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

    /// Takes the attributes of an actuator element. A form other than that of the defaults begins from MuJoCo's own
    /// values, but for `general`.
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
                            "`kv` stands beside `dampratio`",
                            "one of them",
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

    /// Why it is no linear law.
    fn lack(&self) -> Option<String> {
        let affine = self.gain_type == "affine" && self.gains[1..].iter().all(|gain| *gain == 0.0);
        if self.dynamics != "none" {
            return Some(format!(
                "has a state of its own, dyntype {}: a caller filters",
                self.dynamics
            ));
        }
        if self.gain_type != "fixed" && !affine {
            return Some(format!("has a gain that is not constant, gaintype {}", self.gain_type));
        }
        match self.bias_type.as_str() {
            "none" => None,
            "affine" if self.biases[1] > 0.0 => Some("pushes away from where it is".into()),
            "affine" if self.biases[2] > 0.0 && self.gains[0] != -self.biases[1] => {
                Some("pushes the faster it goes".into())
            }
            "affine" => None,
            other => Some(format!("has a bias that is not linear, biastype {other}")),
        }
    }

    /// Its gear.
    pub(crate) fn gear(&self) -> f64 {
        self.gear
    }

    /// \[N·m, N\] its force for a control of 1.
    pub(crate) fn per_control(&self) -> f64 {
        self.gear * self.gains[0]
    }

    /// Its law without control. `start`: its coordinate there; `inertia`: what it drives, where that is
    /// known, for a damping that is stated as a ratio.
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
