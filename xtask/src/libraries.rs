//! `cargo xtask libraries`: the library of the FMUs for others: an older Linux, and Windows.
//!
//! `dbd-fmu => target/libraries/{libdbd_fmu.so,dbd_fmu.dll}`, each compared with the other: one program in C steps an FMU
//! with either, that of Windows under Wine, and the bits of all variables must be the same.

use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context as _, Result, bail};

use crate::chip::{Toolchain, debian};
use crate::command::{cargo, find, output, program, root, run};
use crate::python;

/// The glibc that the library for Linux asks for at most: that of CentOS 7 and manylinux2014.
const GLIBC: &str = "2.17";
pub const LINUX: &str = "x86_64-unknown-linux-gnu";
const WINDOWS: &str = "x86_64-pc-windows-gnu";
const MINGW: &str = "x86_64-w64-mingw32-gcc";
const MINGW_PACKAGE: &str = "gcc-mingw-w64-x86-64-posix";
/// Where Debian has it, which does not put it on the path.
const WINE: [&str; 2] = ["wine64", "/usr/lib/wine/wine64"];
/// Scenes that both are compared on: communication steps and how long \[s\] each is.
const COMPARED: [(&str, &str, &str); 2] =
    [("3ruu", "40", "0.005"), ("cart-pendulum", "100", "0.01")];

/// Builds both and compares them.
///
/// # Errors
/// Where a compiler is missing, building fails, a library asks for more than it may, or bits differ.
pub fn build() -> Result<()> {
    let folder = root().join("target/libraries");
    std::fs::create_dir_all(&folder).context("cannot make target/libraries")?;
    let linux = folder.join("libdbd_fmu.so");
    std::fs::copy(for_linux()?, &linux).context("cannot copy the library")?;
    is_for_older_linux(&linux)?;
    let windows = folder.join("dbd_fmu.dll");
    std::fs::copy(for_windows()?, &windows).context("cannot copy the library")?;
    let Some(wine) = WINE.iter().find(|name| find(name).is_some() || Path::new(name).is_file())
    else {
        println!("skipped: the library for Windows was not run: apt-get install wine64");
        return Ok(());
    };
    let programs = Programs::build(&folder, wine)?;
    COMPARED.iter().try_for_each(|case| programs.compare(case, &linux, &windows))
}

/// What is handed to others holds no lines and no names of ours.
fn bare(command: &mut Command) -> &mut Command {
    command
        .arg("--release")
        .env("CARGO_PROFILE_RELEASE_DEBUG", "0")
        .env("CARGO_PROFILE_RELEASE_STRIP", "symbols")
}

fn for_linux() -> Result<PathBuf> {
    let (mut command, images) = for_older_linux("cargo-zigbuild")?;
    command.arg("rustc");
    run(bare(&mut command).args(["--package", "dbd-fmu", "--lib"]).args(["--target", &target()]))?;
    Ok(images.join("libdbd_fmu.so"))
}

/// `host-sim` for the same Linux, without names of ours.
///
/// # Errors
/// Where it does not build, or asks for a newer glibc.
pub fn host_sim() -> Result<PathBuf> {
    let (mut command, images) = for_older_linux("cargo-zigbuild")?;
    command.arg("build");
    run(bare(&mut command)
        .args(["--locked", "--package", "host-sim", "--bin", "host-sim", "--features", "mcap"])
        .args(["--target", &target()]))?;
    let program = images.join("host-sim");
    is_for_older_linux(&program)?;
    Ok(program)
}

/// A program that builds for an older Linux, and where cargo puts what it builds.
///
/// # Errors
/// Where its packages cannot be had.
pub fn for_older_linux(name: &str) -> Result<(Command, PathBuf)> {
    let python = python::environment("libraries", "crates/fmu/requirements-libraries.txt")?;
    let tools = python.parent().context("the path of the interpreter has no folder")?.to_owned();
    let path = std::env::var_os("PATH").unwrap_or_default();
    let path =
        std::env::join_paths(std::iter::once(tools.clone()).chain(std::env::split_paths(&path)))?;
    let target = root().join("target/libraries/zig");
    let mut command = program(tools.join(name));
    command.env("PATH", path).env("CARGO_TARGET_DIR", &target);
    Ok((command, target.join(LINUX).join("release")))
}

fn target() -> String {
    format!("{LINUX}.{GLIBC}")
}

