//! The wheel of Python, for any Linux since glibc 2.17 and CPython since 3.10.
//!
//! `python/ => target/artefacts/python/*.whl`, with the wheels that it needs as a local index; a stranger installs it into
//! an empty environment without any other index.

use std::path::Path;

use anyhow::{Context as _, Result, bail};

use crate::command::{output, run};
use crate::libraries::{LINUX, for_older_linux};
use crate::release::place::only;
use crate::release::stranger::{Stranger, hash_of};

/// The distribution; its module is `dbd`.
const NAME: &str = "dbd-sim";
const ENDING: &str = ".whl";
/// What a stranger tries: a run of a scene that ships.
const SCRIPT: &str =
    "import dbd; plant = dbd.Plant('four-bar'); plant.advance_to(0.02); print(plant.hash_text)";

/// Builds the wheel and collects what it needs.
///
/// # Errors
/// Where it does not build, or a package cannot be had.
pub fn make(folder: &Path) -> Result<()> {
    let (mut maturin, _) = for_older_linux("maturin")?;
    maturin.args(["build", "--release", "--locked", "--zig", "--compatibility", "manylinux2014"]);
    maturin.args(["--target", LINUX, "--manifest-path", "python/Cargo.toml", "--out"]);
    run(maturin.arg(folder))?;
    let wheel = only(folder, ENDING)?;
    let (mut download, _) = for_older_linux("python")?;
    let quiet = ["-m", "pip", "download", "--quiet", "--disable-pip-version-check", "--dest"];
    // Into a folder of its own: it is no artefact.
    run(download.args(quiet).arg(folder.join("needed")).arg("--only-binary=:all:").arg(wheel))
}

/// Installs it from the folder alone, and compares a run with that of `host-sim`.
///
/// # Errors
/// Where it does not install, or bits differ.
pub fn try_out(folder: &Path, stranger: &Stranger) -> Result<()> {
    let place = stranger.work().join("python");
    run(stranger.command("python3").args(["-m", "venv"]).arg(&place))?;
    let python = place.join("bin/python");
    let mut install = stranger.command(&python);
    install.args(["-m", "pip", "install", "--quiet", "--disable-pip-version-check", "--no-index"]);
    run(install.arg("--find-links").arg(folder.join("needed")).arg(NAME))?;
    let found = output(stranger.command(&python).args(["-c", SCRIPT]))?;
    println!("{NAME}: four-bar after 20 ms has the hash {}", found.trim());
    let summary = stranger.work().join("out/four-bar/summary.json");
    if !summary.is_file() {
        println!("not compared: the part `crates` did not run");
        return Ok(());
    }
    let expected = hash_of(&summary).context("no run to compare with")?;
    if found.trim() != expected {
        bail!("Python has {}, host-sim {expected}", found.trim());
    }
    Ok(())
}
