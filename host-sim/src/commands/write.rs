//! `host-sim check --write FILE`: a scene in its long form.
//!
//! `(text, changes) => file whose scene has the same bits`. Nothing that is there is replaced unasked.

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
    /// There is something already.
    #[error("{} exists", file.display())]
    Taken {
        /// The file.
        file: PathBuf,
    },
    /// Two things for standard output.
    #[error("--write - prints to standard output, and so does --json or --svg -")]
    Both,
    /// What was written is not the same scene.
    #[error("the long form of this scene does not read back to the same bits, and is not written")]
    Differs,
    /// The scene is refused.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// The file cannot be written.
    #[error("cannot write {}: {reason}", file.display())]
    Write {
        /// The file.
        file: PathBuf,
        /// Why; part of the message and therefore not a source, which would say it twice.
        reason: io::Error,
    },
}

impl Diagnostic for WriteError {
    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        Some(Box::new(match self {
            Self::Taken { .. } => "name another file, or replace that one with --overwrite",
            Self::Both => "one of them, or --write FILE",
            Self::Differs => "this is a mistake in host-sim; the scene itself can be used as it is",
            Self::Scene(error) => return Some(Box::new(error.help())),
            Self::Write { .. } => return None,
        }))
    }
}

/// Whether standard output is meant.
#[must_use]
pub fn is_output(file: &Path) -> bool {
    file == Path::new("-")
}

/// The long form of a scene, seen to read back to the same bits.
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
        // As they are shown, −0 is not 0.
        Ok(back)
            if format!("{:?}", back.model) == format!("{:?}", scene.model)
                && format!("{:?}", back.geometry) == format!("{:?}", scene.geometry) =>
        {
            Ok(written)
        }
        _ => Err(WriteError::Differs),
    }
}

/// Writes a text to a file, whole or not at all.
///
/// # Errors
/// [`WriteError::Taken`] where there is one and it is not to be replaced, [`WriteError::Write`].
pub fn write(file: &Path, text: &str, overwrite: bool) -> Result<(), WriteError> {
    // A device is never replaced.
    if file.exists() && !(overwrite && file.is_file()) {
        return Err(WriteError::Taken { file: file.to_owned() });
    }
    write_at(file, text).map_err(|reason| WriteError::Write { file: file.to_owned(), reason })
}
