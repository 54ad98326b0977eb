//! `cargo xtask bench`: times on this machine.

use std::io::{self, IsTerminal as _};
use std::process::ExitCode;

use dbd_bench::command::main_with;
use host_sim::terminal::{Console, Look};

fn main() -> ExitCode {
    let (mut out, mut err) = (io::stdout(), io::stderr());
    let mut console = Console {
        look: Look::of(&io::stdout()),
        err_look: Look::of(&io::stderr()),
        terminal: io::stderr().is_terminal(),
        out: &mut out,
        err: &mut err,
    };
    main_with(std::env::args_os(), &mut console).into()
}
