//! A new project for C of a scene, as its owner meets it: written, linked by a C compiler, run in QEMU.
//!
//! `host-sim new c => library; library, C => image => golden bits, every function of the header`. The library is built
//! beside the firmware, as the Rust project is.

use std::fs;
use std::path::{Path, PathBuf};

use anyhow::{Result, bail};

use crate::chip::firmware::within;
use crate::chip::{Toolchain, firmware, setup};
use crate::command::{output, program, root, run, shown};

/// The project, whose functions the test of the interface calls.
const NAME: &str = "cart-for-c";
const LIBRARY: &str = "libcart_for_c.a";
/// A program that calls every function.
const INTERFACE: &str = "xtask/src/chip/interface.c";
const CHECKED: &str = "every function as its header says\n";
/// As the project's Makefile.
const COMPILER_OPTIONS: [&str; 11] = [
    "-std=c99",
    "-O2",
    "-Wall",
    "-Wextra",
    "-Werror",
    "-mcpu=cortex-m4",
    "-mthumb",
    "-mfpu=fpv4-sp-d16",
    "-mfloat-abi=hard",
    "-ffreestanding",
    "-nostdlib",
];
const EMULATOR_OPTIONS: [&str; 12] = [
    "-M",
    "mps2-an386",
    "-display",
    "none",
    "-monitor",
    "none",
    "-serial",
    "null",
    "-semihosting-config",
    "enable=on,target=native",
    "-icount",
    "shift=6",
];

/// Writes a project below a folder and runs its program and one of the whole interface on the target; where it is asked
/// for, `make test` on the PC, which compiles its build script's crates once more.
///
/// # Errors
/// Where a step of it fails, or bits differ.
pub fn check(toolchain: &Toolchain, folder: &Path, host_sim: &Path, here: bool) -> Result<()> {
    let project = folder.join(NAME);
    run(program(host_sim).args(["new", "c"]).arg(&project))?;
    fs::copy(root().join("Cargo.lock"), project.join("Cargo.lock"))?;
    let mut build = toolchain.cargo("build", firmware::LIBRARIES);
    within(&mut build, toolchain, &project);
    run(&mut build)?;
    let golden = fs::read_to_string(project.join("golden.txt"))?;
    for (source, expected) in
        [(project.join("example/main.c"), golden.as_str()), (root().join(INTERFACE), CHECKED)]
    {
        let image = linked(toolchain, &project, &source)?;
        let mut emulator = program(setup::EMULATOR);
        emulator.args(EMULATOR_OPTIONS).arg("-kernel").arg(image);
        println!("$ {}", shown(&emulator));
        let printed = output(&mut emulator)?;
        if printed != expected {
            bail!("the target printed\n{printed}and must print\n{expected}");
        }
        println!("{printed}");
    }
    if here {
        run(program("make").arg("test").current_dir(&project))?;
    }
    Ok(())
}

/// An image of a C program and the project's library.
fn linked(toolchain: &Toolchain, project: &Path, source: &Path) -> Result<PathBuf> {
    let image = project.join("image.elf");
    let mut compiler = program(setup::C_COMPILER);
    compiler.args(COMPILER_OPTIONS).arg("-Wl,--gc-sections").arg("-I");
    compiler.arg(project.join("include")).arg("-T").arg(project.join("example/board.ld"));
    compiler.arg(source).arg(project.join("example/board.c"));
    compiler.arg(toolchain.images(firmware::PROFILE).join(LIBRARY)).arg("-o").arg(&image);
    run(&mut compiler)?;
    Ok(image)
}
