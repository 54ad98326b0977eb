//! `host-sim import`: a mechanism of another program's file becomes a scene.
//!
//! `FILE.xml => TOML, what was left out, what is good to know`. The scene is loaded before it is handed on:
//! what is written can be run.

use std::fmt;
use std::io::{self, BufRead as _};
use std::path::{Path, PathBuf};

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use clap::{Args, ValueEnum, ValueHint};
use dbd_import::{Imported, Kind, Options, Weld, omission};
use dbd_plant::time::Time;
use dbd_report::output::file::write_at;
use dbd_scene::{Assembled, OpenJoint, Scene, SceneError};
use miette::{Diagnostic, LabeledSpan, SourceCode};
use thiserror::Error;

/// Takes all kinds.
const ALL: &str = "all";

/// What is imported, how, and where to.
#[derive(Clone, Debug, Args)]
pub struct ImportArguments {
    /// MJCF, MuJoCo's XML, or URDF
    #[arg(value_hint = ValueHint::FilePath)]
    pub file: PathBuf,
    /// Write to this file, whole or not at all, instead of to standard output
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    pub out: Option<PathBuf>,
    /// Leave out what has no counterpart, by its kind; as often as wanted
    #[arg(long, value_name = "KIND", value_parser = kinds())]
    pub ignore: Vec<Ignored>,
    /// Print what has no counterpart, with line and size, and write nothing
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
    /// By how much a loop may stay open, m [default: 1e-4 of the mechanism's size]
    #[arg(long, value_name = "m", value_parser = above_zero, allow_hyphen_values = true)]
    pub tolerance: Option<f64>,
    /// Fraction of a body's mass that a body between two of its joints takes where no joint says them, e.g. 0.01
    #[arg(long, value_name = "FRACTION", value_parser = fraction, allow_hyphen_values = true)]
    pub carriers: Option<f64>,
    /// What becomes of a body without a joint
    #[arg(long, value_enum, default_value = "merge")]
    pub weld: WeldArgument,
    /// Begin at this keyframe of the file [default: the pose of its bodies]
    #[arg(long, value_name = "NAME")]
    pub keyframe: Option<String>,
    /// Simulated time that the scene states, e.g. 0.5s
    #[arg(long, value_name = "TIME", default_value = "1s", allow_hyphen_values = true)]
    pub duration: Time,
    /// The scene's name [default: the model's]
    #[arg(long, value_name = "NAME")]
    pub name: Option<String>,
}

/// One kind, or all.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ignored {
    /// Whatever has no counterpart.
    All,
    /// What is of this kind.
    One(Kind),
}

/// What becomes of a body without a joint.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum WeldArgument {
    /// It is one with its parent
    Merge,
    /// It is a body of its own with a fixed joint
    Fixed,
}

fn kinds() -> impl TypedValueParser<Value = Ignored> {
    let kinds = Kind::ALL.iter().map(|kind| PossibleValue::new(kind.name()).help(kind.summary()));
    let all = std::iter::once(PossibleValue::new(ALL).help("whatever has no counterpart"));
    PossibleValuesParser::new(kinds.chain(all)).try_map(|name| {
        let kind = Kind::ALL.iter().find(|kind| kind.name() == name);
        match (kind, name.as_str()) {
            (Some(kind), _) => Ok(Ignored::One(*kind)),
            (None, ALL) => Ok(Ignored::All),
            (None, _) => Err("there is no such kind"),
        }
    })
}

fn number(text: &str) -> Result<f64, String> {
    let number = text.trim().parse::<f64>().ok().filter(|number| number.is_finite());
    number.ok_or_else(|| "it is no finite number".to_owned())
}

fn above_zero(text: &str) -> Result<f64, String> {
    number(text).and_then(|n| if n > 0.0 { Ok(n) } else { Err("it is not above 0".into()) })
}

fn not_negative(text: &str) -> Result<f64, String> {
    number(text).and_then(|n| if n >= 0.0 { Ok(n) } else { Err("it is below 0".into()) })
}

fn fraction(text: &str) -> Result<f64, String> {
    number(text).and_then(|n| {
        if n > 0.0 && n < 1.0 { Ok(n) } else { Err("it is not between 0 and 1".into()) }
    })
}

