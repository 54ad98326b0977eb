//! The wheels of Python, for any Linux since glibc 2.17: one for CPython since 3.10, one for CPython without its global lock.
//!
//! `python/ => target/artefacts/python/*.whl`, with the wheels that it needs as a local index; a stranger installs it into
//! an empty environment without any other index.

use std::ffi::OsStr;
use std::path::Path;

use anyhow::Result;

use crate::command::{find, output, run};
use crate::libraries::{LINUX, for_older_linux};
use crate::release::place::only;
use crate::release::stranger::Stranger;

/// The distribution; its module is `dbd`.
const NAME: &str = "dbd-sim";
const ENDING: &str = ".whl";
/// The interpreter without a global lock. Its stable interface is another one, so it needs a wheel of its own.
const FREE_THREADED: &str = "python3.14t";
/// What a stranger tries: a run of a scene that ships, and the same in lanes.
const SCRIPT: &str = "import dbd; plant = dbd.Plant('four-bar'); many = [plant.copy() for _ in range(8)]; \
                      plant.advance_to(0.02); dbd.rollouts(many, 1, plant.steps, threads=1); \
                      assert {each.hash for each in many} == {plant.hash}; print(plant.hash_text)";

/// Builds the wheel and collects what it needs.
///
/// # Errors
/// Where it does not build, or a package cannot be had.
pub fn make(folder: &Path) -> Result<()> {
    build(folder, &[])?;
    let wheel = only(folder, ENDING)?;
    let (mut download, _) = for_older_linux("python")?;
    let quiet = ["-m", "pip", "download", "--quiet", "--disable-pip-version-check", "--dest"];
    // Into a folder of its own: it is no artefact.
    run(download.args(quiet).arg(folder.join("needed")).arg("--only-binary=:all:").arg(wheel))?;
    build(folder, &["--interpreter", FREE_THREADED])
}

fn build(folder: &Path, interpreter: &[&str]) -> Result<()> {
    let (mut maturin, _) = for_older_linux("maturin")?;
    maturin.args(["build", "--release", "--locked", "--zig", "--compatibility", "manylinux2014"]);
    maturin.args(["--target", LINUX, "--manifest-path", "python/Cargo.toml"]).args(interpreter);
    maturin.args(["--features", "lanes"]);
    run(maturin.arg("--out").arg(folder))
}

/// Installs the first from the folder alone, and compares a run with that of `host-sim`; the other one likewise, with the
/// packages of the public index, where its interpreter is there.
///
/// # Errors
/// Where it does not install, or bits differ.
pub fn try_out(folder: &Path, stranger: &Stranger) -> Result<()> {
    let needed = folder.join("needed");
    installed(
        stranger,
        "python3",
        &["--no-index".as_ref(), "--find-links".as_ref(), needed.as_os_str()],
    )?;
    if find(FREE_THREADED).is_none() {
        println!("the wheel for {FREE_THREADED} was not tried: there is no such interpreter");
        return Ok(());
    }
    installed(stranger, FREE_THREADED, &["--find-links".as_ref(), folder.as_os_str()])
}

fn installed(stranger: &Stranger, interpreter: &str, from: &[&OsStr]) -> Result<()> {
    let place = stranger.work().join(interpreter);
    run(stranger.command(interpreter).args(["-m", "venv"]).arg(&place))?;
    let python = place.join("bin/python");
    let quiet = ["-m", "pip", "install", "--quiet", "--disable-pip-version-check"];
    run(stranger.command(&python).args(quiet).args(from).arg(NAME))?;
    let found = output(stranger.command(&python).args(["-c", SCRIPT]))?;
    stranger.compare(&format!("{NAME} in {interpreter}"), found.trim())
}
