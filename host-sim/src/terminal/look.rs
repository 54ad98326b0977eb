//! Colours and width of text output.
//!
//! `(stream, environment) => colours, width`. `NO_COLOR`, `CLICOLOR`, `CLICOLOR_FORCE` and `TERM=dumb` have their usual
//! meaning (<https://no-color.org>, <https://bixense.com/clicolors>); without a terminal there are by default no
//! colours and no line breaks.

use std::fmt::Display;

use anstream::stream::RawStream;
use anstream::{AutoStream, ColorChoice};
use anstyle::{AnsiColor, Style};

/// Colours and width of a text output.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Look {
    /// Whether it is coloured.
    pub colours: bool,
    /// Columns of the terminal; `None` without a terminal, when lines are not broken.
    pub width: Option<usize>,
}

/// Heads of tables, names.
pub const HEAD: Style = Style::new().bold();
/// Success.
pub const GOOD: Style = AnsiColor::Green.on_default();
/// Failure.
pub const BAD: Style = AnsiColor::Red.on_default().bold();
/// Warnings.
pub const DOUBTFUL: Style = AnsiColor::Yellow.on_default().bold();
/// Notes.
pub const GOOD_TO_KNOW: Style = AnsiColor::Cyan.on_default();

impl Look {
    /// Neither colours nor a width, for files.
    pub const PLAIN: Self = Self { colours: false, width: None };

    /// The style for a stream of this process.
    #[must_use]
    pub fn of(stream: &impl RawStream) -> Self {
        let columns = || terminal_size::terminal_size().map(|(width, _)| usize::from(width.0));
        Self {
            colours: AutoStream::choice(stream) != ColorChoice::Never,
            width: if stream.is_terminal() { columns().filter(|width| *width > 0) } else { None },
        }
    }

    /// A text in a style, if colours are on.
    #[must_use]
    pub fn paint(self, style: Style, text: impl Display) -> String {
        if self.colours { format!("{style}{text}{style:#}") } else { text.to_string() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_painted_ends_its_colour() {
        let coloured = Look { colours: true, width: None };
        assert_eq!(coloured.paint(BAD, "no"), "\u{1b}[1m\u{1b}[31mno\u{1b}[0m");
        assert_eq!(Look::PLAIN.paint(BAD, "no"), "no");
    }
}
