//! The host's programs whose bits the target's are compared with.
//!
//! Optimised as a release and not at all: with the target's, three levels of optimisation.

use std::path::PathBuf;
use std::process::Command;

use anyhow::{Context as _, Result};

use crate::built::{Program, build};
use crate::chip::firmware;
use crate::command::{cargo, output, program};

/// The same programs twice.
pub struct Host {
    release: PathBuf,
    plant: PathBuf,
    unoptimised: PathBuf,
}

impl Host {
    /// Takes the release's programs from those that were built, and builds the others.
    ///
    /// # Errors
    /// Where they are not there or do not build.
    pub fn new(built: &[Program]) -> Result<Self> {
        let unoptimised = build(
            cargo()
                .args(["build", "--package", "firmware", "--bin", firmware::SHARED])
                .env("CARGO_PROFILE_DEV_OPT_LEVEL", "0"),
        )?;
        let plant = plant(built)?;
        Ok(Self { release: shared(built)?, plant, unoptimised: shared(&unoptimised)? })
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

    /// Lines of a program, not optimised.
    ///
    /// # Errors
    /// Where it fails.
    pub fn unoptimised(&self, arguments: &[&str]) -> Result<Vec<String>> {
        lines(program(&self.unoptimised).args(arguments))
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
