//! Where a command's text goes, and how errors look there.
//!
//! Text that cannot be written, for example because its reader has gone, is dropped: results are
//! files, and a command never fails for want of an audience.

use std::io::Write;

use annotate_snippets::renderer::DecorStyle;
use annotate_snippets::{AnnotationKind, Group, Level, Renderer, Snippet};
use miette::{Diagnostic, LabeledSpan, SourceSpan};

/// Standard output and standard error, or what stands for them.
pub struct Console<'c> {
    /// Results.
    pub out: &'c mut dyn Write,
    /// Errors.
    pub err: &'c mut dyn Write,
    /// Whether errors may be coloured and progress be shown.
    pub terminal: bool,
}

impl Console<'_> {
    /// Writes results.
    pub fn print(&mut self, text: &str) {
        let _ = self.out.write_all(text.as_bytes());
        let _ = self.out.flush();
    }

    /// Writes a warning.
    pub fn warn(&mut self, warning: &str) {
        let _ = writeln!(self.err, "warning: {warning}");
    }

    /// Writes an error with its place and its help.
    pub fn report(&mut self, error: &dyn Diagnostic) {
        let text = rendered(error, self.terminal);
        let _ = writeln!(self.err, "{text}");
    }
}

/// An error as people read it: what is wrong; file, line, column and the line itself with a mark;
/// what would be right.
fn rendered(error: &dyn Diagnostic, colours: bool) -> String {
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
    let renderer = if colours { Renderer::styled() } else { Renderer::plain() };
    renderer.decor_style(DecorStyle::Unicode).render(&[group])
}

/// Where an error lies.
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

    #[test]
    fn an_error_shows_file_line_column_message_the_line_and_help() {
        let text = "name = \"ö\"\nduration = 1\n[[body]]\nname = \"b\"\nmass = -1\n";
        let error = Scene::parse(text, "slope.toml").unwrap_err();
        let shown = rendered(&error, false);
        for part in ["slope.toml:5:8", &error.message(), error.help(), "mass = -1"] {
            assert!(shown.contains(part), "{part}: {shown}");
        }
        assert!(rendered(&error, true).contains("\u{1b}["));
    }

    /// What is wrong may lie at the very end, in an empty file or behind letters of many bytes.
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
            let shown = rendered(&error, false);
            assert!(shown.contains(&place), "{place}: {shown}");
            assert!(shown.contains(error.help()), "{shown}");
        }
    }
}
