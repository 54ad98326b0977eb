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
//! - `baseline`, `provenance`: stored counts and measured data.
//! - `audit`, `cost`, `callgrind`, `instructions`: forbidden calls of a step, and its cost.
//! - `bench`, `growth`, `prove`, `precisions`, `real_time`, `compile_times`, `fuzz`: measurements and random input.
//! - `playground`, `bits`: the kernel in a browser; the same bits everywhere.
//! - `boards`, `hil`, `python`, `libraries`, `packages`, `semver`: firmware, other languages, published crates.
//! - `release`: artefacts for users, each tried.
//! - `test`: all checks.

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
mod real_time;
mod release;
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
    /// DBD_TOOLCHAIN=prebuilt|rust-src|debian selects one of the three compilers.
    Setup,
    /// Runs all checks of a change, on the host and on the target.
    Test {
        /// Run all steps of the hash program on the target, without a limit of instructions.
        #[arg(long, conflicts_with = "quick")]
        long: bool,
        /// Run on the host only, without the long tests; lists the omitted ones.
        #[arg(long)]
        quick: bool,
        /// Write the times of the steps and the slowest tests to docs/development.md.
        #[arg(long, conflicts_with = "quick")]
        write_times: bool,
    },
    /// Runs the tests across the crates, which write the tables and pictures of README and
    /// docs; golden bits are only compared.
    Tables,
    /// Builds a program of the firmware and runs it in QEMU.
    Fw {
        /// The program.
        name: String,
        /// Set no time limit.
        #[arg(long)]
        long: bool,
        /// Arguments of the program.
        #[arg(last = true)]
        arguments: Vec<String>,
    },
    /// Counts instructions and memory of a step on the target; writes docs/costs.csv and the
    /// baseline of this compiler.
    Cost {
        /// Scenes to print [default: all]. The file always contains all.
        scenes: Vec<String>,
        /// Write nothing: show the differences to the file, and fail if a count rose by more
        /// than 1 %.
        #[arg(long)]
        compare: bool,
        /// Count only the sample and write only the baseline of this compiler.
        #[arg(long, conflicts_with_all = ["compare", "scenes"])]
        baseline: bool,
        /// Count the cost of the guards of the sample's models, and write docs/results/guards.csv.
        #[arg(long, conflicts_with_all = ["compare", "scenes", "baseline"])]
        guards: bool,
        /// Count what a step costs more with each element, and write docs/results/elements.csv.
        #[arg(long, conflicts_with_all = ["compare", "scenes", "baseline", "guards"])]
        elements: bool,
        /// Count steps on each core of `host-sim new firmware`, and write docs/results/cores.csv.
        #[arg(long, conflicts_with_all = ["compare", "scenes", "baseline", "guards", "elements"])]
        cores: bool,
    },
    /// Counts the instructions of a step on this machine, by valgrind's callgrind, compared with the flops of a
    /// step, a plain loop and the baseline of this compiler and target.
    Instructions {
        /// Write the baseline of this compiler and target, docs/instructions-baseline.csv.
        #[arg(long)]
        baseline: bool,
    },
    /// Asks `host-sim advise` which configurations of practical scenes keep up with controllers; writes
    /// docs/results/real-time.csv.
    RealTime,
    /// Counts how the work of reading and checking a scene grows with its bodies, by valgrind's
    /// callgrind; writes docs/results/growth.csv, fails if it grows faster than the bodies.
    Growth,
    /// Times steps and ensembles on this machine, which should be idle otherwise; writes docs/results/bench.json and
    /// docs/results/ensembles.csv. With arguments it measures only these and writes nothing
    Bench {
        /// Scenes and options: `--help` lists them
        #[arg(trailing_var_arg = true, allow_hyphen_values = true)]
        arguments: Vec<String>,
    },
    /// Tests scene reading, snapshots, steps and the command line with random input, on
    /// all cores; fails on any failure.
    Fuzz(fuzz::Campaign),
    /// Runs scenes for a long time in every precision and measures the energy error from rounding; writes
    /// docs/results/precisions.csv.
    Precisions {
        /// Scenes of that file [default: all].
        scenes: Vec<String>,
    },
    /// Checks all inputs where the tests check a sample: roots, arctangents, long runs; writes
    /// docs/results/proof.csv.
    Prove {
        /// `roots`, `arctangents`, `long-runs` [default: all].
        names: Vec<String>,
    },
    /// Compares the golden bits with other optimisations on the host, and in QEMU on other machines;
    /// writes docs/results/bits.csv.
    Bits {
        /// Builds and machines to compare, by the first words of their rows [default: all].
        #[arg(value_name = "NAME")]
        names: Vec<String>,
    },
    /// Runs controllers with their plants on the target: bit-identical to the host, without missed ticks at their rate.
    Plant {
        /// Number of ticks of each.
        #[arg(default_value_t = 100_000)]
        ticks: u32,
    },
    /// Hardware in the loop in QEMU: a plant on the chip and its controller here, and the reverse, on clean, bad and
    /// broken lines.
    Hil {
        /// Break the line for 60 s instead of 1 s.
        #[arg(long)]
        long: bool,
    },
    /// Builds the programs of a chip with its community's HAL and runs them in QEMU: hashes must be the
    /// golden ones, and overruns must occur exactly where intended.
    Boards {
        /// `plain`, `rtic`, `embassy` [default: all].
        names: Vec<String>,
    },
    /// Writes a new firmware project, runs it in QEMU and tests it on the host.
    Project,
    /// Measures the compiler's CPU time per crate against the budgets, for the README's first command and the tests.
    CompileTimes {
        /// One of the builds [default: both].
        builds: Vec<compile_times::Build>,
        /// Write the measured times as the budget.
        #[arg(long)]
        write: bool,
    },
    /// Records data files as measured at the present commit, if no command here measures them.
    Provenance {
        /// Paths from the root.
        #[arg(required = true)]
        files: Vec<String>,
        /// Keep stale data unchanged; their tables mark them as stale.
        #[arg(long)]
        stale: bool,
    },
    /// Tests FMUs of all scenes with their importers, and builds and tests the Python package.
    Python,
    /// Builds the library of the FMUs for an older Linux and for Windows, and compares their bits under Wine.
    Libraries,
    /// Builds the kernel in WebAssembly for the pages of `host-sim play`, and docs/playground/index.html with all
    /// scenes.
    Playground {
        /// Only time steps in Chromium against host-sim.
        #[arg(long)]
        measure: bool,
    },
    /// Checks that the published crates can be packaged and that their metadata are complete.
    Packages,
    /// Makes what users get, in target/artefacts, and uses each in an empty folder as a stranger would; publishes nothing.
    Release {
        /// Parts to make [default: all].
        parts: Vec<release::Part>,
    },
    /// Compares the published crates' interfaces with those of a revision, by cargo-semver-checks.
    Semver {
        /// A revision of this repository, e.g. the tag of a version.
        revision: String,
    },
    /// Checks the linked steps and calls for panics, allocation, fused and soft floating point.
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
        Command::Cost { elements: true, .. } => cost::elements::run(),
        Command::Cost { cores: true, .. } => cost::cores::run(),
        Command::Cost { scenes, compare, .. } => cost::run(&scenes, compare),
        Command::Instructions { baseline } => instructions::run(baseline),
        Command::Growth => growth::run(),
        Command::RealTime => real_time::run(),
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
        Command::Release { parts } => release::run(&parts),
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
