//! Building and running the firmware's programs.

use std::path::PathBuf;
use std::time::Duration;

use anyhow::{Result, bail};

use crate::command::{root, run as run_command};
use crate::toolchain::Toolchain;
use crate::{emulator, setup};

/// The profile of images.
const PROFILE: &str = "firmware";
/// Real time for a program without `--long`: ten times what 3·10⁹ instructions take.
const TIME_LIMIT: Duration = Duration::from_secs(600);
/// Linked for the audit, not to be run.
const AUDIT: &str = "audit";

/// `cargo xtask fw NAME`.
///
/// # Errors
/// Where the name is unknown, or building or running fails.
pub fn run(name: &str, long: bool, arguments: &[String]) -> Result<()> {
    let programs = programs()?;
    if !programs.iter().any(|program| program == name) {
        bail!("there is no program `{name}`; there are: {}", programs.join(", "));
    }
    let toolchain = setup::complete()?;
    execute(&toolchain, name, long, arguments).map(drop)
}

/// The programs that can be run, in alphabetical order.
///
/// # Errors
/// Where their sources cannot be listed.
pub fn programs() -> Result<Vec<String>> {
    let mut programs = Vec::new();
    for file in std::fs::read_dir(root().join("firmware/src/bin"))? {
        if let Some(name) = file?.path().file_stem().and_then(|name| name.to_str()) {
            programs.push(name.to_owned());
        }
    }
    programs.retain(|program| program != AUDIT);
    programs.sort();
    Ok(programs)
}

/// Builds a program and returns the path of its image.
///
/// # Errors
/// Where it does not build.
pub fn build(toolchain: &Toolchain, name: &str) -> Result<PathBuf> {
    run_command(toolchain.cargo("build", "core").args(selection(name)))?;
    Ok(toolchain.images(PROFILE).join(name))
}

/// Builds the roots of the audit, with a planted fault or none.
///
/// # Errors
/// Where they do not build.
pub fn build_audit(toolchain: &Toolchain, plant: Option<&str>) -> Result<PathBuf> {
    // The planted allocation needs `alloc`.
    let mut command = toolchain.cargo("build", "core,alloc");
    run_command(command.args(selection(AUDIT)).args(["--features", plant.unwrap_or(AUDIT)]))?;
    Ok(toolchain.images(PROFILE).join(AUDIT))
}

/// Builds and runs a program; returns its lines.
///
/// # Errors
/// Where it does not build, fails, or takes too long.
pub fn execute(
    toolchain: &Toolchain,
    name: &str,
    long: bool,
    arguments: &[String],
) -> Result<Vec<String>> {
    let image = build(toolchain, name)?;
    let mut command = toolchain.cargo("run", "core");
    command.args(selection(name)).arg("--quiet");
    if !arguments.is_empty() {
        command.args(["--", "-append", &arguments.join(" ")]);
    }
    let limit = (!long).then_some(TIME_LIMIT);
    emulator::run(&mut command, &image, limit)
}

fn selection(name: &str) -> [&str; 6] {
    ["--package", "firmware", "--profile", PROFILE, "--bin", name]
}
