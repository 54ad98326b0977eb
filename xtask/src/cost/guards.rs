//! `cargo xtask cost --guards`: instructions of guards, as docs/results/guards.csv.
//!
//! `program guards in QEMU => rows`. One row per model and scheme of the sample.

use anyhow::{Context as _, Result, bail};

use crate::chip::{firmware, setup};
use crate::command::root;

const FILE: &str = "docs/results/guards.csv";

/// The file's first lines, with the compiler between them.
const HEADER: &str = "scene,scheme,precision,step,every_step,look_mean,look_most,look_at_energy";

/// Counts and writes the file.
///
/// # Errors
/// Where building, running or writing fails, or the program tells nothing.
pub fn run() -> Result<()> {
    let toolchain = setup::complete()?;
    let rows = rows(&firmware::execute(&toolchain, "guards", false, &[])?)?;
    let head = format!(
        "# Instructions on a Cortex-M4F; written by `cargo xtask cost --guards`, {}.\n",
        toolchain.describe_compiler()?
    );
    std::fs::write(root().join(FILE), format!("{head}{HEADER}\n{}\n", rows.join("\n")))
        .with_context(|| format!("cannot write {FILE}"))?;
    println!("written: {FILE}");
    crate::provenance::note(&[FILE])
}

/// Lines `guard SCENE SCHEME PRECISION` and five counts, as rows.
fn rows(lines: &[String]) -> Result<Vec<String>> {
    let mut rows = Vec::new();
    for line in lines {
        let Some(words) = line.strip_prefix("guard ") else { continue };
        let columns: Vec<&str> = words.split_whitespace().collect();
        let counted = columns.iter().skip(3).all(|count| count.parse::<u64>().is_ok());
        if columns.len() != HEADER.split(',').count() || !counted {
            bail!("cannot read `{line}`");
        }
        rows.push(columns.join(","));
    }
    if rows.is_empty() {
        bail!("the program counted no guard");
    }
    Ok(rows)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_becomes_a_row_or_is_refused() {
        let rows = |line: &str| rows(&[line.to_owned()]);
        assert_eq!(rows("guard a b f32 1 2 3 4 5").unwrap(), ["a,b,f32,1,2,3,4,5"]);
        assert!(rows("guard a b f32 1 2 3 4").is_err());
        assert!(rows("guard a b f32 1 2 x 4 5").is_err());
        assert!(rows("cost a").is_err());
    }
}
