//! Runs programs of tests, several at once, and times each test.
//!
//! `programs => jobs => cases`. A job is a program, or a module of a program that takes long, whose tests run one after
//! the other in one process, in the package's folder: what tests of a module share is computed once. As many jobs run at
//! once as there are cores, those that took longest last time first. Only the times need an unstable option of the test
//! program itself: its environment has RUSTC_BOOTSTRAP, no build's has.

use std::collections::{BTreeMap, VecDeque};
use std::path::PathBuf;
use std::process::{Command, Stdio};
use std::sync::Mutex;
use std::time::Instant;

use anyhow::{Context as _, Result, bail};
use serde_json::Value;

use crate::built::Program;
use crate::command::{output, root, target_dir};

/// The program whose modules are jobs of their own.
const SPLIT: &str = "tests::dynamics";

/// Jobs that begin first where no times are known yet: they take longest.
const FIRST: [&str; 4] =
    ["tests::dynamics stability", "mechanics::mechanics", "tests::command_line", "tests::trade"];

/// \[s\] a test that took longer last time is no part of [`Selection::Fast`].
const LONG: f64 = 1.0;

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
    /// All but those that took long last time.
    Fast,
}

/// Tests that run in one process.
struct Job<'p> {
    /// The program, and its module where it is not all of it.
    name: String,
    program: &'p Program,
    /// The names; all of the program if empty.
    tests: Vec<String>,
    /// Those that are left out.
    skipped: Vec<String>,
}

/// A job that ran.
type Done = Result<Vec<Case>>;

/// What a run came to.
#[derive(Debug)]
pub struct Ran {
    /// What was run.
    pub cases: Vec<Case>,
    /// The tests that were left out as too long.
    pub left_out: Vec<String>,
}

/// Runs the tests of all programs, prints a line per job and what failed.
///
/// # Errors
/// Where a test failed or a program did not end as it should; all of them have run then.
pub fn run(programs: &[Program], selection: Selection) -> Result<Ran> {
    let known = Times::load();
    let long: Vec<String> = match selection {
        Selection::All => Vec::new(),
        Selection::Fast => known.longer_than(LONG),
    };
    let mut waiting = Vec::new();
    for program in programs.iter().filter(|program| program.tests) {
        waiting.extend(jobs(program, &long)?);
    }
    waiting.sort_by(|a, b| known.of(b).total_cmp(&known.of(a)));
    let total = waiting.len();
    let waiting = Mutex::new(VecDeque::from(waiting));
    let done: Mutex<Vec<(String, Done)>> = Mutex::new(Vec::new());
    std::thread::scope(|scope| {
        for _ in 0..cores().min(total) {
            scope.spawn(|| {
                loop {
                    let next = waiting.lock().ok().and_then(|mut waiting| waiting.pop_front());
                    let Some(job) = next else { break };
                    let start = Instant::now();
                    let cases = run_one(&job);
                    show(&job.name, start.elapsed().as_secs_f64(), &cases);
                    if let Ok(mut done) = done.lock() {
                        done.push((job.name, cases));
                    }
                }
            });
        }
    });
    let (mut cases, mut broken) = (Vec::new(), Vec::new());
    for (name, outcome) in done.into_inner().unwrap_or_default() {
        match outcome {
            Ok(more) => cases.extend(more),
            Err(error) => broken.push(format!("{name}: {error:#}")),
        }
    }
    known.with(&cases).save()?;
    let count = |wanted: fn(&Outcome) -> bool| cases.iter().filter(|c| wanted(&c.outcome)).count();
    let passed = count(|outcome| *outcome == Outcome::Passed);
    let failed = count(|outcome| matches!(outcome, Outcome::Failed(_)));
    let ignored = count(|outcome| *outcome == Outcome::Ignored);
    println!("{passed} tests passed, {failed} failed, {ignored} ignored in {total} jobs");
    if failed > 0 || !broken.is_empty() {
        bail!("{failed} tests failed; failed jobs: [{}]", broken.join("; "));
    }
    if passed == 0 {
        bail!("no test was run");
    }
    Ok(Ran { cases, left_out: long })
}

