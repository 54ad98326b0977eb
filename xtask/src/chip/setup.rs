//! What the target's commands need: a compiler, the emulator, tools that read images; the tests' browser.
//!
//! `machine => toolchain`, installing what is missing where this process may.

use anyhow::{Result, bail};

use crate::chip::Toolchain;
use crate::chip::debian;
use crate::command::{find, output, program};

/// The target of the firmware.
pub const TARGET: &str = "thumbv7em-none-eabihf";
/// What runs its images.
pub const EMULATOR: &str = "qemu-system-arm";
/// What compiles C for it.
pub const C_COMPILER: &str = "arm-none-eabi-gcc";
const C_PACKAGE: &str = "gcc-arm-none-eabi";
const DISASSEMBLER: &str = "arm-none-eabi-objdump";
const BINUTILS: &str = "binutils-arm-none-eabi";
const BROWSERS: [&str; 4] = ["chromium", "chromium-browser", "google-chrome", "chrome"];

/// `cargo xtask setup`.
///
/// # Errors
/// Where something is missing and cannot be installed.
pub fn run() -> Result<()> {
    let target = complete().map(drop);
    let browser = browser();
    target.and(browser)
}

/// Finds or installs the browser that shows reports in the tests, and prints its version.
///
/// # Errors
/// If it is missing and cannot be installed.
pub fn browser() -> Result<()> {
    // What the tests look for, in their order.
    let other = BROWSERS.into_iter().find(|name| find(name).is_some());
    let otherwise = "install Chromium or Chrome on PATH";
    tool("browser", other.unwrap_or(BROWSERS[0]), BROWSERS[0], otherwise)
}

/// Finds or installs what counts the host's instructions, and prints its version.
///
/// # Errors
/// If it is missing and cannot be installed.
pub fn counter() -> Result<()> {
    tool("counter of instructions", "valgrind", "valgrind", "install valgrind")
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
        tool("C compiler", C_COMPILER, C_PACKAGE, "install GCC for arm-none-eabi"),
        counter(),
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

/// Finds or installs a program and prints its version.
///
/// # Errors
/// If it is missing and cannot be installed.
pub fn tool(role: &str, name: &str, package: &str, otherwise: &str) -> Result<()> {
    if find(name).is_none() {
        debian::install(&format!("the {role} {name}"), &[package], otherwise)?;
    }
    let version = output(program(name).arg("--version"))?;
    println!("{role}: {}", version.lines().next().unwrap_or(name));
    Ok(())
}
