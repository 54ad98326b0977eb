//! The head of a recorded run.

use std::path::PathBuf;

use dbd_plant::number_format::NumberFormat;
use serde::Serialize;

use crate::report::summary::SetValue;

/// The kind of a recording.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Kind {
    /// A trace with its summary.
    Run,
    /// A golden file.
    Golden,
}

/// A number besides those of the bodies.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Value {
    /// Its name, that of a read-out's column in a trace.
    pub name: String,
    /// Its unit; `None` where it is not recorded.
    pub unit: Option<String>,
}

/// The properties of a recorded run. SI units.
#[derive(Clone, Debug, PartialEq)]
pub struct Head {
    /// The file that holds its samples.
    pub file: PathBuf,
    /// The kind of the recording.
    pub kind: Kind,
    /// The scene's name.
    pub scene: String,
    /// The scheme's name.
    pub scheme: String,
    /// Newton iterations per step, where they are known.
    pub newton: Option<u32>,
    /// ρ∞, of the scheme that has it.
    pub rho: Option<f64>,
    /// The damping method, if known.
    pub damping: Option<String>,
    /// The precision's name.
    pub precision: String,
    /// The representation of orientations.
    pub orientation: String,
    /// \[s\] the step.
    pub step: f64,
    /// Samples.
    pub samples: u64,
    /// How many digits its numbers have.
    pub number_format: NumberFormat,
    /// Names of the bodies in the model's order.
    pub bodies: Vec<String>,
    /// The other recorded values, except energies.
    pub values: Vec<Value>,
    /// `ok`, or why it ended early; `None` where that is not recorded.
    pub status: Option<String>,
    /// Values of the scene that were changed for it.
    pub set: Vec<SetValue>,
    /// The whole path of the scene's file, or `built in` or `standard input`.
    pub scene_file: Option<String>,
    /// FNV-1a 64 of that file's text.
    pub scene_hash: Option<String>,
    /// Hash of the model, the same in every precision.
    pub model: Option<u64>,
    /// The version of host-sim that ran it.
    pub version: Option<String>,
    /// Properties that could not be checked, one sentence each.
    pub unchecked: Vec<String>,
}

impl Head {
    /// Whether it ended early.
    #[must_use]
    pub fn failed(&self) -> bool {
        self.status.as_ref().is_some_and(|status| status != "ok")
    }
}
