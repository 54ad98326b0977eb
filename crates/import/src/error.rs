//! Import errors: file, line, column, problem and remedy.

use std::fmt::{self, Write as _};
use std::io;

use miette::{Diagnostic, LabeledSpan, NamedSource, SourceCode, SourceSpan};
use thiserror::Error;

use crate::omission::{self, Omission};
use crate::place::{Place, Texts};

/// A file cannot be read or is refused.
#[derive(Debug, Error)]
pub enum ImportError {
    /// A file cannot be read.
    // The reason is part of the message; as a source it would be shown twice.
    #[error("cannot read {file}: {reason}")]
    Unreadable {
        /// Its name.
        file: String,
        /// The reason.
        reason: io::Error,
    },
    /// A file is refused.
    #[error("{0}")]
    Refused(Box<Refusal>),
    /// The file contains items without a counterpart.
    #[error("{}", omitted(file, omissions))]
    Omitted {
        /// Its name.
        file: String,
        /// Those items.
        omissions: Vec<Omission>,
    },
}

/// A problem in a file and its position.
#[derive(Debug, Error)]
#[error("{message}")]
pub struct Refusal {
    source_text: NamedSource<String>,
    span: SourceSpan,
    /// From 1.
    pub line: usize,
    /// In characters from 1.
    pub column: usize,
    /// The problem.
    pub message: String,
    /// The remedy.
    pub help: String,
}

fn omitted(file: &str, omissions: &[Omission]) -> String {
    let (count, s) = (omissions.len(), if omissions.len() == 1 { "" } else { "s" });
    let mut text = format!("{file} has {count} item{s} without a counterpart");
    for line in omission::table(omissions).lines() {
        let _ = write!(text, "\n  {line}");
    }
    text
}

impl ImportError {
    /// The remedy.
    #[must_use]
    pub fn help(&self) -> String {
        match self {
            Self::Unreadable { .. } => "expected a readable MJCF or URDF file, XML in UTF-8".into(),
            Self::Refused(refusal) => refusal.help.clone(),
            Self::Omitted { omissions, .. } => {
                let mut kinds: Vec<&str> = omissions.iter().map(|o| o.kind.name()).collect();
                kinds.sort_unstable();
                kinds.dedup();
                let options: Vec<String> =
                    kinds.iter().map(|kind| format!("--ignore {kind}")).collect();
                format!(
                    "use {} to leave them out; the scene then moves without them",
                    options.join(" ")
                )
            }
        }
    }
}

impl Diagnostic for ImportError {
    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        Some(Box::new(ImportError::help(self)))
    }

    fn source_code(&self) -> Option<&dyn SourceCode> {
        match self {
            Self::Refused(refusal) => Some(&refusal.source_text),
            _ => None,
        }
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        let Self::Refused(refusal) = self else { return None };
        let label = LabeledSpan::new_with_span(Some("here".into()), refusal.span);
        Some(Box::new(std::iter::once(label)))
    }
}

/// A problem at a position, before the texts are available.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Fault {
    place: Place,
    message: String,
    help: String,
}

impl Fault {
    /// A problem at a position.
    pub(crate) fn at(place: Place, message: impl Into<String>, help: impl Into<String>) -> Self {
        Self { place, message: message.into(), help: help.into() }
    }

    /// The line of its position.
    pub(crate) fn line(&self) -> usize {
        self.place.line
    }

    /// The refusal with the surrounding text.
    pub(crate) fn refuse(self, texts: &Texts) -> ImportError {
        let (file, text) = texts.file(self.place.file);
        let within =
            |byte: usize| (0..=byte.min(text.len())).rev().find(|b| text.is_char_boundary(*b));
        let start = within(self.place.start).unwrap_or(0);
        let end = within(self.place.end).unwrap_or(0).max(start);
        let line_start = text[..start].rfind('\n').map_or(0, |newline| newline + 1);
        ImportError::Refused(Box::new(Refusal {
            source_text: NamedSource::new(file, text.to_owned()).with_language("XML"),
            span: (start..end).into(),
            line: text[..start].matches('\n').count() + 1,
            column: text[line_start..start].chars().count() + 1,
            message: self.message,
            help: self.help,
        }))
    }
}
