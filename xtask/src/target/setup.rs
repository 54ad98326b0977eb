//! What the target's commands need: a compiler, the emulator, tools that read images.
//!
//! `machine => toolchain`, installing what is missing where this process may.

use anyhow::{Result, bail};

use crate::command::{find, output, program};
use crate::target::Toolchain;
use crate::target::debian;

/// The target of the firmware.
pub const TARGET: &str = "thumbv7em-none-eabihf";
const EMULATOR: &str = "qemu-system-arm";
const DISASSEMBLER: &str = "arm-none-eabi-objdump";
const BINUTILS: &str = "binutils-arm-none-eabi";

/// `cargo xtask setup`.
///
/// # Errors
/// Where something is missing and cannot be installed.
pub fn run() -> Result<()> {
    complete().map(drop)
}

/// Finds or installs everything and prints what was found.
///
/// # Errors
/// Where something is missing and cannot be installed; all of it is named at once.
pub fn complete() -> Result<Toolchain> {
    let toolchain = toolchain();
    let tools = [
        tool("emulator", EMULATOR, EMULATOR, "install QEMU for Arm, version 7 or later"),
        tool("disassembler", DISASSEMBLER, BINUTILS, "install GNU binutils for arm-none-eabi"),
    ];
    let missing = toolchain.as_ref().err().into_iter();
    let missing = missing.chain(tools.iter().filter_map(|tool| tool.as_ref().err()));
    let missing: Vec<String> = missing.map(|error| format!("{error:#}")).collect();
    match toolchain {
        Ok(toolchain) if missing.is_empty() => Ok(toolchain),
        _ => bail!("{}", missing.join("\nerror: ")),
    }
}

fn toolchain() -> Result<Toolchain> {
    let toolchain = Toolchain::find(TARGET)?;
    println!("{}", toolchain.describe()?);
    Ok(toolchain)
}

fn tool(role: &str, name: &str, package: &str, otherwise: &str) -> Result<()> {
    if find(name).is_none() {
        debian::install(&format!("the {role} {name}"), &[package], otherwise)?;
    }
    let version = output(program(name).arg("--version"))?;
    println!("{role}: {}", version.lines().next().unwrap_or(name));
    Ok(())
}
