//! Campaigns of random input: builds `dbd-fuzz` with every check, as fast as released, and runs it.
//!
//! `seconds, targets, seed => executions, findings`. An input that fails is kept in a file, and is
//! run again with `--replay`.

use std::path::PathBuf;

use anyhow::Result;
use clap::Args;

use crate::command::{cargo, run as run_command};

/// The settings of a campaign.
#[derive(Args)]
pub struct Campaign {
    /// Total seconds for all targets.
    #[arg(required_unless_present = "replay")]
    seconds: Option<f64>,
    /// One of scene, snapshot, step, line and command-line; may be repeated [default: all].
    #[arg(long = "target", value_name = "NAME")]
    targets: Vec<String>,
    /// Seed of the inputs [default: the clock].
    #[arg(long)]
    seed: Option<u64>,
    /// Run these inputs again, and show them.
    #[arg(long, value_name = "FILE", conflicts_with_all = ["seconds", "targets", "seed"])]
    replay: Vec<PathBuf>,
}

/// Runs a campaign, or inputs again.
///
/// # Errors
/// Where anything was found.
pub fn run(campaign: &Campaign) -> Result<()> {
    let mut command = cargo();
    command.args(["run", "--profile", "fuzz", "--package", "dbd-fuzz", "--"]);
    let Campaign { seconds, targets, seed, replay } = campaign;
    match seconds {
        Some(seconds) => {
            command.args(["run", &seconds.to_string()]);
            targets.iter().for_each(|target| _ = command.args(["--target", target]));
            seed.iter().for_each(|seed| _ = command.args(["--seed", &seed.to_string()]));
        }
        None => _ = command.args(["replay", "--show"]).args(replay),
    }
    run_command(&mut command)
}
