//! `cargo xtask bits`: the golden bits however the host's compiler optimises, and on other machines.
//!
//! `builds × tests => docs/results/bits.csv`. The host runs the golden tests; another machine, which
//! QEMU's user mode emulates, those of the kernel and the proofs too, and halves of runs whose other
//! halves the host takes.

use std::path::PathBuf;
use std::process::Command;

use anyhow::{Context as _, Result, bail};

use crate::bits::{host, relay};
use crate::built::{Program, build};
use crate::chip::{Toolchain, debian, firmware, setup};
use crate::command::{cargo, find, output, program, root};
use crate::playground;
use crate::steps::Steps;

/// Where the outcome is kept.
const FILE: &str = "docs/results/bits.csv";
const HEADER: &str = "build,byte_order,optimisation,hashes,tests,relayed";
/// The tables of golden bits, whose rows the test `golden` compares.
const GOLDEN: [&str; 3] =
    ["tests/bits/hashes.csv", "tests/bits/fixed.csv", "tests/bits/orientations.csv"];

/// WebAssembly, as live views run it.
const BROWSER: &str = "wasm32";

/// Levels of optimisation on the host, and flags of the compiler.
const LEVELS: [(&str, &str, &str); 6] = [
    ("opt-0", "0", ""),
    ("opt-1", "1", ""),
    ("opt-2", "2", ""),
    ("opt-3", "3", ""),
    ("opt-s", "s", ""),
    ("native", "3", "-C target-cpu=native"),
];

/// A machine that QEMU emulates, with Debian's linker and C library for it.
struct Machine {
    name: &'static str,
    byte_order: &'static str,
    target: &'static str,
    emulator: &'static str,
    /// The name of its GNU tools.
    tools: &'static str,
    packages: [&'static str; 3],
}

/// One of each byte order. s390x is not among them: QEMU 7.2 takes the first factor of its product of two
/// numbers in single precision, to double precision (MDEBR), for one in double precision.
const MACHINES: [Machine; 2] = [
    Machine {
        name: "aarch64",
        byte_order: "little",
        target: "aarch64-unknown-linux-gnu",
        emulator: "qemu-aarch64",
        tools: "aarch64-linux-gnu",
        packages: ["qemu-user", "gcc-aarch64-linux-gnu", "libc6-dev-arm64-cross"],
    },
    Machine {
        name: "powerpc64",
        byte_order: "big",
        target: "powerpc64-unknown-linux-gnu",
        emulator: "qemu-ppc64",
        tools: "powerpc64-linux-gnu",
        packages: ["qemu-user", "gcc-powerpc64-linux-gnu", "libc6-dev-ppc64-cross"],
    },
];

/// Compares all builds, or those that are named.
///
/// # Errors
/// Where one differs, a name is unknown, or a compiler or an emulator is missing and cannot be installed.
pub fn run(names: &[String]) -> Result<()> {
    let known = names_of_builds();
    if let Some(name) = names.iter().find(|name| !known.contains(&name.as_str())) {
        bail!("unknown build `{name}`; known builds: {}", known.join(", "));
    }
    let wanted = |name: &str| names.is_empty() || names.iter().any(|other| other == name);
    let (mut steps, mut rows) = (Steps::default(), Vec::new());
    for (name, level, flags) in LEVELS.into_iter().filter(|level| wanted(level.0)) {
        steps.step(&format!("golden bits: {name}"), || {
            rows.push(on_host(name, level, flags)?);
            Ok(())
        });
    }
    for machine in MACHINES.iter().filter(|machine| wanted(machine.name)) {
        steps.step(&format!("the same bits on {}", machine.name), || {
            rows.push(machine.compare()?);
            Ok(())
        });
    }
    if wanted(BROWSER) {
        steps.step("the same bits in a browser", || {
            rows.push(in_a_browser()?);
            Ok(())
        });
    }
    println!("\n{HEADER}\n{}", rows.join("\n"));
    let written = write(&rows);
    steps.finish()?;
    written?;
    // What was not asked for is as old as it was.
    if names.is_empty() {
        crate::provenance::note(&[FILE])
    } else {
        crate::provenance::keep(&[FILE])
    }
}

/// Puts rows into the file, in place of those of the same builds.
fn write(rows: &[String]) -> Result<()> {
    let path = root().join(FILE);
    let present = std::fs::read_to_string(&path).unwrap_or_default();
    std::fs::write(&path, merged(&present, rows))
        .with_context(|| format!("cannot write {FILE}"))?;
    println!("written: {FILE}");
    Ok(())
}

/// The file with these rows, in the order of the builds.
fn merged(present: &str, rows: &[String]) -> String {
    let build = |row: &str| row.split([' ', ',']).next().unwrap_or_default().to_owned();
    let mut text = format!(
        "# Golden hashes that were found equal, tests that passed and runs that changed machines half way;\n\
         # written by `cargo xtask bits`.\n{HEADER}\n"
    );
    for name in names_of_builds() {
        let of = |row: &&str| build(row) == name;
        let new = rows.iter().map(String::as_str).find(of);
        if let Some(row) = new.or_else(|| present.lines().find(of)) {
            text += row;
            text.push('\n');
        }
    }
    text
}

fn names_of_builds() -> Vec<&'static str> {
    let machines = MACHINES.iter().map(|machine| machine.name);
    LEVELS.iter().map(|level| level.0).chain(machines).chain([BROWSER]).collect()
}

