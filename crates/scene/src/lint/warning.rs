//! A warning, and the formatting of its numbers.

use std::fmt;

/// Severity of a warning.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Severity {
    /// Information; often intended.
    Note,
    /// Probably a mistake.
    Warning,
}

/// A probable mistake, or information.
#[derive(Clone, Debug, PartialEq)]
pub struct Warning {
    /// Its severity.
    pub severity: Severity,
    /// Its subject: ``joint `wrist` ``.
    pub name: String,
    /// The line of the subject in the scene file, from 1.
    pub line: Option<usize>,
    /// The text of the warning.
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

/// A number with three significant digits.
pub(super) fn short(value: f64) -> String {
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
