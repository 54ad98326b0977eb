//! The output streams of a command, and the format of errors.
//!
//! A closed reader, e.g. `head`, is not an error: the rest of the output is dropped. Results that
//! cannot be written for another reason, e.g. a full disk, are an error. Failures to write errors are ignored.

use std::io::{self, Write};

use annotate_snippets::renderer::DecorStyle;
use annotate_snippets::{AnnotationKind, Group, Level, Renderer, Snippet};
use clap::ColorChoice;
use miette::{Diagnostic, LabeledSpan, SourceSpan};
use thiserror::Error;

use crate::terminal::look::{DOUBTFUL, GOOD_TO_KNOW, Look};

/// Standard output and standard error, or substitutes.
pub struct Console<'c> {
    /// Results.
    pub out: &'c mut dyn Write,
    /// Errors.
    pub err: &'c mut dyn Write,
    /// The style of results.
    pub look: Look,
    /// The style of errors.
    pub err_look: Look,
    /// Whether errors go to a terminal, and progress is shown by a bar.
    pub terminal: bool,
}

/// Standard output cannot be written.
#[derive(Debug, Error, Diagnostic)]
#[error("cannot write to standard output: {0}")]
pub struct OutputError(io::Error);

impl<'c> Console<'c> {
    /// Results and errors without colours.
    #[must_use]
    pub fn plain(out: &'c mut dyn Write, err: &'c mut dyn Write) -> Self {
        Self { out, err, look: Look::PLAIN, err_look: Look::PLAIN, terminal: false }
    }

    /// Applies the user's choice of colours.
    pub fn choose(&mut self, choice: ColorChoice) {
        let colours = match choice {
            ColorChoice::Auto => return,
            ColorChoice::Always => true,
            ColorChoice::Never => false,
        };
        self.look.colours = colours;
        self.err_look.colours = colours;
    }

    /// Writes results.
    ///
    /// # Errors
    /// If they cannot be written although there is a reader.
    pub fn print(&mut self, text: &str) -> Result<(), OutputError> {
        self.print_to_reader(text).map(|_| ())
    }

    /// Writes results; returns whether there still is a reader.
    ///
    /// # Errors
    /// As [`Self::print`].
    pub fn print_to_reader(&mut self, text: &str) -> Result<bool, OutputError> {
        let written = self.out.write_all(text.as_bytes()).and_then(|()| self.out.flush());
        match written {
            Ok(()) => Ok(true),
            Err(error) if error.kind() == io::ErrorKind::BrokenPipe => Ok(false),
            Err(error) => Err(OutputError(error)),
        }
    }

    /// Writes a warning.
    pub fn warn(&mut self, warning: &str) {
        let _ = writeln!(self.err, "{} {warning}", self.err_look.paint(DOUBTFUL, "warning:"));
    }

    /// Writes a note.
    pub fn note(&mut self, note: &str) {
        let _ = writeln!(self.err, "{} {note}", self.err_look.paint(GOOD_TO_KNOW, "note:"));
    }

    /// Writes an error with its place and its help.
    pub fn report(&mut self, error: &dyn Diagnostic) {
        let text = rendered(error, self.err_look);
        let _ = writeln!(self.err, "{text}");
    }
}

/// An error for people: the problem; file, line, column and the marked line;
/// the remedy.
fn rendered(error: &dyn Diagnostic, look: Look) -> String {
    let message = error.to_string();
    let mut group = Group::with_title(Level::ERROR.primary_title(&message));
    let source = Source::of(error);
    if let Some(Source { file, text, line, labels }) = &source {
        let marks = labels.iter().map(|(range, label)| {
            AnnotationKind::Primary.span(range.clone()).label(label.as_deref())
        });
        let snippet = Snippet::source(text).path(file).line_start(*line).annotations(marks);
        group = group.element(snippet);
    }
    let help = error.help().map(|help| help.to_string());
    if let Some(help) = &help {
        group = group.element(Level::HELP.message(help));
    }
    let renderer = if look.colours { Renderer::styled() } else { Renderer::plain() };
    let renderer = match look.width {
        Some(width) => renderer.term_width(width),
        None => renderer,
    };
    renderer.decor_style(DecorStyle::Unicode).render(&[group])
}

/// The location of an error.
struct Source {
    file: String,
    text: String,
    /// The number of the text's first line.
    line: usize,
    labels: Vec<(std::ops::Range<usize>, Option<String>)>,
}

impl Source {
    fn of(error: &dyn Diagnostic) -> Option<Self> {
        let labels: Vec<LabeledSpan> = error.labels()?.collect();
        let (first, code) = (labels.first()?, error.source_code()?);
        let whole = code.read_span(first.inner(), 1, 1).ok()?;
        let start = whole.span().offset();
        let text = String::from_utf8_lossy(whole.data()).into_owned();
        let within = |span: &SourceSpan| {
            let from = span.offset().saturating_sub(start).min(text.len());
            from..(from + span.len()).min(text.len())
        };
        let labels = labels
            .iter()
            .map(|label| (within(label.inner()), label.label().map(str::to_owned)))
            .collect();
        let file = whole.name().unwrap_or_default().to_owned();
        Some(Self { file, line: whole.line() + 1, labels, text })
    }
}

#[cfg(test)]
mod tests {
    use dbd_scene::Scene;

    use super::*;

    /// A writer that fails with a given error.
    struct Failing(io::ErrorKind);

    impl Write for Failing {
        fn write(&mut self, _: &[u8]) -> io::Result<usize> {
            Err(self.0.into())
        }

        fn flush(&mut self) -> io::Result<()> {
            Ok(())
        }
    }

    #[test]
    fn a_full_disk_is_a_failure_and_a_reader_that_has_gone_is_none() {
        let fails = |kind| {
            let (mut out, mut err) = (Failing(kind), Vec::new());
            Console::plain(&mut out, &mut err).print("text").is_err()
        };
        assert!(fails(io::ErrorKind::StorageFull));
        assert!(!fails(io::ErrorKind::BrokenPipe));
    }

    #[test]
    fn an_error_shows_file_line_column_message_the_line_and_help() {
        let text = "name = \"ö\"\nduration = 1\n[[body]]\nname = \"b\"\nmass = -1\n";
        let error = Scene::parse(text, "slope.toml").unwrap_err();
        let shown = rendered(&error, Look::PLAIN);
        for part in ["slope.toml:5:8", &error.message(), error.help(), "mass = -1"] {
            assert!(shown.contains(part), "{part}: {shown}");
        }
        let coloured = Look { colours: true, width: None };
        assert!(rendered(&error, coloured).contains("\u{1b}["));
    }

    /// An error may be at the very end, in an empty file or after multi-byte characters.
    #[test]
    fn any_place_can_be_shown() {
        let whole = "name = \"ö\"\nduration = 1\n# äöü€😀\n[[body]]\nname = \"bé\"\nmass = \"ß";
        for end in (0..=whole.len()).filter(|end| whole.is_char_boundary(*end)) {
            let error = Scene::parse(&whole[..end], "cut.toml").unwrap_err();
            let place = format!(
                "cut.toml:{}:{}",
                error.line().unwrap_or_default(),
                error.column().unwrap_or_default()
            );
            let shown = rendered(&error, Look::PLAIN);
            assert!(shown.contains(&place), "{place}: {shown}");
            assert!(shown.contains(error.help()), "{shown}");
        }
    }
}
