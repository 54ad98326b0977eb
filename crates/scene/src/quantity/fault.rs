//! Errors of a value's text.

use std::ops::Range;

/// An error of a value's text: position, problem, remedy.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{message}")]
pub struct Fault {
    /// Bytes of the text.
    pub place: Range<usize>,
    /// The problem.
    pub message: String,
    /// The remedy.
    pub help: String,
    /// Whether a number exceeds the range of an f64.
    pub is_too_large: bool,
}

impl Fault {
    pub(super) fn new(
        place: Range<usize>,
        message: impl Into<String>,
        help: impl Into<String>,
    ) -> Self {
        Self { place, message: message.into(), help: help.into(), is_too_large: false }
    }

    pub(super) fn too_large(place: Range<usize>) -> Self {
        let help = "use a value below 1.8e308 in SI units";
        Self { is_too_large: true, ..Self::new(place, "value is too large", help) }
    }
}