fn is_for_older_linux(image: &Path) -> Result<()> {
    let asked = newest_symbol(image)?;
    println!("{} requires glibc {asked}", image.display());
    if version(&asked) > version(GLIBC) {
        bail!("{} requires glibc {asked}, at most {GLIBC} is permitted", image.display());
    }
    Ok(())
}

fn for_windows() -> Result<PathBuf> {
    if find(MINGW).is_none() {
        let otherwise = "install MinGW-w64 for x86-64";
        debian::install("a linker for Windows", &[MINGW_PACKAGE], otherwise)?;
    }
    let toolchain = Toolchain::with_linker(WINDOWS, Some(MINGW.into()))?;
    println!("{}", toolchain.describe()?);
    let mut command = toolchain.cargo("rustc", "std,panic_unwind");
    run(bare(&mut command).args(["--package", "dbd-fmu", "--lib"]))?;
    Ok(toolchain.images("release").join("dbd_fmu.dll"))
}

/// The newest version of glibc that a library names.
fn newest_symbol(library: &Path) -> Result<String> {
    let symbols = output(program("objdump").arg("-T").arg(library))?;
    let versions = symbols.split("GLIBC_").skip(1).map(|rest| {
        rest.split(|c: char| !(c.is_ascii_digit() || c == '.')).next().unwrap_or_default()
    });
    versions
        .max_by_key(|text| version(text))
        .map(str::to_owned)
        .context("the library has no symbols of glibc")
}

fn version(text: &str) -> Vec<u32> {
    text.split('.').filter_map(|part| part.parse().ok()).collect()
}

/// The program that steps an FMU, for either system.
struct Programs<'w> {
    folder: PathBuf,
    wine: &'w str,
}

impl<'w> Programs<'w> {
    fn build(folder: &Path, wine: &'w str) -> Result<Self> {
        let compile = |compiler: &str, options: &[&str], source: &str, name: &str| {
            let source = format!("crates/fmu/importers/{source}");
            let mut command = program(compiler);
            run(command.args(options).args(["-O1", "-o"]).arg(folder.join(name)).arg(source))
        };
        compile("cc", &[], "run.c", "run")?;
        compile(MINGW, &[], "run.c", "run.exe")?;
        compile(MINGW, &["-shared"], "bcryptprimitives.c", "bcryptprimitives.dll")?;
        Ok(Self { folder: folder.to_owned(), wine })
    }

    fn compare(
        &self,
        (scene, steps, step): &(&str, &str, &str),
        linux: &Path,
        windows: &Path,
    ) -> Result<()> {
        let (fmu, unpacked) = (self.folder.join(format!("{scene}.fmu")), self.folder.join(scene));
        let mut make = cargo();
        make.args(["run", "--release", "--quiet", "--package", "host-sim", "--", "fmu", scene]);
        make.args(["--fmi", "3", "--library"]).arg(linux).arg("--library").arg(windows);
        output(make.arg("--out").arg(&fmu))?;
        output(program("python3").args(["-m", "zipfile", "-e"]).arg(&fmu).arg(&unpacked))?;
        let description = unpacked.join("modelDescription.xml");
        let description = std::fs::read_to_string(description).context("no model description")?;
        let token = description.split("instantiationToken=\"").nth(1);
        let token = token.and_then(|rest| rest.split('"').next()).context("no token")?;
        let variables = description.matches("<Float64 ").count().to_string();
        let resources = unpacked.join("resources");
        let drive = |path: &Path| format!("Z:{}", path.display());
        let rest = [&variables, *steps, *step];
        let here = output(
            program(self.folder.join("run")).arg(linux).args([token]).arg(&resources).args(rest),
        )?;
        let mut there = program(self.wine);
        there.arg(self.folder.join("run.exe")).arg(drive(windows)).arg(token);
        there.arg(drive(&resources)).args(rest);
        there.env("WINEPREFIX", self.folder.join("wine")).env("WINEDEBUG", "-all");
        let there = output(&mut there)?.replace('\r', "");
        if here.lines().count().to_string() != *steps || here != there {
            bail!("{scene}: the libraries for Linux and Windows give different bits");
        }
        println!("{scene}: {steps} × {variables} values, the same bits on Linux and Windows");
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn versions_are_compared_by_their_numbers() {
        assert!(version("2.17") > version("2.3.4") && version("2.34") > version("2.17"));
    }
}
