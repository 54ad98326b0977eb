//! `host-sim bench`: what a step costs here, beside other ways to the same step.
//!
//! `systems => times in turn, in one process => cost of a body, a TSDA, a joint; growth; what was aimed at`. Nothing is
//! written. Times are the machine's of this minute; ratios of times that were taken in turn say more, and
//! instructions, which `cargo xtask instructions` counts, say it without noise.

mod fit;
mod goals;
mod outcome;
mod systems;
mod table;
mod turns;
mod ways;

use clap::Args;
use clap::builder::RangedU64ValueParser;
use dbd_bench::chain;
use dbd_plant::PlantError;
use miette::Diagnostic;
use thiserror::Error;

use crate::terminal::{Catalogue, LoadError};

pub use outcome::Outcome;

/// What `host-sim bench` takes.
#[derive(Clone, Debug, Args)]
pub struct BenchArguments {
    /// Scenes by name (see list), paths to .toml files or - for standard input [default: the ten systems of the
    /// paper's Table 7, and chains]
    #[arg(value_name = "SCENE")]
    pub scenes: Vec<String>,
    /// Changes one value of the scenes by its path, as often as wanted, see run
    #[arg(long = "set", value_name = "PATH=VALUE", requires = "scenes")]
    pub set: Vec<String>,
    /// Links of chains, one chain each [default: 10,100,1000,10000 where no scene is named, else none]
    #[arg(
        long,
        value_name = "LINKS",
        value_delimiter = ',',
        value_parser = RangedU64ValueParser::<usize>::new().range(1..=chain::MOST as u64)
    )]
    pub chains: Option<Vec<usize>>,
    /// Rounds in which each way is measured once
    #[arg(
        long,
        value_name = "N",
        default_value_t = 15,
        value_parser = RangedU64ValueParser::<usize>::new().range(3..=10_000)
    )]
    pub rounds: usize,
    /// Steps of a measurement [default: as many as take 2 ms]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..=1_000_000_000))]
    pub steps: Option<u64>,
    /// As JSON
    #[arg(long)]
    pub json: bool,
    /// Print nothing but errors, and with --json the result
    #[arg(long)]
    pub quiet: bool,
}

/// Why nothing was measured.
#[derive(Debug, Error, Diagnostic)]
pub enum BenchError {
    /// A scene could not be loaded.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Load(#[from] LoadError),
    /// A scene cannot be stepped.
    #[error("{name}: {why}")]
    #[diagnostic(help("a scene that host-sim run can run"))]
    Plant {
        /// The scene.
        name: String,
        /// Why.
        why: PlantError,
    },
    /// A chain is refused.
    #[error(transparent)]
    #[diagnostic(help("--chains takes numbers of links, e.g. 10,100,1000"))]
    Chain(#[from] chain::ChainError),
}

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
    Ok(Outcome::new(rounds, rows))
}
