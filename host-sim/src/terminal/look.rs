//! How text looks where it goes: with colours or without, and how wide.
//!
//! `(stream, environment) => colours, width`. `NO_COLOR`, `CLICOLOR`, `CLICOLOR_FORCE` and `TERM=dumb` count as
//! everywhere (<https://no-color.org>, <https://bixense.com/clicolors>); where there is no terminal, nothing is
//! coloured unasked and no line is broken.

use std::fmt::Display;

use anstream::stream::RawStream;
use anstream::{AutoStream, ColorChoice};
use anstyle::{AnsiColor, Style};

/// How text looks where it goes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Look {
    /// Whether it is coloured.
    pub colours: bool,
    /// Columns of the terminal; `None` where there is none, and lines are as long as they are.
    pub width: Option<usize>,
}

/// Heads of tables, names.
pub const HEAD: Style = Style::new().bold();
/// What is as it should be.
pub const GOOD: Style = AnsiColor::Green.on_default();
/// What is not.
pub const BAD: Style = AnsiColor::Red.on_default().bold();
/// What is probably not meant.
pub const DOUBTFUL: Style = AnsiColor::Yellow.on_default().bold();
/// What is good to know.
pub const GOOD_TO_KNOW: Style = AnsiColor::Cyan.on_default();

impl Look {
    /// Neither colours nor a width, as a file has it.
    pub const PLAIN: Self = Self { colours: false, width: None };

    /// What suits a stream of this process.
    #[must_use]
    pub fn of(stream: &impl RawStream) -> Self {
        let columns = || terminal_size::terminal_size().map(|(width, _)| usize::from(width.0));
        Self {
            colours: AutoStream::choice(stream) != ColorChoice::Never,
            width: if stream.is_terminal() { columns().filter(|width| *width > 0) } else { None },
        }
    }

    /// A text in a style, where there are colours.
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
