//! `host-sim sweep`: one scene with many values, one row per case.
//!
//! `SPEC.toml => cases => OUT/SPEC/cases/*.rows => OUT/SPEC/sweep.{csv,html,json}`. Every axis is checked
//! before anything is written; finished cases are kept as they come and never run again. Alike cases run in
//! lockstep.

pub mod case;
pub mod error;
pub mod folder;
pub mod loaded;
pub mod outcome;
pub mod workers;

use std::collections::{HashMap, HashSet};
use std::path::PathBuf;
use std::thread;

use clap::{Args, ValueHint};
use dbd_study::sweep::cases::Cases;
use dbd_study::sweep::key::Key;
use dbd_study::sweep::page::{Page, html};
use dbd_study::sweep::row::Row;
use dbd_study::sweep::shard::Shard;
use dbd_study::sweep::store::Store;
use dbd_study::sweep::table::Table;

use crate::commands::run::RunError;
use crate::commands::sweep::error::SweepError;
use crate::commands::sweep::folder::SweepFolder;
use crate::commands::sweep::loaded::Sweep;
use crate::commands::sweep::outcome::SweepOutcome;
use crate::commands::sweep::workers::on_all;
use crate::terminal::Catalogue;

/// Arguments of `host-sim sweep`.
#[derive(Clone, Debug, Args)]
pub struct SweepArguments {
    /// The sweep's file: scene, axes, columns
    #[arg(value_name = "SPEC.toml", value_hint = ValueHint::FilePath)]
    pub spec: PathBuf,
    /// Run one shard of the cases, I of N, counted from 1; --merge makes the table of all shards
    #[arg(long, value_name = "I/N")]
    pub shard: Option<Shard>,
    /// Run no cases; make the table of the finished ones
    #[arg(long, conflicts_with = "shard")]
    pub merge: bool,
    /// Make the table even if cases are missing
    #[arg(long, requires = "merge")]
    pub partial: bool,
    /// Number of parallel cases [default: one per core]
    #[arg(long, value_name = "N")]
    pub jobs: Option<std::num::NonZeroUsize>,
    /// Write each case's results as run does, to OUT/SPEC/reports
    #[arg(long, conflicts_with = "merge")]
    pub reports: bool,
    /// Folder for results; each sweep gets a subfolder named after its file
    #[arg(long, value_name = "DIR", default_value = "out", value_hint = ValueHint::DirPath)]
    pub out: PathBuf,
    /// Overwrite the table of another sweep whose file has the same name
    #[arg(long)]
    pub overwrite: bool,
    /// Print only errors
    #[arg(long)]
    pub quiet: bool,
    /// Print the outcome as JSON
    #[arg(long)]
    pub json: bool,
}

/// Runs the request; `progress` is called with the finished and total numbers of cases.
///
/// # Errors
/// [`SweepError`]; a case that fails is a row.
pub fn sweep(
    catalogue: &Catalogue,
    arguments: &SweepArguments,
    progress: &mut dyn FnMut(u64, u64),
) -> Result<SweepOutcome, SweepError> {
    let sweep = Sweep::load(catalogue, &arguments.spec)?;
    let text = sweep.text()?;
    let cases = Cases::new(&sweep.spec);
    let shard = arguments.shard.unwrap_or(Shard::WHOLE);
    let folder = SweepFolder::of(&arguments.out, &sweep.file, arguments.overwrite)?;
    let keys: Vec<Key> = (0..cases.len()).map(|case| sweep.key(case)).collect();
    let own = of_share(&keys, shard);
    let threads = arguments.jobs.map_or_else(cores, usize::from);
    let mut ran = 0;
    let mut store;
    if arguments.merge {
        store = Store::read(&folder.cases).map_err(SweepError::Write)?;
    } else {
        store = folder.open(shard)?;
        let mut begun = HashSet::new();
        let mut pending = own.clone();
        pending.retain(|case| !store.holds(keys[*case]) && begun.insert(keys[*case]));
        let all = pending.len() as u64;
        progress(0, all);
        let parts = sweep.parts(&pending, threads);
        let mut take = |part: usize, rows: Vec<Row>| {
            for (case, row) in parts[part].iter().zip(rows) {
                store.add(keys[*case], &row.cells())?;
                ran += 1;
                progress(ran, all);
            }
            Ok(())
        };
        let numbers: Vec<usize> = (0..parts.len()).collect();
        on_all(&numbers, threads, &|part| sweep.run(&text, &parts[part]), &mut take)
            .map_err(SweepError::Write)?;
    }
    if arguments.reports {
        let mut take = |_, written: Result<(), RunError>| written;
        on_all(&own, threads, &|case| sweep.report(&text, case, &folder.place), &mut take)?;
    }
    let cells = |case: usize| store.get(keys[case]).filter(|cells| sweep.fits(cells));
    let missing = own.iter().copied().filter(|case| cells(*case).is_none()).collect();
    let mut outcome = SweepOutcome::new(&sweep, &store, shard, ran, missing);
    for case in own {
        if let Some(cells) = cells(case) {
            outcome.count(case, cells);
        }
    }
    if !shard.is_whole() {
        return Ok(outcome);
    }
    if !outcome.missing.is_empty() && !arguments.partial {
        return Err(outcome.incomplete());
    }
    let table = Table::new(&sweep.spec, &sweep.columns, &cells);
    let page = html(&Page {
        name: &sweep.file.stem,
        scene: &sweep.found.scene.name,
        spec: &sweep.spec,
        columns: &sweep.columns,
        table: &table,
        summary: &outcome.rows_of_page(),
        commands: &sweep.commands(&arguments.spec),
    });
    folder.write(&table, &page, &outcome)?;
    outcome.written = Some(format!("{}/sweep.{{csv,html,json}}", folder.place.display()));
    Ok(outcome)
}

/// The cases of a shard. Cases with one key belong to the shard of the first.
fn of_share(keys: &[Key], shard: Shard) -> Vec<usize> {
    let mut first = HashMap::new();
    let is_own = |case: &usize| shard.holds(*first.entry(keys[*case]).or_insert(*case));
    (0..keys.len()).filter(is_own).collect()
}

fn cores() -> usize {
    thread::available_parallelism().map_or(1, usize::from)
}
