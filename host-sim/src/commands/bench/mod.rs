//! `host-sim bench`: what a step costs here, beside other ways to the same step.
//!
//! `systems => times in turn, in one process => cost of a body, a TSDA, a joint; growth; what was aimed at`. Nothing is
//! written. Times are the machine's of this minute; ratios of times that were taken in turn say more, and
//! instructions, which `cargo xtask instructions` counts, say it without noise.

mod arguments;
mod ensembles;
mod error;
mod fit;
mod goals;
mod outcome;
mod systems;
mod table;
mod turns;
mod ways;

use crate::terminal::Catalogue;

pub use arguments::BenchArguments;
pub use error::BenchError;
pub use outcome::Outcome;

/// Measures; `progress` hears of rounds done and rounds to do.
///
/// # Errors
/// [`BenchError`], before anything is measured.
pub fn bench(
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
    Ok(Outcome::new(rounds, rows, ensembles))
}
