//! An element with a far higher frequency than the others, which alone limits the step size.

use std::f64::consts::TAU;

use crate::facts::Facts;
use crate::lint::warning::{Severity, Warning, short};
use crate::scene::Scene;

/// A stiffness in the wrong unit, N/mm for N/m, or a mass in grams changes a frequency by √1000 = 32.
/// The joints of the scenes that ship lie within 3 of their median.
const FAR_ABOVE: f64 = 20.0;

/// Fewest joints for a meaningful median.
const FEWEST: usize = 3;

pub(super) fn check(scene: &Scene, facts: &Facts, warnings: &mut Vec<Warning>) {
    let (Some(fastest), Some(median)) = (facts.fastest(), facts.median_frequency()) else { return };
    if facts.joints.len() < FEWEST || fastest.frequency < FAR_ABOVE * median {
        return;
    }
    warnings.push(Warning {
        severity: Severity::Warning,
        name: fastest.name.clone(),
        line: scene.line_of_element(fastest.row),
        text: format!(
            "vibrates at {} Hz, {} times the median of the joints, and alone limits the step size; \
             check that its stiffness is in N/m and its bodies' masses in kg",
            short(fastest.frequency / TAU),
            short(fastest.frequency / median),
        ),
    });
}
