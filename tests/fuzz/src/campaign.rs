//! A campaign: workers on every core, one target after the other, and what they found.
//!
//! `(targets, time or executions, seed) => counts, findings`. A worker that dies has met an input
//! that no panic is caught of: too much time or memory, a stack used up. The block that it was in is
//! run once more with a trace, and goes on with the next.

use std::collections::BTreeMap;
use std::fs;
use std::io::{BufRead as _, BufReader, Read as _};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::Mutex;
use std::time::{Duration, Instant};

use anyhow::{Context as _, Result};

use crate::block::file_name;
use crate::execution::TOO_LONG;
use crate::target::{Finding, Target};
use crate::worker::{Found, Reported};

/// What a campaign is.
#[derive(Clone, Debug)]
pub struct Campaign {
    /// The program that is a worker when it is told to be.
    pub program: PathBuf,
    /// From what inputs are made.
    pub seed: u64,
    /// Processes at a time.
    pub workers: u64,
    /// How long an input may take.
    pub limit: Duration,
    /// Where findings go.
    pub findings: PathBuf,
}

/// How far a campaign goes with a target.
#[derive(Clone, Copy, Debug)]
pub enum Extent {
    /// For so long.
    Time(Duration),
    /// So many inputs, rounded up to whole blocks: always the same ones.
    Inputs(u64),
}

/// What came of a target.
#[derive(Clone, Debug, Default)]
pub struct Report {
    /// What the workers told, added up.
    pub sum: Reported,
    /// How long it took.
    pub time: Duration,
    /// Findings by their keys.
    pub found: BTreeMap<String, Found>,
    /// Inputs that took long, and how long \[s\].
    pub slow: Vec<(PathBuf, f64)>,
}

impl Report {
    fn add(&mut self, reported: &Reported) {
        let sum = &mut self.sum;
        sum.executions += reported.executions;
        sum.taken += reported.taken;
        sum.skipped += reported.skipped;
        sum.findings += reported.findings;
        sum.slowest = sum.slowest.max(reported.slowest);
    }

    fn find(&mut self, found: Found) {
        self.found.entry(found.finding.key.clone()).or_insert(found);
    }
}

impl Campaign {
    /// Runs a target.
    ///
    /// # Errors
    /// Where workers cannot be run or findings not be written.
    pub fn run(&self, target: &dyn Target, extent: Extent) -> Result<Report> {
        fs::create_dir_all(&self.findings).context("there is no folder for findings")?;
        let begun = Instant::now();
        let (end, time) = match extent {
            Extent::Time(time) => (u64::MAX, Some(time)),
            Extent::Inputs(inputs) => (inputs.div_ceil(target.block()), None),
        };
        let report = Mutex::new(Report::default());
        std::thread::scope(|scope| -> Result<()> {
            let row = |worker| {
                let (report, target) = (&report, target);
                scope.spawn(move || {
                    let mut next = worker;
                    let left = || time.map(|time| time.saturating_sub(begun.elapsed()));
                    while next < end && left() != Some(Duration::ZERO) {
                        next = self.worker(target, next, end, left(), report)?;
                    }
                    Ok(())
                })
            };
            let rows: Vec<_> = (0..self.workers).map(row).collect();
            rows.into_iter().try_for_each(|row| row.join().expect("a row only counts"))
        })?;
        let mut report = report.into_inner().expect("no row panics");
        report.time = begun.elapsed();
        Ok(report)
    }

    fn command(&self, target: &dyn Target) -> Command {
        let mut command = Command::new(&self.program);
        command.args(["worker", target.name(), "--seed", &self.seed.to_string()]);
        command.args(["--limit", &self.limit.as_secs_f64().to_string()]);
        command.arg("--findings").arg(&self.findings);
        command.stdin(Stdio::null()).stdout(Stdio::piped());
        command
    }

