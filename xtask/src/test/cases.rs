//! Runs programs of tests, several at once, and times each test.
//!
//! `programs => cases`. A program runs its tests one after the other, in its package's folder; as
//! many programs run at once as there are cores, those that took longest last time first. Only the
//! times need an unstable option of the test program itself: its environment has RUSTC_BOOTSTRAP,
//! no build's has.

use std::collections::{BTreeMap, VecDeque};
use std::path::PathBuf;
use std::process::{Command, Stdio};
use std::sync::Mutex;
use std::time::Instant;

use anyhow::{Context as _, Result, bail};
use serde_json::Value;

use crate::built::Program;
use crate::command::{root, target_dir};

use super::long;

/// A test that was run.
#[derive(Clone, Debug, PartialEq)]
pub struct Case {
    /// `PROGRAM TEST`.
    pub name: String,
    /// \[s\] the time it took.
    pub seconds: f64,
    /// How it went.
    pub outcome: Outcome,
}

/// How a test went.
#[derive(Clone, Debug, PartialEq)]
pub enum Outcome {
    /// Well.
    Passed,
    /// Not; with what it printed.
    Failed(String),
    /// It has `#[ignore]`.
    Ignored,
}

/// Which tests.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Selection {
    /// All.
    All,
    /// All but those of [`long::LONG`].
    Fast,
}

/// A program that ran: its name, its time \[s\] and its cases.
type Done = (String, f64, Result<Vec<Case>>);

/// Runs the tests of all programs, prints a line per program and what failed.
///
/// # Errors
/// Where a test failed or a program did not end as it should; all of them have run then.
pub fn run(programs: &[Program], selection: Selection) -> Result<Vec<Case>> {
    let known = Times::load();
    let mut waiting: Vec<&Program> = programs.iter().filter(|program| program.tests).collect();
    waiting.sort_by(|a, b| known.of(b).total_cmp(&known.of(a)));
    let total = waiting.len();
    let waiting = Mutex::new(VecDeque::from(waiting));
    let done: Mutex<Vec<Done>> = Mutex::new(Vec::new());
    std::thread::scope(|scope| {
        for _ in 0..cores().min(total) {
            scope.spawn(|| {
                loop {
                    let next = waiting.lock().ok().and_then(|mut waiting| waiting.pop_front());
                    let Some(program) = next else { break };
                    let start = Instant::now();
                    let cases = run_one(program, selection);
                    let seconds = start.elapsed().as_secs_f64();
                    show(program, seconds, &cases);
                    if let Ok(mut done) = done.lock() {
                        done.push((program.name.clone(), seconds, cases));
                    }
                }
            });
        }
    });
    let done = done.into_inner().unwrap_or_default();
    if selection == Selection::All {
        known.with(&done).save()?;
    }
    let (mut cases, mut broken) = (Vec::new(), Vec::new());
    for (name, _, outcome) in done {
        match outcome {
            Ok(more) => cases.extend(more),
            Err(error) => broken.push(format!("{name}: {error:#}")),
        }
    }
    let count = |wanted: fn(&Outcome) -> bool| cases.iter().filter(|c| wanted(&c.outcome)).count();
    let passed = count(|outcome| *outcome == Outcome::Passed);
    let failed = count(|outcome| matches!(outcome, Outcome::Failed(_)));
    let ignored = count(|outcome| *outcome == Outcome::Ignored);
    println!("{passed} tests passed, {failed} failed, {ignored} ignored in {total} programs");
    if failed > 0 || !broken.is_empty() {
        bail!("{failed} tests failed; programs that did not end well: [{}]", broken.join("; "));
    }
    if passed == 0 {
        bail!("no test was run");
    }
    Ok(cases)
}

/// Cores that may be used.
pub fn cores() -> usize {
    std::thread::available_parallelism().map_or(1, usize::from)
}

/// The slowest tests, slowest first.
pub fn slowest(cases: &[Case], count: usize) -> Vec<Case> {
    let mut sorted = cases.to_vec();
    sorted.sort_by(|a, b| b.seconds.total_cmp(&a.seconds));
    sorted.truncate(count);
    sorted
}

fn run_one(program: &Program, selection: Selection) -> Result<Vec<Case>> {
    let mut command = Command::new(&program.path);
    command
        .current_dir(&program.folder)
        .stdin(Stdio::null())
        .env("RUSTC_BOOTSTRAP", "1")
        .args(["-Z", "unstable-options", "--report-time", "--format", "json"])
        .args(["--test-threads", "1"]);
    if selection == Selection::Fast {
        command.arg("--exact");
        for test in long::of(&program.name) {
            command.args(["--skip", test]);
        }
    }
    let output = command.output().context("it cannot be run")?;
    let text = String::from_utf8_lossy(&output.stdout);
    match cases(&program.name, &text) {
        Some(cases) => Ok(cases),
        None => bail!("it ended with {}\n{text}{}", output.status, {
            String::from_utf8_lossy(&output.stderr)
        }),
    }
}

