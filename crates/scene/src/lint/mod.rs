//! Warnings about a valid scene.
//!
//! `scene => warnings`, in the order parameters, angles, bodies, joints and raw elements, torsion springs, interactions, frequencies, inputs,
//! read-outs. Warnings never stop a run; invalid scenes are refused when they are read. Every threshold is a constant
//! with its reason.

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
mod warning;

pub use springs::{OneSided, one_sided_springs};
pub use warning::{Severity, Warning};

use crate::facts::{Facts, facts};
use crate::scene::Scene;

/// The warnings about a scene.
#[must_use]
pub fn warnings(scene: &Scene) -> Vec<Warning> {
    warnings_with(scene, &facts(scene))
}

/// The warnings about a scene whose [facts](crate::facts()) are known.
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
