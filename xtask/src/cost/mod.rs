//! `cargo xtask cost`: instructions and memory of a step, as docs/costs.csv and a table.
//!
//! `program cost in QEMU, image of the audit => rows`. Instructions, plant, model and stack are
//! measured by the program; `.text` is the code that the step reaches, with its literals, known for
//! the steps that the audit links. Which scenes with which values: `firmware/qemu/build.rs`; which schemes and
//! dampings: `firmware/qemu/src/chart.rs`.

pub mod baseline;
mod compare;
pub mod cores;
mod cycles;
pub mod elements;
pub mod guards;
mod mix;
mod row;
mod table;

use anyhow::{Context as _, Result, bail};

use crate::audit::{Image, Root};
use crate::chip::{Toolchain, firmware, setup};
use crate::command::root;
use crate::provenance;

use mix::Mix;
use row::Cost;

const FILE: &str = "docs/costs.csv";

/// `cargo xtask cost [--compare] [SCENE…]`.
///
/// # Errors
/// Where a scene is unknown, building, running or writing fails, or a compared count rose.
pub fn run(scenes: &[String], compare: bool) -> Result<()> {
    let toolchain = setup::complete()?;
    let file = root().join(FILE);
    let (costs, mixes) = measure(&toolchain)?;
    for scene in scenes {
        if !costs.iter().any(|cost| cost.scene == *scene) {
            let mut known: Vec<&str> = costs.iter().map(|cost| cost.scene.as_str()).collect();
            known.sort_unstable();
            known.dedup();
            bail!("unknown scene `{scene}`; known scenes: {}", known.join(", "));
        }
    }
    println!("\n{}", table::table(&costs, &mixes, scenes));
    if compare {
        let before = std::fs::read_to_string(&file).with_context(|| format!("cannot read {FILE}"));
        return compare::compare(&row::read(&before?)?, &costs);
    }
    std::fs::write(&file, row::csv(&costs)).with_context(|| format!("cannot write {FILE}"))?;
    println!("written: {FILE}");
    mix::write(&toolchain, &costs, &mixes)?;
    baseline::write(&toolchain)?;
    provenance::note(&[FILE, mix::FILE])
}

/// `cargo xtask cost --baseline`.
///
/// # Errors
/// Where building, running or writing fails.
pub fn baseline() -> Result<()> {
    baseline::write(&setup::complete()?)
}

fn measure(toolchain: &Toolchain) -> Result<(Vec<Cost>, Vec<Mix>)> {
    let image = Image::read(&firmware::build_audit(toolchain)?)?;
    let (mut costs, mixes) = mix::measure(toolchain)?;
    for cost in &mut costs {
        // A Newton iteration more is a number, not code.
        let scheme = cost.scheme.split('+').next().unwrap_or_default();
        let root = Root::step(&cost.scene, scheme, &cost.precision);
        let reach = image.reach(&root.symbol()).ok();
        cost.text = reach.map(|reach| reach.iter().map(|function| function.size).sum());
    }
    if !costs.iter().any(|cost| cost.text.is_some()) {
        bail!("the program reported no step of the audit's");
    }
    Ok((costs, mixes))
}
