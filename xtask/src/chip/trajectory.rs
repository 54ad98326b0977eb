//! A run that the target records is the one that the PC records.
//!
//! `program trajectory => lines; golden file of the same run => equal, or the first line that differs`. The tests hold the
//! golden file against a run on the host.

use std::fs;

use anyhow::{Context as _, Result, bail};

use crate::chip::{Toolchain, firmware};
use crate::command::root;

/// The run, recorded on a PC.
const GOLDEN: &str = "tests/dynamics/trajectories/four-bar.golden";

/// Compares what the target records with the golden file.
///
/// # Errors
/// Where the program fails or a line differs.
pub fn compare(toolchain: &Toolchain) -> Result<()> {
    let golden = fs::read_to_string(root().join(GOLDEN));
    let golden = golden.with_context(|| format!("cannot read {GOLDEN}"))?;
    check(&firmware::execute(toolchain, "trajectory", false, &[])?, &golden)
}

fn check(lines: &[String], golden: &str) -> Result<()> {
    let count = golden.lines().count();
    let pairs = golden.lines().zip(lines).enumerate();
    if let Some((row, (wanted, found))) = pairs.into_iter().find(|(_, (a, b))| a != b) {
        bail!("line {} differs from {GOLDEN}:\n{found}\nthe PC's is\n{wanted}", row + 1);
    }
    if lines.len() != count {
        bail!("the target recorded {} lines, {GOLDEN} has {count}", lines.len());
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn another_line_and_a_missing_one_are_found() {
        let lines = |text: &str| text.lines().map(str::to_owned).collect::<Vec<_>>();
        assert!(check(&lines("a\nb\n"), "a\nb\n").is_ok());
        let said = |text: &str| check(&lines(text), "a\nb\n").unwrap_err().to_string();
        assert!(
            said("a\nc\n")
                .starts_with("line 2 differs from tests/dynamics/trajectories/four-bar.golden")
        );
        assert!(said("a\n").starts_with("the target recorded 1 lines"));
    }
}
