//! A warning, and numbers in its words.

use std::fmt;

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

/// A number with three digits.
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