/// The jobs of a program without the tests that are `long`, each `PROGRAM TEST`.
fn jobs<'p>(program: &'p Program, long: &[String]) -> Result<Vec<Job<'p>>> {
    let of_program =
        |name: &String| name.strip_prefix(&program.name)?.strip_prefix(' ').map(str::to_owned);
    let skipped: Vec<String> = long.iter().filter_map(of_program).collect();
    if program.name != SPLIT {
        let (name, tests) = (program.name.clone(), Vec::new());
        return Ok(vec![Job { name, program, tests, skipped }]);
    }
    let list = output(Command::new(&program.path).args(["--list", "--format", "terse"]))?;
    let mut modules: BTreeMap<&str, Vec<String>> = BTreeMap::new();
    for test in list.lines().filter_map(|line| line.strip_suffix(": test")) {
        if !skipped.iter().any(|name| name == test) {
            let module = test.split("::").next().unwrap_or_default();
            modules.entry(module).or_default().push(test.to_owned());
        }
    }
    let job = |(module, tests)| {
        let name = format!("{} {module}", program.name);
        Job { name, program, tests, skipped: Vec::new() }
    };
    Ok(modules.into_iter().map(job).collect())
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

fn run_one(job: &Job<'_>) -> Done {
    let Job { program, tests, skipped, .. } = job;
    let mut command = Command::new(&program.path);
    command
        .current_dir(&program.folder)
        .stdin(Stdio::null())
        .env("RUSTC_BOOTSTRAP", "1")
        .args(["-Z", "unstable-options", "--report-time", "--format", "json"])
        .args(["--test-threads", "1", "--exact"])
        .args(skipped.iter().flat_map(|test| ["--skip", test]))
        .args(tests);
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

fn show(name: &str, seconds: f64, cases: &Done) {
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

/// \[s\] how long each test took last time, `PROGRAM TEST`.
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
            let (name, seconds) = line.rsplit_once(',')?;
            Some((name.to_owned(), seconds.parse().ok()?))
        };
        Self(text.lines().filter_map(row).collect())
    }

    fn longer_than(&self, limit: f64) -> Vec<String> {
        let long = self.0.iter().filter(|(_, seconds)| **seconds > limit);
        long.map(|(name, _)| name.clone()).collect()
    }

    /// \[s\] a job's tests together; what is not known is behind what is known to be long.
    fn of(&self, job: &Job<'_>) -> f64 {
        let begins = |name: &str| {
            let rest = name.strip_prefix(job.name.as_str());
            rest.is_some_and(|rest| rest.starts_with("::") || rest.starts_with(' '))
        };
        let known: f64 = self.0.iter().filter(|(name, _)| begins(name)).map(|(_, s)| s).sum();
        let first = FIRST.iter().position(|name| *name == job.name);
        let unknown = first.map_or(0.0, |place| 100.0 / (1 + place) as f64);
        if known > 0.0 { known } else { unknown }
    }

    fn with(mut self, cases: &[Case]) -> Self {
        self.0.extend(cases.iter().map(|case| (case.name.clone(), case.seconds)));
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

    #[test]
    fn a_job_takes_as_long_as_its_tests_and_long_ones_are_known() {
        let (path, folder) = (PathBuf::from("p"), PathBuf::from("f"));
        let program = Program { name: "tests::dynamics".to_owned(), tests: true, path, folder };
        let job = |name: &str| Job {
            name: name.to_owned(),
            program: &program,
            tests: Vec::new(),
            skipped: Vec::new(),
        };
        let cases = [("tests::dynamics a::x", 0.5), ("tests::dynamics a::y", 2.0)];
        let case = |(name, seconds): (&str, f64)| Case {
            name: name.to_owned(),
            seconds,
            outcome: Outcome::Passed,
        };
        let times = Times::default().with(&cases.map(case));
        assert_eq!(times.of(&job("tests::dynamics a")), 2.5);
        assert_eq!(times.of(&job("tests::dynamics")), 2.5);
        assert_eq!(times.of(&job("tests::dynamics b")), 0.0);
        assert!(times.of(&job(FIRST[0])) > times.of(&job(FIRST[1])));
        assert_eq!(times.longer_than(LONG), ["tests::dynamics a::y"]);
    }
}
