//! What is probably not meant in a scene that is nevertheless right.
//!
//! `scene => warnings`, in the order parameters, angles, bodies, joints and raw elements, torsion springs, interactions, frequencies, inputs,
//! read-outs. They stop nothing: what cannot be run is refused when the scene is read. Every threshold is a constant
//! beside its reason.

mod angles;
mod bodies;
mod elements;
mod frequencies;
mod inputs;
mod interactions;
mod locked;
mod parameters;
mod reach;
mod readouts;
mod springs;
mod torsion_springs;

pub use springs::OneSided;

use std::fmt;

use crate::{Facts, Scene};

/// How much a warning weighs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Severity {
    /// Good to know; often meant.
    Note,
    /// Probably a mistake.
    Warning,
}

/// Something that is probably not meant, or good to know.
#[derive(Clone, Debug, PartialEq)]
pub struct Warning {
    /// How much it weighs.
    pub severity: Severity,
    /// What it is about, as messages call it: ``joint `wrist` ``.
    pub name: String,
    /// The line, from 1, on which that begins in the scene file.
    pub line: Option<usize>,
    /// What is odd about it.
    pub text: String,
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.line {
            Some(line) => write!(f, "{} (line {line}): {}", self.name, self.text),
            None => write!(f, "{}: {}", self.name, self.text),
        }
    }
}

impl Scene {
    /// What is probably not meant.
    #[must_use]
    pub fn warnings(&self) -> Vec<Warning> {
        self.warnings_with(&self.facts())
    }

    /// What is probably not meant, where the scene's [facts](Self::facts) are at hand.
    #[must_use]
    pub fn warnings_with(&self, facts: &Facts) -> Vec<Warning> {
        let mut warnings = Vec::new();
        parameters::judge(self, &mut warnings);
        angles::judge(self, &mut warnings);
        bodies::judge(self, facts, &mut warnings);
        locked::judge(self, facts, &mut warnings);
        elements::judge(self, &mut warnings);
        springs::judge(self, facts, &mut warnings);
        reach::judge(self, &mut warnings);
        torsion_springs::judge(self, &mut warnings);
        interactions::judge(self, &mut warnings);
        frequencies::judge(self, facts, &mut warnings);
        inputs::judge(self, facts, &mut warnings);
        readouts::judge(self, &mut warnings);
        warnings
    }
}

/// A number with three digits.
fn short(value: f64) -> String {
    if (1e-2..1e4).contains(&value.abs()) || value == 0.0 {
        let digits = if value.abs() < 1.0 { 4 } else { 2 };
        let text = format!("{value:.digits$}");
        let text = text.trim_end_matches('0').trim_end_matches('.');
        return text.to_owned();
    }
    let text = format!("{value:.2e}");
    let (digits, exponent) = text.split_once('e').unwrap_or((&text, "0"));
    format!("{}e{exponent}", digits.trim_end_matches('0').trim_end_matches('.'))
}
