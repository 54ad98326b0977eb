//! Errors of a sweep's file: file, line, column, problem, remedy.

use std::io;
use std::ops::Range;
use std::sync::Arc;

use miette::{Diagnostic, NamedSource, SourceSpan};
use thiserror::Error;

/// A sweep's file that cannot be read, or that is invalid.
#[derive(Debug, Error, Diagnostic)]
pub enum SpecError {
    /// The file cannot be read.
    // The reason is part of the message; a source would repeat it.
    #[error("cannot read {file}: {reason}")]
    #[diagnostic(help("give a readable TOML file in UTF-8"))]
    Unreadable {
        /// Its name.
        file: String,
        /// Why.
        reason: io::Error,
    },
    /// It is invalid.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Refused(#[from] Box<Refusal>),
}

/// Problem of a sweep's file, and its position.
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
    /// Its name in messages.
    pub file: String,
    /// Its text.
    pub text: Arc<str>,
}

impl Source {
    /// The error at the bytes `span`.
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

    /// The text at a position.
    #[must_use]
    pub fn written(&self, span: Range<usize>) -> &str {
        self.text.get(span).unwrap_or_default()
    }
}