/// The cases of a program that said its last word; `None` where it did not.
fn cases(program: &str, text: &str) -> Option<Vec<Case>> {
    let (mut cases, mut complete) = (Vec::new(), false);
    for line in text.lines().filter(|line| line.starts_with('{')) {
        let Ok(event) = serde_json::from_str::<Value>(line) else { continue };
        let outcome = match (event["type"].as_str(), event["event"].as_str()) {
            (Some("suite"), Some("ok" | "failed")) => {
                complete = true;
                continue;
            }
            (Some("test"), Some("ok")) => Outcome::Passed,
            (Some("test"), Some("ignored")) => Outcome::Ignored,
            (Some("test"), Some("failed")) => {
                let printed = event["stdout"].as_str().unwrap_or_default();
                Outcome::Failed(printed.to_owned())
            }
            _ => continue,
        };
        let seconds = event["exec_time"].as_f64().unwrap_or_default();
        let name = format!("{program} {}", event["name"].as_str()?);
        cases.push(Case { name, seconds, outcome });
    }
    complete.then_some(cases)
}

fn show(program: &Program, seconds: f64, cases: &Result<Vec<Case>>) {
    let name = &program.name;
    match cases {
        Err(error) => println!("{seconds:>9.1} s  {name}: {error:#}"),
        Ok(cases) => {
            println!("{seconds:>9.1} s  {name}, {} tests", cases.len());
            for case in cases {
                if let Outcome::Failed(printed) = &case.outcome {
                    println!("FAILED {}\n{printed}", case.name);
                }
            }
        }
    }
}

/// \[s\] how long each program took last time.
#[derive(Clone, Debug, Default)]
struct Times(BTreeMap<String, f64>);

impl Times {
    fn file() -> PathBuf {
        target_dir().join("test-times.csv")
    }

    fn load() -> Self {
        // Without it, the order is another.
        let text = std::fs::read_to_string(Self::file()).unwrap_or_default();
        let row = |line: &str| {
            let (name, seconds) = line.split_once(',')?;
            Some((name.to_owned(), seconds.parse().ok()?))
        };
        Self(text.lines().filter_map(row).collect())
    }

    /// A program that is not known is judged by its long tests.
    fn of(&self, program: &Program) -> f64 {
        let guess = || 10.0 * long::of(&program.name).count() as f64;
        self.0.get(&program.name).copied().unwrap_or_else(guess)
    }

    fn with(mut self, done: &[Done]) -> Self {
        self.0.extend(done.iter().map(|(name, seconds, _)| (name.clone(), *seconds)));
        self
    }

    fn save(&self) -> Result<()> {
        let text: String =
            self.0.iter().map(|(name, seconds)| format!("{name},{seconds}\n")).collect();
        let file = Self::file();
        std::fs::create_dir_all(file.parent().unwrap_or(root()))?;
        std::fs::write(&file, text).with_context(|| format!("cannot write {}", file.display()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const EVENTS: &str = r#"
{ "type": "suite", "event": "started", "test_count": 3 }
{ "type": "test", "event": "started", "name": "a::well" }
{ "type": "test", "name": "a::well", "event": "ok", "exec_time": 1.5 }
a line of the test itself
{ "type": "test", "name": "a::ill", "event": "failed", "exec_time": 0.25, "stdout": "left: 1\n" }
{ "type": "test", "name": "a::later", "event": "ignored" }
"#;
    const END: &str = r#"{ "type": "suite", "event": "failed", "passed": 1, "failed": 1 }"#;

    #[test]
    fn cases_are_read_from_events() {
        let cases = cases("kernel", &format!("{EVENTS}{END}\n")).unwrap();
        let outcomes: Vec<&Outcome> = cases.iter().map(|case| &case.outcome).collect();
        let failed = Outcome::Failed("left: 1\n".to_owned());
        assert_eq!(outcomes, [&Outcome::Passed, &failed, &Outcome::Ignored]);
        assert_eq!(cases[0].name, "kernel a::well");
        assert_eq!(slowest(&cases, 1)[0].seconds, 1.5);
    }

    #[test]
    fn a_program_that_broke_off_has_no_cases() {
        assert_eq!(cases("kernel", EVENTS), None);
    }
}
