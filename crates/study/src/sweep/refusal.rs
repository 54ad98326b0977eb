//! Why a sweep is refused: file, line, column, what is wrong, what would be right.

use std::io;
use std::ops::Range;
use std::sync::Arc;

use miette::{Diagnostic, NamedSource, SourceSpan};
use thiserror::Error;

/// A sweep's file that cannot be read, or that is refused.
#[derive(Debug, Error, Diagnostic)]
pub enum SpecError {
    /// The file cannot be read.
    // The reason is part of the message and therefore not a source, which would say it twice.
    #[error("cannot read {file}: {reason}")]
    #[diagnostic(help("a sweep is a readable TOML file in UTF-8"))]
    Unreadable {
        /// Its name.
        file: String,
        /// Why.
        reason: io::Error,
    },
    /// It is refused.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Refused(#[from] Box<Refusal>),
}

/// What is wrong with a sweep's file, and where.
#[derive(Debug, Error, Diagnostic)]
#[error("{message}")]
#[diagnostic(help("{help}"))]
pub struct Refusal {
    #[source_code]
    text: NamedSource<String>,
    #[label("here")]
    span: SourceSpan,
    message: String,
    help: String,
}

/// A sweep's file: its name and its text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Source {
    /// What messages call it.
    pub file: String,
    /// Its text.
    pub text: Arc<str>,
}

impl Source {
    /// Refuses the bytes `span`.
    #[must_use]
    pub fn refuse(
        &self,
        span: Range<usize>,
        message: impl Into<String>,
        help: impl Into<String>,
    ) -> Box<Refusal> {
        Box::new(Refusal {
            text: NamedSource::new(&self.file, self.text.to_string()).with_language("TOML"),
            span: span.into(),
            message: message.into(),
            help: help.into(),
        })
    }

    /// The text of a place.
    #[must_use]
    pub fn written(&self, span: Range<usize>) -> &str {
        self.text.get(span).unwrap_or_default()
    }
}
