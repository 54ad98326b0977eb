//! `host-sim import`: a mechanism of another program's file becomes a scene.
//!
//! `FILE.xml => TOML, what was left out, what is good to know`. The scene is loaded before it is handed on:
//! what is written can be run.

use std::fmt;
use std::path::{Path, PathBuf};

use clap::builder::TypedValueParser;
use clap::{Args, ValueEnum, ValueHint};
use dbd_import::{Imported, Kind, Options, Weld, omission};
use dbd_plant::time::Time;
use dbd_scene::{Assembled, OpenJoint, Scene, SceneError};
use miette::{Diagnostic, LabeledSpan, SourceCode};
use thiserror::Error;

use crate::arguments::{Ignored, ignorable};
use crate::commands::replace::{ReplaceError, replace};

/// The imported file, the settings and the destination.
#[derive(Clone, Debug, Args)]
pub struct ImportArguments {
    /// MJCF, MuJoCo's XML, or URDF
    #[arg(value_hint = ValueHint::FilePath)]
    pub file: PathBuf,
    /// Write to this file, atomically, instead of to standard output
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    pub out: Option<PathBuf>,
    /// Omit elements of this kind that have no counterpart; may be repeated
    #[arg(long, value_name = "KIND", value_parser = kinds())]
    pub ignore: Vec<Ignored<Kind>>,
    /// List elements without a counterpart, with line and size, and write nothing
    #[arg(long, conflicts_with = "out")]
    pub list: bool,
    /// Stiffness of each spring of a joint, N/m
    #[arg(long, value_name = "N/m", default_value = "1e7", value_parser = above_zero, allow_hyphen_values = true)]
    pub stiffness: f64,
    /// Damping of each spring of a joint, N·s/m
    #[arg(long, value_name = "N·s/m", default_value = "0", value_parser = not_negative, allow_hyphen_values = true)]
    pub damping: f64,
    /// Size of all joints, m [default: each twice the radius of gyration of the smaller of its bodies]
    #[arg(long, value_name = "m", value_parser = above_zero, allow_hyphen_values = true)]
    pub span: Option<f64>,
    /// Largest permitted gap of a loop, m [default: 1e-4 of the mechanism's size]
    #[arg(long, value_name = "m", value_parser = above_zero, allow_hyphen_values = true)]
    pub tolerance: Option<f64>,
    /// Fraction of a body's mass given to the bodies between its joints if the file states none, e.g. 0.01
    #[arg(long, value_name = "FRACTION", value_parser = fraction, allow_hyphen_values = true)]
    pub carriers: Option<f64>,
    /// Treatment of a body without a joint
    #[arg(long, value_enum, default_value = "merge")]
    pub weld: WeldArgument,
    /// Start at this keyframe of the file [default: the pose of its bodies]
    #[arg(long, value_name = "NAME")]
    pub keyframe: Option<String>,
    /// Duration to write into the scene, e.g. 0.5s
    #[arg(long, value_name = "TIME", default_value = "1s", allow_hyphen_values = true)]
    pub duration: Time,
    /// The scene's name [default: the model's]
    #[arg(long, value_name = "NAME")]
    pub name: Option<String>,
}

/// Treatment of a body without a joint.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum WeldArgument {
    /// Merge it with its parent
    Merge,
    /// Keep it as a separate body with a fixed joint
    Fixed,
}

fn kinds() -> impl TypedValueParser<Value = Ignored<Kind>> {
    ignorable(Kind::ALL, |kind| [kind.name(), kind.summary()])
}

fn number(text: &str) -> Result<f64, String> {
    let number = text.trim().parse::<f64>().ok().filter(|number| number.is_finite());
    number.ok_or_else(|| "expected a finite number".to_owned())
}

fn above_zero(text: &str) -> Result<f64, String> {
    number(text).and_then(|n| if n > 0.0 { Ok(n) } else { Err("expected a number above 0".into()) })
}

fn not_negative(text: &str) -> Result<f64, String> {
    number(text)
        .and_then(|n| if n >= 0.0 { Ok(n) } else { Err("expected a number of at least 0".into()) })
}

fn fraction(text: &str) -> Result<f64, String> {
    number(text).and_then(|n| {
        if n > 0.0 && n < 1.0 { Ok(n) } else { Err("expected a number between 0 and 1".into()) }
    })
}

