//! What the target's commands need: a compiler, the emulator, tools that read images.
//!
//! `machine => toolchain`, installing what is missing where this process may.

use anyhow::Result;

use crate::command::{find, output, program};
use crate::debian;
use crate::toolchain::Toolchain;

/// The target of the firmware.
pub const TARGET: &str = "thumbv7em-none-eabihf";
const EMULATOR: &str = "qemu-system-arm";
const DISASSEMBLER: &str = "arm-none-eabi-objdump";

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
/// Where something is missing and cannot be installed.
pub fn complete() -> Result<Toolchain> {
    let toolchain = toolchain()?;
    need(EMULATOR, "qemu-system-arm", "install QEMU for Arm, version 7 or later")?;
    let version = output(program(EMULATOR).arg("--version"))?;
    println!("emulator: {}", version.lines().next().unwrap_or(EMULATOR));
    need(DISASSEMBLER, "binutils-arm-none-eabi", "install GNU binutils for arm-none-eabi")?;
    let version = output(program(DISASSEMBLER).arg("--version"))?;
    println!("disassembler: {}", version.lines().next().unwrap_or(DISASSEMBLER));
    Ok(toolchain)
}

fn toolchain() -> Result<Toolchain> {
    let toolchain = Toolchain::find(TARGET)?;
    println!("{}", toolchain.describe()?);
    Ok(toolchain)
}

fn need(tool: &str, package: &str, otherwise: &str) -> Result<()> {
    if find(tool).is_some() {
        return Ok(());
    }
    debian::install(tool, &[package], otherwise)
}
