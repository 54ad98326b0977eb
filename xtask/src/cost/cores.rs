//! `cargo xtask cost --cores`: instructions of a step on each core, as docs/results/cores.csv.
//!
//! `scenes × cores × precisions => rows`, each from a project of `host-sim new firmware` that runs in QEMU.

use std::fmt::Write as _;

use anyhow::{Context as _, Result};

use crate::built::host_sim;
use crate::chip::cores::CORES;
use crate::chip::setup;
use crate::command::root;

const FILE: &str = "docs/results/cores.csv";
const SCENES: [&str; 6] =
    ["four-bar", "hexagon", "3rrr", "double-wishbone", "macpherson", "delta-pick-and-place"];
const PRECISIONS: [&str; 3] = ["f32", "fixed", "f64"];

/// Counts and writes the file.
///
/// # Errors
/// Where building, running or writing fails.
pub fn run() -> Result<()> {
    let compiler = setup::complete()?.describe_compiler()?;
    let host_sim = host_sim(&[])?;
    let folder = std::env::temp_dir().join(format!("dbd-cores-{}", std::process::id()));
    let mut text = format!(
        "# Instructions of a step of leapfrog in projects of `host-sim new firmware --core`; written by `cargo xtask cost \
         --cores`, {compiler}.\nscene,core,mcu,precision,instructions_mean,instructions_max\n"
    );
    for core in &CORES {
        let toolchain = core.toolchain()?;
        for (scene, precision) in SCENES.iter().flat_map(|one| PRECISIONS.map(|two| (one, two))) {
            let below = folder.join(format!("{scene}-{precision}"));
            let options = ["--scheme", "leapfrog", "--damping", "sweeps", "--precision", precision];
            std::fs::create_dir_all(&below)?;
            let project =
                core.written(&host_sim, &below, &format!("scenes/{scene}.toml"), &options)?;
            let [mean, most] = core.count(&toolchain, &project)?;
            println!("{scene} {} {precision}: {mean}", core.name);
            writeln!(text, "{scene},{},{},{precision},{mean},{most}", core.name, core.mcu)?;
        }
    }
    std::fs::remove_dir_all(&folder)?;
    std::fs::write(root().join(FILE), text).with_context(|| format!("cannot write {FILE}"))?;
    println!("written: {FILE}");
    crate::provenance::note(&[FILE])
}
