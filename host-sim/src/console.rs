//! Where a command's text goes, and how errors look there.
//!
//! Text that cannot be written, for example because its reader has gone, is dropped: results are
//! files, and a command never fails for want of an audience.

use std::io::Write;

use miette::{Diagnostic, GraphicalReportHandler, GraphicalTheme};

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
        let theme = match self.terminal {
            true => GraphicalTheme::unicode(),
            false => GraphicalTheme::unicode_nocolor(),
        };
        let mut text = String::new();
        let handler = GraphicalReportHandler::new_themed(theme).with_wrap_lines(false);
        if handler.render_report(&mut text, error).is_err() {
            text = format!("{error}\n");
        }
        let _ = self.err.write_all(text.as_bytes());
    }
}
