//! `host-sim compare`: two recorded runs in one report.
//!
//! `(A, B, bands) => comparison => OUT/compare/NAME/{report.html,compare.json}, words`.
//!
//! - [`differs`]: the settings in which the two runs differ.
//! - [`words`]: the report for people.
//! - [`record`]: the report for programs.
//! - [`folder`]: its folder.
//! - [`scene`], [`charts`], [`replay`], [`mod@page`]: the page.

pub mod charts;
pub mod differs;
pub mod folder;
pub mod page;
pub mod record;
pub mod replay;
pub mod scene;
pub mod words;

use std::io;
use std::path::PathBuf;

use clap::{Args, ValueHint};
use dbd_golden::BandList;
use dbd_report::output::set::FileSet;
use miette::Diagnostic;
use thiserror::Error;

use crate::commands::compare::folder::{PAGE, Place, SEAL};
use crate::commands::compare::page::{Differences, page};
use crate::commands::compare::record::Record;
use crate::commands::compare::scene::scenes;
use crate::commands::folder::FolderError;
use crate::comparison::{CompareError, Comparison, compare};
use crate::recorded::{Recorded, Unreadable};
use crate::terminal::Catalogue;
use crate::terminal::text::json;

/// The compared runs and the destination of the report.
#[derive(Clone, Debug, Args)]
pub struct CompareArguments {
    /// A run: its folder (out/four-bar), its trace.csv or summary.json; or a golden file, also within a
    /// console log
    #[arg(value_hint = ValueHint::AnyPath)]
    pub a: PathBuf,
    /// The second run, likewise
    #[arg(value_hint = ValueHint::AnyPath)]
    pub b: PathBuf,
    /// Accept differences within bands: 1e-6 for all in SI units, or
    /// position=1e-6,orientation=1e-6,velocity=1e-3,angular-velocity=1e-3,READOUT=1e-3
    #[arg(long, value_name = "BANDS", allow_hyphen_values = true)]
    pub band: Option<BandList>,
    /// Folder for the report, written to compare/NAME/ in it
    #[arg(long, value_name = "DIR", default_value = "out", value_hint = ValueHint::DirPath)]
    pub out: PathBuf,
    /// Do not write a report
    #[arg(long)]
    pub no_report: bool,
    /// Overwrite the report of two other runs whose folders have the same names
    #[arg(long)]
    pub overwrite: bool,
    /// Print only errors
    #[arg(long)]
    pub quiet: bool,
    /// Print the comparison as JSON
    #[arg(long)]
    pub json: bool,
}

/// Why two runs were not compared, or the report not written.
#[derive(Debug, Error, Diagnostic)]
pub enum CompareRefusal {
    /// One cannot be read.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Unreadable(#[from] Unreadable),
    /// They cannot be compared.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Compare(#[from] CompareError),
    /// There is no folder for the report.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Folder(#[from] FolderError),
    /// The report cannot be written.
    #[error("cannot write the report: {0}")]
    Write(io::Error),
}

/// The outcome of a comparison.
#[derive(Clone, Debug)]
pub struct Compared {
    /// The comparison.
    pub comparison: Comparison,
    /// The same for programs.
    pub record: Record,
    /// The folder of the report, where one was written.
    pub folder: Option<PathBuf>,
}

/// Compares two runs and writes the report. `progress` is called with the finished and total numbers of common samples.
///
/// # Errors
/// [`CompareRefusal`]; nothing is written then.
pub fn compare_runs(
    catalogue: &Catalogue,
    arguments: &CompareArguments,
    progress: &mut dyn FnMut(u64, u64),
) -> Result<Compared, CompareRefusal> {
    let paths = [&arguments.a, &arguments.b];
    let [a, b] = paths.map(|path| Recorded::open(path));
    let runs = [a?, b?];
    let all = runs[0].head.samples.min(runs[1].head.samples);
    let mut done = 0;
    let mut differences = Differences::new([&runs[0].head, &runs[1].head]);
    let comparison = compare(runs, arguments.band.as_ref(), &mut |a, b| {
        differences.look(a, b);
        done += 1;
        if done % 1024 == 0 {
            progress(done.min(all), all);
        }
    })?;
    let record = Record::of(&comparison);
    let mut folder = None;
    if !arguments.no_report {
        let called = paths.map(PathBuf::as_path);
        let files = comparison.heads.each_ref().map(|head| head.file.as_path());
        let place = Place::of(&arguments.out, called, files, arguments.overwrite);
        let at = place.folder()?;
        let scenes = scenes(catalogue, &comparison.heads);
        let page = page(&comparison, differences, &scenes, called)?;
        let mut files = FileSet::new(&at);
        let written = files.write(PAGE, &page).and_then(|()| files.write(SEAL, &json(&record)));
        let whole = written.and_then(|()| files.finish()).map_err(CompareRefusal::Write)?;
        // Another comparison may have been written there meanwhile.
        place.claim(&at)?;
        whole.publish().map_err(CompareRefusal::Write)?;
        folder = Some(at);
    }
    Ok(Compared { comparison, record, folder })
}
