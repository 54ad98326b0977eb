//! A process that runs blocks of a target and tells what it found.
//!
//! `blocks => lines on standard output`. A finding is written to a file, shrunk, and told once. Where
//! an input takes too long the process ends; where it takes too much memory the allocator ends it.
//! Who called it runs the block again with a trace, which holds the input that was the last.

use std::collections::BTreeSet;
use std::fs;
use std::io::{self, Write as _};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use anyhow::{Context as _, Result};

use crate::block::{file_name, inputs};
use crate::execution::{execute, watch};
use crate::shrink::shrunk;
use crate::target::{Finding, Reach, Target};

/// What takes longer is shown: it is no fault, but may become one.
const SLOW: Duration = Duration::from_secs(2);

/// What a worker is to do.
#[derive(Clone, Debug)]
pub struct Work {
    /// From what inputs are made.
    pub seed: u64,
    /// The first block.
    pub first: u64,
    /// From a block to the next.
    pub stride: u64,
    /// The block at which to end, exclusive.
    pub end: u64,
    /// Or when to end: no block is begun later.
    pub time: Duration,
    /// How long an input may take.
    pub limit: Duration,
    /// Where findings go.
    pub findings: PathBuf,
    /// The file in which each input stands before it is run.
    pub trace: Option<PathBuf>,
}

/// What a worker tells.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Reported {
    /// The block it is about.
    pub block: u64,
    /// Inputs that were run.
    pub executions: u64,
    /// Of these, taken and not refused.
    pub taken: u64,
    /// Inputs that were not run.
    pub skipped: u64,
    /// The time of the slowest.
    pub slowest: Duration,
    /// Findings, each of those before again included.
    pub findings: u64,
}

impl Reported {
    fn line(&self) -> String {
        let Self { block, executions, taken, skipped, slowest, findings } = self;
        let slowest = slowest.as_nanos();
        format!("block\t{block}\t{executions}\t{taken}\t{skipped}\t{slowest}\t{findings}")
    }

    /// What such a line says.
    #[must_use]
    pub fn of_line(line: &str) -> Option<Self> {
        let numbers = line.strip_prefix("block\t")?.split('\t').map(str::parse);
        let numbers: Vec<u64> = numbers.collect::<Result<_, _>>().ok()?;
        let [block, executions, taken, skipped, slowest, findings] = numbers[..] else {
            return None;
        };
        let slowest = Duration::from_nanos(slowest);
        Some(Self { block, executions, taken, skipped, slowest, findings })
    }
}

/// A finding as it is told.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Found {
    /// The file of its input.
    pub file: PathBuf,
    /// What it is.
    pub finding: Finding,
}

impl Found {
    fn line(&self) -> String {
        let Self { file, finding: Finding { key, message } } = self;
        let [key, message] = [key, message].map(|text| text.escape_debug().to_string());
        format!("found\t{}\t{key}\t{message}", file.display())
    }

    /// What such a line says.
    #[must_use]
    pub fn of_line(line: &str) -> Option<Self> {
        let mut parts = line.strip_prefix("found\t")?.split('\t');
        let (file, key, message) = (parts.next()?, parts.next()?, parts.next()?);
        let finding = Finding { key: key.into(), message: message.into() };
        Some(Self { file: file.into(), finding })
    }
}

/// Does the work.
///
/// # Errors
/// Where a file cannot be written, or nobody reads.
pub fn work(target: &dyn Target, work: &Work) -> Result<()> {
    let begun = Instant::now();
    watch(work.limit);
    let mut known = BTreeSet::new();
    let mut block = work.first;
    while block < work.end && begun.elapsed() < work.time {
        let reported = run_block(target, work, block, &mut known)?;
        say(&reported.line())?;
        let Some(next) = block.checked_add(work.stride) else { break };
        block = next;
    }
    Ok(())
}

fn say(line: &str) -> Result<()> {
    let mut out = io::stdout().lock();
    writeln!(out, "{line}").and_then(|()| out.flush()).context("nobody listens")
}

fn run_block(
    target: &dyn Target,
    work: &Work,
    block: u64,
    known: &mut BTreeSet<String>,
) -> Result<Reported> {
    let mut reported = Reported { block, ..Reported::default() };
    for input in inputs(target, work.seed, block) {
        if let Some(trace) = &work.trace {
            fs::write(trace, &input).context("the trace cannot be written")?;
        }
        let begun = Instant::now();
        let outcome = execute(target, &input);
        let mut took = begun.elapsed();
        if took > SLOW && outcome.is_ok() {
            // On a busy machine it may only have waited.
            let again = Instant::now();
            let _ = execute(target, &input);
            took = took.min(again.elapsed());
        }
        if took > SLOW.max(reported.slowest) {
            keep_slow(target, &work.findings, &input, took)?;
        }
        reported.slowest = reported.slowest.max(took);
        match outcome {
            Ok(Reach::Skipped) => {
                reported.skipped += 1;
                continue;
            }
            Ok(Reach::Taken) => reported.taken += 1,
            Ok(Reach::Refused) => {}
            Err(finding) => {
                reported.findings += 1;
                if known.insert(finding.key.clone()) {
                    tell(target, &work.findings, &input, finding)?;
                }
            }
        }
        reported.executions += 1;
    }
    Ok(reported)
}

/// Writes an input that took long and tells of it.
fn keep_slow(target: &dyn Target, folder: &Path, input: &[u8], took: Duration) -> Result<()> {
    let file = folder.join(file_name(target, input));
    fs::write(&file, input).with_context(|| format!("{}", file.display()))?;
    say(&format!("slow\t{}\t{}", file.display(), took.as_secs_f64()))
}

/// Writes a finding's input, tells of it, then makes it small: what shrinks may hang.
fn tell(target: &dyn Target, folder: &Path, input: &[u8], finding: Finding) -> Result<()> {
    let file = folder.join(file_name(target, input));
    fs::write(&file, input).with_context(|| format!("{}", file.display()))?;
    let key = finding.key.clone();
    say(&Found { file: file.clone(), finding }.line())?;
    let small = shrunk(target, input, &key);
    fs::write(&file, small).with_context(|| format!("{}", file.display()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_read_back() {
        let slowest = Duration::from_nanos(5);
        let reported =
            Reported { block: 7, executions: 1, taken: 2, skipped: 3, slowest, findings: 4 };
        assert_eq!(Reported::of_line(&reported.line()), Some(reported));
        let finding = Finding { key: "a b".into(), message: "c:\n\td".into() };
        let found = Found { file: "x/y".into(), finding };
        let read = Found::of_line(&found.line()).unwrap();
        assert_eq!(read.finding.message, "c:\\n\\td");
        assert_eq!((read.file, read.finding.key), (found.file, found.finding.key));
        assert_eq!(Found::of_line("block\t1"), None);
    }
}
