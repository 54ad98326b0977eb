//! The kernel in WebAssembly, and the page with all scenes that a web host shows.
//!
//! `dbd-play => dbd_play.wasm beside host-sim, docs/playground/index.html`.

use std::path::PathBuf;
use std::process::Command;

use anyhow::{Context as _, Result, bail};

use crate::built::{build, host_sim};
use crate::chip::{Toolchain, setup};
use crate::command::{cargo, output, program, root, run, target_dir};

/// What a browser runs.
const TARGET: &str = "wasm32-unknown-unknown";
/// The profile of the module.
const PROFILE: &str = "web";
const MODULE: &str = "dbd_play.wasm";
/// What is measured: \[µs\] per step.
const HEADER: &str = "scene,steps,native_us,browser_us";
/// The page, which is not kept with the sources.
const PAGE: &str = "docs/playground/index.html";

/// `cargo xtask playground`.
///
/// # Errors
/// Where the target's compiler is missing, or something does not build or cannot be written.
pub fn make() -> Result<()> {
    let module = module(Speed::Full)?;
    let built = build(cargo().args(["build", "--release", "--package", "host-sim"]))?;
    let host_sim = host_sim(&built)?;
    let beside = host_sim.with_file_name(MODULE);
    std::fs::copy(&module, &beside).context("cannot copy the module next to host-sim")?;
    println!("{}: for host-sim play", beside.display());
    let page = root().join(PAGE);
    run(program(host_sim).args(["play", "--all", "--no-open", "--out"]).arg(page))
}

/// `cargo xtask playground --measure`: times steps in Chromium and by host-sim as released, one after the other.
///
/// # Errors
/// Where something does not build, or a run fails.
pub fn measure() -> Result<()> {
    setup::browser()?;
    module(Speed::Full)?;
    let built = build(cargo().args(["build", "--release", "--package", "host-sim"]))?;
    let host_sim = host_sim(&built)?;
    let mut tests = cargo();
    tests.args(["test", "--no-run", "--workspace", "--all-features", "--test", "browser"]);
    let built = build(&mut tests)?;
    let found = built.iter().find(|program| program.name == "tests::browser");
    let found = found.context("the tests in a browser were not built")?;
    let mut test = Command::new(&found.path);
    test.current_dir(&found.folder).env("DBD_HOST_SIM", host_sim);
    let said = output(test.args(["--ignored", "speed_beside_host_sim", "--nocapture"]))?;
    let rows = said.lines().filter_map(|line| line.strip_prefix("measured,"));
    let rows: Vec<&str> = rows.collect();
    if rows.is_empty() {
        bail!("no measurement was printed:\n{said}");
    }
    println!("{HEADER}\n{}", rows.join("\n"));
    Ok(())
}

/// How fast a module's steps are to be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Speed {
    /// As users have it.
    Full,
    /// A quarter of that, compiled in less than half the time: the bits are the same.
    Tests,
}

/// Builds the module; where it is.
///
/// # Errors
/// Where the target's compiler is missing, or it does not build.
pub fn module(speed: Speed) -> Result<PathBuf> {
    let toolchain = Toolchain::find(TARGET)?;
    println!("{}", toolchain.describe()?);
    let mut command = toolchain.cargo("rustc", "std,panic_abort");
    command.args([
        "--profile",
        PROFILE,
        "--package",
        "dbd-play",
        "--lib",
        "--crate-type",
        "cdylib",
    ]);
    if speed == Speed::Tests {
        for option in ["opt-level=1", "codegen-units=16"] {
            command.args(["--config", &format!("profile.{PROFILE}.package.dbd-plant.{option}")]);
        }
    }
    run(&mut command)?;
    let folder = target_dir().join("play");
    std::fs::create_dir_all(&folder).context("cannot make a folder for the module")?;
    let module = folder.join(MODULE);
    let made = toolchain.images(PROFILE).join(MODULE);
    let size = std::fs::copy(made, &module).context("cannot copy the module")?;
    println!("{}: {size} bytes", module.display());
    Ok(module)
}
