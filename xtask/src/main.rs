//! The developer's commands, `cargo xtask COMMAND`.
//!
//! `sources => steps => verdict`. Host parts go through the cargo that runs this program, target
//! parts through the compiler that [`toolchain`] finds.

mod audit;
mod command;
mod cost;
mod debian;
mod emulator;
mod firmware;
mod hashes;
mod image;
mod relay;
mod setup;
mod steps;
mod test;
mod toolchain;

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
    /// Finds or installs the target's compiler, the emulator and the tools that read its images.
    ///
    /// DBD_TOOLCHAIN=prebuilt|rust-src|debian demands one of the three compilers.
    Setup,
    /// Everything that must hold before a change is kept; on the host and on the target.
    Test {
        /// All steps of the hash program on the target, however many instructions they take.
        #[arg(long)]
        long: bool,
    },
    /// Builds a program of the firmware and runs it in QEMU.
    Fw {
        /// The program.
        name: String,
        /// Sets no time limit.
        #[arg(long)]
        long: bool,
        /// Arguments of the program.
        #[arg(last = true)]
        arguments: Vec<String>,
    },
    /// Counts instructions and memory of a step on the target; writes docs/costs.csv.
    Cost {
        /// Scenes to print, all of them where none is named. The file always holds all.
        scenes: Vec<String>,
    },
    /// Looks into the linked steps for panics, allocation, fused and soft floating point.
    Audit,
}

fn main() -> ExitCode {
    let outcome = match Cli::parse().command {
        Command::Setup => setup::run(),
        Command::Test { long } => test::run(long),
        Command::Fw { name, long, arguments } => firmware::run(&name, long, &arguments),
        Command::Cost { scenes } => cost::run(&scenes),
        Command::Audit => audit::run(),
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error:#}");
            ExitCode::FAILURE
        }
    }
}
