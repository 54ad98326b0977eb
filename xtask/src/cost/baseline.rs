//! The sample that is counted before a change is kept, against docs/costs-baseline.csv.
//!
//! `program sample in QEMU, baseline of this compiler => verdict`.

use anyhow::Result;

use crate::baseline::{Baseline, Count, Key};
use crate::chip::{Toolchain, firmware};

const FILE: Baseline = Baseline {
    file: "docs/costs-baseline.csv",
    names: "scene,scheme,precision",
    command: "cargo xtask cost --baseline",
};

/// Counts the sample and compares it with the baseline.
///
/// # Errors
/// Where counting fails, a count is outside the band, or rows are missing.
pub fn check(toolchain: &Toolchain) -> Result<()> {
    FILE.check(&key(toolchain)?, &sample(toolchain)?)
}

/// Counts the sample and writes it as the baseline of this compiler, beside those of others.
///
/// # Errors
/// Where counting, reading or writing fails.
pub fn write(toolchain: &Toolchain) -> Result<()> {
    FILE.write(&key(toolchain)?, &sample(toolchain)?)
}

fn key(toolchain: &Toolchain) -> Result<Key> {
    Ok(Key { compiler: toolchain.describe_compiler()?, target: toolchain.target().to_owned() })
}

fn sample(toolchain: &Toolchain) -> Result<Vec<Count>> {
    let costs = super::row::parse(&firmware::execute(toolchain, "sample", false, &[])?)?;
    Ok(costs.iter().map(|cost| (cost.name(), cost.mean)).collect())
}
