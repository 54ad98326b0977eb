//! `cargo xtask test`: everything that must hold before a change is kept.

use anyhow::{Result, bail};

use crate::command::{cargo, run as run_command, succeeds};
use crate::steps::Steps;
use crate::toolchain::Toolchain;
use crate::{audit, cost, firmware, hashes, relay, setup};

const KERNEL: &str = "dbd-kernel";
const KERNEL_FEATURES: [&str; 4] = ["nalgebra", "defmt", "heapless", "micromath"];
/// Targets that the kernel is checked for beside the firmware's: without an FPU, without
/// instructions for it, with a newer core.
const OTHER_TARGETS: [&str; 3] =
    ["thumbv7em-none-eabi", "thumbv6m-none-eabi", "thumbv8m.main-none-eabihf"];

/// Runs all steps.
///
/// # Errors
/// Where something that the steps need is missing, or a step failed.
pub fn run(long: bool) -> Result<()> {
    host_tools()?;
    let toolchain = setup::complete()?;
    let mut steps = Steps::default();
    on_host(&mut steps);
    checks(&mut steps);
    on_target(&toolchain, long, &mut steps);
    audit::add_steps(&toolchain, &mut steps);
    steps.finish()
}

fn host_tools() -> Result<()> {
    for (subcommand, component) in [("fmt", "rustfmt"), ("clippy", "clippy")] {
        if !succeeds(cargo().args([subcommand, "--version"])) {
            bail!("`cargo {subcommand}` is missing: rustup component add {component}");
        }
    }
    Ok(())
}

fn on_host(steps: &mut Steps) {
    let features = KERNEL_FEATURES.join(",");
    steps.step("rustfmt", || run_command(cargo().args(["fmt", "--all", "--check"])));
    steps.step("clippy, workspace", || {
        run_command(cargo().args([
            "clippy",
            "--workspace",
            "--all-targets",
            "--",
            "-D",
            "warnings",
        ]))
    });
    steps.step("clippy, kernel with its features", || {
        run_command(
            cargo()
                .args(["clippy", "-p", KERNEL, "--all-targets", "--features", &features])
                .args(["--", "-D", "warnings"]),
        )
    });
    steps.step("documentation", || {
        run_command(
            cargo()
                .args(["doc", "--workspace", "--no-deps", "--lib"])
                .env("RUSTDOCFLAGS", "-D warnings"),
        )
    });
    steps.step("tests, debug", || run_command(cargo().args(["test", "--quiet", "--workspace"])));
    steps.step("tests, release", || {
        run_command(cargo().args(["test", "--quiet", "--workspace", "--release"]))
    });
    for feature in KERNEL_FEATURES {
        steps.step(&format!("kernel tests with {feature}"), || {
            run_command(cargo().args(["test", "--quiet", "-p", KERNEL, "--features", feature]))
        });
    }
}

/// The kernel compiles for every target, bare and with all features.
fn checks(steps: &mut Steps) {
    let features = KERNEL_FEATURES.join(",");
    for target in [setup::TARGET].iter().chain(&OTHER_TARGETS) {
        steps.step(&format!("kernel for {target}"), || {
            let toolchain = Toolchain::find(target)?;
            let check = || {
                let mut command = toolchain.cargo("check", "core");
                command.args(["--quiet", "-p", KERNEL]);
                command
            };
            run_command(&mut check())?;
            run_command(check().args(["--features", &features]))
        });
    }
}

fn on_target(toolchain: &Toolchain, long: bool, steps: &mut Steps) {
    steps.step("drivers on the target", || {
        firmware::execute(toolchain, "board", false, &[]).map(drop)
    });
    steps.step("same bits on host and target", || hashes::compare(toolchain, long));
    steps.step("runs that change machines", || relay::compare(toolchain));
    steps.step("costs on the target", || cost::check(toolchain));
}
