//! `cargo xtask prove`: what the tests try with a sample, over all inputs.
//!
//! `program prove => docs/results/proof.csv`. Pages show the file; a run that finds something wrong
//! writes it too and fails.

use std::process::Stdio;

use anyhow::{Context as _, Result, bail};

use crate::command::{cargo, root, shown};

/// Where the outcome is kept.
const FILE: &str = "docs/results/proof.csv";

/// Proves, on as many threads as there are cores, and writes the file.
///
/// # Errors
/// Where something is wrong, or the program cannot be built or the file not be written.
pub fn run() -> Result<()> {
    let mut command = cargo();
    command.args(["run", "--release", "--package", "dbd-proof", "--bin", "prove"]);
    let line = shown(&command);
    println!("$ {line}");
    let output = command.stderr(Stdio::inherit()).output();
    let output = output.with_context(|| format!("cannot run `{line}`"))?;
    let table = String::from_utf8(output.stdout).context("its lines are no text")?;
    if table.lines().count() < 2 {
        bail!("`{line}` ended with {} and proved nothing", output.status);
    }
    let head = "# All inputs, or densely many; written by `cargo xtask prove`. Seconds are those of all \
                cores together.\n";
    std::fs::write(root().join(FILE), head.to_owned() + &table)
        .with_context(|| format!("cannot write {FILE}"))?;
    println!("{table}written: {FILE}");
    if !output.status.success() {
        bail!("something is wrong, see above");
    }
    Ok(())
}
