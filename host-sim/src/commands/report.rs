//! `host-sim report`: the page of a recorded run, with its animation and its curves, or its log for Foxglove.
//!
//! `(recording, scene) => HTML or MCAP`. The recording is a run's folder or a golden file: of `run`, of a test that
//! steps a plant itself, or of firmware, also within a console's log.

use std::fs::File;
use std::io::{self, Read as _};
use std::path::{Path, PathBuf};

use clap::{Args, ValueHint};
use dbd_kernel::fingerprint::model_hash;
use dbd_report::data::{Data, Run, Table, Text};
use dbd_report::output::file::write_at;
use dbd_report::page::html;
use dbd_report::picture::{Mechanism, Paper, svg};
use dbd_scene::Scene;
use dbd_study::command::quoted;
use miette::Diagnostic;
use thiserror::Error;

use crate::commands::compare::page::MAX_PICTURED;
use crate::commands::compare::replay::{of_rows, of_scene};
use crate::commands::compare::scene::{fits, scene as scene_of};
use crate::commands::compare::words;
use crate::commands::play::is_page;
use crate::comparison::run::{End, end_of};
use crate::recorded::{Head, Recorded, Unreadable};
use crate::terminal::{Catalogue, LoadError};

/// The ending of a file for Foxglove and PlotJuggler, and its first bytes.
const MCAP: &str = "mcap";
const MCAP_MAGIC: &[u8] = b"\x89MCAP0\r\n";

/// The recording and its page.
#[derive(Clone, Debug, Args)]
pub struct ReportArguments {
    /// A recorded run: its folder (out/four-bar), its trace.csv or summary.json; or a golden file, also within a
    /// console log
    #[arg(value_hint = ValueHint::AnyPath)]
    pub run: PathBuf,
    /// The scene by name or path [default: that of the recording, where it is unchanged]
    #[arg(long, value_name = "SCENE", value_hint = ValueHint::FilePath)]
    pub scene: Option<String>,
    /// Write the page to this file; with the ending .mcap, the samples for Foxglove and PlotJuggler [default: the
    /// recording's file with the ending .html]
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    pub out: Option<PathBuf>,
}

/// Why a recorded run has no page.
#[derive(Debug, Error, Diagnostic)]
pub enum ReportError {
    /// The recording cannot be read.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Unreadable(#[from] Unreadable),
    /// The scene cannot be loaded.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Load(#[from] LoadError),
    /// The scene is another one.
    #[error("the scene `{called}` has other bodies than the recording: {bodies}")]
    #[diagnostic(help("give the recording's own scene with --scene"))]
    Bodies {
        /// The scene.
        called: String,
        /// The bodies of the recording.
        bodies: String,
    },
    /// The file has other contents.
    #[error("{} is not {what}", file.display())]
    #[diagnostic(help("choose another file with --out, or remove that one"))]
    Taken {
        /// The file.
        file: PathBuf,
        /// What would be replaced.
        what: &'static str,
    },
    /// This program writes no MCAP files.
    #[error("this host-sim was built without MCAP files")]
    #[diagnostic(help(
        "build it with `cargo install host-sim --features mcap`, or write a page with the ending .html"
    ))]
    NoMcap,
    /// An MCAP file needs the scene.
    #[error("no MCAP file: {why}")]
    #[diagnostic(help("give the recording's own scene with --scene"))]
    NoScene {
        /// Why there is no scene.
        why: String,
    },
    /// The page cannot be written.
    #[error("cannot write {}: {reason}", file.display())]
    Write {
        /// The file.
        file: PathBuf,
        /// The reason; part of the message and therefore not a source, which would repeat it.
        reason: io::Error,
    },
}

/// A page that was written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Written {
    /// Its file.
    pub file: PathBuf,
    /// What it lacks, a sentence each.
    pub warnings: Vec<String>,
}