    /// Runs a worker from a block on; the block after the last that is done with.
    fn worker(
        &self,
        target: &dyn Target,
        first: u64,
        end: u64,
        time: Option<Duration>,
        report: &Mutex<Report>,
    ) -> Result<u64> {
        let mut command = self.command(target);
        command.args(["--first", &first.to_string(), "--stride", &self.workers.to_string()]);
        command.args(["--end", &end.to_string()]);
        if let Some(time) = time {
            command.args(["--time", &time.as_secs_f64().to_string()]);
        }
        let mut child = command.stderr(Stdio::null()).spawn().context("no worker can be run")?;
        let mut next = first;
        for line in BufReader::new(child.stdout.take().expect("it is piped")).lines() {
            next = hear(&line?, report).map_or(next, |block| block.saturating_add(self.workers));
        }
        if !child.wait()?.success() {
            self.trace(target, next, report)?;
            next = next.saturating_add(self.workers);
        }
        Ok(next)
    }

    /// Runs a block in which a worker died, for the input that did it.
    fn trace(&self, target: &dyn Target, block: u64, report: &Mutex<Report>) -> Result<()> {
        let trace = self.findings.join(format!(".{}-{block}", target.name()));
        let (first, end) = (block.to_string(), (block + 1).to_string());
        let mut command = self.command(target);
        command.args(["--first", &first, "--stride", "1", "--end", &end]).arg("--trace");
        let mut child = command.arg(&trace).stderr(Stdio::piped()).spawn()?;
        let mut said = String::new();
        let (out, err) = (child.stdout.take(), child.stderr.take());
        std::thread::scope(|scope| {
            scope.spawn(|| {
                // Whatever it is, it is only shown.
                let _ = err.map(|mut err| err.read_to_string(&mut said));
            });
            let lines = out.map(|out| BufReader::new(out).lines());
            for line in lines.into_iter().flatten().map_while(Result::ok) {
                hear(&line, report);
            }
        });
        let status = child.wait()?;
        let said = said.trim();
        let key = match status.code() {
            Some(0) => "a worker died, and did not again".to_owned(),
            Some(TOO_LONG) => "an input takes too long".to_owned(),
            _ => {
                // Sizes differ from input to input, the fault does not.
                let why = said.lines().next().unwrap_or_default();
                let why: String = why.chars().filter(|c| !c.is_ascii_digit()).collect();
                format!("an input ends the process: {status} {why}")
            }
        };
        let input = fs::read(&trace).unwrap_or_default();
        let file = self.findings.join(file_name(target, &input));
        fs::rename(&trace, &file).context("a finding cannot be kept")?;
        let message = format!("{key}, block {block}: {said}");
        let mut report = report.lock().expect("no row panics");
        report.sum.findings += 1;
        report.find(Found { file, finding: Finding { key, message } });
        Ok(())
    }
}

/// Takes a line of a worker; the block that it says is done.
fn hear(line: &str, report: &Mutex<Report>) -> Option<u64> {
    let mut report = report.lock().expect("no row panics");
    if let Some(found) = Found::of_line(line) {
        report.find(found);
    }
    if let Some((file, time)) = line.strip_prefix("slow\t").and_then(|rest| rest.split_once('\t')) {
        report.slow.push((file.into(), time.parse().unwrap_or_default()));
    }
    let reported = Reported::of_line(line)?;
    report.add(&reported);
    Some(reported.block)
}

/// The table of a campaign and its findings; how many there were.
#[must_use]
pub fn text(reports: &[(&dyn Target, Report)], root: &Path) -> String {
    let mut text = format!(
        "{:<14}{:>14}{:>14}{:>10}{:>12}{:>14}{:>10}\n",
        "target", "executions", "taken", "skipped", "per second", "slowest, ms", "failures"
    );
    for (target, report) in reports {
        let Report { sum, time, .. } = report;
        text += &format!(
            "{:<14}{:>14}{:>14}{:>10}{:>12.0}{:>14.1}{:>10}\n",
            target.name(),
            sum.executions,
            sum.taken,
            sum.skipped,
            sum.executions as f64 / time.as_secs_f64().max(1e-9),
            1e3 * sum.slowest.as_secs_f64(),
            sum.findings,
        );
    }
    let short = |file: &'_ Path| file.strip_prefix(root).unwrap_or(file).display().to_string();
    for (file, time) in reports.iter().flat_map(|(_, report)| &report.slow) {
        text += &format!("\n{}\n    took {time:.1} s\n", short(file));
    }
    for found in reports.iter().flat_map(|(_, report)| report.found.values()) {
        let file = short(&found.file);
        text += &format!("\n{file}\n    {}\n", found.finding.message);
    }
    text
}
