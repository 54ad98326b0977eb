//! Building and running the firmware's programs.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Duration;

use anyhow::{Result, bail};

use crate::chip::{Toolchain, emulator, setup};
use crate::command::{output, run as run_command};

/// The profile of images.
pub const PROFILE: &str = "firmware";
/// The profile of the image [`LAWS`].
const BITS: &str = "bits";
/// Real time for a program without `--long`: ten times what 3·10⁹ instructions take.
const TIME_LIMIT: Duration = Duration::from_secs(600);
/// The image of several programs: its first argument names one.
pub const SHARED: &str = "programs";
/// The image of controllers with their plants.
pub const PLANT: &str = "plant";
/// The image with one end of a line.
const HIL: &str = "hil";
/// The image that steps scenes with laws.
pub const LAWS: &str = "laws";
/// Where time matters: 8 ns an instruction, 125 million in a second, about what a part of 168 MHz
/// does; asleep it passes at once to what is due next, whatever the host does. The last of several such
/// options holds.
const CLOCK: &str = "shift=3,sleep=off";
/// Linked for the audit, not to be run.
const AUDIT: &str = "audit";
/// What an image is linked from: the audit plants an allocation.
pub const LIBRARIES: &str = "core,alloc";

/// Programs that can be run, each with the image that holds it.
const PROGRAMS: [(&str, &str); 16] = [
    ("board", SHARED),
    ("cost", "cost"),
    ("cost-double", "cost-double"),
    ("cost-fixed", "cost-fixed"),
    ("cost-solved", "cost-solved"),
    ("elements", "elements"),
    ("guards", "guards"),
    ("hash", SHARED),
    (HIL, HIL),
    (LAWS, LAWS),
    ("plant", PLANT),
    ("relay", SHARED),
    ("root", SHARED),
    ("sample", SHARED),
    ("sensors", SHARED),
    ("trajectory", SHARED),
];

/// `cargo xtask fw NAME`.
///
/// # Errors
/// Where the name is unknown, or building or running fails.
pub fn run(name: &str, long: bool, arguments: &[String]) -> Result<()> {
    image_of(name)?;
    let toolchain = setup::complete()?;
    execute(&toolchain, name, long, arguments).map(drop)
}

/// The image that holds a program.
fn image_of(name: &str) -> Result<&'static str> {
    match PROGRAMS.iter().find(|(program, _)| *program == name) {
        Some((_, image)) => Ok(image),
        None => bail!(
            "unknown program `{name}`; known programs: {}",
            PROGRAMS.map(|(program, _)| program).join(", ")
        ),
    }
}

/// Builds the roots of the audit and returns the path of their image.
///
/// # Errors
/// Where they do not build.
pub fn build_audit(toolchain: &Toolchain) -> Result<PathBuf> {
    let mut command = toolchain.cargo("build", LIBRARIES);
    run_command(command.args(selection(AUDIT)).args(features(AUDIT)))?;
    Ok(toolchain.images(PROFILE).join(AUDIT))
}

/// Links the images that the tests take, beside other work: silent, and what fails fails again where the image
/// is wanted. A link takes one core for minutes.
pub fn link_ahead(toolchain: &Toolchain) {
    for bin in [SHARED, AUDIT, PLANT, HIL, LAWS] {
        let mut command = toolchain.cargo("build", LIBRARIES);
        let _ = output(command.args(selection(bin)).args(features(bin)));
    }
}

/// Builds and runs a program; returns its lines.
///
/// # Errors
/// Where there is no such program, or it does not build, fails, or takes too long.
pub fn execute(
    toolchain: &Toolchain,
    name: &str,
    long: bool,
    arguments: &[String],
) -> Result<Vec<String>> {
    execute_with(toolchain, name, long, arguments, &[])
}

/// The image that holds a program, built.
///
/// # Errors
/// Where there is no such program, or it does not build.
pub fn build(toolchain: &Toolchain, name: &str) -> Result<PathBuf> {
    let bin = image_of(name)?;
    run_command(toolchain.cargo("build", LIBRARIES).args(selection(bin)).args(features(bin)))?;
    Ok(toolchain.images(profile(bin)).join(bin))
}

/// Builds several images of one feature side by side.
///
/// # Errors
/// Where one does not build.
pub fn build_all(toolchain: &Toolchain, bins: &[&str]) -> Result<()> {
    let Some(first) = bins.first() else { return Ok(()) };
    let mut command = toolchain.cargo("build", LIBRARIES);
    command.args(selection(first)).args(features(first));
    run_command(command.args(bins[1..].iter().flat_map(|bin| ["--bin", bin])))
}

/// The same as [`execute`] with further options of the emulator.
///
/// # Errors
/// As [`execute`].
pub fn execute_with(
    toolchain: &Toolchain,
    name: &str,
    long: bool,
    arguments: &[String],
    options: &[String],
) -> Result<Vec<String>> {
    let image = build(toolchain, name)?;
    let bin = image_of(name)?;
    let first = (bin == SHARED).then(|| name.to_owned());
    let arguments: Vec<String> = first.into_iter().chain(arguments.iter().cloned()).collect();
    let mut command = toolchain.cargo("run", LIBRARIES);
    command.args(selection(bin)).args(features(bin)).arg("--quiet");
    command.arg("--");
    if bin == PLANT {
        command.args(["-icount", CLOCK]);
    }
    command.args(options);
    if !arguments.is_empty() {
        command.args(["-append", &arguments.join(" ")]);
    }
    let limit = (!long).then_some(TIME_LIMIT);
    emulator::run(&mut command, &image, limit)
}

fn selection(bin: &str) -> [&str; 6] {
    ["--package", "firmware", "--profile", profile(bin), "--bin", bin]
}

fn profile(bin: &str) -> &'static str {
    if bin == LAWS { BITS } else { PROFILE }
}

/// Images that are dear to build have a feature of their name's first word.
fn features(bin: &str) -> Vec<&str> {
    let first = bin.split('-').next().unwrap_or(bin);
    if [SHARED, PLANT, HIL].contains(&bin) { Vec::new() } else { vec!["--features", first] }
}

/// Lets a command of cargo run in a project's folder, with the artefacts of the firmware.
pub fn within(command: &mut Command, toolchain: &Toolchain, project: &Path) {
    let profile = format!("profile.{PROFILE}.inherits='release'");
    command.current_dir(project).env("CARGO_TARGET_DIR", toolchain.target_dir());
    command.args(["--offline", "--profile", PROFILE, "--config", &profile]);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::command::root;

    #[test]
    fn programs_of_the_shared_image_are_those_that_it_knows() {
        let source = root().join("firmware/qemu/src/bin").join(SHARED).with_extension("rs");
        let source = std::fs::read_to_string(source).unwrap();
        let known: Vec<&str> = source
            .lines()
            .filter_map(|line| line.trim().strip_prefix('"')?.split_once("\" => Ok("))
            .map(|(name, _)| name)
            .collect();
        let shared = PROGRAMS.iter().filter(|(_, image)| *image == SHARED);
        assert_eq!(known, shared.map(|(name, _)| *name).collect::<Vec<_>>());
        assert!(image_of("audit").is_err());
    }
}