/// Why nothing was imported.
#[derive(Debug, Error)]
pub enum ImportError {
    /// The file is refused.
    #[error(transparent)]
    Import(#[from] dbd_import::ImportError),
    /// The scene that it becomes is refused.
    #[error("the scene that {} becomes is refused: {error}", file.display())]
    Scene {
        /// The file.
        file: PathBuf,
        /// Why; part of the message and therefore not a source, which would say it twice.
        error: SceneError,
    },
    /// A loop does not close; the scene is handed on even so.
    #[error("a loop of {} stays open by {gap:.1e} m at {joint}: its scene does not load", file.display())]
    Open {
        /// The file.
        file: PathBuf,
        /// The joint that is open most.
        joint: String,
        /// \[m\] by how much, an angle times the length of `[assemble]` included.
        gap: f64,
    },
    /// The file to write holds something else.
    #[error("{} holds what host-sim has not imported", file.display())]
    Taken {
        /// The file.
        file: PathBuf,
    },
    /// The file cannot be written.
    #[error("cannot write {}: {reason}", file.display())]
    Write {
        /// The file.
        file: PathBuf,
        /// Why; part of the message and therefore not a source, which would say it twice.
        reason: io::Error,
    },
}

impl Diagnostic for ImportError {
    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        match self {
            Self::Import(error) => Diagnostic::help(error),
            Self::Scene { error, .. } => Diagnostic::help(error),
            Self::Taken { .. } => Some(Box::new("--out takes another name, or remove that file")),
            Self::Write { .. } => None,
            Self::Open { gap, .. } => Some(Box::new(format!(
                "the scene is written: correct its points or poses, or allow the gap with \
                 `--tolerance {:.0e}`, in the scene with `tolerance` in [assemble]",
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
        let ignored = self.ignore.iter().flat_map(|ignored| match ignored {
            Ignored::One(kind) => vec![*kind],
            Ignored::All => Kind::ALL.to_vec(),
        });
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
            ignored: ignored.collect(),
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

/// \[m\] no mechanism is open by so much.
const ANY_GAP: f64 = 1e9;

/// Imports a file, and loads what it becomes.
///
/// # Errors
/// [`ImportError`], but for those of files that are written and for [`ImportError::Open`].
pub fn import(arguments: &ImportArguments) -> Result<Import, ImportError> {
    let options = arguments.options();
    let imported = dbd_import::import(&arguments.file, &options)?;
    let called = format!("{} as a scene", arguments.file.display());
    match Scene::parse(&imported.scene, &called) {
        Ok(scene) => Ok(Import { closed: closed(&scene), imported, open: None }),
        // A scene that loads once any gap is allowed is open and nothing else.
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
        "loops open by up to {before:.1e} m at the file's pose are closed; {joint} keeps the largest \
         gap, {gap:.1e} m"
    ))
}

/// What in a file has no counterpart, one line each.
///
/// # Errors
/// Where the file is refused for another reason.
pub fn list(arguments: &ImportArguments) -> Result<String, ImportError> {
    let options = Options { ignored: Kind::ALL.to_vec(), ..arguments.options() };
    let imported = dbd_import::import(&arguments.file, &options)?;
    Ok(omission::table(&imported.omitted))
}

/// Writes an imported scene to a file, in place of an older one.
///
/// # Errors
/// [`ImportError::Taken`] where the file is none that was imported, [`ImportError::Write`].
pub fn write(file: &Path, text: &str) -> Result<(), ImportError> {
    // A device, which looks empty, takes no other file's name either.
    if file.exists() && !(file.is_file() && is_imported(file, text)) {
        return Err(ImportError::Taken { file: file.to_owned() });
    }
    write_at(file, text).map_err(|reason| ImportError::Write { file: file.to_owned(), reason })
}

/// Whether a file begins as an import of the same file does; an empty one holds nothing to lose.
fn is_imported(file: &Path, text: &str) -> bool {
    let Ok(content) = std::fs::File::open(file) else { return false };
    let mut line = Vec::new();
    // Enough for the head of any name.
    let read = io::Read::take(io::BufReader::new(content), 4096).read_until(b'\n', &mut line);
    let head = text.split_inclusive('\n').next().unwrap_or_default();
    read.is_ok_and(|count| count == 0 || line == head.as_bytes())
}
