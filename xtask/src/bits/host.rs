//! The host's programs whose bits the target's are compared with.
//!
//! Optimised as a release and as the tests are, where a step is not at all: with the target's, three levels of optimisation.

use std::path::PathBuf;
use std::process::Command;

use anyhow::{Context as _, Result};

use crate::built::Program;
use crate::chip::firmware;
use crate::command::{output, program};

/// The same programs twice.
pub struct Host {
    release: PathBuf,
    plant: PathBuf,
    tested: PathBuf,
}

impl Host {
    /// Takes them from the programs that were built as released, and with the tests.
    ///
    /// # Errors
    /// Where they are not there.
    pub fn new(released: &[Program], tested: &[Program]) -> Result<Self> {
        let (release, plant) = (shared(released)?, plant(released)?);
        Ok(Self { release, plant, tested: shared(tested)? })
    }

    /// The program of controllers with their plants, optimised.
    pub fn plant(&self) -> &PathBuf {
        &self.plant
    }

    /// Lines of a program, optimised.
    ///
    /// # Errors
    /// Where it fails.
    pub fn released(&self, arguments: &[&str]) -> Result<Vec<String>> {
        lines(program(&self.release).args(arguments))
    }

    /// Lines of a program, built with the tests.
    ///
    /// # Errors
    /// Where it fails.
    pub fn tested(&self, arguments: &[&str]) -> Result<Vec<String>> {
        lines(program(&self.tested).args(arguments))
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
    Ok(program.with_context(|| format!("{name} was not built"))?.path.clone())
}

/// What a program prints.
///
/// # Errors
/// Where it fails.
pub fn lines(command: &mut Command) -> Result<Vec<String>> {
    let text = output(command)?;
    Ok(text.lines().map(str::to_owned).collect())
}
