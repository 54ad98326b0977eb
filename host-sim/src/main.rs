//! The command line, see [`host_sim::cli`].

use std::io::{self, IsTerminal as _};
use std::process::ExitCode;

use anstream::AutoStream;
use host_sim::cli::main_with;
use host_sim::terminal::interrupt::clean_up_on_signals;
use host_sim::terminal::{Console, Look};

fn main() -> ExitCode {
    clean_up_on_signals();
    // What comes here is plain where it ought to be; consoles that know no colours are taught them.
    let (mut out, mut err) = (AutoStream::always(io::stdout()), AutoStream::always(io::stderr()));
    let mut console = Console {
        look: Look::of(&io::stdout()),
        err_look: Look::of(&io::stderr()),
        terminal: io::stderr().is_terminal(),
        out: &mut out,
        err: &mut err,
    };
    main_with(std::env::args_os(), &mut console).into()
}
