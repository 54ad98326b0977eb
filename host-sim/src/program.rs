//! The whole command line as a custom program with custom laws.
//!
//! `laws => exit code`.

use std::io::{self, IsTerminal as _};
use std::process::ExitCode;

use anstream::AutoStream;
use dbd_kernel::laws::Law;

use crate::cli::main_with;
use crate::terminal::interrupt::clean_up_on_signals;
use crate::terminal::{Console, Look};

/// The command line `host-sim`, with further laws.
///
/// ```no_run
/// fn main() -> std::process::ExitCode {
///     host_sim::Program::new().law::<dbd_kernel::laws::EndStop>().run()
/// }
/// ```
#[derive(Debug, Default)]
#[must_use = "it does nothing before `run`"]
pub struct Program(());

impl Program {
    /// The unmodified command line.
    pub fn new() -> Self {
        Self::default()
    }

    /// Registers a law under its name; exported source names its type by the path of its module.
    pub fn law<L: Law>(self) -> Self {
        self.law_at::<L>(L::PATH)
    }

    /// [`Self::law`] with another path for the type in exported source, e.g. if its module is private:
    /// `law_at::<my_laws::Drag>("my_laws::Drag")`.
    pub fn law_at<L: Law>(self, path: &str) -> Self {
        dbd_scene::laws::register::<L>(path);
        self
    }

    /// Runs the command given by the arguments.
    #[must_use]
    pub fn run(self) -> ExitCode {
        clean_up_on_signals();
        // The text has no colour codes unless wanted; consoles without support for them are configured.
        let mut out = AutoStream::always(io::stdout());
        let mut err = AutoStream::always(io::stderr());
        let mut console = Console {
            look: Look::of(&io::stdout()),
            err_look: Look::of(&io::stderr()),
            terminal: io::stderr().is_terminal(),
            out: &mut out,
            err: &mut err,
        };
        main_with(std::env::args_os(), &mut console).into()
    }
}
