//! `cargo xtask prove`: what the tests try with a sample, over all inputs.
//!
//! `program prove => docs/results/proof.csv`. Pages show the file; a run that finds something wrong
//! writes it too and fails.

use std::process::Stdio;

use anyhow::{Context as _, Result, bail};

use crate::command::{cargo, root, shown};

/// Where the outcome is kept.
const FILE: &str = "docs/results/proof.csv";

/// The first words of the file.
const HEAD: &str = "# All inputs, or densely many; written by `cargo xtask prove`. Seconds are those of all threads \
                    together, on a machine with other work.\n";

/// Proves all, or what is named, on as many threads as there are cores, and writes the file.
///
/// # Errors
/// Where something is wrong, or the program cannot be built or the file not be written.
pub fn run(names: &[String]) -> Result<()> {
    let mut command = cargo();
    command.args(["run", "--release", "--package", "dbd-proof", "--bin", "prove", "--"]);
    command.args(names);
    let line = shown(&command);
    println!("$ {line}");
    let output = command.stderr(Stdio::inherit()).output();
    let output = output.with_context(|| format!("cannot run `{line}`"))?;
    let table = String::from_utf8(output.stdout).context("its output is not UTF-8")?;
    print!("{table}");
    if table.lines().count() < 2 {
        bail!("`{line}` ended with {} and proved nothing", output.status);
    }
    let path = root().join(FILE);
    let present = std::fs::read_to_string(&path).unwrap_or_default();
    std::fs::write(&path, merged(HEAD, &present, &table))
        .with_context(|| format!("cannot write {FILE}"))?;
    println!("written: {FILE}");
    if !output.status.success() {
        bail!("a proof failed, see above");
    }
    // What was not asked for is as old as it was.
    if names.is_empty() { crate::provenance::note(&[FILE]) } else { Ok(()) }
}

/// The file with the rows of this table in place of those of the same proofs, by the first column. A file with other
/// columns is begun anew.
pub fn merged(head: &str, present: &str, table: &str) -> String {
    let proof = |row: &str| row.split(',').next().unwrap_or_default().to_owned();
    let mut lines = table.lines();
    let header = lines.next().unwrap_or_default();
    let mut rows: Vec<&str> = lines.collect();
    let new: Vec<String> = rows.iter().map(|row| proof(row)).collect();
    let mut kept = present.lines().filter(|line| !line.starts_with('#'));
    if kept.next() == Some(header) {
        rows.extend(kept.filter(|line| !new.contains(&proof(line))));
    }
    // By proof, the rows of each as they were told.
    rows.sort_by_key(|row| proof(row));
    format!("{head}{header}\n{}\n", rows.join("\n"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_take_the_place_of_those_of_the_same_proof() {
        let first = merged(HEAD, "", "proof,of\nroot,2\nroot,1\nangle,1\n");
        let both = merged(HEAD, &first, "proof,of\nroot,3\n");
        let rows: Vec<&str> = both.lines().skip(1).collect();
        assert_eq!(rows, ["proof,of", "angle,1", "root,3"]);
        assert!(first.ends_with("proof,of\nangle,1\nroot,2\nroot,1\n"), "{first}");
        let others = merged(HEAD, &first, "proof,of,why\nroot,3,so\n");
        assert!(others.ends_with("\nproof,of,why\nroot,3,so\n"), "{others}");
    }
}
