//! The developer's commands, `cargo xtask COMMAND`.
//!
//! `sources => steps => verdict`. Host parts go through the cargo that runs this program, target
//! parts through the compiler that [`chip::toolchain`] finds.
//!
//! # Modules
//!
//! Each uses only those before it:
//!
//! - `attended`, `command`, `built`, `steps`: other programs, what cargo builds, lists of steps.
//! - [`chip`]: compiler, emulator and images of the target.
//! - `baseline`, `provenance`: counts and data that are kept.
//! - `audit`, `cost`, `callgrind`, `instructions`: what a step must not reach, and what it costs.
//! - `bench`, `growth`, `prove`, `precisions`, `compile_times`, `fuzz`: measurements and random input.
//! - `playground`, `bits`: the kernel in a browser; the same bits everywhere.
//! - `boards`, `hil`, `python`, `libraries`, `packages`, `semver`: firmware, other languages, what is published.
//! - `test`: all that must hold.

mod attended;
mod audit;
mod baseline;
mod bench;
mod bits;
mod boards;
mod built;
mod callgrind;
mod chip;
mod command;
mod compile_times;
mod cost;
mod fuzz;
mod growth;
mod hil;
mod instructions;
mod libraries;
mod packages;
mod playground;
mod precisions;
mod prove;
mod provenance;
mod python;
mod semver;
mod steps;
mod test;

use std::process::ExitCode;

use clap::{Parser, Subcommand};

use chip::{firmware, project, setup};

/// Commands for people who work on this repository.
#[derive(Parser)]
#[command(name = "cargo xtask", bin_name = "cargo xtask")]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Finds or installs the target's compiler, the emulator and the tools that read its images, and
    /// the browser of the reports' tests.
    ///
    /// DBD_TOOLCHAIN=prebuilt|rust-src|debian demands one of the three compilers.
    Setup,
    /// Everything that must hold before a change is kept; on the host and on the target.
    Test {
        /// All steps of the hash program on the target, however many instructions they take.
        #[arg(long, conflicts_with = "quick")]
        long: bool,
        /// On the host only, without the long tests: says what it leaves out.
        #[arg(long)]
        quick: bool,
        /// Writes the times of the steps and the slowest tests into docs/development.md.
        #[arg(long, conflicts_with = "quick")]
        write_times: bool,
    },
    /// Runs the tests across the crates and lets them write the tables and pictures of README and
    /// docs from what they compute; golden bits are only compared.
    Tables,
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
    /// Counts instructions and memory of a step on the target; writes docs/costs.csv and the
    /// baseline of this compiler.
    Cost {
        /// Scenes to print, all of them where none is named. The file always holds all.
        scenes: Vec<String>,
        /// Writes nothing: shows what differs from the file, and fails where a count rose by more
        /// than 1 %.
        #[arg(long)]
        compare: bool,
        /// Counts the sample alone and writes the baseline of this compiler, nothing else.
        #[arg(long, conflicts_with_all = ["compare", "scenes"])]
        baseline: bool,
        /// Counts what the guards of the sample's models cost, and writes docs/results/guards.csv.
        #[arg(long, conflicts_with_all = ["compare", "scenes", "baseline"])]
        guards: bool,
    },
    /// Counts the instructions of a step on this machine, by valgrind's callgrind: beside the flops of a
    /// step, a plain loop's and the baseline of this compiler and target.
    Instructions {
        /// Writes the baseline of this compiler and target, docs/instructions-baseline.csv.
        #[arg(long)]
        baseline: bool,
    },
    /// Counts how the work of reading and looking at a scene grows with its bodies, by valgrind's
    /// callgrind; writes docs/results/growth.csv, fails where it grows faster than the bodies.
    Growth,
    /// Times steps and ensembles on this machine, which should do nothing else; writes docs/results/bench.json and
    /// docs/results/ensembles.csv. With arguments it measures what these name and writes nothing
    Bench {
        /// Scenes and options: `--help` lists them
        #[arg(trailing_var_arg = true, allow_hyphen_values = true)]
        arguments: Vec<String>,
    },
    /// Gives random input to the reader of scenes, to snapshots, to steps and to the command line, on
    /// all cores; fails where anything fails.
    Fuzz(fuzz::Campaign),
    /// Steps scenes long in every precision and looks at what rounding does to their energy; writes
    /// docs/results/precisions.csv.
    Precisions {
        /// Scenes of that file, all of them where none is named.
        scenes: Vec<String>,
    },
    /// Tries all inputs where the tests try a sample: roots, arctangents, long runs; writes
    /// docs/results/proof.csv.
    Prove {
        /// `roots`, `arctangents`, `long-runs`; all of them where none is named.
        names: Vec<String>,
    },
    /// Compares the golden bits with other optimisations on the host, and in QEMU on other machines;
    /// writes docs/results/bits.csv.
    Bits {
        /// Builds and machines to compare, all of them where none is named: the rows' first words.
        #[arg(value_name = "NAME")]
        names: Vec<String>,
    },
    /// Runs controllers with their plants on the target: the host's bits, no tick missed at their rate.
    Plant {
        /// Ticks of each.
        #[arg(default_value_t = 100_000)]
        ticks: u32,
    },
    /// Hardware in the loop in QEMU: a plant on the chip and its controller here, and the reverse, on clean, bad and
    /// broken lines.
    Hil {
        /// Breaks the line for 60 s instead of 1 s.
        #[arg(long)]
        long: bool,
    },
    /// Builds the programs of a chip with its community's HAL and runs them in QEMU: hashes must be the
    /// golden ones, overruns must be counted where they are meant, and nowhere else.
    Boards {
        /// `plain`, `rtic`, `embassy`; all of them where none is named.
        names: Vec<String>,
    },
    /// Writes a new firmware project, runs it in QEMU and tests it on the host.
    Project,
    /// CPU time of the compiler, crate by crate, beside the budgets: of the README's first command and of the tests.
    CompileTimes {
        /// One of the builds; both where none is named.
        builds: Vec<compile_times::Build>,
        /// Makes what is measured the budget.
        #[arg(long)]
        write: bool,
    },
    /// Notes files of data as measured at the present commit, where no command here measures them.
    Provenance {
        /// Paths from the root.
        #[arg(required = true)]
        files: Vec<String>,
        /// Keeps stale data as they are; their tables call them stale.
        #[arg(long)]
        stale: bool,
    },
    /// Holds FMUs of all scenes to their importers, and builds and tests the Python package.
    Python,
    /// Builds the library of the FMUs for an older Linux and for Windows, and compares their bits under Wine.
    Libraries,
    /// Builds the kernel in WebAssembly, which `host-sim play` puts on its pages, and docs/playground/index.html with all
    /// scenes.
    Playground {
        /// Times steps in Chromium beside host-sim instead.
        #[arg(long)]
        measure: bool,
    },
    /// Looks whether the crates that are published can be packaged, and what their metadata lacks.
    Packages,
    /// Compares the published crates' interfaces with those of a revision, by cargo-semver-checks.
    Semver {
        /// A revision of this repository, e.g. the tag of a version.
        revision: String,
    },
    /// Looks into the linked steps and calls for panics, allocation, fused and soft floating point.
    Audit,
}