/// Why nothing was imported.
#[derive(Debug, Error)]
pub enum ImportError {
    /// The file is refused.
    #[error(transparent)]
    Import(#[from] dbd_import::ImportError),
    /// The resulting scene is invalid.
    #[error("invalid scene from {}: {error}", file.display())]
    Scene {
        /// The file.
        file: PathBuf,
        /// The reason; part of the message and therefore not a source, which would repeat it.
        error: SceneError,
    },
    /// A loop does not close; the scene is returned nevertheless.
    #[error("a loop of {} remains open by {gap:.1e} m at {joint}: its scene does not load", file.display())]
    Open {
        /// The file.
        file: PathBuf,
        /// The joint that is open most.
        joint: String,
        /// \[m\] by how much, an angle times the length of `[assemble]` included.
        gap: f64,
    },
}

impl Diagnostic for ImportError {
    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        match self {
            Self::Import(error) => Diagnostic::help(error),
            Self::Scene { error, .. } => Diagnostic::help(error),
            Self::Open { gap, .. } => Some(Box::new(format!(
                "correct the points or poses in the written scene, or allow the gap with \
                 `--tolerance {:.0e}`, or in the scene with `tolerance` in [assemble]",
                2.0 * gap
            ))),
        }
    }

    fn source_code(&self) -> Option<&dyn SourceCode> {
        match self {
            Self::Import(error) => error.source_code(),
            Self::Scene { error, .. } => error.source_code(),
            _ => None,
        }
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        match self {
            Self::Import(error) => error.labels(),
            Self::Scene { error, .. } => error.labels(),
            _ => None,
        }
    }
}

impl ImportArguments {
    fn options(&self) -> Options {
        Options {
            name: self.name.clone(),
            stiffness: self.stiffness,
            damping: self.damping,
            span: self.span,
            tolerance: self.tolerance,
            carriers: self.carriers,
            duration: self.duration.seconds(),
            weld: match self.weld {
                WeldArgument::Merge => Weld::Merge,
                WeldArgument::Fixed => Weld::Fixed,
            },
            keyframe: self.keyframe.clone(),
            ignored: Ignored::all_of(&self.ignore, Kind::ALL),
        }
    }
}

/// What a file becomes, and how its loops close.
pub struct Import {
    /// The scene and what it leaves out.
    pub imported: Imported,
    /// The joints that were open at the file's pose and are closed, in words.
    pub closed: Option<String>,
    /// [`ImportError::Open`], where a loop does not close.
    pub open: Option<ImportError>,
}

/// \[m\] larger than any gap.
const ANY_GAP: f64 = 1e9;

/// Imports a file, and loads what it becomes.
///
/// # Errors
/// [`ImportError`], except for errors of the output file and [`ImportError::Open`].
pub fn import(arguments: &ImportArguments) -> Result<Import, ImportError> {
    let options = arguments.options();
    let imported = dbd_import::import(&arguments.file, &options)?;
    let called = format!("{} as a scene", arguments.file.display());
    match Scene::parse(&imported.scene, &called) {
        Ok(scene) => Ok(Import { closed: closed(&scene), imported, open: None }),
        // A scene that loads with any gap allowed has no other error.
        Err(error) => {
            let file = arguments.file.clone();
            let options = Options { tolerance: Some(ANY_GAP), ..options };
            let widened = dbd_import::import(&arguments.file, &options)?;
            let open = Scene::parse(&widened.scene, &called).ok().and_then(|scene| worst(&scene));
            match open {
                Some((joint, gap)) => {
                    let open = Some(ImportError::Open { file, joint, gap });
                    Ok(Import { imported, closed: None, open })
                }
                None => Err(ImportError::Scene { file, error }),
            }
        }
    }
}

/// \[m\] the gap of a joint, its angle times the length of `[assemble]`.
fn size(open: &OpenJoint, assembled: &Assembled) -> f64 {
    open.distance + assembled.length * open.angle
}

/// The joint that an assembled scene leaves open most, and by how much.
fn worst(scene: &Scene) -> Option<(String, f64)> {
    let assembled = scene.assembled.as_ref()?;
    let left = assembled.left.as_ref()?;
    Some((left.joint.clone(), size(left, assembled)))
}

/// By how much the loops of a scene were open, and are.
fn closed(scene: &Scene) -> Option<String> {
    let assembled = scene.assembled.as_ref()?;
    let before = assembled.open.iter().map(|open| size(open, assembled)).fold(0.0, f64::max);
    let (joint, gap) = worst(scene)?;
    Some(format!(
        "loops open by up to {before:.1e} m at the file's pose were closed; the largest remaining gap, at {joint}, \
         is {gap:.1e} m"
    ))
}

/// The elements of a file without a counterpart, one per line.
///
/// # Errors
/// Where the file is refused for another reason.
pub fn list(arguments: &ImportArguments) -> Result<String, ImportError> {
    let options = Options { ignored: Kind::ALL.to_vec(), ..arguments.options() };
    let imported = dbd_import::import(&arguments.file, &options)?;
    Ok(omission::table(&imported.omitted))
}

/// Writes an imported scene to a file, in place of an older one of the same source.
///
/// # Errors
/// [`ReplaceError`].
pub fn write(file: &Path, text: &str) -> Result<(), ReplaceError> {
    let head = text.split_inclusive('\n').next().unwrap_or_default();
    replace(file, text, (head, "import"))
}
