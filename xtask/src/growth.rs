//! `cargo xtask growth`: how the work of looking at a scene grows with its bodies.
//!
//! `program growth of dbd-plant below valgrind's callgrind => instructions per way and size, exponents`. Counted,
//! not timed: the same figures on a busy machine. What is held against every joint for every body
//! has the exponent 2, and shows from a few hundred bodies on.

use std::fmt::Write as _;

use anyhow::{Context as _, Result, bail};

use crate::built::{Program, build};
use crate::callgrind;
use crate::chip::setup;
use crate::command::{cargo, root};

/// The program, as cargo's messages name it.
const PROGRAM: &str = "plant::growth";
/// What it does once per way.
const WAYS: [&str; 3] = ["load", "check", "run"];
/// Links of the chains.
const SIZES: [u64; 4] = [10, 100, 1_000, 10_000];
/// Those of the step of `cargo xtask test`.
const FEW: [u64; 2] = [80, 320];
/// No exponent may be above: longer names and the ends of a chain make 0.01 of it. A hundred
/// instructions for each pair of bodies come to 1.04 and more at the few sizes.
const MAX: f64 = 1.03;
const FILE: &str = "docs/results/growth.csv";

/// Instructions of a way, by size.
struct Row {
    way: &'static str,
    counts: Vec<u64>,
}

/// Counts all sizes and writes docs/results/growth.csv.
///
/// # Errors
/// Where valgrind is missing, building, counting or writing fails, or an exponent is above its limit.
pub fn run() -> Result<()> {
    setup::counter()?;
    let options = ["build", "--release", "--package", "dbd-plant", "--example", "growth"];
    let rows = rows(&build(cargo().args(options))?, &SIZES)?;
    println!("\n{}", table(&rows, &SIZES));
    std::fs::write(root().join(FILE), csv(&rows))
        .with_context(|| format!("cannot write {FILE}"))?;
    println!("written: {FILE}");
    crate::provenance::note(&[FILE])?;
    check_growth(&rows, &SIZES)
}

/// The step of `cargo xtask test`: two small sizes, of a program that the tests' build has built.
///
/// # Errors
/// Where counting fails or an exponent is above its limit.
pub fn check(built: &[Program]) -> Result<()> {
    setup::counter()?;
    let rows = rows(built, &FEW)?;
    println!("{}", table(&rows, &FEW));
    check_growth(&rows, &FEW)
}

fn rows(built: &[Program], sizes: &[u64]) -> Result<Vec<Row>> {
    let program = built.iter().find(|program| program.name == PROGRAM && !program.tests);
    let program = program.with_context(|| format!("`{PROGRAM}` was not built"))?;
    let row = |way: &'static str| {
        let counts = sizes.iter().map(|size| {
            callgrind::count(&program.path, "*counted_work*", &[way, &size.to_string()])
        });
        Ok(Row { way, counts: counts.collect::<Result<_>>()? })
    };
    WAYS.into_iter().map(row).collect()
}

/// How the counts grow from size to size: `log(count ratio)/log(size ratio)`.
fn exponents(counts: &[u64], sizes: &[u64]) -> Vec<f64> {
    let log = |pair: &[u64]| (pair[1] as f64 / pair[0] as f64).ln();
    counts
        .windows(2)
        .zip(sizes.windows(2))
        .map(|(counts, sizes)| log(counts) / log(sizes))
        .collect()
}

/// The last two sizes tell: at first what is paid once per scene hides the growth.
fn check_growth(rows: &[Row], sizes: &[u64]) -> Result<()> {
    let above = rows.iter().filter_map(|row| {
        let last = exponents(&row.counts, sizes).last().copied()?;
        (last > MAX).then(|| format!("{} grows with the exponent {last:.2}", row.way))
    });
    let above: Vec<String> = above.collect();
    if !above.is_empty() {
        bail!("{}; at most {MAX} is linear", above.join(", "));
    }
    println!("all exponents are at most {MAX}");
    Ok(())
}

fn table(rows: &[Row], sizes: &[u64]) -> String {
    let mut text = format!("{:<12}", "bodies");
    sizes.iter().for_each(|size| text += &format!("{size:>16}"));
    text += "  exponents\n";
    for row in rows {
        let _ = write!(text, "{:<12}", row.way);
        row.counts.iter().for_each(|count| text += &format!("{count:>16}"));
        let exponents = exponents(&row.counts, sizes).into_iter().map(|e| format!("{e:.2}"));
        let _ = writeln!(text, "  {}", exponents.collect::<Vec<_>>().join(" "));
    }
    text
}

fn csv(rows: &[Row]) -> String {
    let mut text = String::from(
        "# Instructions (x86-64, release) of looking at a chain; written by `cargo xtask growth`.\n\
         way,bodies,instructions\n",
    );
    for row in rows {
        for (size, count) in SIZES.iter().zip(&row.counts) {
            let _ = writeln!(text, "{},{size},{count}", row.way);
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_quadratic_is_refused() {
        let row = |counts: [u64; 2]| [Row { way: "load", counts: counts.to_vec() }];
        assert!(check_growth(&row([1_000, 4_100]), &FEW).is_ok());
        assert!(check_growth(&row([1_000, 4_300]), &FEW).is_err());
        assert!(check_growth(&row([1_000, 16_000]), &FEW).is_err());
        assert_eq!(exponents(&[10, 100, 10_000], &[10, 100, 1_000]), [1.0, 2.0]);
    }
}
