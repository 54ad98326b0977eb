//! `host-sim fmu`: a scene becomes an FMU for other tools.
//!
//! `(scene, method, step, library) => SCENE.fmu`. The scene is built first; the file appears whole or not at all.

use std::fmt;
use std::fs::File;
use std::io::{self, Read as _, Write as _};
use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum, ValueHint};
use dbd_fmu::description::Role;
use dbd_fmu::{ArchiveError, Fmi, LIBRARY, Library, archive};
use dbd_plant::instance::{Blueprint, Settings};
use dbd_plant::time::{Time, display};
use dbd_plant::{DampingName, Named as _, PrecisionName, SchemeName};
use dbd_report::output::file::PendingFile;
use dbd_scene::file::read;
use miette::Diagnostic;
use thiserror::Error;

use crate::arguments::{SceneArgument, names};
use crate::terminal::Found;

/// The exported scene and the destination.
#[derive(Clone, Debug, Args)]
pub struct FmuArguments {
    /// The scene
    #[command(flatten)]
    pub scene: SceneArgument,
    /// The version of FMI
    #[arg(long, value_enum, default_value_t = FmiVersion::Two)]
    pub fmi: FmiVersion,
    /// Time-stepping scheme
    #[arg(long, value_parser = names::<SchemeName>(), default_value = SchemeName::default().name())]
    pub scheme: SchemeName,
    /// Newton iterations per step of the dbd schemes, at most 8 [default: 0]
    #[arg(long, value_name = "N")]
    pub newton: Option<u32>,
    /// Spectral radius of generalized-alpha at infinite frequency, 0 to 0.8: the fraction of an unresolved
    /// vibration that remains per step [default: 0.5]
    #[arg(long, value_name = "RHO", allow_hyphen_values = true)]
    pub rho: Option<f64>,
    /// Damping method [default: the scheme's own]
    #[arg(long, value_parser = names::<DampingName>())]
    pub damping: Option<DampingName>,
    /// Precision
    #[arg(long, value_parser = names::<PrecisionName>(), default_value = PrecisionName::default().name())]
    pub precision: PrecisionName,
    /// Step, e.g. 20us [default: the scene's, else the advised one]
    #[arg(long, value_name = "TIME", allow_hyphen_values = true)]
    pub step: Option<Time>,
    /// Write to this file, atomically [default: SCENE.fmu]
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    pub out: Option<PathBuf>,
    /// Include this library; may be repeated, once per system [default: the one next to host-sim]
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    pub library: Vec<PathBuf>,
}

/// Versions of FMI.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum FmiVersion {
    /// FMI 2.0.4, which most tools read
    #[value(name = "2")]
    Two,
    /// FMI 3.0.2
    #[value(name = "3")]
    Three,
}

/// Why there is no FMU.
#[derive(Debug, Error)]
pub enum FmuError {
    /// The scene, the settings or a library are refused.
    #[error(transparent)]
    Archive(#[from] ArchiveError),
    /// The library is not there.
    #[error("cannot read the library {}: {reason}", file.display())]
    Library {
        /// Where it was looked for.
        file: PathBuf,
        /// Why not.
        reason: io::Error,
    },
    /// The file has other contents.
    #[error("{} is not an FMU", file.display())]
    Taken {
        /// The file.
        file: PathBuf,
    },
    /// The file cannot be written.
    #[error("cannot write {}: {reason}", file.display())]
    Write {
        /// The file.
        file: PathBuf,
        /// The reason; part of the message and therefore not a source, which would repeat it.
        reason: io::Error,
    },
}

impl Diagnostic for FmuError {
    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        match self {
            Self::Archive(error) => error.help(),
            Self::Library { .. } => Some(Box::new(
                "build it next to host-sim with cargo build --release -p dbd-fmu, or give its path with --library",
            )),
            Self::Taken { .. } => {
                Some(Box::new("choose another file with --out, or remove that one"))
            }
            Self::Write { .. } => None,
        }
    }
}

