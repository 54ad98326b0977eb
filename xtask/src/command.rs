//! Running other programs: what was run is shown, and a failure names it.
//!
//! `program, arguments => exit status | output`. All programs run in the repository's root.

use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use anyhow::{Context as _, Result, bail};

/// Where everything is built once and nobody steps through it: nothing is kept for a second build or for a
/// backtrace, and a crate is cut into fewer parts, each of which has its own copy of what is generic.
/// `dbd-plant`, optimised and checked as ever, then takes 58 CPU seconds instead of 105.
///
/// An image for the target is linked in half of the time without what a debugger reads of it; its code is
/// the same.
const ONCE: [(&str, &str); 5] = [
    ("CARGO_INCREMENTAL", "0"),
    ("CARGO_PROFILE_DEV_CODEGEN_UNITS", "4"),
    ("CARGO_PROFILE_DEV_DEBUG", "0"),
    ("CARGO_PROFILE_RELEASE_DEBUG", "0"),
    ("CARGO_PROFILE_FIRMWARE_DEBUG", "0"),
];

/// The repository's root.
pub fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().expect("xtask lies in the repository's root")
}

/// The cargo that runs this program.
pub fn cargo() -> Command {
    cargo_at(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()))
}

/// A cargo at a path.
pub fn cargo_at(path: impl AsRef<OsStr>) -> Command {
    let mut cargo = program(path);
    if builds_once() {
        cargo.envs(ONCE);
    }
    cargo
}

/// Whether everything is built once, see [`ONCE`].
pub fn builds_once() -> bool {
    ["CI", "DBD_ONCE"].iter().any(|name| std::env::var_os(name).is_some())
}

/// A cargo that builds everything once.
pub fn cargo_once() -> Command {
    let mut cargo = cargo();
    cargo.envs(ONCE);
    cargo
}

/// A program that will run in the repository's root.
pub fn program(name: impl AsRef<OsStr>) -> Command {
    let mut command = Command::new(name);
    command.current_dir(root()).stdin(Stdio::null());
    command
}

/// Runs to the end with output to the terminal.
///
/// # Errors
/// Where the program is missing or does not end with success.
pub fn run(command: &mut Command) -> Result<()> {
    let line = shown(command);
    println!("$ {line}");
    let status = command.status().with_context(|| format!("cannot run `{line}`"))?;
    if !status.success() {
        bail!("`{line}` ended with {status}");
    }
    Ok(())
}

/// Runs to the end and returns what it printed.
///
/// # Errors
/// Where the program is missing or does not end with success; its error output is part of it.
pub fn output(command: &mut Command) -> Result<String> {
    let line = shown(command);
    let output = command.output().with_context(|| format!("cannot run `{line}`"))?;
    if !output.status.success() {
        let stderr = String::from_utf8_lossy(&output.stderr);
        bail!("`{line}` ended with {}\n{}", output.status, stderr.trim_end());
    }
    Ok(String::from_utf8_lossy(&output.stdout).into_owned())
}

/// Whether the program exists and ends with success; prints nothing.
pub fn succeeds(command: &mut Command) -> bool {
    command.stdout(Stdio::null()).stderr(Stdio::null()).status().is_ok_and(|s| s.success())
}

/// The first file of this name on PATH.
pub fn find(name: &str) -> Option<PathBuf> {
    let path = std::env::var_os("PATH")?;
    std::env::split_paths(&path).map(|dir| dir.join(name)).find(|file| file.is_file())
}

/// Where cargo puts what it builds.
pub fn target_dir() -> PathBuf {
    let named = std::env::var_os("CARGO_TARGET_DIR");
    named.map_or_else(|| root().join("target"), |dir| root().join(dir))
}

/// The command as one would type it.
pub fn shown(command: &Command) -> String {
    let program = Path::new(command.get_program());
    let name = program.file_name().unwrap_or(program.as_os_str());
    std::iter::once(name)
        .chain(command.get_args())
        .map(OsStr::to_string_lossy)
        .collect::<Vec<_>>()
        .join(" ")
}
