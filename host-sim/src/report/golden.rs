//! What a comparison with a golden run came to, in the summary and in words.

use miette::Diagnostic;
use serde::Serialize;
use thiserror::Error;

/// A run that is not the golden one.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("{words}")]
pub struct NotGolden {
    /// What differs, where and how far.
    pub words: String,
    /// What to do about it.
    pub help: Option<String>,
}

impl Diagnostic for NotGolden {
    fn help<'a>(&'a self) -> Option<Box<dyn std::fmt::Display + 'a>> {
        self.help.as_ref().map(|help| Box::new(help) as Box<dyn std::fmt::Display>)
    }
}

/// What became of the comparison, as the summary has it.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct GoldenOutcome {
    /// The golden file.
    pub file: String,
    /// `equal`, `within` (its bands), `blessed` or `different`.
    pub verdict: &'static str,
    /// The same in words.
    pub words: String,
    /// What is wrong, where it is different.
    #[serde(skip)]
    pub failure: Option<NotGolden>,
}
