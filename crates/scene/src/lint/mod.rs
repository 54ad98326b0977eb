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

pub use springs::{OneSided, one_sided_springs};

use std::fmt;

use crate::facts::Facts;
use crate::scene::Scene;

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

/// What is probably not meant.
#[must_use]
pub fn warnings(scene: &Scene) -> Vec<Warning> {
    crate::lint::warnings_with(scene, &crate::facts::facts(scene))
}

/// What is probably not meant, where the scene's [facts](Self::facts) are at hand.
#[must_use]
pub fn warnings_with(scene: &Scene, facts: &Facts) -> Vec<Warning> {
    let mut warnings = Vec::new();
    parameters::judge(scene, &mut warnings);
    angles::judge(scene, &mut warnings);
    bodies::judge(scene, facts, &mut warnings);
    locked::judge(scene, facts, &mut warnings);
    elements::judge(scene, &mut warnings);
    springs::judge(scene, facts, &mut warnings);
    reach::judge(scene, &mut warnings);
    torsion_springs::judge(scene, &mut warnings);
    interactions::judge(scene, &mut warnings);
    frequencies::judge(scene, facts, &mut warnings);
    inputs::judge(scene, facts, &mut warnings);
    readouts::judge(scene, &mut warnings);
    warnings
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
