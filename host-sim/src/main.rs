//! The command line, see [`host_sim::cli`].

use std::io::{self, IsTerminal as _};
use std::process::ExitCode;

use host_sim::cli::main_with;
use host_sim::terminal::Console;
use host_sim::terminal::interrupt::clean_up_on_signals;

fn main() -> ExitCode {
    let terminal = io::stderr().is_terminal() && std::env::var_os("NO_COLOR").is_none();
    clean_up_on_signals();
    let mut console = Console { out: &mut io::stdout(), err: &mut io::stderr(), terminal };
    main_with(std::env::args_os(), &mut console).into()
}
