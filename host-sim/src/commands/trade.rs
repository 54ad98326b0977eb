//! `host-sim trade`: speed and accuracy of every method on a scene at every step.
//!
//! `(scene, window) => survey => OUT/SCENE/trade.{csv,svg,html,json}`, the results kept in the folder
//! for the next call.

use std::io;
use std::path::PathBuf;

use dbd_report::output::set::FileSet;
use dbd_scene::Scene;
use dbd_study::frame::frame;
use dbd_study::{Phase, SurveyError, Trade, TradeOptions, files, survey};
use miette::Diagnostic;
use serde::Serialize;
use thiserror::Error;

use crate::commands::folder::{Destination, FolderError};
use crate::report::SetValue;
use crate::terminal::SceneFile;
use crate::terminal::text;

/// The request for a trade-off study.
#[derive(Clone, Debug)]
pub struct TradeRequest<'r> {
    /// The scene's name on the command line.
    pub called: &'r str,
    /// \[s\] the longest window; 0.5 s or the scene's duration where `None`.
    pub window: Option<f64>,
    /// \[s\] a multiple of every step; the scene's sampling interval or a round time if `None`.
    pub period: Option<f64>,
    /// Where results go.
    pub out: &'r Destination,
    /// The built-in scene of this name.
    pub shipped: Option<Scene>,
}

/// Why a study failed, or its results could not be written.
#[derive(Debug, Error, Diagnostic)]
pub enum TradeError {
    /// The study failed.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Survey(#[from] SurveyError),
    /// The folder for the results cannot be made.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Folder(#[from] FolderError),
    /// Results cannot be written.
    #[error("cannot write the results: {0}")]
    Write(io::Error),
}

/// Runs a study and writes the results; `progress` is called with its phase. Returns the study and the
/// folder of its files.
///
/// # Errors
/// [`TradeError`].
pub fn trade(
    scene: &Scene,
    request: TradeRequest<'_>,
    progress: &mut dyn FnMut(Phase),
) -> Result<(Trade, PathBuf), TradeError> {
    let TradeRequest { called, window, period, out, shipped } = request;
    let options = TradeOptions { window, period, cache: None, shipped };
    // Bad input leaves no folder behind.
    frame(scene, &options).map_err(SurveyError::from)?;
    let folder = out.folder(&scene.name)?;
    let options = TradeOptions { cache: Some(folder.clone()), ..options };
    let trade = survey(scene, &options, progress)?;
    let report = files::Report { scene, called, trade: &trade };
    let mut files = FileSet::new(&folder);
    let written = report.add_to(&mut files);
    let written = written.and_then(|()| files.write("trade.json", &json(&report, &out.file)));
    let whole = written.and_then(|()| files.finish()).map_err(TradeError::Write)?;
    // Another scene's results may have been written there meanwhile.
    out.claim(&folder, &scene.name)?;
    whole.publish().map_err(TradeError::Write)?;
    Ok((trade, folder))
}

/// The JSON of a study: window, points and origin.
#[must_use]
pub fn json(report: &files::Report<'_>, file: &SceneFile) -> String {
    #[derive(Serialize)]
    struct Whole<'w> {
        #[serde(flatten)]
        survey: files::Json<'w>,
        scene_file: &'w str,
        scene_hash: &'w str,
        #[serde(skip_serializing_if = "Vec::is_empty")]
        set: Vec<SetValue>,
    }
    let SceneFile { place, hash, .. } = file;
    let set = SetValue::of(report.scene);
    text::json(&Whole { survey: report.json(), scene_file: place, scene_hash: hash, set })
}
