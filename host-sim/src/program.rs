//! The whole command line as a program of a user's own, with laws of their own.
//!
//! `laws => exit code`.

use std::io::{self, IsTerminal as _};
use std::process::ExitCode;

use anstream::AutoStream;
use dbd_kernel::laws::Law;

use crate::cli::main_with;
use crate::terminal::interrupt::clean_up_on_signals;
use crate::terminal::{Console, Look};

/// The command line `host-sim`, which may know more laws than this crate.
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
    /// The command line as it is.
    pub fn new() -> Self {
        Self::default()
    }

    /// Makes a law known to scenes by its name; exported source names its type by the path of its module.
    pub fn law<L: Law>(self) -> Self {
        self.law_at::<L>(L::PATH)
    }

    /// [`Self::law`] whose type exported source names by another path, where its module is private:
    /// `law_at::<my_laws::Drag>("my_laws::Drag")`.
    pub fn law_at<L: Law>(self, path: &str) -> Self {
        dbd_scene::laws::register::<L>(path);
        self
    }

    /// Runs what the arguments say.
    #[must_use]
    pub fn run(self) -> ExitCode {
        clean_up_on_signals();
        // What comes here is plain where it ought to be; consoles that know no colours are taught them.
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
