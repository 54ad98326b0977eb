//! `cargo xtask test`: all checks of a change.
//!
//! `sources => steps => verdict, the slowest tests`. On the host every crate is built once, with all
//! features, checked and optimised as the dev profile says, and once more for the documentation's
//! and the linter's eyes. The release profile builds what a release must prove: the golden bits, and Python's module.

mod cases;
mod times;

use std::process::Command;

use anyhow::{Context as _, Result, bail};

use crate::bits::{closed_loop, hashes, host::Host, relay};
use crate::built::{Program, build};
use crate::chip::{Toolchain, firmware, project, setup, trajectory};
use crate::command::{cargo, run as run_command, succeeds};
use crate::steps::Steps;
use crate::{
    audit, boards, compile_times, cost, growth, hil, instructions, packages, playground,
    provenance, python,
};

use cases::{Case, Selection};

const KERNEL: &str = "dbd-kernel";
const GOLDEN: &str = "dbd-bits";
/// What small models do.
const MECHANICS: &str = "dbd-mechanics";
/// The package with which firmware compares trajectories.
const TRAJECTORIES: &str = "dbd-golden";
const PROOF: &str = "dbd-proof";
/// Packages that depend only on scene and plant.
const FMU: &str = "dbd-fmu";
/// Options of every host build: one set of features, so that nothing is built twice.
const EVERYTHING: [&str; 2] = ["--workspace", "--all-features"];
/// Targets that the kernel is checked for beside the firmware's: without an FPU, without
/// instructions for it, with a newer core.
const OTHER_TARGETS: [&str; 2] = ["thumbv7em-none-eabi", "thumbv6m-none-eabi"];
/// The program that looks at reports in a browser; a plain `cargo test` leaves its tests out.
const BROWSER: &str = "tests::browser";
/// The slowest tests that are named.
const SLOWEST: usize = 10;

/// Runs all steps.
///
/// # Errors
/// Where something that the steps need is missing, or a step failed.
pub fn run(long: bool, write_times: bool) -> Result<()> {
    host_tools()?;
    let toolchain = setup::complete()?;
    let (mut steps, mut cases) = (Steps::default(), Vec::new());
    steps.step("rustfmt", || run_command(cargo().args(["fmt", "--all", "--check"])));
    steps.step("packages of what is published", packages::check);
    steps.step("measured data are those of the sources", provenance::check);
    let (host, programs) = std::thread::scope(|scope| {
        // An image is optimised as one: its link takes one core for minutes, whatever else is done.
        scope.spawn(|| firmware::link_ahead(&toolchain));
        linter_and_documentation(&mut steps);
        let programs = tests(&mut steps, Selection::All, &mut cases, &mut Vec::new());
        steps.step("work grows with the bodies alone", || growth::check(&programs));
        in_a_browser(&mut steps, &programs);
        documentation_tests(&mut steps);
        bare(&mut steps);
        let host = release(&mut steps, &programs, long, &mut cases);
        other_targets(&mut steps);
        python::add_steps(&mut steps, &programs);
        (host, programs)
    });
    on_target(&toolchain, (host.as_ref(), &programs), long, &mut steps);
    audit::add_steps(&toolchain, &mut steps);
    let slowest = cases::slowest(&cases, SLOWEST);
    show(&slowest);
    let written = if write_times { times::write(&steps, &slowest, &toolchain) } else { Ok(()) };
    steps.finish()?;
    written
}

/// The host's steps without the long tests.
///
/// # Errors
/// Where a step failed.
pub fn quick() -> Result<()> {
    let (mut steps, mut cases, mut left_out) = (Steps::default(), Vec::new(), Vec::new());
    steps.step("rustfmt", || run_command(cargo().args(["fmt", "--all", "--check"])));
    steps.step("measured data are those of the sources", provenance::check);
    tests(&mut steps, Selection::Fast, &mut cases, &mut left_out);
    show(&cases::slowest(&cases, SLOWEST));
    println!("\nleft out:");
    println!("  linter, documentation and its tests, the kernel without features");
    println!("  reports in a browser, golden bits in release, everything on the target");
    println!("  {} tests that took longer than a second last time:", left_out.len());
    left_out.iter().for_each(|test| println!("    {test}"));
    steps.finish()
}

/// Writes the pages' tables and pictures.
///
/// # Errors
/// Where a test failed.
pub fn tables() -> Result<()> {
    let command = |options: &[&str]| {
        let mut tests = cargo();
        tests.arg("test").args(options).args([
            "--package",
            "dbd-tests",
            "--package",
            GOLDEN,
            "--package",
            MECHANICS,
            "--package",
            PROOF,
        ]);
        tests.arg("--all-features");
        tests
    };
    // What compiles is shown as it comes; of the tests only what fails.
    run_command(&mut command(&["--no-run"]))?;
    run_command(command(&["--quiet"]).env("DBD_BLESS", "1"))
}

fn host_tools() -> Result<()> {
    for (subcommand, component) in [("fmt", "rustfmt"), ("clippy", "clippy")] {
        if !succeeds(cargo().args([subcommand, "--version"])) {
            bail!("`cargo {subcommand}` is missing: rustup component add {component}");
        }
    }
    Ok(())
}

fn linter_and_documentation(steps: &mut Steps) {
    steps.step("clippy", || {
        let mut command = cargo();
        command.arg("clippy").args(EVERYTHING);
        run_command(command.args(["--all-targets", "--", "-D", "warnings"]))
    });
    steps.step("documentation", || {
        let mut command = cargo();
        command.arg("doc").args(EVERYTHING).args(["--no-deps", "--lib"]);
        run_command(command.env("RUSTDOCFLAGS", "-D warnings"))
    });
}

