//! Why a text is no value.

use std::ops::Range;

/// What is wrong with a text that should be a value, where, and what would be right.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{message}")]
pub struct Fault {
    /// Bytes of the text.
    pub place: Range<usize>,
    /// What is wrong.
    pub message: String,
    /// What would be right.
    pub help: String,
    /// Whether it is a number beyond what an f64 holds.
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
        let help = "a value is below 1.8e308 in SI units";
        Self { is_too_large: true, ..Self::new(place, "a value is too large", help) }
    }
}
