//! The developer's commands, `cargo xtask COMMAND`.
//!
//! `sources => steps => verdict`. Host parts go through the cargo that runs this program, target
//! parts through the toolchain that `toolchain` finds.

mod command;
mod steps;
mod test;

use std::process::ExitCode;

use clap::{Parser, Subcommand};

/// Commands for people who work on this repository.
#[derive(Parser)]
#[command(name = "cargo xtask", bin_name = "cargo xtask")]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Everything that must hold before a change is kept.
    Test,
}

fn main() -> ExitCode {
    let outcome = match Cli::parse().command {
        Command::Test => test::run_all(),
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error:#}");
            ExitCode::FAILURE
        }
    }
}
