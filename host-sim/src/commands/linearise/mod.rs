//! `host-sim linearise`: a scene as a linear system.
//!
//! `(scene, time, states, inputs, outputs) => A, B, C, D, poles`, as text, JSON, CSV or MATLAB source. The plant
//! runs to the time with the default method first.

mod formats;
mod report;

use std::fmt;
use std::path::{Path, PathBuf};

use clap::{Args, ValueHint};
use dbd_plant::instance::{Blueprint, Instance, InstanceError, LinearOptions, Settings};
use dbd_plant::time::Time;
use dbd_scene::nearest;
use miette::Diagnostic;
use thiserror::Error;

use crate::arguments::SceneArgument;
use crate::commands::linearise::formats::Format;
pub use crate::commands::linearise::report::{LinearReport, Pole, Quantity};
use crate::commands::replace::{ReplaceError, replace};
use crate::terminal::Found;

/// The scene, the time and the destination of a linearisation.
#[derive(Clone, Debug, Args)]
pub struct LineariseArguments {
    /// The scene
    #[command(flatten)]
    pub scene: SceneArgument,
    /// Run to this time first, with the default method and step, e.g. 0.5s [default: stay at t = 0]
    #[arg(long, value_name = "TIME", allow_hyphen_values = true)]
    pub at: Option<Time>,
    /// Outputs to use as states, one per retained slow motion [default: twelve coordinates per
    /// body]
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    pub states: Option<Vec<String>>,
    /// Inputs [default: all]
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    pub inputs: Option<Vec<String>>,
    /// Outputs [default: the states; without --states, all read-outs]
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    pub outputs: Option<Vec<String>>,
    /// Write A, B, C and D to this file, atomically; its name ends with .json, .csv or .m (MATLAB)
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    pub out: Option<PathBuf>,
}

/// Why there is no linear system.
#[derive(Debug, Error)]
pub enum LineariseError {
    /// The scene, the time or the states are refused, or a step failed.
    #[error(transparent)]
    Instance(#[from] InstanceError),
    /// No input or output has this name.
    #[error("the scene `{scene}` has no {kind} `{name}`")]
    Unknown {
        /// The scene.
        scene: String,
        /// `input` or `output`.
        kind: &'static str,
        /// What was asked for.
        name: String,
        /// All that there are.
        known: Vec<String>,
    },
    /// The file name has no known extension.
    #[error("{} does not end with .json, .csv or .m", file.display())]
    Ending {
        /// The file.
        file: PathBuf,
    },
    /// The file is not written.
    #[error(transparent)]
    File(#[from] ReplaceError),
}

impl Diagnostic for LineariseError {
    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        match self {
            Self::Instance(error) => error.help(),
            Self::Unknown { kind, name, known, .. } if known.is_empty() => {
                Some(Box::new(format!("it has no {kind}s; omit `{name}`")))
            }
            Self::Unknown { kind, name, known, .. } => {
                let meant = nearest(name, known.iter().map(String::as_str));
                let meant =
                    meant.map(|meant| format!("did you mean {meant}? ")).unwrap_or_default();
                Some(Box::new(format!("{meant}the {kind}s: {}", known.join(", "))))
            }
            Self::Ending { .. } => Some(Box::new("the extension selects the format")),
            Self::File(error) => error.help(),
        }
    }
}

/// Linearises a scene; writes the file where one is asked for.
///
/// # Errors
/// [`LineariseError`]; nothing is written then.
pub fn linearise(
    found: &Found,
    arguments: &LineariseArguments,
) -> Result<LinearReport, LineariseError> {
    let out = arguments.out.as_deref().map(|file| format_of(file).map(|format| (file, format)));
    let out = out.transpose()?;
    let blueprint = Blueprint {
        file: format!("{}.toml", found.file.stem),
        text: found.text.as_str().into(),
        changes: arguments.scene.changes(),
    };
    let mut instance = Instance::new(blueprint, Settings::default())?;
    let LineariseArguments { states, inputs, outputs, .. } = arguments;
    let known: Vec<&str> = instance.inputs().iter().map(|input| input.name.as_str()).collect();
    check(found, "input", inputs.iter().flatten(), &known)?;
    let known: Vec<&str> = instance.outputs().iter().map(|output| output.name.as_str()).collect();
    check(found, "output", states.iter().chain(outputs).flatten(), &known)?;
    if let Some(time) = arguments.at {
        instance.advance_to(time.seconds())?;
    }
    let options = LinearOptions {
        states: states.clone(),
        inputs: inputs.clone(),
        outputs: outputs.clone(),
        ..LinearOptions::default()
    };
    let linear = instance.linearise(&options)?;
    let report = LinearReport::of(found, &instance, linear, states.is_some())?;
    if let Some((file, format)) = out {
        replace(file, &format.text(&report), (format.head(), "linearise"))?;
    }
    Ok(report)
}

fn format_of(file: &Path) -> Result<Format, LineariseError> {
    let ending = file.extension().and_then(|ending| ending.to_str());
    let format = ending.and_then(Format::of_ending);
    format.ok_or_else(|| LineariseError::Ending { file: file.to_owned() })
}

fn check<'n>(
    found: &Found,
    kind: &'static str,
    mut names: impl Iterator<Item = &'n String>,
    known: &[&str],
) -> Result<(), LineariseError> {
    let Some(name) = names.find(|name| !known.contains(&name.as_str())) else { return Ok(()) };
    let known = known.iter().map(|name| (*name).to_owned()).collect();
    Err(LineariseError::Unknown {
        scene: found.scene.name.clone(),
        kind,
        name: name.clone(),
        known,
    })
}
