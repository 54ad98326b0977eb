//! The folder of a scene's results.
//!
//! `(--out, scene) => folder`, made where it is not there yet.

use std::fmt;
use std::io;
use std::path::{Path, PathBuf};

use dbd_output::file;
use dbd_scene::Scene;
use miette::Diagnostic;
use thiserror::Error;

/// The folder for the results cannot be made.
#[derive(Debug, Error)]
#[error("cannot write to {}: {reason}", folder.display())]
pub struct FolderError {
    /// The folder.
    pub folder: PathBuf,
    /// Why; part of the message and therefore not a source, which would say it twice.
    pub reason: io::Error,
}

impl Diagnostic for FolderError {
    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        Some(Box::new(match self.reason.kind() {
            io::ErrorKind::InvalidInput => {
                "results lie in a folder of the scene's name: change its `name`"
            }
            _ => "name another folder with --out DIR",
        }))
    }
}

/// The folder of a scene's results below `out`.
///
/// # Errors
/// Where it cannot be made or written to, or no folder can have the scene's name.
pub fn results(out: &Path, scene: &Scene) -> Result<PathBuf, FolderError> {
    let failed = |reason| FolderError { folder: out.join(&scene.name), reason };
    file::folder(out, &scene.name).map_err(failed)
}
