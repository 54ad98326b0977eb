//! The keys of a `summary.json` that are needed to read its trace.
//!
//! `file => keys`. Keys of later versions are ignored; a later format of the trace is an error. Keys that earlier
//! versions did not write are `None`.

use std::path::Path;

use dbd_scene::file::{MAX_BYTES, read};
use serde::Deserialize;

use crate::recorded::unreadable::Unreadable;
use crate::report::summary::SetValue;
use crate::report::trace::FORMAT;

/// The needed keys of a summary.
#[derive(Clone, Debug, Deserialize)]
pub struct RunSummary {
    /// Version of host-sim.
    pub version: Option<String>,
    /// Format of the trace.
    pub trace_format: Option<u64>,
    /// Rows of the trace.
    pub samples: Option<u64>,
    /// Hash of the trace's text.
    pub trace_hash: Option<String>,
    /// The scene's name.
    pub scene: String,
    /// The scheme.
    pub scheme: String,
    /// Newton iterations.
    pub newton: Option<u32>,
    /// ρ∞, of the scheme that has it.
    #[serde(default)]
    pub rho: Option<f64>,
    /// The damping method, if not the scheme's own.
    pub damping: Option<String>,
    /// The precision.
    pub precision: String,
    /// How orientations were stored.
    pub orientation: String,
    /// \[s\] the step.
    pub step: f64,
    /// \[s\] how far the run came.
    pub duration: f64,
    /// \[J\] energy of the last row.
    pub energy_final: Option<f64>,
    /// Hash of the last row's state.
    pub state_hash: Option<String>,
    /// Turn counts of the last row.
    #[serde(default)]
    pub turns: Vec<i32>,
    /// `ok`, or why it ended early.
    pub status: String,
    /// Where the scene came from.
    pub scene_file: Option<String>,
    /// Hash of that text.
    pub scene_hash: Option<String>,
    /// Values that were changed.
    #[serde(default)]
    pub set: Vec<SetValue>,
    /// Columns of the read-outs.
    #[serde(default)]
    pub readouts: Vec<Column>,
}

/// A column of a read-out.
#[derive(Clone, Debug, Deserialize)]
pub struct Column {
    /// Its name.
    pub name: String,
    /// Its unit.
    pub unit: String,
}

impl RunSummary {
    /// Reads a summary.
    ///
    /// # Errors
    /// If it cannot be read, is not a summary, or has a later format.
    pub fn read(file: &Path) -> Result<Self, Unreadable> {
        let failed = |reason| Unreadable::system(file, &reason);
        let text = read(file, MAX_BYTES).map_err(failed)?;
        let summary: Self = serde_json::from_slice(&text).map_err(|error| {
            // The position is reported separately; serde's is at the end of its message.
            let words = error.to_string();
            let words = words.split(" at line ").next().unwrap_or_default();
            let wrong = Unreadable::new(file, format!("is not a summary of a run: {words}"));
            let wrong = wrong.at_line(error.line().max(1) as u64).at_column(error.column().max(1));
            wrong.with_remedy("run the scene again: its trace and its summary belong together")
        })?;
        let wrong = |problem: String| Unreadable::new(file, problem);
        if let Some(format) = summary.trace_format.filter(|format| *format != u64::from(FORMAT)) {
            let by = summary.version.as_ref().map(|of| format!(" by host-sim {of}"));
            return Err(wrong(format!(
                "its trace is of format {format}, written{}; this program, {}, reads format {FORMAT}",
                by.unwrap_or_default(),
                env!("CARGO_PKG_VERSION"),
            ))
            .with_remedy("compare with the program that wrote it, or run the scene again with this program"));
        }
        let times = [("step", summary.step), ("duration", summary.duration)];
        if let Some((key, time)) =
            times.iter().find(|(_, time)| !(time.is_finite() && *time >= 0.0))
        {
            return Err(wrong(format!("`{key}` is {time}, which is not a valid time")));
        }
        if summary.step == 0.0 {
            return Err(wrong("`step` is 0, which is not a valid step".into()));
        }
        Ok(summary)
    }

    /// A hash of 16 hexadecimal digits; `None` for any other text.
    #[must_use]
    pub fn hash(text: &str) -> Option<u64> {
        if text.len() == 16 { u64::from_str_radix(text, 16).ok() } else { None }
    }
}
