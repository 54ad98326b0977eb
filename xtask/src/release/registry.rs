//! The crates as packages, and a folder of all packages in place of the public registry.
//!
//! `packages, dependencies of the lock file => target/artefacts/registry` (a directory source of cargo). From it a
//! stranger installs `host-sim` and builds a firmware project that names versions only.

use std::fs;
use std::path::Path;

use anyhow::{Context as _, Result, bail};

use crate::chip::firmware::LIBRARIES;
use crate::chip::setup;
use crate::command::{cargo, output, program, run, target_dir};
use crate::packages;
use crate::release::place::{emptied, folder};
use crate::release::stranger::{Stranger, hash_of};

/// The packages and their dependencies, unpacked.
const REGISTRY: &str = "registry";

/// Makes all packages, and the folder that replaces the registry.
///
/// # Errors
/// Where a package is incomplete or refused.
pub fn make(crates: &Path) -> Result<()> {
    packages::check()?;
    let registry = emptied(REGISTRY)?;
    let mut vendor = cargo();
    vendor.args(["vendor", "--locked", "--versioned-dirs"]).arg(&registry);
    // What cargo builds for the target needs packages of its own.
    if let Some(library) = setup::complete()?.library_manifest()? {
        vendor.arg("--sync").arg(library).env("RUSTC_BOOTSTRAP", "1");
    }
    output(&mut vendor)?;
    for (name, version) in packages::published()? {
        let file = format!("{name}-{version}.crate");
        let package = target_dir().join("package").join(&file);
        fs::copy(&package, crates.join(&file)).with_context(|| format!("no package {file}"))?;
        run(program("tar").arg("-xzf").arg(&package).arg("-C").arg(&registry))?;
        // No file is checked: the package itself was made here.
        let checksum = registry.join(format!("{name}-{version}")).join(".cargo-checksum.json");
        fs::write(checksum, "{\"files\":{}}")?;
    }
    Ok(())
}

/// Makes the stranger's cargo take the folder for the public registry.
fn settle(stranger: &Stranger) -> Result<()> {
    let home = stranger.cargo_home();
    fs::create_dir_all(&home)?;
    let settings = format!(
        "[source.crates-io]\nreplace-with = \"artefacts\"\n[source.artefacts]\ndirectory = {:?}\n",
        folder(REGISTRY)?.to_string_lossy()
    );
    fs::write(home.join("config.toml"), settings).context("cannot write cargo's settings")
}

/// `cargo install host-sim`, and a run with it. Without optimisation: what is tried is that it builds.
///
/// # Errors
/// Where it does not build from its packages, or its run differs from that of the repository.
pub fn install(stranger: &Stranger) -> Result<()> {
    settle(stranger)?;
    let mut install = stranger.command("cargo");
    run(install.args(["install", "--quiet", "--debug", "host-sim"]))?;
    let host_sim = stranger.cargo_home().join("bin/host-sim");
    run(stranger.command(host_sim).args(["run", "four-bar", "--duration", "20ms", "--quiet"]))?;
    let found = hash_of(&stranger.work().join("out/four-bar/summary.json"))?;
    stranger.compare("cargo install host-sim", &found)
}

/// A firmware project that depends on the packages by version: its golden bits here and in QEMU.
///
/// # Errors
/// Where it does not build, or bits differ.
pub fn firmware(stranger: &Stranger) -> Result<()> {
    let toolchain = setup::complete()?;
    let host_sim = stranger.cargo_home().join("bin/host-sim");
    let new = ["new", "firmware", "gate", "--scene", "cart-pendulum", "--registry"];
    run(stranger.command(host_sim).args(new))?;
    let project = stranger.work().join("gate");
    let manifest = fs::read_to_string(project.join("Cargo.toml"))?;
    if manifest.contains("path = ") || manifest.contains("git = ") {
        bail!("the project depends on sources, not on packages:\n{manifest}");
    }
    run(stranger.command("cargo").args(["test", "--quiet"]).current_dir(&project))?;
    let mut target = toolchain.cargo("run", LIBRARIES);
    target.current_dir(&project).arg("--release").env("CARGO_HOME", stranger.cargo_home());
    target.env("CARGO_TARGET_DIR", stranger.work().join("target"));
    let printed = output(&mut target)?;
    let golden = fs::read_to_string(project.join("tests/golden.txt"))?;
    if printed != format!("{golden}status: ok\n") {
        bail!("the target printed\n{printed}the golden bits are\n{golden}");
    }
    println!("{printed}the packages give the golden bits here and on the target");
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::command::root;

    #[test]
    fn the_settings_name_one_source() {
        let stranger = Stranger::new().unwrap();
        settle(&stranger).unwrap();
        let text = fs::read_to_string(stranger.cargo_home().join("config.toml")).unwrap();
        let directory = root().join("target/artefacts/registry");
        assert!(
            text.contains("replace-with") && text.contains(directory.to_str().unwrap()),
            "{text}"
        );
    }
}
