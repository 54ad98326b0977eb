//! Controllers with their plants on the chip: the same trace as on the host, and no tick missed.
//!
//! `program plant on host and target => equal lines, overruns 0 at each loop's rate, counted beyond it`.
//! Beyond its rate a loop falls behind real time, and does the same tick by tick.

use std::path::PathBuf;

use anyhow::{Context as _, Result, bail};

use crate::bits::host::{self, Host};
use crate::built::build;
use crate::chip::{Toolchain, firmware, setup};
use crate::command::{cargo, program};

/// What the program names its loops.
const LOOPS: [&str; 2] = ["cart-pendulum", "delta-pick-and-place"];
/// Ticks in the tests, of each loop: the second one's cost ten times as much.
pub const SHORT: [u32; 2] = [10_000, 1_000];
/// Ticks in the long tests.
pub const LONG: [u32; 2] = [1_000_000; 2];
/// Ticks that are too fast.
const FORCED: u32 = 200;

/// `cargo xtask plant [TICKS]`.
///
/// # Errors
/// As [`compare`]; where the host's program does not build.
pub fn run(ticks: u32) -> Result<()> {
    let toolchain = setup::complete()?;
    let host =
        build(cargo().args(["build", "--release", "--package", "firmware", "--bin", "plant"]))?;
    compare(&toolchain, &host::plant(&host)?, [ticks; 2])
}

/// The step of `cargo xtask test`.
///
/// # Errors
/// As [`compare`].
pub fn step(toolchain: &Toolchain, host: &Host, long: bool) -> Result<()> {
    compare(toolchain, host.plant(), if long { LONG } else { SHORT })
}

/// Runs each loop on both machines, at its rate and forced beyond it.
///
/// # Errors
/// Where a line differs, a tick is missed at the loop's own rate or none beyond it, or a program fails.
fn compare(toolchain: &Toolchain, host: &PathBuf, ticks: [u32; 2]) -> Result<()> {
    for (name, ticks) in LOOPS.into_iter().zip(ticks) {
        let on_target = |ticks: u32, period: Option<u32>| {
            let mut arguments = vec![name.to_owned(), ticks.to_string()];
            arguments.extend(period.map(|period| period.to_string()));
            // Of the ticks asked for: no limit.
            firmware::execute(toolchain, "plant", true, &arguments)
        };
        let on_host = |ticks: u32| host::lines(program(host).args([name, &ticks.to_string()]));
        let chip = on_target(ticks, None)?;
        same(&on_host(ticks)?, &chip).with_context(|| name.to_owned())?;
        let pace = Pace::of(&chip)?;
        if pace.overruns > 0 {
            bail!("{name} missed {} of {ticks} ticks at its own rate", pace.overruns);
        }
        let chip = on_target(FORCED, Some(pace.busy / 2))?;
        same(&on_host(FORCED)?, &chip).with_context(|| format!("{name}, forced"))?;
        let forced = Pace::of(&chip)?;
        // At twice the rate that it bears every tick misses another, but for the last.
        if forced.overruns + 2 < FORCED {
            bail!("{name} missed only {} ticks of {FORCED} at twice its rate", forced.overruns);
        }
        println!(
            "{name}: {ticks} ticks with the host's bits, {} us of each {} us at work, none missed; \
             given {} us, {} were missed in {FORCED}",
            pace.busy, pace.period, forced.period, forced.overruns
        );
    }
    Ok(())
}

/// Whether the lines that tell what was done are the same, and there are some.
fn same(host: &[String], target: &[String]) -> Result<()> {
    let done = |lines: &[String]| -> Vec<String> {
        let reported = |line: &&String| line.starts_with("loop ") || line.starts_with("last ");
        lines.iter().filter(reported).cloned().collect()
    };
    let [host, target] = [host, target].map(done);
    if host.is_empty() {
        bail!("the host printed no ticks");
    }
    for (line, other) in host.iter().zip(&target) {
        if line != other {
            bail!("the host has `{line}`, the target `{other}`");
        }
    }
    if host.len() != target.len() {
        bail!("the host printed {} lines, the target {}", host.len(), target.len());
    }
    Ok(())
}

/// How a run kept its pace.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Pace {
    overruns: u32,
    busy: u32,
    period: u32,
}

impl Pace {
    /// Reads `pace NAME overruns N busy MEAN us of PERIOD, MAX in tick TICK`.
    fn of(lines: &[String]) -> Result<Self> {
        let line = lines.iter().find(|line| line.starts_with("pace "));
        let line = line.context("the target printed no pace")?;
        let words: Vec<&str> = line.split_whitespace().collect();
        let read = || {
            let ["pace", _, "overruns", overruns, "busy", busy, "us", "of", period, ..] = words[..]
            else {
                return None;
            };
            Some(Self {
                overruns: overruns.parse().ok()?,
                busy: busy.parse().ok()?,
                period: period.strip_suffix(',')?.parse().ok()?,
            })
        };
        read().with_context(|| format!("cannot read `{line}`"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lines(text: &str) -> Vec<String> {
        text.lines().map(str::to_owned).collect()
    }

    #[test]
    fn a_line_that_differs_is_found() {
        let host = lines("info: x\nloop a 1 00\nloop a 2 01\nlast a 2 5\npace a overruns 0");
        assert!(same(&host, &lines("loop a 1 00\nloop a 2 01\nlast a 2 5")).is_ok());
        for other in ["loop a 1 00\nloop a 2 02\nlast a 2 5", "loop a 1 00\nloop a 2 01", ""] {
            assert!(same(&host, &lines(other)).is_err(), "{other}");
        }
        assert!(same(&[], &[]).is_err());
    }

    #[test]
    fn a_pace_is_read() {
        let pace = Pace::of(&lines("loop a\npace a overruns 3 busy 404 us of 1000, 405 in tick 7"));
        assert_eq!(pace.unwrap(), Pace { overruns: 3, busy: 404, period: 1000 });
        assert!(Pace::of(&lines("pace a overruns x busy 1 us of 2, 3")).is_err());
        assert!(Pace::of(&[]).is_err());
    }
}