/// Writes the FMU of a scene; what was written, in a line.
///
/// # Errors
/// [`FmuError`]; nothing is written then.
pub fn fmu(found: &Found, arguments: &FmuArguments) -> Result<String, FmuError> {
    let blueprint = Blueprint {
        file: format!("{}.toml", found.file.stem),
        text: found.text.as_str().into(),
        changes: arguments.scene.changes(),
    };
    let settings = Settings {
        scheme: Some(arguments.scheme.name().into()),
        newton: arguments.newton,
        rho: arguments.rho,
        damping: arguments.damping.map(|damping| damping.name().into()),
        precision: Some(arguments.precision.name().into()),
        step: arguments.step.map(Time::seconds),
    };
    let (fmi, version) = match arguments.fmi {
        FmiVersion::Two => (Fmi::Two, "2.0"),
        FmiVersion::Three => (Fmi::Three, "3.0"),
    };
    // Errors in the scene are reported before errors of the file.
    archive(blueprint.clone(), settings.clone(), fmi, &[])?;
    let libraries = libraries(&arguments.library)?;
    let fmu = archive(blueprint, settings, fmi, &libraries)?;
    let file = arguments.out.clone();
    let file = file.unwrap_or_else(|| PathBuf::from(format!("{}.fmu", found.file.stem)));
    write(&file, &fmu.bytes)?;
    let count = |is: fn(&Role) -> bool| {
        fmu.description.variables.iter().filter(|variable| is(&variable.role)).count()
    };
    Ok(format!(
        "{}: FMI {version}, step {}, inputs: {}, outputs: {}, parameters: {}\n",
        file.display(),
        display(fmu.description.step),
        count(|role| matches!(role, Role::Input(_))),
        count(|role| matches!(role, Role::Output(..))),
        count(|role| matches!(role, Role::Parameter(_))),
    ))
}

/// \[byte\] larger than any library of an FMU.
const MAX_LIBRARY: u64 = 1 << 30;

/// The library that cargo built with this program; of an installed program the one beside it.
fn beside() -> PathBuf {
    let program = std::env::current_exe().unwrap_or_default();
    let built = program.with_file_name("deps").join(LIBRARY);
    if built.is_file() { built } else { program.with_file_name(LIBRARY) }
}

/// The libraries of these files; without any the one beside this program.
fn libraries(files: &[PathBuf]) -> Result<Vec<Library>, FmuError> {
    let files = if files.is_empty() { vec![beside()] } else { files.to_vec() };
    let read = |file: PathBuf| match read(&file, MAX_LIBRARY) {
        Ok(bytes) => Ok(Library::new(file.display().to_string(), bytes)?),
        Err(reason) => Err(FmuError::Library { file, reason }),
    };
    files.into_iter().map(read).collect()
}

fn write(file: &Path, bytes: &[u8]) -> Result<(), FmuError> {
    // A device, which seems empty, is not replaced either.
    if file.exists() && !(file.is_file() && is_archive(file)) {
        return Err(FmuError::Taken { file: file.to_owned() });
    }
    let write = || {
        let name = file.file_name().and_then(|name| name.to_str());
        let name = name.ok_or_else(|| io::Error::other("it is not a file name"))?;
        let folder = file.parent().filter(|folder| *folder != Path::new(""));
        let mut pending = PendingFile::create(folder.unwrap_or(Path::new(".")), name)?;
        pending.write_all(bytes)?;
        pending.complete()
    };
    write().map_err(|reason| FmuError::Write { file: file.to_owned(), reason })
}

/// Whether a file begins as an archive does; an empty file may be replaced.
fn is_archive(file: &Path) -> bool {
    let mut head = Vec::new();
    let read = File::open(file).and_then(|content| content.take(4).read_to_end(&mut head));
    read.is_ok() && (head.is_empty() || head == b"PK\x03\x04")
}
