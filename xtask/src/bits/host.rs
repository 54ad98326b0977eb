//! The host's programs whose bits the target's are compared with.
//!
//! `programs as tested, programs as released => paths => lines`. What steps is not optimised in the tests' build and has
//! every check; a release's is compiled for the long tests alone, as the golden tables are compared in release, too.

use std::path::PathBuf;
use std::process::Command;

use anyhow::{Context as _, Result};

use crate::built::Program;
use crate::chip::firmware;
use crate::command::{output, program};

/// The programs of the firmware, for this machine.
pub struct Host {
    checked: PathBuf,
    released: Option<PathBuf>,
    plant: PathBuf,
}

impl Host {
    /// Takes the programs from those of the tests' build and those of the release.
    ///
    /// # Errors
    /// Where they are not there.
    pub fn new(tests: &[Program], release: &[Program]) -> Result<Self> {
        Ok(Self { checked: shared(tests)?, released: shared(release).ok(), plant: plant(release)? })
    }

    /// The program of controllers with their plants, optimised.
    pub fn plant(&self) -> &PathBuf {
        &self.plant
    }

    /// Lines of a program as tested.
    ///
    /// # Errors
    /// Where it fails.
    pub fn checked(&self, arguments: &[&str]) -> Result<Vec<String>> {
        lines(program(&self.checked).args(arguments))
    }

    /// Lines of a program as released, where it was built.
    ///
    /// # Errors
    /// Where it fails.
    pub fn released(&self, arguments: &[&str]) -> Result<Option<Vec<String>>> {
        let released = self.released.as_ref();
        released.map(|released| lines(program(released).args(arguments))).transpose()
    }
}

/// The program that holds the others, among those that were built.
///
/// # Errors
/// Where it is not among them.
pub fn shared(built: &[Program]) -> Result<PathBuf> {
    named(built, firmware::SHARED)
}

/// The program of controllers with their plants, among those that were built.
///
/// # Errors
/// Where it is not among them.
pub fn plant(built: &[Program]) -> Result<PathBuf> {
    named(built, firmware::PLANT)
}

fn named(built: &[Program], name: &str) -> Result<PathBuf> {
    let name = format!("qemu::{name}");
    let program = built.iter().find(|program| program.name == name && !program.tests);
    Ok(program.with_context(|| format!("cargo did not build {name}"))?.path.clone())
}

/// What a program prints.
///
/// # Errors
/// Where it fails.
pub fn lines(command: &mut Command) -> Result<Vec<String>> {
    let text = output(command)?;
    Ok(text.lines().map(str::to_owned).collect())
}
