//! Steps, ratios, costs and steppers as people read them.

use std::fmt;

use dbd_plant::digits::{approximate, significant};
use dbd_plant::time::{display, rounded};

use crate::point::{Machine, Stepper};

/// A step, after ≈ where it is not the exact number.
#[must_use]
pub fn shown(step: f64) -> String {
    let (exact, short) = (display(step), approximate(step));
    if exact == short { exact } else { format!("≈{short}") }
}

/// `leapfrog, f32`, as on the command line.
#[must_use]
pub fn named(stepper: &Stepper) -> String {
    let mut text = stepper.scheme.clone();
    if let Some(newton) = stepper.newton.filter(|newton| *newton > 0) {
        text += &format!(" with {newton} Newton iteration{}", if newton > 1 { "s" } else { "" });
    }
    if let Some(damping) = &stepper.damping {
        text += &format!(" with {damping} damping");
    }
    text += &format!(", {}", stepper.precision);
    if stepper.orientation != "quaternion" {
        text += &format!(", {}", stepper.orientation);
    }
    text
}

/// A ratio with two digits.
#[must_use]
pub fn times(ratio: f64) -> String {
    significant(rounded(ratio, 2), 2)
}

/// A fraction in per cent.
#[must_use]
pub fn percent(share: f64) -> String {
    format!("{} %", significant(100.0 * share, 2))
}

/// A cost with its unit.
pub struct Cost(pub f64, pub Machine);

impl fmt::Display for Cost {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.1 {
            Machine::Host => {
                let seconds = significant(rounded(self.0, 2), 2);
                write!(f, "{seconds} s of a core per simulated second")
            }
            Machine::Target => {
                let millions = significant(rounded(self.0 * 1e-6, 3), 3);
                write!(f, "{millions} million instructions per simulated second")
            }
        }
    }
}

/// A sentence with a capital letter.
#[must_use]
pub fn capital(sentence: &str) -> String {
    let mut letters = sentence.chars();
    letters.next().map(char::to_uppercase).into_iter().flatten().chain(letters).collect()
}