/// The row of a level of optimisation.
fn on_host(name: &str, level: &str, flags: &str) -> Result<String> {
    let mut command = cargo();
    command.args(["test", "--no-run", "--release", "--package", "dbd-bits"]);
    command.env("CARGO_PROFILE_RELEASE_OPT_LEVEL", level);
    if !flags.is_empty() {
        command.env("RUSTFLAGS", flags);
    }
    let passed = run_tests(&build(&mut command)?, |path| program(path))?;
    let order = if cfg!(target_endian = "big") { "big" } else { "little" };
    let options = format!("opt-level = {level} {flags}");
    Ok(format!(
        "{name} on {},{order},{},{},{passed},",
        std::env::consts::ARCH,
        options.trim(),
        golden()?
    ))
}

/// The row of WebAssembly in Chromium, which compares all golden hashes but those of what is for comparison only.
fn in_a_browser() -> Result<String> {
    setup::browser()?;
    playground::module(playground::Speed::Full)?;
    let mut tests = cargo();
    tests.args(["test", "--no-run", "--workspace", "--all-features", "--test", "browser"]);
    let built = build(&mut tests)?;
    let found = built.iter().find(|program| program.name == "tests::browser");
    let found = found.context("the tests in a browser were not built")?;
    let mut test = Command::new(&found.path);
    test.current_dir(&found.folder).args([
        "--ignored",
        "golden_hashes_in_webassembly",
        "--nocapture",
    ]);
    let said = output(&mut test)?;
    let count = said.lines().find_map(|line| line.strip_suffix(" golden hashes equal"));
    let count = count.context("the browser compared no hashes")?;
    Ok(format!("{BROWSER} in Chromium,little,opt-level = 3,{count},1,"))
}

impl Machine {
    /// The row of this machine.
    fn compare(&self) -> Result<String> {
        let toolchain = self.toolchain()?;
        println!("{}\n{}", toolchain.describe()?, first_line(self.emulator)?);
        let libraries = "std,panic_abort,test";
        let mut tests = toolchain.cargo("test", libraries);
        tests.args(["--no-run", "--release", "--lib", "--bins", "--tests"]);
        for package in ["dbd-bits", "dbd-kernel", "dbd-proof"] {
            tests.args(["--package", package]);
        }
        let passed = run_tests(&build(&mut tests)?, |path| self.command(path))?;
        let both = ["build", "--release", "--package", "firmware", "--bin", firmware::SHARED];
        let here = host::shared(&build(cargo().args(both))?)?;
        let mut there = toolchain.cargo(both[0], libraries);
        let there = host::shared(&build(there.args(&both[1..]))?)?;
        let relayed = relay::compare_machines(
            ("host", |arguments: &[&str]| host::lines(program(&here).args(arguments))),
            (self.name, |arguments: &[&str]| host::lines(self.command(&there).args(arguments))),
        )?;
        let Self { name, byte_order, .. } = self;
        Ok(format!("{name} in QEMU,{byte_order},opt-level = 3,{},{passed},{relayed}", golden()?))
    }

    fn toolchain(&self) -> Result<Toolchain> {
        let linker = format!("{}-gcc", self.tools);
        if find(self.emulator).is_none() || find(&linker).is_none() {
            let purpose = format!("emulator or linker for {}", self.name);
            let otherwise = format!("install {} and {linker}", self.emulator);
            debian::install(&purpose, &self.packages, &otherwise)?;
        }
        let linker = find(&linker).with_context(|| format!("{linker} is not on PATH"))?;
        Toolchain::with_linker(self.target, Some(linker))
    }

    /// A program of this machine as the host runs it.
    fn command(&self, path: &PathBuf) -> Command {
        let mut command = program(self.emulator);
        command.arg("-L").arg(format!("/usr/{}", self.tools)).arg(path);
        command
    }
}

/// Runs programs of tests; how many tests passed.
fn run_tests(built: &[Program], command: impl Fn(&PathBuf) -> Command) -> Result<u32> {
    let mut passed = 0;
    for program in built.iter().filter(|program| program.tests) {
        println!("    {}", program.name);
        let text = output(command(&program.path).current_dir(&program.folder));
        let text = text.with_context(|| format!("{} failed", program.name))?;
        let counts = text.lines().filter_map(|line| line.strip_prefix("test result: ok. "));
        passed +=
            counts.filter_map(|line| line.split(' ').next()?.parse::<u32>().ok()).sum::<u32>();
    }
    if passed == 0 {
        bail!("no test was run");
    }
    Ok(passed)
}

/// How many golden hashes there are.
fn golden() -> Result<usize> {
    let rows = GOLDEN.into_iter().map(|file| {
        let text = std::fs::read_to_string(root().join(file));
        Ok(text.with_context(|| format!("cannot read {file}"))?.lines().skip(1).count())
    });
    rows.sum()
}

fn first_line(emulator: &str) -> Result<String> {
    let text = output(program(emulator).arg("--version"))?;
    Ok(text.lines().next().unwrap_or(emulator).to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_take_the_place_of_those_of_their_builds() {
        let rows = |text: &[&str]| text.iter().map(|&row| row.to_owned()).collect::<Vec<_>>();
        let first = merged("", &rows(&["powerpc64 in QEMU,big,a", "opt-0 on x86_64,little,a"]));
        let both =
            merged(&first, &rows(&["opt-0 on x86_64,little,b", "native on x86_64,little,b"]));
        let builds: Vec<&str> = both.lines().skip(3).collect();
        assert_eq!(
            builds,
            ["opt-0 on x86_64,little,b", "native on x86_64,little,b", "powerpc64 in QEMU,big,a"]
        );
    }
}
