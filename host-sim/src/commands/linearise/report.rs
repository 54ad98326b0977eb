//! A linear system with names, units and poles, and what people read of it.
//!
//! `(instance, linear system) => report => rows`.

use std::f64::consts::TAU;

use dbd_plant::digits::significant;
use dbd_plant::instance::{Instance, InstanceError, Linear};
use dbd_plant::time::display;
use serde::Serialize;

use crate::report::SetValue;
use crate::terminal::{Found, Look};

/// Largest number of poles in the text; the files contain all.
const MAX_POLES: usize = 24;

/// A state, an input or an output.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Quantity {
    /// Its name.
    pub name: String,
    /// Its SI unit; empty for a plain number.
    pub unit: String,
}

/// An eigenvalue of A.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Pole {
    /// \[rad/s\] the real part.
    pub re: f64,
    /// \[rad/s\] the imaginary part.
    pub im: f64,
}

/// A scene as a linear system.
#[derive(Clone, Debug, PartialEq)]
pub struct LinearReport {
    /// The scene's name.
    pub scene: String,
    /// Where its text comes from, and the text's hash.
    pub source: [String; 2],
    /// Values that were changed.
    pub set: Vec<SetValue>,
    /// \[s\] the time.
    pub time: f64,
    /// The matrices.
    pub linear: Linear,
    /// Whether the system is reduced to its slow motions.
    pub is_reduced: bool,
    /// The states.
    pub states: Vec<Quantity>,
    /// The inputs.
    pub inputs: Vec<Quantity>,
    /// The outputs.
    pub outputs: Vec<Quantity>,
    /// The poles in ascending order of their moduli.
    pub poles: Vec<Pole>,
}

/// The unit of a rate.
fn per_second(unit: &str) -> String {
    match unit {
        "" => "1/s".to_owned(),
        unit => unit.strip_suffix("/s").map_or(format!("{unit}/s"), |unit| format!("{unit}/s²")),
    }
}

impl LinearReport {
    /// The report of an instance's linear system.
    ///
    /// # Errors
    /// [`InstanceError::Linearisation`] where the poles cannot be computed.
    pub fn of(
        found: &Found,
        instance: &Instance,
        linear: Linear,
        is_reduced: bool,
    ) -> Result<Self, InstanceError> {
        let output = |name: &String| {
            let known = instance.outputs().iter().find(|output| output.name == *name);
            known.map_or("", |output| output.unit).to_owned()
        };
        let input = |name: &String| {
            let known = instance.inputs().iter().find(|input| input.name == *name);
            known.map_or("", |input| input.unit).to_owned()
        };
        // Per body three shifts and three rotations; the second half are their rates.
        let of_body = |row: usize| match (2 * row < linear.states.len(), row % 6 < 3) {
            (true, true) => "m",
            (true, false) => "rad",
            (false, true) => "m/s",
            (false, false) => "rad/s",
        };
        let quantity = |name: &String, unit: String| Quantity { name: name.clone(), unit };
        let states = linear.states.iter().enumerate().map(|(row, name)| {
            quantity(name, if is_reduced { output(name) } else { of_body(row).to_owned() })
        });
        let poles = linear.poles()?;
        Ok(Self {
            scene: found.scene.name.clone(),
            source: [found.file.place.clone(), found.file.hash.clone()],
            set: SetValue::of(&found.scene),
            time: instance.time(),
            is_reduced,
            states: states.collect(),
            inputs: linear.inputs.iter().map(|name| quantity(name, input(name))).collect(),
            outputs: linear.outputs.iter().map(|name| quantity(name, output(name))).collect(),
            poles: poles.iter().map(|pole| Pole { re: pole.re, im: pole.im }).collect(),
            linear,
        })
    }

    /// The report for people.
    #[must_use]
    pub fn text(&self, look: Look) -> String {
        let list = |all: &[Quantity]| {
            let with_unit = |Quantity { name, unit }: &Quantity| match unit.as_str() {
                "" => name.clone(),
                unit => format!("{name} [{unit}]"),
            };
            let all: Vec<String> = all.iter().map(with_unit).collect();
            if all.is_empty() { "none".to_owned() } else { all.join(", ") }
        };
        let states = if self.is_reduced {
            list(&self.states)
        } else {
            let count = self.states.len();
            format!(
                "{count}, twelve coordinates per body; reduce to the slow motions with --states and output names"
            )
        };
        let left_out = match self.linear.slowest_left_out {
            speed if speed.is_finite() => format!(
                "motions from {} rad/s ({} Hz)",
                significant(speed, 5),
                significant(speed / TAU, 5)
            ),
            _ => "nothing".to_owned(),
        };
        let rows = [
            ("scene", format!("{} at {}", self.scene, display(self.time))),
            ("states", states),
            ("inputs", list(&self.inputs)),
            ("outputs", list(&self.outputs)),
            ("drift", self.drift()),
            ("left out", left_out),
        ];
        format!("{}\n{}", look.table(&rows), self.pole_table(look))
    }

    /// The rate of each state, of many the largest.
    fn drift(&self) -> String {
        let rate = |(state, rate): (&Quantity, &f64)| {
            format!("{} {} of {}", significant(*rate, 4), per_second(&state.unit), state.name)
        };
        let all = self.states.iter().zip(self.linear.drift.iter());
        if self.is_reduced {
            return all.map(rate).collect::<Vec<_>>().join(", ");
        }
        let largest = all.max_by(|(_, a), (_, b)| a.abs().total_cmp(&b.abs()));
        largest.map_or_else(|| "none".to_owned(), |found| format!("at most {}", rate(found)))
    }

    fn pole_table(&self, look: Look) -> String {
        // Of a pair the one with the positive imaginary part.
        let shown: Vec<&Pole> = self.poles.iter().filter(|pole| pole.im >= 0.0).collect();
        let line = |pole: &&Pole| {
            let speed = pole.re.hypot(pole.im);
            let value = match pole.im {
                // Without the sign of a zero.
                0.0 => significant(pole.re + 0.0, 5),
                im => format!("{} ± {}i", significant(pole.re, 5), significant(im, 5)),
            };
            let damping = if speed > 0.0 { significant(-pole.re / speed, 3) } else { "–".into() };
            [value, significant(speed, 5), significant(speed / TAU, 5), damping]
        };
        let lines: Vec<_> = shown.iter().take(MAX_POLES).map(line).collect();
        let head = ["poles [rad/s]", "modulus [rad/s]", "[Hz]", "damping ratio"];
        let more = shown.len().saturating_sub(MAX_POLES);
        let rest = match more {
            0 => String::new(),
            _ => look.sentence(&format!("and {more} faster ones; --out writes all of them")),
        };
        look.columns(Some(head), &lines) + &rest
    }
}