fn tests(
    steps: &mut Steps,
    selection: Selection,
    cases: &mut Vec<Case>,
    left_out: &mut Vec<String>,
) -> Vec<Program> {
    let mut programs = Vec::new();
    steps.step("tests are built", || {
        programs = compile_times::show()?;
        Ok(())
    });
    if !programs.is_empty() {
        steps.step("tests", || {
            let ran = cases::run(&programs, selection)?;
            cases.extend(ran.cases);
            left_out.extend(ran.left_out);
            Ok(())
        });
    }
    programs
}

/// Reports and live views as a browser shows them.
fn in_a_browser(steps: &mut Steps, programs: &[Program]) {
    steps.step("reports and live views in a browser", || {
        setup::browser()?;
        playground::module(playground::Speed::Tests)?;
        let program = programs.iter().find(|program| program.name == BROWSER);
        let program = program.with_context(|| format!("`{BROWSER}` was not built"))?;
        let mut command = Command::new(&program.path);
        run_command(command.current_dir(&program.folder).args([
            "--ignored",
            "--skip",
            "golden_hashes",
            "--skip",
            "speed_beside",
        ]))
    });
}

fn documentation_tests(steps: &mut Steps) {
    steps.step("tests in the documentation", || {
        run_command(cargo().args(["test", "--quiet", "--doc", "--no-fail-fast"]).args(EVERYTHING))
    });
}

/// The kernel as firmware has it, without features. The plant without them is in the programs as released.
fn bare(steps: &mut Steps) {
    steps.step("tests of the kernel without features", || {
        run_command(cargo().args(["test", "--quiet", "--lib", "--package", KERNEL]))
    });
    // With others, features of crates from the registry are on that it does not ask for.
    steps.step("the FMU library by itself", || {
        run_command(cargo().args(["check", "--quiet", "--package", FMU]))
    });
}

/// Golden bits as released, and the programs that are compared with the target's.
fn release(
    steps: &mut Steps,
    programs: &[Program],
    long: bool,
    cases: &mut Vec<Case>,
) -> Option<Host> {
    let (mut host, mut golden, mut counted) = (None, None, Vec::new());
    steps.step("the host's programs are built as released", || {
        let mut command = cargo();
        command.args(["build", "--release", "--package", GOLDEN, "--test", "golden"]);
        command.args(["--package", "firmware", "--bin", firmware::PLANT]);
        command.args(instructions::BUILD);
        if long {
            command.args(["--bin", firmware::SHARED]);
        }
        // The dependencies of Python's module are compiled once with the rest.
        command.args(["--package", python::CRATE, "--lib"]);
        let built = build(&mut command)?;
        golden = built.iter().find(|program| program.tests).cloned();
        counted = built.clone();
        host = Some(Host::new(programs, &built)?);
        Ok(())
    });
    steps.step("golden bits in release", || {
        let mut golden: Program = golden.context("the test `golden` was not built")?;
        golden.name += " in release";
        cases.extend(cases::run(&[golden], Selection::All)?.cases);
        Ok(())
    });
    steps.step("instructions of a step on this machine", || instructions::check(&counted));
    host
}

/// The kernel and what compares trajectories compile for every target, the kernel with all features for
/// the firmware's.
fn other_targets(steps: &mut Steps) {
    steps.step("kernel for the firmware's target and two more", || {
        let targets = [setup::TARGET].into_iter().chain(OTHER_TARGETS);
        let toolchains = targets.map(Toolchain::find).collect::<Result<Vec<_>>>()?;
        let check = |toolchains: &[Toolchain], options: &[&str]| {
            for mut command in Toolchain::cargo_for(toolchains, "check", "core") {
                command.args(["--package", KERNEL]).args(options);
                // Nothing of it runs: the library need not be optimised.
                command.env("CARGO_PROFILE_DEV_OPT_LEVEL", "0").env("CARGO_PROFILE_DEV_DEBUG", "0");
                run_command(&mut command)?;
            }
            Ok(())
        };
        check(&toolchains, &["--package", TRAJECTORIES, "--no-default-features"])?;
        check(&toolchains[..1], &["--all-features"])
    });
}

fn on_target(
    toolchain: &Toolchain,
    (host, programs): (Option<&Host>, &[Program]),
    long: bool,
    steps: &mut Steps,
) {
    steps.step("drivers on the target", || {
        firmware::execute(toolchain, "board", false, &[]).map(drop)
    });
    steps.step("same bits of sensors on host and target", || {
        firmware::execute(toolchain, "sensors", false, &[]).map(drop)
    });
    steps.step("a run recorded on the target", || trajectory::compare(toolchain));
    let host = || host.context("the host's programs were not built");
    steps.step("same bits on host and target", || hashes::compare(toolchain, host()?, long));
    steps.step("the golden bits of laws on the target", || hashes::compare_laws(toolchain));
    steps.step("runs that change machines", || relay::compare(toolchain, host()?));
    let closed = "controllers with their plants, ticked on the target";
    steps.step(closed, || closed_loop::step(toolchain, host()?, long));
    steps.step("hardware in the loop", || hil::step(toolchain, host()?.plant(), programs, long));
    steps.step("an STM32F4 with its community's HAL", || {
        boards::check_format()?;
        boards::execute(toolchain, if long { &boards::PROGRAMS } else { &[boards::PLAIN] })
    });
    steps.step("new firmware projects, in Rust and in C", || {
        project::check(toolchain, long, programs)
    });
    steps.step("costs on the target", || cost::baseline::check(toolchain));
}

fn show(slowest: &[Case]) {
    println!("\n== slowest tests");
    for case in slowest {
        println!("{:>9.1} s  {}", case.seconds, case.name);
    }
}
