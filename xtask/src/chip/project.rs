//! New projects of a scene, as their owner meets them: written, run in QEMU, tested on the PC; one with a controller.
//!
//! `host-sim new firmware => image, test`. It is built beside the firmware, with its compiler, its
//! profile and its lock file, so that what both depend on is compiled once.

use std::fs;
use std::path::{Path, PathBuf};

use anyhow::{Context as _, Result, bail};

use crate::built::{Program, host_sim};
use crate::chip::firmware::{LIBRARIES, within};
use crate::chip::{Toolchain, c_project, cores};
use crate::command::{program, root, run};

const NAME: &str = "new-project";
/// What its golden test says of the first line that differs.
const DIFFERENCE: &str = "steps and hash: the first that differ";

/// Writes a project, compares what it prints on the target with its golden bits, and, where it is asked
/// for, tests it here, which compiles its build script's crates once more. The command line is that of the
/// programs that were built, else it is built.
///
/// # Errors
/// Where a step of it fails, bits differ, or a planted difference is not found.
pub fn check(toolchain: &Toolchain, here: bool, programs: &[Program]) -> Result<()> {
    let host_sim = host_sim(programs)?;
    // Not below the repository, whose .cargo/config.toml cargo would add to the project's.
    let folder = std::env::temp_dir().join(format!("dbd-{NAME}-{}", std::process::id()));
    fs::create_dir_all(&folder)?;
    let first = cores::written(&host_sim, &folder.join(NAME), SCENE, &[]);
    let controlled = CONTROLLED.map(|machine| machine.written(&host_sim, &folder));
    let checked = std::iter::once(first).chain(controlled).try_for_each(|project| {
        let project = project?;
        on_the_target(toolchain, &project)?;
        if here { on_the_pc(toolchain, &project) } else { Ok(()) }
    });
    let checked = checked.and_then(|()| match of_the_notebook(&folder)? {
        Some(project) => on_the_target(toolchain, &project),
        None => {
            println!(
                "skipped the notebook's project: the tests of the Python package did not write it"
            );
            Ok(())
        }
    });
    let checked = checked.and_then(|()| cores::check(&host_sim, &folder));
    let checked = checked.and_then(|()| c_project::check(toolchain, &folder, &host_sim, here));
    fs::remove_dir_all(&folder)?;
    checked
}

/// A mechanism with a drive, friction and stops: laws have their bits on the target, too.
const SCENE: &str = "docs/examples/gate-opener/gate-opener.toml";

/// A mechanism with its controller, in a folder of the examples: a scene, two source files, and the golden bits of
/// its run on the PC.
struct Controlled {
    name: &'static str,
    /// The type of its plant.
    plant: &'static str,
    /// Lines of the scene that drive its input without a controller.
    table: &'static [&'static str],
    /// Options of its project.
    options: &'static [&'static str],
}

const CONTROLLED: [Controlled; 2] = [
    Controlled { name: "balance-robot", plant: "BalanceRobot", table: &[], options: &[] },
    Controlled {
        name: "gate-opener",
        plant: "GateOpener",
        table: &["table = ", "interpolate = "],
        // At rest without its controller, the gate would be given fixed point.
        options: &["--precision", "f32"],
    },
];

impl Controlled {
    /// The project with its controller, as the cookbook says.
    fn written(&self, host_sim: &Path, folder: &Path) -> Result<PathBuf> {
        let own = root().join("docs/examples").join(self.name);
        let text = fs::read_to_string(own.join(format!("{}.toml", self.name)))?;
        let kept = text.lines().filter(|line| !self.table.iter().any(|key| line.starts_with(key)));
        let scene = folder.join(format!("{}.toml", self.name));
        fs::write(&scene, kept.map(|line| format!("{line}\n")).collect::<String>())?;
        let project = folder.join(format!("{}-controlled", self.name));
        let project = cores::written(host_sim, &project, &scene.to_string_lossy(), self.options)?;
        let copy = |file: &str, to: &str| fs::copy(own.join(file), project.join(to));
        copy("control.rs", "src/control.rs")?;
        copy("controller.rs", "src/controller.rs")?;
        copy("golden.txt", "tests/golden.txt")?;
        let file = project.join("src/lib.rs");
        let source = fs::read_to_string(&file)?;
        let function = format!("pub fn control(_plant: &mut {}Plant) {{}}", self.plant);
        if !source.contains(&function) {
            bail!("{} does not have `{function}`", file.display());
        }
        let own = "mod control;\npub mod controller;\npub use control::control;";
        fs::write(&file, source.replace(&function, own))?;
        Ok(project)
    }
}

/// The project that the notebook of the Python package has written, with the golden bits of its run in Python; `None`
/// where its test did not run.
fn of_the_notebook(folder: &Path) -> Result<Option<PathBuf>> {
    let written = root().join("target/python/notebook/chip");
    if !written.is_dir() {
        return Ok(None);
    }
    let project = folder.join("notebook");
    run(program("cp").arg("-r").arg(&written).arg(&project))?;
    fs::copy(root().join("Cargo.lock"), project.join("Cargo.lock"))?;
    Ok(Some(project))
}

fn on_the_target(toolchain: &Toolchain, project: &Path) -> Result<()> {
    let mut command = toolchain.cargo("run", LIBRARIES);
    within(&mut command, toolchain, project);
    cores::compare(command, project)
}

fn on_the_pc(toolchain: &Toolchain, project: &Path) -> Result<()> {
    let test = || {
        let mut command = toolchain.host_cargo("test");
        within(&mut command, toolchain, project);
        command.args(["--quiet", "--test", "golden"]);
        command
    };
    run(&mut test())?;
    // A test that finds nothing proves nothing.
    let file = project.join("tests/golden.txt");
    let golden = fs::read_to_string(&file)?;
    fs::write(&file, golden.replacen("10 ", "10 0", 1))?;
    // The test says on its standard output what it found.
    let found = test().output();
    fs::write(&file, golden)?;
    let found = found.context("cannot run cargo")?;
    let said = String::from_utf8_lossy(&found.stdout);
    if found.status.success() || !said.contains(DIFFERENCE) {
        bail!("the golden test does not name a planted difference: {said}");
    }
    Ok(())
}
