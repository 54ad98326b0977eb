//! The result of a comparison with a golden run, in the summary and as text.

use miette::Diagnostic;
use serde::Serialize;
use thiserror::Error;

/// A run that differs from the golden run.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("{words}")]
pub struct NotGolden {
    /// What differs, where and how far.
    pub words: String,
    /// The remedy.
    pub help: Option<String>,
}

impl Diagnostic for NotGolden {
    fn help<'a>(&'a self) -> Option<Box<dyn std::fmt::Display + 'a>> {
        self.help.as_ref().map(|help| Box::new(help) as Box<dyn std::fmt::Display>)
    }
}

/// The result of the comparison in the summary.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct GoldenOutcome {
    /// The golden file.
    pub file: String,
    /// `equal`, `within` (its bands), `blessed` or `different`.
    pub verdict: &'static str,
    /// The same as text.
    pub words: String,
    /// The difference, if there is one.
    #[serde(skip)]
    pub failure: Option<NotGolden>,
}
