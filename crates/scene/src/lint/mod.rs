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
    parameters::check(scene, &mut warnings);
    angles::check(scene, &mut warnings);
    bodies::check(scene, facts, &mut warnings);
    locked::check(scene, facts, &mut warnings);
    elements::check(scene, &mut warnings);
    springs::check(scene, facts, &mut warnings);
    reach::check(scene, &mut warnings);
    torsion_springs::check(scene, &mut warnings);
    interactions::check(scene, &mut warnings);
    frequencies::check(scene, facts, &mut warnings);
    inputs::check(scene, facts, &mut warnings);
    readouts::check(scene, &mut warnings);
    warnings
}
