//! Errors of a scene: file, line, column, problem, remedy.

use std::fmt;
use std::io;

use miette::{Diagnostic, LabeledSpan, NamedSource, SourceCode, SourceSpan};
use thiserror::Error;

use crate::quantity::Scope;
use crate::written::{Angles, Log};

/// A scene that cannot be read or is invalid.
///
/// Displayed as the problem on one line; accessors and the diagnostic provide position and help.
#[derive(Debug, Error)]
pub enum SceneError {
    /// The file cannot be read.
    // The reason is part of the message and therefore not a source, which would repeat it.
    #[error("cannot read {file}: {reason}")]
    Unreadable {
        /// Its name.
        file: String,
        /// Why.
        reason: io::Error,
    },
    /// The scene is invalid.
    #[error("{0}")]
    Refused(Box<Refusal>),
}

/// The problem of a scene and its position.
#[derive(Debug, Error)]
#[error("{message}")]
pub struct Refusal {
    scene: NamedSource<String>,
    span: SourceSpan,
    line: usize,
    column: usize,
    message: String,
    help: String,
}

impl SceneError {
    /// The scene's file.
    #[must_use]
    pub fn file(&self) -> &str {
        match self {
            Self::Unreadable { file, .. } => file,
            Self::Refused(refusal) => refusal.scene.name(),
        }
    }

    /// The line of the problem, from 1; `None` where the file cannot be read.
    #[must_use]
    pub fn line(&self) -> Option<usize> {
        match self {
            Self::Unreadable { .. } => None,
            Self::Refused(refusal) => Some(refusal.line),
        }
    }

    /// The column of the problem, in characters from 1; `None` where the file cannot be read.
    #[must_use]
    pub fn column(&self) -> Option<usize> {
        match self {
            Self::Unreadable { .. } => None,
            Self::Refused(refusal) => Some(refusal.column),
        }
    }

    /// The problem.
    #[must_use]
    pub fn message(&self) -> String {
        self.to_string()
    }

    /// The remedy.
    #[must_use]
    pub fn help(&self) -> &str {
        match self {
            Self::Unreadable { .. } => "expected a readable TOML file in UTF-8",
            Self::Refused(refusal) => &refusal.help,
        }
    }
}

impl Diagnostic for SceneError {
    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        Some(Box::new(SceneError::help(self)))
    }

    fn source_code(&self) -> Option<&dyn SourceCode> {
        match self {
            Self::Unreadable { .. } => None,
            Self::Refused(refusal) => Some(&refusal.scene),
        }
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        match self {
            Self::Unreadable { .. } => None,
            Self::Refused(refusal) => {
                let label = LabeledSpan::new_with_span(Some("here".into()), refusal.span);
                Some(Box::new(std::iter::once(label)))
            }
        }
    }
}

/// The text of a scene, its file name, and the scope of its names.
#[derive(Clone, Copy)]
pub(crate) struct Source<'t> {
    /// The name used in messages.
    pub(crate) file: &'t str,
    /// The text of the file, then a line per change.
    pub(crate) text: &'t str,
    /// Length of the text of the file.
    pub(crate) own: usize,
    /// Values of names, once known.
    pub(crate) scope: Option<&'t Scope>,
    /// Log of the numbers read, if requested.
    pub(crate) log: Option<&'t Log>,
    /// Log of large angles while a scene is read.
    pub(crate) angles: Option<&'t Angles>,
}

impl<'t> Source<'t> {
    /// The file name shown for a change of a scene.
    pub(crate) const CHANGE: &'static str = "--set";

    /// The text of a file, without changes.
    pub(crate) fn of(file: &'t str, text: &'t str) -> Self {
        Self { file, text, own: text.len(), scope: None, log: None, angles: None }
    }

    /// Whether a byte belongs to a change.
    pub(crate) fn is_change(self, byte: usize) -> bool {
        byte > self.own && self.text.len() > self.own
    }

    /// The part that contains a byte, the file or the line of a change, and its start.
    fn part(self, byte: usize) -> (Self, usize) {
        let own = |text| (Self { text, ..self }, 0);
        if !self.is_change(byte) {
            return own(self.text.get(..self.own).unwrap_or(self.text));
        }
        let byte = byte.min(self.text.len());
        let start = self.text[..byte].rfind('\n').map_or(0, |newline| newline + 1);
        let end = self.text[byte..].find('\n').map_or(self.text.len(), |length| byte + length);
        (Self::of(Self::CHANGE, &self.text[start..end]), start)
    }

    /// An error at the bytes `span`.
    pub(crate) fn refuse(
        self,
        span: std::ops::Range<usize>,
        message: impl Into<String>,
        help: impl Into<String>,
    ) -> SceneError {
        let (part, start) = self.part(span.start);
        let span = span.start - start..span.end.saturating_sub(start);
        let (line, column) = part.position(span.start);
        SceneError::Refused(Box::new(Refusal {
            scene: NamedSource::new(part.file, part.text.to_owned()).with_language("TOML"),
            span: span.into(),
            line,
            column,
            message: message.into(),
            help: help.into(),
        }))
    }

    /// Line and column of a byte, from 1; the column counts characters.
    pub(crate) fn position(self, byte: usize) -> (usize, usize) {
        let before = self.text.get(..byte).unwrap_or(self.text);
        let line_start = before.rfind('\n').map_or(0, |newline| newline + 1);
        let line = before.matches('\n').count() + 1;
        (line, before[line_start..].chars().count() + 1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn positions_count_lines_and_characters_from_one() {
        let source = Source::of("f", "a = 1\n# ö\nö = 2");
        assert_eq!(source.position(0), (1, 1));
        assert_eq!(source.position(4), (1, 5));
        assert_eq!(source.position(6), (2, 1));
        // ö takes two bytes and one column.
        assert_eq!(source.position(source.text.len()), (3, 6));
        assert_eq!(source.position(1000), (3, 6));
    }

    #[test]
    fn the_diagnostic_holds_file_place_message_and_help() {
        let source = Source::of("slope.toml", "mass = -1\n");
        let error = source.refuse(7..9, "`mass` is -1", "`mass` is a number > 0 in kg");
        assert_eq!((error.file(), error.line(), error.column()), ("slope.toml", Some(1), Some(8)));
        assert_eq!(error.to_string(), "`mass` is -1");
        let help = Diagnostic::help(&error).map(|help| help.to_string());
        assert_eq!(help.as_deref(), Some("`mass` is a number > 0 in kg"));
        let label = error.labels().and_then(|mut labels| labels.next()).unwrap();
        let shown = error.source_code().unwrap().read_span(label.inner(), 0, 0).unwrap();
        assert_eq!((shown.name(), shown.data()), (Some("slope.toml"), &b"-1"[..]));
    }
}