/// Writes the page of a recorded run.
///
/// # Errors
/// [`ReportError`]; nothing is written then.
pub fn report(catalogue: &Catalogue, arguments: &ReportArguments) -> Result<Written, ReportError> {
    let recorded = Recorded::open(&arguments.run)?;
    let head = recorded.head.clone();
    let end = end_of(recorded)?;
    let mut warnings = head.unchecked.clone();
    let scene = match &arguments.scene {
        Some(called) => Ok(asked(catalogue, called, &head, &mut warnings)?),
        None => scene_of(catalogue, &head),
    };
    let again = || Recorded::open(&arguments.run);
    let file = arguments.out.clone().unwrap_or_else(|| head.file.with_extension("html"));
    if file.extension().is_some_and(|ending| ending == MCAP) {
        let scene = scene.map_err(|why| ReportError::NoScene { why })?;
        let bytes = log(&scene, again()?, end)?.map_err(|why| ReportError::NoScene { why })?;
        return written(file, &bytes, warnings);
    }
    let shown = match &scene {
        Ok(scene) => of_scene(scene, again()?, end)?,
        Err(why) => Err(why.clone()),
    };
    let run: Run = match shown {
        Ok(run) => run,
        Err(why) => {
            warnings.push(format!("no animation: {why}; give the scene with --scene"));
            of_rows(again()?, end)?
        }
    };
    let pictured = scene.as_ref().ok().filter(|scene| scene.body_names.len() <= MAX_PICTURED);
    let description = scene.as_ref().map(|scene| scene.description.clone()).unwrap_or_default();
    let mut data = Data::of_run(&head.scene, &description, run);
    data.text = Text {
        failures: head.status.iter().filter(|status| *status != "ok").cloned().collect(),
        warnings: warnings.clone(),
        picture: pictured.map(|scene| svg(&Mechanism::of(scene), Paper::Page)),
        tables: vec![Table {
            title: "Recording".into(),
            columns: Vec::new(),
            rows: vec![vec!["run".into(), words::run(&head, end)]],
        }],
        commands: vec![(String::new(), command(arguments))],
        ..Text::default()
    };
    written(file, html(&data).as_bytes(), warnings)
}

#[cfg(feature = "mcap")]
fn log(scene: &Scene, run: Recorded, end: End) -> Result<Result<Vec<u8>, String>, ReportError> {
    Ok(crate::commands::compare::replay::log_of_scene(scene, run, end)?)
}

#[cfg(not(feature = "mcap"))]
fn log(_: &Scene, _: Recorded, _: End) -> Result<Result<Vec<u8>, String>, ReportError> {
    Err(ReportError::NoMcap)
}

/// Writes a file that does not exist, is empty, or is of its kind.
fn written(file: PathBuf, bytes: &[u8], warnings: Vec<String>) -> Result<Written, ReportError> {
    let (what, is_own) = if bytes.starts_with(MCAP_MAGIC) {
        ("an MCAP file", begins(&file, MCAP_MAGIC))
    } else {
        ("an HTML page", is_page(&file))
    };
    // A device, which seems empty, is not replaced either.
    if file.exists() && !(file.is_file() && is_own) {
        return Err(ReportError::Taken { file, what });
    }
    match write_at(&file, bytes) {
        Ok(()) => Ok(Written { file, warnings }),
        Err(reason) => Err(ReportError::Write { file, reason }),
    }
}

/// Whether a file is empty or begins with the given bytes.
fn begins(file: &Path, with: &[u8]) -> bool {
    let mut bytes = Vec::new();
    let read =
        File::open(file).and_then(|file| file.take(with.len() as u64).read_to_end(&mut bytes));
    read.is_ok() && (bytes.is_empty() || bytes == with)
}

/// The scene that was asked for, if it has the recording's bodies.
fn asked(
    catalogue: &Catalogue,
    called: &str,
    head: &Head,
    warnings: &mut Vec<String>,
) -> Result<Scene, ReportError> {
    let found = catalogue.load(called)?;
    let Ok(scene) = fits(found.scene, head) else {
        let bodies = head.bodies.join(", ");
        return Err(ReportError::Bodies { called: called.to_owned(), bodies });
    };
    let differs = head.model.is_some_and(|model| model != model_hash(&*scene.in_world()));
    if differs {
        warnings.push(format!(
            "`{called}` has other numbers than the recorded model: forces and energies are those of the scene"
        ));
    }
    Ok(scene)
}

fn command(arguments: &ReportArguments) -> String {
    let run = quoted(&arguments.run.display().to_string());
    let scene = arguments.scene.as_ref().map(|scene| format!(" --scene {}", quoted(scene)));
    format!("host-sim report {run}{}", scene.unwrap_or_default())
}
