//! `host-sim trade`: speed against accuracy, every way of stepping a scene at every step.
//!
//! `(scene, window) => survey => OUT/SCENE/trade.{csv,svg,html}`, the results kept in the folder for
//! the next call.

use std::io;
use std::path::{Path, PathBuf};

use dbd_scene::Scene;
use dbd_study::survey::longest_window;
use dbd_study::{Phase, SurveyError, Trade, TradeOptions, files, survey};
use miette::Diagnostic;
use thiserror::Error;

use crate::commands::folder::{FolderError, results};

/// What a survey is asked for.
#[derive(Clone, Copy, Debug)]
pub struct TradeRequest<'r> {
    /// What a command line calls the scene.
    pub called: &'r str,
    /// \[s\] the longest window; 0.5 s or the scene's duration where `None`.
    pub window: Option<f64>,
    /// The folder below which results go.
    pub out: &'r Path,
    /// Whether the scene is the one that ships under its name.
    pub shipped: bool,
}

/// Why a survey could not be made, or its results not be written.
#[derive(Debug, Error, Diagnostic)]
pub enum TradeError {
    /// There is no survey.
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

/// Surveys a scene and writes the results; `progress` hears what it is at. The survey, and the
/// folder of its files.
///
/// # Errors
/// [`TradeError`].
pub fn trade(
    scene: &Scene,
    request: &TradeRequest<'_>,
    progress: &mut dyn FnMut(Phase),
) -> Result<(Trade, PathBuf), TradeError> {
    let TradeRequest { called, window, out, shipped } = *request;
    // Bad input leaves no folder behind.
    longest_window(scene, window).map_err(SurveyError::from)?;
    let folder = results(out, scene)?;
    let options = TradeOptions { window, cache: Some(folder.clone()), shipped };
    let trade = survey(scene, &options, progress)?;
    let report = files::Report { scene, called, trade: &trade };
    report.write(&folder).map_err(TradeError::Write)?;
    Ok((trade, folder))
}
