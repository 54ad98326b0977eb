//! `host-sim sweep`: many values of one scene, a row per case.
//!
//! `SPEC.toml => cases => OUT/SPEC/cases/*.rows => OUT/SPEC/sweep.{csv,html,json}`. Every axis is checked
//! before anything is written; finished cases are kept as they come and never run again.

pub mod case;
pub mod error;
pub mod folder;
pub mod outcome;
pub mod workers;

use std::collections::{HashMap, HashSet};
use std::path::{Path, PathBuf};
use std::thread;

use clap::{Args, ValueHint};
use dbd_study::command::quoted;
use dbd_sweep::Spec;
use dbd_sweep::cases::Cases;
use dbd_sweep::check::{CheckError, Trial as _, check};
use dbd_sweep::columns::{Column, columns};
use dbd_sweep::key::{Digest, Key};
use dbd_sweep::page::{Page, html};
use dbd_sweep::row::{self, Row};
use dbd_sweep::shard::Shard;
use dbd_sweep::store::Store;
use dbd_sweep::table::Table;

use crate::commands::folder::Destination;
use crate::commands::run::{RunError, RunOptions, run};
use crate::commands::sweep::case::Bench;
use crate::commands::sweep::error::SweepError;
use crate::commands::sweep::folder::SweepFolder;
use crate::commands::sweep::outcome::SweepOutcome;
use crate::commands::sweep::workers::on_all;
use crate::terminal::catalogue::is_path;
use crate::terminal::{Catalogue, Found, LoadError, SceneFile};

/// What `host-sim sweep` takes.
#[derive(Clone, Debug, Args)]
pub struct SweepArguments {
    /// The sweep's file: scene, axes, columns
    #[arg(value_name = "SPEC.toml", value_hint = ValueHint::FilePath)]
    pub spec: PathBuf,
    /// Run a share of the cases, I of N from 1; --merge makes the table of all shares
    #[arg(long, value_name = "I/N")]
    pub shard: Option<Shard>,
    /// Run nothing: make the table of the cases that are finished
    #[arg(long, conflicts_with = "shard")]
    pub merge: bool,
    /// Make the table though cases are missing
    #[arg(long, requires = "merge")]
    pub partial: bool,
    /// Cases that run at once [default: one per core]
    #[arg(long, value_name = "N")]
    pub jobs: Option<std::num::NonZeroUsize>,
    /// Write each case's results as run does, below OUT/SPEC/reports
    #[arg(long, conflicts_with = "merge")]
    pub reports: bool,
    /// Folder below which results are written, each sweep's in one of its file's name
    #[arg(long, value_name = "DIR", default_value = "out", value_hint = ValueHint::DirPath)]
    pub out: PathBuf,
    /// Replace the table of another sweep whose file has the same name
    #[arg(long)]
    pub overwrite: bool,
    /// Print nothing but errors
    #[arg(long)]
    pub quiet: bool,
    /// Print what it came to as JSON
    #[arg(long)]
    pub json: bool,
}

/// A sweep that may begin: its file is read and every axis checked.
pub struct Sweep {
    spec: Spec,
    file: SceneFile,
    found: Found,
    /// What a command line calls the scene.
    called: String,
    /// What messages call its file.
    name: String,
    columns: Vec<Column>,
    base: Digest,
}

impl Sweep {
    /// Reads a sweep's file and its scene, and tries every axis. Nothing is written.
    ///
    /// # Errors
    /// Where one of them is refused.
    pub fn load(catalogue: &Catalogue, path: &Path) -> Result<Self, SweepError> {
        let spec = Spec::load(path)?;
        let called = spec.scene.text.as_str();
        let beside = path.parent().unwrap_or(Path::new("")).join(called);
        let called = match is_path(called) {
            true => beside.display().to_string(),
            false => called.to_owned(),
        };
        let found = match catalogue.load(&called) {
            Err(LoadError::Unknown(_)) if called == "-" => {
                let help = "a scene by name, or a path to a .toml file: each share reads it anew";
                let place = spec.scene.place.clone();
                let message = "a sweep's scene does not come from standard input";
                return Err(spec.source.refuse(place, message, help).into());
            }
            found => found?,
        };
        let place = path.canonicalize().unwrap_or_else(|_| path.to_owned());
        let stem = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let file = SceneFile::new(stem, place.display().to_string(), &spec.source.text);
        // In rows of refused cases it stands, too: the same on every machine.
        let name = format!("{}.toml", found.file.stem);
        let bench = Bench { text: &found.text, file: &name };
        let scene = check(&spec, &bench).map_err(|error| match error {
            CheckError::Refused(refusal) => SweepError::from(refusal),
            CheckError::Scene(error) => SweepError::Load(error.into()),
        })?;
        let columns = columns(&spec, &scene)?;
        let mut base = Digest::new().with("sweep 1").with(VERSION).with(&found.text);
        for column in &columns {
            base = base.with(&column.name);
        }
        Ok(Self { spec, file, found, called, name, columns, base })
    }

