//! CPU time that the compiler takes for each crate, held to a budget.
//!
//! `build, this program around each call of the compiler => seconds per crate => verdict`. Two builds have budgets: the
//! README's first command, and the tests' programs, whose times every full test shows. Seconds are a machine's and an
//! hour's; judged is a crate's time over that of all crates from the registry together, which change with `Cargo.lock`
//! alone.

use std::collections::BTreeMap;
use std::ffi::OsString;
use std::fmt::Write as _;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};

use anyhow::{Context as _, Result, bail};

use crate::built::{Program, build};
use crate::command::{builds_once, cargo, cargo_once, output, program, root, target_dir};

/// Where each call of the compiler leaves a line; it makes this program the compiler's wrapper.
const LOG: &str = "DBD_COMPILE_LOG";
const FILE: &str = "xtask/compile-times.csv";
/// A crate may take so many times its budget before the step fails: parts of it are as noisy as the machine.
const MAX: f64 = 1.3;
/// Shares below this are noise.
const LEAST: f64 = 0.02;
/// Ticks of a second in `/proc`, on every Linux that has a port of Rust's.
const TICKS: f64 = 100.0;

/// The compiler's exit code, where cargo called this program in place of the compiler.
pub fn wrapped() -> Option<ExitCode> {
    let log = std::env::var_os(LOG)?;
    let arguments: Vec<OsString> = std::env::args_os().skip(1).collect();
    let (compiler, rest) = arguments.split_first()?;
    let status = match Command::new(compiler).args(rest).status() {
        Ok(status) => status,
        Err(error) => {
            eprintln!("cannot run {}: {error}", compiler.display());
            return Some(ExitCode::FAILURE);
        }
    };
    let stat = std::fs::read_to_string("/proc/self/stat").unwrap_or_default();
    let name = std::env::var("CARGO_PKG_NAME").unwrap_or_default();
    let folder = std::env::var_os("CARGO_MANIFEST_DIR").unwrap_or_default();
    let own = Path::new(&folder).starts_with(root());
    // Where cargo asks what the compiler is, no crate is compiled.
    let compiles =
        rest.iter().any(|word| word == "--emit" || word.to_string_lossy().starts_with("--emit="));
    if let (Some(seconds), true) = (of_children(&stat), compiles) {
        let line = format!("{},{seconds}\n", if own { &name } else { REGISTRY });
        let file = std::fs::OpenOptions::new().append(true).create(true).open(log);
        // A line that is lost shows as a crate that was not measured.
        let _ = file.and_then(|mut file| file.write_all(line.as_bytes()));
    }
    Some(ExitCode::from(status.code().and_then(|code| u8::try_from(code).ok()).unwrap_or(1)))
}

/// The name of all crates from outside the workspace together.
const REGISTRY: &str = "registry";

/// \[s\] of a process's children that have ended, user and system, of `/proc/PID/stat`.
fn of_children(stat: &str) -> Option<f64> {
    let fields: Vec<&str> = stat.rsplit_once(')')?.1.split_whitespace().collect();
    let ticks = |index: usize| fields.get(index)?.parse::<f64>().ok();
    Some((ticks(13)? + ticks(14)?) / TICKS)
}

/// \[s\] per crate.
type Times = BTreeMap<String, f64>;

/// A build that has budgets.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum Build {
    /// The README's first command.
    FirstCommand,
    /// All programs of tests.
    Tests,
}

impl Build {
    const ALL: [Self; 2] = [Self::FirstCommand, Self::Tests];

    fn name(self) -> &'static str {
        match self {
            Self::FirstCommand => "first-command",
            Self::Tests => "tests",
        }
    }

    fn arguments(self) -> &'static [&'static str] {
        match self {
            Self::FirstCommand => &["build", "--release", "--package", "host-sim"],
            Self::Tests => &["test", "--no-run", "--workspace", "--all-features"],
        }
    }
}

/// Builds the programs of tests; where everything is built once, shows the crates beside their budgets. They are not
/// judged here: what the linter has built of the registry is not built again.
///
/// # Errors
/// Where it does not build.
pub fn show() -> Result<Vec<Program>> {
    let mut command = cargo();
    command.args(Build::Tests.arguments());
    if !builds_once() {
        return build(&mut command);
    }
    let (programs, times) = measured(&mut command, &target_dir())?;
    print!("{}", table(&times, &budgets(Build::Tests)?));
    Ok(programs)
}

fn budgets(of: Build) -> Result<Times> {
    let text = std::fs::read_to_string(root().join(FILE))
        .with_context(|| format!("cannot read {FILE}"))?;
    Ok(read(&text, of.name()))
}

fn check(times: &Times, budgets: &Times) -> Result<()> {
    let over = over(times, budgets);
    if over.is_empty() {
        return Ok(());
    }
    bail!(
        "{} take more than {MAX} times their budget; where that is meant: \
         cargo xtask compile-times --write",
        over.join(", ")
    )
}

/// `cargo xtask compile-times`: builds in a folder of their own, from the first crate on; both where none is named.
///
/// # Errors
/// Where building or writing fails, or, where nothing is written, a crate is over its budget.
pub fn run(builds: &[Build], write: bool) -> Result<()> {
    let builds = if builds.is_empty() { &Build::ALL } else { builds };
    for build in builds {
        let folder = target_dir().join("compile-times");
        if folder.exists() {
            std::fs::remove_dir_all(&folder).context("cannot remove the last build")?;
        }
        let mut command = cargo_once();
        command.args(build.arguments()).arg("--target-dir").arg(&folder);
        let (_, times) = measured(&mut command, &folder)?;
        let budgets = budgets(*build)?;
        print!("{}", table(&times, &budgets));
        if !write {
            check(&times, &budgets)?;
            continue;
        }
        let commit = output(program("git").args(["log", "-1", "--format=%h,%cs"]))?;
        let text = std::fs::read_to_string(root().join(FILE)).unwrap_or_default();
        let rows = rows(&times, build.name(), commit.trim());
        std::fs::write(root().join(FILE), merged(&text, build.name(), &rows))
            .with_context(|| format!("cannot write {FILE}"))?;
        println!("written: {FILE}");
    }
    Ok(())
}

