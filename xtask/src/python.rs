//! What tools of other languages say: FMUs in their importers, the Python package in its tests.
//!
//! `requirements => virtual environment => pytest`. The environments lie in `target/python`. Where Python or its
//! packages cannot be had, the steps are skipped and say so, with what to install.

use std::path::{Path, PathBuf};

use anyhow::{Context as _, Result, bail};

use crate::built::{Program, fmu_library, host_sim};
use crate::chip::debian;
use crate::command::{find, output, program, root, run, succeeds};
use crate::steps::Steps;

/// The package's crate.
pub const CRATE: &str = "dbd-python";
/// The oldest Python of which the package is.
const OLDEST: &str = "import sys; sys.exit(sys.version_info < (3, 10))";
const PACKAGES: [&str; 2] = ["python3", "python3-venv"];
const LIBRARY: &str = "target/python/libdbd_fmu.so";
const OTHERWISE: &str = "install Python 3.10 or later with its modules venv and pip";

/// `cargo xtask python`: the steps alone.
///
/// # Errors
/// Where one of them failed.
pub fn check() -> Result<()> {
    let mut steps = Steps::default();
    add_steps(&mut steps, &[]);
    steps.finish()
}

/// Adds the steps. The command line is that of the programs that were built, else it is built.
pub fn add_steps(steps: &mut Steps, programs: &[Program]) {
    let importers = "FMUs in their importers";
    match environment("importers", "crates/fmu/importers/requirements.txt") {
        Ok(python) => steps.step(importers, || in_importers(&python, programs)),
        Err(error) => steps.skip(importers, &format!("{error:#}")),
    }
    let package = "the Python package";
    match environment("package", "python/requirements-tests.txt") {
        Ok(python) => steps.step(package, || package_tests(&python, programs)),
        Err(error) => steps.skip(package, &format!("{error:#}")),
    }
}

/// `cargo xtask setup`'s part: both environments.
///
/// # Errors
/// Where one of them cannot be made; what to install is part of the message.
pub fn set_up() -> Result<()> {
    environment("importers", "crates/fmu/importers/requirements.txt")?;
    environment("package", "python/requirements-tests.txt").map(drop)
}

/// The interpreter of a virtual environment with the packages that a file requires, made where it is not there.
///
/// # Errors
/// Where Python or its packages cannot be had; what to install is part of the message.
pub fn environment(name: &str, requirements: &str) -> Result<PathBuf> {
    let folder = root().join("target/python").join(name);
    let (python, stamp) = (folder.join("bin/python"), folder.join("requirements.txt"));
    let wanted = std::fs::read(root().join(requirements))
        .with_context(|| format!("cannot read {requirements}"))?;
    if python.is_file() && std::fs::read(&stamp).is_ok_and(|made| made == wanted) {
        return Ok(python);
    }
    if find("python3").is_none() {
        debian::install("Python", &PACKAGES, OTHERWISE)?;
    }
    if !succeeds(program("python3").args(["-c", OLDEST])) {
        bail!("python3 is older than 3.10; {OTHERWISE}");
    }
    // Debian's interpreter comes without the module that makes environments.
    if !succeeds(program("python3").args(["-c", "import ensurepip, venv"])) {
        debian::install("Python's module venv", &PACKAGES, OTHERWISE)?;
    }
    // One that was left half made says nothing of what is in it.
    let make = ["-m", "venv", "--clear"];
    output(program("python3").args(make).arg(&folder))
        .context("cannot create a virtual environment")?;
    let quiet = ["-m", "pip", "install", "--quiet", "--disable-pip-version-check", "-r"];
    println!("packages of {requirements} are installed into {}", shown(&folder));
    output(program(&python).args(quiet).arg(requirements))
        .with_context(|| format!("the packages of {requirements} cannot be installed"))?;
    std::fs::write(&stamp, wanted).with_context(|| format!("cannot write {}", stamp.display()))?;
    Ok(python)
}

fn shown(folder: &Path) -> String {
    folder.strip_prefix(root()).unwrap_or(folder).display().to_string()
}

fn in_importers(python: &Path, programs: &[Program]) -> Result<()> {
    let host_sim = host_sim(programs)?;
    // Without its symbols it is packed into dozens of archives in a fraction of the time.
    let (built, library) = (fmu_library(programs)?, root().join(LIBRARY));
    output(program("strip").arg("-o").arg(&library).arg(&built)).context("binutils are missing")?;
    let mut tests = program(python);
    tests.args(["-m", "pytest", "--quiet", "-p", "no:cacheprovider", "crates/fmu/importers"]);
    tests.env("HOST_SIM", &host_sim).env("FMU_LIBRARY", library);
    run(tests.env_remove("PYTHONPATH"))
}

/// Builds the wheel as it is published, installs it and runs its tests. [`CRATE`] is among what was built as released.
fn package_tests(python: &Path, programs: &[Program]) -> Result<()> {
    let host_sim = host_sim(programs)?;
    let wheels = root().join("target/python/wheels");
    if wheels.exists() {
        std::fs::remove_dir_all(&wheels).context("cannot remove the last wheels")?;
    }
    let mut maturin = program(python);
    maturin.args(["-m", "maturin", "build", "--release", "--locked", "--manifest-path"]);
    maturin.arg("python/Cargo.toml").arg("--interpreter").arg(python).arg("--out").arg(&wheels);
    run(&mut maturin)?;
    let wheel = std::fs::read_dir(&wheels)?.filter_map(Result::ok).map(|entry| entry.path());
    let wheel = wheel.into_iter().find(|path| path.extension().is_some_and(|end| end == "whl"));
    let wheel = wheel.context("no wheel was built")?;
    let install = ["-m", "pip", "install", "--quiet", "--force-reinstall", "--no-deps"];
    run(program(python).args(install).arg(&wheel))?;
    let mut tests = program(python);
    tests.args(["-m", "pytest", "--quiet", "-p", "no:cacheprovider", "python/tests"]);
    run(tests.env("HOST_SIM", host_sim).env_remove("PYTHONPATH"))
}
