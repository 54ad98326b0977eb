//! `cargo xtask instructions`: what a step costs this machine, without noise.
//!
//! `program steps of dbd-bench below callgrind => instructions per step, beside flops, a plain loop and the baseline`.
//! Judged are the counts against their baseline, how they grow with a chain, and how far above the flops they are.

mod table;

use std::path::Path;
use std::sync::Mutex;

use anyhow::{Context as _, Result, bail};

use crate::baseline::{Baseline, Count, Key};
use crate::built::{Program, build};
use crate::callgrind;
use crate::chip::setup;
use crate::command::{cargo, output, program};

use table::Row;

/// The program that takes the steps, as cargo's messages name it.
pub const PROGRAM: &str = "bench::steps";
/// What builds it.
pub const BUILD: [&str; 4] = ["--package", "dbd-bench", "--example", "steps"];

const FILE: Baseline = Baseline {
    file: "docs/instructions-baseline.csv",
    names: "model,numbers",
    command: "cargo xtask instructions --baseline",
};

/// Scenes that are counted, all of them undamped.
const SCENES: [&str; 5] = ["hexagon", "four-bar", "six-bar", "3rrr", "3ruu"];
/// Links of the chains that are counted.
const CHAINS: [u64; 4] = [10, 100, 1_000, 10_000];
/// Steps of a scene.
const STEPS: u64 = 100;
/// Bodies × steps of a chain.
const WORK: u64 = 10_000;

/// What is run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum How {
    /// The kernel in double precision.
    F64,
    /// The kernel in single precision.
    F32,
    /// The plain loop, in double precision.
    Plain,
}

impl How {
    fn name(self) -> &'static str {
        match self {
            Self::F64 => "f64",
            Self::F32 => "f32",
            Self::Plain => "plain",
        }
    }
}

/// The function of the program that is counted.
const FUNCTION: &str = "*counted_steps*";

/// What is stepped: a scene or a chain.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Subject {
    name: String,
    /// The program's argument.
    argument: String,
    /// Links of a chain.
    links: Option<u64>,
    steps: u64,
}

fn subjects() -> Vec<Subject> {
    let scene = |name: &&str| Subject {
        name: (*name).to_owned(),
        argument: format!("scenes/{name}.toml"),
        links: None,
        steps: STEPS,
    };
    let chain = |links: &u64| Subject {
        name: format!("chain-{links}"),
        argument: links.to_string(),
        links: Some(*links),
        steps: (WORK / links).clamp(2, STEPS),
    };
    SCENES.iter().map(scene).chain(CHAINS.iter().map(chain)).collect()
}

/// `cargo xtask instructions [--baseline]`.
///
/// # Errors
/// Where valgrind is missing, building or counting fails, a count is outside its band or a goal is not met.
pub fn run(baseline: bool) -> Result<()> {
    setup::counter()?;
    let built = build(cargo().args(["build", "--release"]).args(BUILD))?;
    let steps = found(&built)?;
    let rows = rows(&steps.path, &[How::F64, How::F32, How::Plain])?;
    let key = key()?;
    println!("\n{}", table::shown(&rows));
    let goals = table::goals(&rows);
    goals.iter().for_each(|goal| println!("{}", goal.line()));
    if baseline {
        table::write(&key, &rows)?;
        FILE.write(&key, &counts(&rows))?;
        return crate::provenance::note(&[table::FILE]);
    }
    FILE.check(&key, &counts(&rows))
}

/// The step of `cargo xtask test`.
///
/// # Errors
/// Where counting fails, a count is outside its band or grows otherwise than with the bodies.
pub fn check(built: &[Program]) -> Result<()> {
    let rows = rows(&found(built)?.path, &[How::F64, How::F32])?;
    FILE.check(&key()?, &counts(&rows))?;
    let growth = table::growth(&rows);
    println!("{}", growth.line());
    if growth.is_met() { Ok(()) } else { bail!("{}", growth.line()) }
}

fn found(built: &[Program]) -> Result<&Program> {
    let program = built.iter().find(|program| program.name == PROGRAM);
    program.with_context(|| format!("`{PROGRAM}` was not built"))
}

/// Instructions per step, rounded.
fn per_step(steps: &Path, what: &str, how: &str, count: u64) -> Result<u64> {
    let collected = callgrind::count(steps, FUNCTION, &[what, how, &count.to_string()])?;
    Ok((collected as f64 / count as f64).round() as u64)
}

/// Floating-point operations of a step in double precision.
fn flops(steps: &Path, what: &str) -> Result<f64> {
    let said = output(program(steps).args([what, "flops", "1"]))?;
    let flops = said.split_whitespace().next().and_then(|word| word.parse().ok());
    flops.with_context(|| format!("no flops in `{said}`"))
}

/// The compiler of the host, and what it compiles for.
fn key() -> Result<Key> {
    let rustc = std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
    let text = output(program(rustc).arg("-vV"))?;
    let line = |name: &str| {
        let found = text.lines().find_map(|line| line.strip_prefix(name));
        found.with_context(|| format!("`rustc -vV` prints no `{name}`"))
    };
    let compiler = format!("rustc {}", line("release: ")?);
    Ok(Key { compiler, target: line("host: ")?.to_owned() })
}

/// Counts of the kernel, by subject and precision.
fn counts(rows: &[Row]) -> Vec<Count> {
    let of = |row: &Row| {
        [(How::F64, row.f64), (How::F32, row.f32)]
            .map(|(how, count)| (format!("{} {}", row.name, how.name()), count))
    };
    rows.iter().flat_map(of).collect()
}

/// A row per subject; several programs run at once.
fn rows(steps: &Path, hows: &[How]) -> Result<Vec<Row>> {
    let subjects = subjects();
    let work: Vec<(usize, Option<How>)> = (0..subjects.len())
        .flat_map(|row| hows.iter().map(move |how| (row, Some(*how))).chain([(row, None)]))
        .collect();
    let empty = |subject: &Subject| Row {
        name: subject.name.clone(),
        links: subject.links,
        ..Row::default()
    };
    let rows: Mutex<Vec<Row>> = Mutex::new(subjects.iter().map(empty).collect());
    let next = Mutex::new(work.into_iter());
    let failed = Mutex::new(None);
    let one = || -> Result<bool> {
        let Some((row, how)) = next.lock().ok().and_then(|mut work| work.next()) else {
            return Ok(false);
        };
        let subject = &subjects[row];
        let count = |how: How| per_step(steps, &subject.argument, how.name(), subject.steps);
        let flops = || flops(steps, &subject.argument);
        let (count, flops) = match how {
            Some(how) => (Some((how, count(how)?)), None),
            None => (None, Some(flops()?)),
        };
        if let Ok(mut rows) = rows.lock() {
            match count {
                Some((How::F64, count)) => rows[row].f64 = count,
                Some((How::F32, count)) => rows[row].f32 = count,
                Some((How::Plain, count)) => rows[row].plain = count,
                None => {}
            }
            rows[row].flops = flops.unwrap_or(rows[row].flops);
        }
        Ok(true)
    };
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    std::thread::scope(|scope| {
        for _ in 0..cores {
            scope.spawn(|| {
                loop {
                    match one() {
                        Ok(true) => {}
                        Ok(false) => break,
                        Err(why) => {
                            failed.lock().map(|mut failed| *failed = Some(why)).ok();
                            break;
                        }
                    }
                }
            });
        }
    });
    match failed.into_inner() {
        Ok(Some(why)) => Err(why),
        _ => rows.into_inner().map_err(|_| anyhow::anyhow!("a counting thread panicked")),
    }
}
