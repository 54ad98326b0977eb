//! `cargo xtask precisions`: what rounding does to the energy of scenes, precision by precision.
//!
//! `example precisions of dbd-bench => docs/results/precisions.csv`, the rows of scenes that were not asked for kept.

use std::process::Stdio;

use anyhow::{Context as _, Result, bail};

use crate::command::{cargo, root, shown};
use crate::prove::merged;

/// Where the outcome is kept.
const FILE: &str = "docs/results/precisions.csv";

/// The first words of the file.
const HEAD: &str = "# Energies of long runs in every precision, written by `cargo xtask precisions`; what the columns are \
                    says docs/precision.md. Times are of a machine with other work.\n";

/// Runs all scenes, or those that are named, and writes the file.
///
/// # Errors
/// Where a run fails, or the program cannot be built or the file not be written.
pub fn run(scenes: &[String]) -> Result<()> {
    let mut command = cargo();
    command.args(["run", "--release", "--package", "dbd-bench", "--example", "precisions", "--"]);
    command.args(scenes).current_dir(root());
    let line = shown(&command);
    println!("$ {line}");
    let output = command.stderr(Stdio::inherit()).output();
    let output = output.with_context(|| format!("cannot run `{line}`"))?;
    let table = String::from_utf8(output.stdout).context("its output is not UTF-8")?;
    print!("{table}");
    if !output.status.success() || table.lines().count() < 2 {
        bail!("`{line}` ended with {}", output.status);
    }
    let path = root().join(FILE);
    let present = std::fs::read_to_string(&path).unwrap_or_default();
    std::fs::write(&path, merged(HEAD, &present, &table))
        .with_context(|| format!("cannot write {FILE}"))?;
    println!("written: {FILE}");
    // What was not asked for is as old as it was.
    if scenes.is_empty() { crate::provenance::note(&[FILE]) } else { Ok(()) }
}