    /// Whether a row has the cells of this sweep's columns.
    fn fits(&self, cells: &[String]) -> bool {
        cells.len() == row::length(self.columns.len())
    }

    /// The row of a case.
    fn run(&self, case: usize) -> Row {
        let cases = Cases::new(&self.spec);
        let bench = Bench { text: &self.found.text, file: &self.name };
        // Every combination was looked at.
        let method = cases.method(case).unwrap_or_default();
        bench.run(&cases.changes(case), &method, &self.columns)
    }

    /// Writes what `run` writes of a case; one that is refused has none.
    fn report(&self, case: usize, folder: &SweepFolder) -> Result<(), RunError> {
        let cases = Cases::new(&self.spec);
        let bench = Bench { text: &self.found.text, file: &self.name };
        let Ok(scene) = bench.scene(&cases.changes(case)) else { return Ok(()) };
        let stem = format!("case-{:06}", case + 1);
        let file = SceneFile { stem, ..self.found.file.clone() };
        let out = Destination { out: folder.place.join("reports"), file, overwrite: true };
        let options = RunOptions {
            out: Some(out),
            called: Some(self.called.clone()),
            ..RunOptions::new(cases.method(case).unwrap_or_default())
        };
        match run(&scene, &options, &mut |_, _| ()) {
            Err(error @ (RunError::Write(_) | RunError::Folder(_))) => Err(error),
            _ => Ok(()),
        }
    }

    /// Command lines: the sweep, and its first case alone.
    fn commands(&self, spec: &Path) -> Vec<String> {
        let cases = Cases::new(&self.spec);
        let changes = cases.changes(0);
        let set: String = changes.iter().map(|one| format!(" --set {}", quoted(one))).collect();
        let method = cases.method(0).unwrap_or_default();
        let options: [(&str, Option<String>); 5] = [
            ("scheme", Some(method.scheme_name().into())),
            ("newton", method.newton().filter(|n| *n > 0).map(|n| n.to_string())),
            ("damping", method.foreign_damping().map(|damping| damping.name().into())),
            ("precision", Some(method.precision_name().into())),
            ("orientation", Some(method.orientation_name().into())),
        ];
        let given = options.into_iter().filter_map(|(name, value)| Some((name, value?)));
        let options: String = given.map(|(name, value)| format!(" --{name} {value}")).collect();
        vec![
            format!("host-sim sweep {}", quoted(&spec.display().to_string())),
            format!("host-sim run {}{set}{options}", quoted(&self.called)),
        ]
    }

    /// The key of a case.
    fn key(&self, case: usize) -> Key {
        let cases = Cases::new(&self.spec);
        let method = cases.method(case).unwrap_or_default();
        let newton = method.newton().map_or(String::new(), |newton| newton.to_string());
        let method = [
            method.scheme_name(),
            &newton,
            method.damping().name(),
            method.precision_name(),
            method.orientation_name(),
        ];
        let key = method.iter().fold(self.base, |key, word| key.with(word));
        Key(cases.changes(case).iter().fold(key, |key, change| key.with(change)).bits())
    }
}

/// What of the program makes other rows: its version and, where it was built in its repository, its sources.
pub const VERSION: &str = concat!(env!("CARGO_PKG_VERSION"), env!("DBD_SOURCES"));

/// Does what is asked for; `progress` hears of cases done and cases to do.
///
/// # Errors
/// [`SweepError`]; a case that fails is a row.
pub fn sweep(
    catalogue: &Catalogue,
    arguments: &SweepArguments,
    progress: &mut dyn FnMut(u64, u64),
) -> Result<SweepOutcome, SweepError> {
    let sweep = Sweep::load(catalogue, &arguments.spec)?;
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
        let mut take = |case: usize, row: Row| {
            store.add(keys[case], &row.cells())?;
            ran += 1;
            progress(ran, all);
            Ok(())
        };
        on_all(&pending, threads, &|case| sweep.run(case), &mut take).map_err(SweepError::Write)?;
    }
    if arguments.reports {
        let mut take = |_, written: Result<(), RunError>| written;
        on_all(&own, threads, &|case| sweep.report(case, &folder), &mut take)?;
    }
    let cells = |case: usize| store.get(keys[case]).filter(|cells| sweep.fits(cells));
    let missing = own.iter().copied().filter(|case| cells(*case).is_none()).collect();
    let mut outcome = SweepOutcome::new(&sweep, &store, shard, ran, missing);
    for case in own {
        if let Some(cells) = cells(case) {
            outcome.count(case, &cells);
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

/// The cases of a share. Those of one key are of the share of the first.
fn of_share(keys: &[Key], shard: Shard) -> Vec<usize> {
    let mut first = HashMap::new();
    let is_own = |case: &usize| shard.holds(*first.entry(keys[*case]).or_insert(*case));
    (0..keys.len()).filter(is_own).collect()
}

fn cores() -> usize {
    thread::available_parallelism().map_or(1, usize::from)
}
