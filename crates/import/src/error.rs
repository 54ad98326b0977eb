//! Why a file is not imported: file, line, column, what is wrong, what would be right.

use std::fmt::{self, Write as _};
use std::io;

use miette::{Diagnostic, LabeledSpan, NamedSource, SourceCode, SourceSpan};
use thiserror::Error;

use crate::omission::{self, Omission};
use crate::place::{Place, Texts};

/// A file that cannot be read, or that is refused.
#[derive(Debug, Error)]
pub enum ImportError {
    /// A file cannot be read.
    // The reason is part of the message and therefore not a source, which would say it twice.
    #[error("cannot read {file}: {reason}")]
    Unreadable {
        /// Its name.
        file: String,
        /// Why.
        reason: io::Error,
    },
    /// A file is refused.
    #[error("{0}")]
    Refused(Box<Refusal>),
    /// The file holds what has no counterpart.
    #[error("{}", omitted(file, omissions))]
    Omitted {
        /// Its name.
        file: String,
        /// What that is.
        omissions: Vec<Omission>,
    },
}

/// What is wrong with a file, and where.
#[derive(Debug, Error)]
#[error("{message}")]
pub struct Refusal {
    source_text: NamedSource<String>,
    span: SourceSpan,
    /// From 1.
    pub line: usize,
    /// In characters from 1.
    pub column: usize,
    /// What is wrong.
    pub message: String,
    /// What would be right.
    pub help: String,
}

fn omitted(file: &str, omissions: &[Omission]) -> String {
    let (count, s) = (omissions.len(), if omissions.len() == 1 { "" } else { "s" });
    let mut text = format!("{file} has {count} thing{s} without a counterpart");
    for line in omission::table(omissions).lines() {
        let _ = write!(text, "\n  {line}");
    }
    text
}

impl ImportError {
    /// What would be right.
    #[must_use]
    pub fn help(&self) -> String {
        match self {
            Self::Unreadable { .. } => "MJCF and URDF are readable XML files in UTF-8".into(),
            Self::Refused(refusal) => refusal.help.clone(),
            Self::Omitted { omissions, .. } => {
                let mut kinds: Vec<&str> = omissions.iter().map(|o| o.kind.name()).collect();
                kinds.sort_unstable();
                kinds.dedup();
                let options: Vec<String> =
                    kinds.iter().map(|kind| format!("--ignore {kind}")).collect();
                format!("{} leaves them out: the scene then moves without them", options.join(" "))
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

/// What is wrong at a place, before the texts are at hand.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Fault {
    place: Place,
    message: String,
    help: String,
}

impl Fault {
    /// Something is wrong at a place.
    pub(crate) fn at(place: Place, message: impl Into<String>, help: impl Into<String>) -> Self {
        Self { place, message: message.into(), help: help.into() }
    }

    /// The line of its place.
    pub(crate) fn line(&self) -> usize {
        self.place.line
    }

    /// The refusal, with the text around it.
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
