//! `cargo xtask test`: everything that must hold before a change is kept.

use anyhow::{Result, bail};

use crate::command::{cargo, run, succeeds};
use crate::steps::Steps;

const KERNEL_FEATURES: [&str; 3] = ["nalgebra", "defmt", "heapless"];

/// Runs all steps.
///
/// # Errors
/// Where something that the steps need is missing, or a step failed.
pub fn run_all() -> Result<()> {
    tools()?;
    let mut steps = Steps::default();
    host(&mut steps);
    steps.finish()
}

fn tools() -> Result<()> {
    for (subcommand, component) in [("fmt", "rustfmt"), ("clippy", "clippy")] {
        if !succeeds(cargo().args([subcommand, "--version"])) {
            bail!("`cargo {subcommand}` is missing: rustup component add {component}");
        }
    }
    Ok(())
}

fn host(steps: &mut Steps) {
    let features = KERNEL_FEATURES.join(",");
    steps.step("rustfmt", || run(cargo().args(["fmt", "--all", "--check"])));
    steps.step("clippy, workspace", || {
        run(cargo().args(["clippy", "--workspace", "--all-targets", "--", "-D", "warnings"]))
    });
    steps.step("clippy, kernel with its features", || {
        run(cargo()
            .args(["clippy", "-p", "dbd-kernel", "--all-targets", "--features", &features])
            .args(["--", "-D", "warnings"]))
    });
    steps.step("documentation", || {
        run(cargo().args(["doc", "--workspace", "--no-deps"]).env("RUSTDOCFLAGS", "-D warnings"))
    });
    steps.step("tests, debug", || run(cargo().args(["test", "--quiet", "--workspace"])));
    steps.step("tests, release", || {
        run(cargo().args(["test", "--quiet", "--workspace", "--release"]))
    });
    for feature in KERNEL_FEATURES {
        steps.step(&format!("kernel tests with {feature}"), || {
            run(cargo().args(["test", "--quiet", "-p", "dbd-kernel", "--features", feature]))
        });
    }
}
