//! `host-sim check --write FILE`: a scene in its long form.
//!
//! `(text, changes) => file whose scene has the same bits`. An existing file is replaced only with --overwrite.

use std::fmt;
use std::io;
use std::path::{Path, PathBuf};

use dbd_report::output::file::write_at;
use dbd_scene::{Scene, SceneError};
use miette::Diagnostic;
use thiserror::Error;

/// Why a scene was not written.
#[derive(Debug, Error)]
pub enum WriteError {
    /// The file exists.
    #[error("{} exists", file.display())]
    Taken {
        /// The file.
        file: PathBuf,
    },
    /// Both would go to standard output.
    #[error("--write -, and --json or --svg -, both write to standard output")]
    Both,
    /// The written scene differs.
    #[error("the long form of this scene does not read back to the same bits and is not written")]
    Differs,
    /// The scene is invalid.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// The file cannot be written.
    #[error("cannot write {}: {reason}", file.display())]
    Write {
        /// The file.
        file: PathBuf,
        /// The reason; part of the message and therefore not a source, which would repeat it.
        reason: io::Error,
    },
}

impl Diagnostic for WriteError {
    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        Some(Box::new(match self {
            Self::Taken { .. } => "choose another file, or replace that one with --overwrite",
            Self::Both => "use only one of them, or write the scene to a file with --write FILE",
            Self::Differs => "this is a bug in host-sim; the scene itself is usable",
            Self::Scene(error) => return Some(Box::new(error.help())),
            Self::Write { .. } => return None,
        }))
    }
}

/// Whether the target is standard output.
#[must_use]
pub fn is_output(file: &Path) -> bool {
    file == Path::new("-")
}

/// The long form of a scene, verified to read back to the same bits.
///
/// # Errors
/// [`WriteError::Differs`] where it does not.
pub fn long_form(
    scene: &Scene,
    text: &str,
    file: &str,
    changes: &[String],
) -> Result<String, WriteError> {
    seen_to_read_back(scene, Scene::long_form(text, file, changes)?, file)
}

/// A scene's written text, if it reads back to the same bits.
///
/// # Errors
/// [`WriteError::Differs`] where it does not.
pub fn seen_to_read_back(scene: &Scene, written: String, file: &str) -> Result<String, WriteError> {
    match Scene::parse(&written, file) {
        // In the debug format −0 differs from 0.
        Ok(back)
            if format!("{:?}", back.model) == format!("{:?}", scene.model)
                && format!("{:?}", back.geometry) == format!("{:?}", scene.geometry) =>
        {
            Ok(written)
        }
        _ => Err(WriteError::Differs),
    }
}

/// Writes a text to a file atomically.
///
/// # Errors
/// [`WriteError::Taken`] if it exists and is not to be replaced, [`WriteError::Write`].
pub fn write(file: &Path, text: &str, overwrite: bool) -> Result<(), WriteError> {
    // A device is never replaced.
    if file.exists() && !(overwrite && file.is_file()) {
        return Err(WriteError::Taken { file: file.to_owned() });
    }
    write_at(file, text).map_err(|reason| WriteError::Write { file: file.to_owned(), reason })
}
