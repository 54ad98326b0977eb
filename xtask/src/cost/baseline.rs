//! The sample that is counted before a change is kept, against docs/costs-baseline.csv.
//!
//! `program sample in QEMU, baseline of this compiler => verdict`. Counts differ from compiler to
//! compiler: each has rows of its own. For a compiler without rows the figures are shown and not
//! judged.

use anyhow::{Context as _, Result, bail};

use crate::command::root;
use crate::target::{Toolchain, firmware};

use super::row::Cost;

const FILE: &str = "docs/costs-baseline.csv";
const HEADER: &str = "compiler,scene,scheme,precision,instructions_mean";
/// A count may lie this part of the baseline's beside it.
const BAND: f64 = 0.02;

/// A row of the file.
#[derive(Clone, Debug, PartialEq)]
struct Row {
    compiler: String,
    /// Scene, scheme and precision.
    name: String,
    mean: u64,
}

/// Counts the sample and compares it with the baseline.
///
/// # Errors
/// Where counting fails, a count is outside the band, or rows are missing.
pub fn check(toolchain: &Toolchain) -> Result<()> {
    let compiler = toolchain.describe_compiler()?;
    let counted = rows(&compiler, &sample(toolchain)?);
    let text = std::fs::read_to_string(root().join(FILE));
    let baseline = read(&text.with_context(|| format!("cannot read {FILE}"))?)?;
    judge(&compiler, &baseline, &counted)
}

/// Counts the sample and writes it as the baseline of this compiler, beside those of others.
///
/// # Errors
/// Where counting, reading or writing fails.
pub fn write(toolchain: &Toolchain) -> Result<()> {
    let compiler = toolchain.describe_compiler()?;
    let counted = rows(&compiler, &sample(toolchain)?);
    let file = root().join(FILE);
    let mut all = match std::fs::read_to_string(&file) {
        Ok(text) => read(&text)?,
        Err(_) => Vec::new(),
    };
    all.retain(|row| row.compiler != compiler);
    all.extend(counted);
    std::fs::write(&file, csv(&all)).with_context(|| format!("cannot write {FILE}"))?;
    println!("written: {FILE}, rows of {compiler}");
    Ok(())
}

fn sample(toolchain: &Toolchain) -> Result<Vec<Cost>> {
    let lines = firmware::execute(toolchain, "sample", false, &[])?;
    super::parse(&lines)
}

fn rows(compiler: &str, costs: &[Cost]) -> Vec<Row> {
    let row =
        |cost: &Cost| Row { compiler: compiler.to_owned(), name: cost.name(), mean: cost.mean };
    costs.iter().map(row).collect()
}

fn judge(compiler: &str, baseline: &[Row], counted: &[Row]) -> Result<()> {
    let own: Vec<&Row> = baseline.iter().filter(|row| row.compiler == compiler).collect();
    if own.is_empty() {
        println!("\n{:<50} {:>9}", "scene scheme precision", "now");
        counted.iter().for_each(|row| println!("{:<50} {:>9}", row.name, row.mean));
        println!("{FILE} has no rows of {compiler}: the counts are shown, not judged");
        return Ok(());
    }
    println!("\n{:<50} {:>9} {:>9} {:>9}", "scene scheme precision", "baseline", "now", "change");
    let mut outside = Vec::new();
    for row in counted {
        let Some(known) = own.iter().find(|known| known.name == row.name) else {
            outside.push(format!("{} has no baseline", row.name));
            continue;
        };
        let change = row.mean as f64 / known.mean.max(1) as f64 - 1.0;
        println!("{:<50} {:>9} {:>9} {:>+7.2} %", row.name, known.mean, row.mean, 100.0 * change);
        if change.abs() > BAND {
            outside.push(format!("{} changed by {:+.2} %", row.name, 100.0 * change));
        }
    }
    let counted_too = |known: &&Row| counted.iter().any(|row| row.name == known.name);
    let missing = own.iter().filter(|known| !counted_too(known));
    outside.extend(missing.map(|known| format!("{} was not counted", known.name)));
    if !outside.is_empty() {
        bail!("{} (where it is meant to be so: cargo xtask cost --baseline)", outside.join("; "));
    }
    println!("all within ±{:.0} % of the baseline of {compiler}", 100.0 * BAND);
    Ok(())
}

fn csv(rows: &[Row]) -> String {
    let mut text = format!("{HEADER}\n");
    for row in rows {
        text += &format!("{},{},{}\n", row.compiler, row.name.replace(' ', ","), row.mean);
    }
    text
}

fn read(text: &str) -> Result<Vec<Row>> {
    if text.lines().next() != Some(HEADER) {
        bail!("{FILE} has another header");
    }
    let row = |line: &str| {
        let columns: Vec<&str> = line.split(',').collect();
        let [compiler, scene, scheme, precision, mean] = columns[..] else { return None };
        let name = format!("{scene} {scheme} {precision}");
        Some(Row { compiler: compiler.to_owned(), name, mean: mean.parse().ok()? })
    };
    let lines = text.lines().skip(1);
    lines.map(|line| row(line).with_context(|| format!("{FILE}: `{line}`"))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rows(compiler: &str, means: [u64; 2]) -> Vec<Row> {
        let names = ["four-bar dbd+1 f32", "gripper leapfrog f32"];
        let row = |(name, mean): (&str, u64)| Row {
            compiler: compiler.to_owned(),
            name: name.to_owned(),
            mean,
        };
        names.into_iter().zip(means).map(row).collect()
    }

    #[test]
    fn a_count_stays_in_its_band() {
        let baseline = rows("rustc 1.96.0", [10_000, 50_000]);
        let judge = |means| judge("rustc 1.96.0", &baseline, &rows("rustc 1.96.0", means));
        assert!(judge([10_190, 49_010]).is_ok());
        assert!(judge([10_210, 50_000]).is_err());
        assert!(judge([10_000, 48_990]).is_err());
    }

    #[test]
    fn a_row_too_few_or_too_many_is_an_error() {
        let both = rows("rustc 1.96.0", [10_000, 50_000]);
        assert!(judge("rustc 1.96.0", &both, &both[..1]).is_err());
        assert!(judge("rustc 1.96.0", &both[..1], &both).is_err());
    }

    #[test]
    fn a_compiler_without_rows_is_not_judged() {
        let baseline = rows("rustc 1.95.0", [10_000, 50_000]);
        assert!(judge("rustc 1.96.0", &baseline, &rows("rustc 1.96.0", [1, 2])).is_ok());
    }

    #[test]
    fn the_file_reads_back() {
        let rows = rows("rustc 1.96.0 (debian)", [10_000, 50_000]);
        assert_eq!(read(&csv(&rows)).unwrap(), rows);
        assert!(read("scene\n").is_err());
        assert!(read(&format!("{HEADER}\na,b,c,d\n")).is_err());
    }
}
