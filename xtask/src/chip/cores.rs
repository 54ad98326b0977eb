//! Projects for other cores, as their owner meets them: written, run in QEMU, a step counted.
//!
//! `host-sim new firmware --core => bits, instructions`. They are built beside the firmware, with its profile.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context as _, Result, bail};

use crate::chip::firmware::{LIBRARIES, PROFILE};
use crate::chip::{Toolchain, setup};
use crate::command::{output, program, root, run, shown};

/// A core of `host-sim new firmware`.
pub struct Core {
    /// As the option `--core` has it.
    pub name: &'static str,
    /// Its class in `host-sim advise`.
    pub mcu: &'static str,
    target: &'static str,
    emulator: [&'static str; 2],
}

const ARM: [&str; 2] = [setup::EMULATOR, setup::EMULATOR];
const RISCV: [&str; 2] = ["qemu-system-riscv32", "qemu-system-misc"];

/// All of them, the firmware's first.
pub const CORES: [Core; 5] = [
    Core { name: "cortex-m4f", mcu: "cortex-m4f", target: setup::TARGET, emulator: ARM },
    Core { name: "cortex-m7", mcu: "cortex-m7-double", target: setup::TARGET, emulator: ARM },
    Core {
        name: "cortex-m33",
        mcu: "cortex-m33",
        target: "thumbv8m.main-none-eabihf",
        emulator: ARM,
    },
    Core {
        name: "rv32imafc",
        mcu: "rv32imafc",
        target: "riscv32imafc-unknown-none-elf",
        emulator: RISCV,
    },
    Core {
        name: "cortex-m0plus",
        mcu: "cortex-m0plus",
        target: "thumbv6m-none-eabi",
        emulator: ARM,
    },
];

/// A scene, and for each core a precision that it has in hardware with the most instructions that a step may take.
const SCENE: &str = "scenes/hexagon.toml";
const CHECKED: [(&str, &str, u64); 3] =
    [("cortex-m7", "f64", 5_500), ("cortex-m33", "f32", 4_000), ("rv32imafc", "f32", 4_500)];

/// What the program `cost` prints before the mean, and before the maximum.
const COUNTED: [&str; 2] = ["mean ", "most "];

/// The bits of each core are those of the PC, and a step takes its FPU.
///
/// # Errors
/// Where a project does not build, its bits differ, or a step takes more instructions than an FPU's.
pub fn check(host_sim: &Path, folder: &Path) -> Result<()> {
    for (name, precision, most) in CHECKED {
        let core = CORES.iter().find(|core| core.name == name).context("an unknown core")?;
        let toolchain = core.toolchain()?;
        let options = ["--precision", precision, "--scheme", "leapfrog"];
        let project = core.written(host_sim, folder, SCENE, &options)?;
        compare(core.command(&toolchain, &project), &project)?;
        let [mean, _] = core.count(&toolchain, &project)?;
        println!("{name}, {precision}: {mean} instructions");
        if mean > most {
            bail!("a step takes {mean} instructions, more than {most}: not by the FPU alone");
        }
    }
    Ok(())
}

impl Core {
    /// Its compiler, with its emulator installed.
    ///
    /// # Errors
    /// Where one is missing and cannot be installed.
    pub fn toolchain(&self) -> Result<Toolchain> {
        let [emulator, package] = self.emulator;
        setup::tool("emulator", emulator, package, "install QEMU for it, version 7 or later")?;
        Toolchain::find(self.target)
    }

    /// The project of a scene for it, in a folder.
    ///
    /// # Errors
    /// Where it cannot be written.
    pub fn written(
        &self,
        host_sim: &Path,
        folder: &Path,
        scene: &str,
        options: &[&str],
    ) -> Result<PathBuf> {
        let options: Vec<&str> = options.iter().copied().chain(["--core", self.name]).collect();
        written(host_sim, &folder.join(self.name), scene, &options)
    }

    /// Instructions of a step, mean and maximum.
    ///
    /// # Errors
    /// Where the program does not build or run.
    pub fn count(&self, toolchain: &Toolchain, project: &Path) -> Result<[u64; 2]> {
        let printed = output(self.command(toolchain, project).args(["--bin", "cost"]))?;
        let number = |before: &str| -> Result<u64> {
            let (_, rest) = printed.split_once(before).context("no count of instructions")?;
            let digits: String = rest.chars().take_while(char::is_ascii_digit).collect();
            Ok(digits.parse()?)
        };
        Ok([number(COUNTED[0])?, number(COUNTED[1])?])
    }

    /// `cargo run` in a project. Start-up crates that this repository does not use are resolved there.
    fn command(&self, toolchain: &Toolchain, project: &Path) -> Command {
        let mut command = toolchain.cargo("run", LIBRARIES);
        command.current_dir(project).env("CARGO_TARGET_DIR", toolchain.target_dir());
        let profile = format!("profile.{PROFILE}.inherits='release'");
        command.args(["--profile", PROFILE, "--config", &profile]);
        command
    }
}

/// A project in a folder, with the versions that the repository's lock file names.
///
/// # Errors
/// Where it cannot be written.
pub fn written(host_sim: &Path, project: &Path, scene: &str, options: &[&str]) -> Result<PathBuf> {
    run(program(host_sim)
        .args(["new", "firmware"])
        .arg(project)
        .arg("--scene")
        .arg(root().join(scene))
        .args(options))?;
    fs::copy(root().join("Cargo.lock"), project.join("Cargo.lock"))?;
    Ok(project.to_owned())
}

/// What a command prints is a project's golden bits.
///
/// # Errors
/// Where it fails or bits differ.
pub fn compare(mut command: Command, project: &Path) -> Result<()> {
    println!("$ {}", shown(&command));
    let printed = output(&mut command)?;
    let golden = fs::read_to_string(project.join("tests/golden.txt"))?;
    let expected = format!("{golden}status: ok\n");
    if printed != expected {
        bail!("the target printed\n{printed}the golden bits are\n{expected}");
    }
    println!("{printed}");
    Ok(())
}
