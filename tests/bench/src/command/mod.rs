//! `cargo xtask bench`: what a step costs here, beside other ways to the same step.
//!
//! `systems => times in turn, in one process => cost of a body, a TSDA, a joint; growth; what was aimed at`. Nothing is
//! written. Times are the machine's of this minute; ratios of times that were taken in turn say more, and
//! instructions, which `cargo xtask instructions` counts, say it without noise.

mod arguments;
mod ensembles;
mod error;
mod fit;
mod goals;
mod nets;
mod outcome;
mod systems;
mod table;
mod turns;
mod ways;

use std::ffi::OsString;
use std::io::Write;

use clap::Parser as _;
use host_sim::terminal::console::OutputError;
use host_sim::terminal::text::json;
use host_sim::terminal::{Catalogue, Console, Exit, Progress};

use arguments::BenchArguments;
use error::BenchError;
use outcome::Outcome;

/// Runs a command line, the program's name first.
pub fn main_with<I>(arguments: I, console: &mut Console<'_>) -> Exit
where
    I: IntoIterator,
    I::Item: Into<OsString> + Clone,
{
    let arguments = match BenchArguments::try_parse_from(arguments) {
        Ok(arguments) => arguments,
        Err(error) => {
            let refused = error.use_stderr();
            let to = if refused { &mut *console.err } else { &mut *console.out };
            let _ = write!(to, "{error}");
            return if refused { Exit::Refused } else { Exit::Done };
        }
    };
    let catalogue = Catalogue::default();
    let mut silence = std::io::sink();
    let lines = if arguments.quiet { &mut silence as &mut dyn Write } else { &mut *console.err };
    let bars = console.terminal && !arguments.quiet;
    let mut progress = Progress::of_many(bars, "rounds", lines);
    let done = bench(&catalogue, &arguments, &mut |done, all| progress.update(done, all));
    progress.finish();
    match done {
        Ok(outcome) => show(&outcome, &arguments, console).unwrap_or_else(|error| {
            console.report(&error);
            Exit::Failed
        }),
        Err(error) => {
            console.report(&error);
            Exit::Refused
        }
    }
}

fn show(
    outcome: &Outcome,
    arguments: &BenchArguments,
    console: &mut Console<'_>,
) -> Result<Exit, OutputError> {
    if arguments.json {
        console.print(&json(outcome))?;
    } else if !arguments.quiet {
        console.print(&outcome.text(console.look))?;
    }
    Ok(Exit::Done)
}

/// Measures; `progress` hears of rounds done and rounds to do.
///
/// # Errors
/// [`BenchError`], before anything is measured.
fn bench(
    catalogue: &Catalogue,
    arguments: &BenchArguments,
    progress: &mut dyn FnMut(u64, u64),
) -> Result<Outcome, BenchError> {
    let systems = systems::of(catalogue, arguments)?;
    let (rounds, all) = (arguments.rounds, systems.len() * arguments.rounds);
    let mut rows = Vec::with_capacity(systems.len());
    for (done, system) in systems.iter().enumerate() {
        let mut heard = |round: usize| progress((done * rounds + round) as u64, all as u64);
        rows.push(ways::measured(system, rounds, arguments.steps, &mut heard)?);
    }
    let ensembles = ensembles::measured(&systems, rounds, arguments.steps);
    let nets = nets::measured(&arguments.nets(), rounds, arguments.steps)?;
    Ok(Outcome::new(rounds, rows, ensembles, nets))
}