fn measured(command: &mut Command, folder: &Path) -> Result<(Vec<Program>, Times)> {
    let log: PathBuf = folder.join("compile-times.log");
    std::fs::create_dir_all(folder)?;
    std::fs::write(&log, "").with_context(|| format!("cannot write {}", log.display()))?;
    // A copy: the build may overwrite this program.
    let own = folder.join("compile-times-wrapper");
    std::fs::copy(std::env::current_exe().context("this program has no path")?, &own)?;
    let programs = build(command.env("RUSTC_WRAPPER", own).env(LOG, &log))?;
    let mut times = Times::new();
    for line in std::fs::read_to_string(&log)?.lines() {
        let Some((name, seconds)) = line.split_once(',') else { continue };
        *times.entry(name.to_owned()).or_default() += seconds.parse().unwrap_or(0.0);
    }
    Ok((programs, times))
}

/// A crate's time over that of the registry's, by name; none where nothing of the registry was built.
fn shares(times: &Times) -> Times {
    let Some(whole) = times.get(REGISTRY) else { return Times::new() };
    let own = times.iter().filter(|(name, _)| *name != REGISTRY);
    own.map(|(name, seconds)| (name.clone(), seconds / whole)).collect()
}

/// Crates that take more than they may, with what they take; a crate without a budget may take nothing.
fn over(times: &Times, budgets: &Times) -> Vec<String> {
    let most = |name: &str| MAX * budgets.get(name).copied().unwrap_or(0.0) + LEAST;
    let all = shares(times).into_iter().filter(|(name, share)| *share > most(name));
    all.map(|(name, share)| format!("{name} ({share:.3} of the registry's)")).collect()
}

const HEAD: &str = "\
# CPU time of the compiler; share: over that of all crates from the registry, which is judged. Written by
# `cargo xtask compile-times --write`.
build,commit,date,crate,seconds,share
";

fn read(csv: &str, build: &str) -> Times {
    let row = |line: &str| match line.split(',').collect::<Vec<_>>()[..] {
        [of, _, _, name, _, share] if of == build => Some((name.to_owned(), share.parse().ok()?)),
        _ => None,
    };
    csv.lines().filter_map(row).collect()
}

fn rows(times: &Times, build: &str, commit: &str) -> String {
    let mut text = String::new();
    for (name, share) in shares(times) {
        let _ = writeln!(text, "{build},{commit},{name},{:.1},{share:.4}", times[&name]);
    }
    text
}

/// The file with new rows of a build.
fn merged(csv: &str, build: &str, rows: &str) -> String {
    let others = csv.lines().skip(HEAD.lines().count());
    let others = others.filter(|line| line.split(',').next() != Some(build));
    let others: String = others.map(|line| format!("{line}\n")).collect();
    format!("{HEAD}{others}{rows}")
}

fn table(times: &Times, budgets: &Times) -> String {
    let shares = shares(times);
    let whole: f64 = times.values().sum();
    let mut text = format!("{whole:>8.1} CPU s in all\n");
    for (name, seconds) in times {
        let share = shares.get(name).map_or(String::new(), |share| format!("{share:>8.3}"));
        let budget = budgets.get(name).map_or(String::new(), |share| format!("{share:>8.3}"));
        let _ = writeln!(text, "{seconds:>8.1} s{share:>8} of{budget:>8}  {name}");
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    fn times(of: &[(&str, f64)]) -> Times {
        of.iter().map(|(name, seconds)| ((*name).to_owned(), *seconds)).collect()
    }

    #[test]
    fn time_of_children_is_read() {
        let stat = "7 (a (b) c) S 1 1 1 0 -1 4194304 9 9 0 0 5 6 250 50 20 0 1 0 77";
        assert_eq!(of_children(stat), Some(3.0));
        assert_eq!(of_children(""), None);
    }

    #[test]
    fn a_crate_that_grew_is_named_on_a_slower_machine_too() {
        let rows = rows(&times(&[("a", 10.0), ("b", 1.0), (REGISTRY, 20.0)]), "tests", "c,d");
        let before = format!("{HEAD}tests,c,d,a,1,7\nfirst-command,c,d,a,1,0.25\n");
        let file = merged(&before, "tests", &rows);
        assert_eq!(read(&file, "first-command"), times(&[("a", 0.25)]));
        let budgets = read(&file, "tests");
        assert_eq!(budgets, times(&[("a", 0.5), ("b", 0.05)]));
        let slow = times(&[("a", 30.0), ("b", 3.0), (REGISTRY, 60.0)]);
        assert!(over(&slow, &budgets).is_empty());
        let grown = times(&[("a", 45.0), ("b", 3.0), (REGISTRY, 60.0)]);
        assert_eq!(over(&grown, &budgets), ["a (0.750 of the registry's)"]);
        let unknown = times(&[("c", 30.0), (REGISTRY, 60.0)]);
        assert_eq!(over(&unknown, &budgets), ["c (0.500 of the registry's)"]);
        assert!(shares(&times(&[("a", 1.0)])).is_empty(), "no share of nothing");
    }
}
