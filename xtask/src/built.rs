//! Programs and shared libraries as cargo builds them for the host.
//!
//! `cargo's arguments => programs, with their tests or without`. What compiles is shown as it comes.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use anyhow::{Context as _, Result, bail};
use serde_json::Value;

use crate::command::{cargo, shown};

/// A program that was built.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Program {
    /// `PACKAGE` for a library's tests, else `PACKAGE::TARGET`.
    pub name: String,
    /// Whether it is a program of tests.
    pub tests: bool,
    /// The file.
    pub path: PathBuf,
    /// Its package's folder, in which its tests run.
    pub folder: PathBuf,
}

/// Runs a cargo command that builds and returns the programs.
///
/// # Errors
/// Where it fails or says what is not understood.
pub fn build(command: &mut Command) -> Result<Vec<Program>> {
    let line = shown(command);
    println!("$ {line}");
    command.args(["--message-format", "json-render-diagnostics"]).stderr(Stdio::inherit());
    let output = command.output().with_context(|| format!("cannot run `{line}`"))?;
    if !output.status.success() {
        bail!("`{line}` ended with {}", output.status);
    }
    programs(&String::from_utf8_lossy(&output.stdout))
}

/// The command line: that of the programs that were built, else it is built.
///
/// # Errors
/// Where it does not build.
pub fn host_sim(programs: &[Program]) -> Result<PathBuf> {
    let is_it = |program: &&Program| program.name == "host-sim::host-sim" && !program.tests;
    if let Some(program) = programs.iter().find(is_it) {
        return Ok(program.path.clone());
    }
    let built = build(cargo().args(["build", "--package", "host-sim", "--bin", "host-sim"]))?;
    let found = built.iter().find(is_it).context("`host-sim` was not built")?;
    Ok(found.path.clone())
}

/// The library that an FMU holds: that of the programs that were built, else it is built.
///
/// # Errors
/// Where it does not build.
pub fn fmu_library(programs: &[Program]) -> Result<PathBuf> {
    let is_it = |program: &&Program| program.name == "fmu" && !program.tests;
    if let Some(library) = programs.iter().find(is_it) {
        return Ok(library.path.clone());
    }
    let built = build(cargo().args(["build", "--package", "dbd-fmu", "--lib"]))?;
    Ok(built.iter().find(is_it).context("`dbd-fmu` was not built")?.path.clone())
}

/// The programs in cargo's messages.
fn programs(messages: &str) -> Result<Vec<Program>> {
    let mut programs = Vec::new();
    for line in messages.lines().filter(|line| line.starts_with('{')) {
        let message: Value = serde_json::from_str(line).context("cargo printed no JSON")?;
        let Some(path) = message["executable"].as_str().or_else(|| library(&message)) else {
            continue;
        };
        let program = program(&message, path);
        programs.push(program.with_context(|| format!("incomplete message from cargo: {line}"))?);
    }
    Ok(programs)
}

/// The shared library among a target's files.
fn library(message: &Value) -> Option<&str> {
    let own = message["target"]["crate_types"].as_array()?.iter().any(|kind| kind == "cdylib");
    let mut files = message["filenames"].as_array()?.iter().filter_map(Value::as_str);
    files.find(|file| own && file.ends_with(".so"))
}

fn program(message: &Value, path: &str) -> Option<Program> {
    let folder = Path::new(message["manifest_path"].as_str()?).parent()?;
    let package = folder.file_name()?.to_str()?;
    let target = message["target"]["name"].as_str()?;
    let kind = message["target"]["kind"][0].as_str()?;
    let name = if kind == "lib" { package.to_owned() } else { format!("{package}::{target}") };
    Some(Program {
        name,
        tests: message["profile"]["test"].as_bool()?,
        path: path.into(),
        folder: folder.into(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const MESSAGES: &str = r#"
{"reason":"compiler-artifact","manifest_path":"/r/kernel/Cargo.toml","target":{"kind":["lib"],"name":"dbd_kernel"},"profile":{"test":false},"executable":null}
{"reason":"compiler-artifact","manifest_path":"/r/kernel/Cargo.toml","target":{"kind":["lib"],"name":"dbd_kernel"},"profile":{"test":true},"executable":"/t/dbd_kernel-1"}
{"reason":"compiler-artifact","manifest_path":"/r/tests/Cargo.toml","target":{"kind":["test"],"name":"golden"},"profile":{"test":true},"executable":"/t/golden-2"}
{"reason":"compiler-artifact","manifest_path":"/r/firmware/Cargo.toml","target":{"kind":["bin"],"name":"programs"},"profile":{"test":false},"executable":"/t/programs"}
{"reason":"compiler-artifact","manifest_path":"/r/fmu/Cargo.toml","target":{"kind":["lib","cdylib"],"crate_types":["lib","cdylib"],"name":"dbd_fmu"},"profile":{"test":false},"filenames":["/t/libdbd_fmu.rlib","/t/libdbd_fmu.so"],"executable":null}
{"reason":"build-finished","success":true}
"#;

    #[test]
    fn programs_are_read_from_cargos_messages() {
        let programs = programs(MESSAGES).unwrap();
        let names: Vec<(&str, bool)> =
            programs.iter().map(|program| (program.name.as_str(), program.tests)).collect();
        assert_eq!(
            names,
            [
                ("kernel", true),
                ("tests::golden", true),
                ("firmware::programs", false),
                ("fmu", false)
            ]
        );
        assert_eq!(fmu_library(&programs).unwrap(), Path::new("/t/libdbd_fmu.so"));
        assert_eq!(programs[1].folder, Path::new("/r/tests"));
        assert_eq!(programs[1].path, Path::new("/t/golden-2"));
    }

    #[test]
    fn a_message_without_its_parts_is_an_error() {
        assert!(super::programs("{\"executable\":\"/t/x\"}").is_err());
        assert!(super::programs("{no").is_err());
    }
}