fn main() -> ExitCode {
    if let Some(code) = compile_times::wrapped() {
        return code;
    }
    let command = Cli::parse().command;
    let outcome = attended::attended("still at work", || match command {
        Command::Setup => setup::run().and(python::set_up()),
        Command::Test { quick: true, .. } => test::quick(),
        Command::Test { long, write_times, .. } => test::run(long, write_times),
        Command::Tables => test::tables(),
        Command::Fw { name, long, arguments } => firmware::run(&name, long, &arguments),
        Command::Cost { baseline: true, .. } => cost::baseline(),
        Command::Cost { guards: true, .. } => cost::guards::run(),
        Command::Cost { scenes, compare, .. } => cost::run(&scenes, compare),
        Command::Instructions { baseline } => instructions::run(baseline),
        Command::Growth => growth::run(),
        Command::Bench { arguments } => bench::run(&arguments),
        Command::Fuzz(campaign) => fuzz::run(&campaign),
        Command::Bits { names } => bits::machines::run(&names),
        Command::Precisions { scenes } => precisions::run(&scenes),
        Command::Prove { names } => prove::run(&names),
        Command::Plant { ticks } => bits::closed_loop::run(ticks),
        Command::Hil { long } => hil::run(long),
        Command::Boards { names } => boards::run(&names),
        Command::Project => {
            setup::complete().and_then(|toolchain| project::check(&toolchain, true, &[]))
        }
        Command::CompileTimes { builds, write } => compile_times::run(&builds, write),
        Command::Provenance { files, stale: false } => provenance::note(&files),
        Command::Provenance { files, stale: true } => provenance::keep(&files),
        Command::Python => python::check(),
        Command::Libraries => libraries::build(),
        Command::Playground { measure: true } => playground::measure(),
        Command::Playground { .. } => playground::make(),
        Command::Packages => packages::check(),
        Command::Semver { revision } => semver::run_against(&revision),
        Command::Audit => audit::run(),
    });
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error:#}");
            ExitCode::FAILURE
        }
    }
}
