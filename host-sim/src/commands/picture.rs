//! `host-sim check --svg`: the mechanism's picture in a file or on standard output.
//!
//! `(scene, file) => SVG`. A file that is no SVG is not replaced.

use std::fmt;
use std::io::{self, Read as _};
use std::path::{Path, PathBuf};

use dbd_report::output::file::write_at;
use dbd_report::picture::{Mechanism, Paper, svg};
use dbd_scene::Scene;
use miette::Diagnostic;
use thiserror::Error;

/// Why there is no picture.
#[derive(Debug, Error)]
pub enum PictureError {
    /// Both would go to standard output.
    #[error("--svg - and --json both write to standard output")]
    Both,
    /// The file has other contents.
    #[error("{} is not an SVG", file.display())]
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

impl Diagnostic for PictureError {
    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        match self {
            Self::Both => Some(Box::new("write the picture to a file with --svg FILE")),
            Self::Taken { .. } => {
                Some(Box::new("choose another file with --svg, or remove that one"))
            }
            Self::Write { .. } => None,
        }
    }
}

/// The picture of a scene at its initial pose.
#[must_use]
pub fn picture(scene: &Scene, paper: Paper) -> String {
    svg(&Mechanism::of(scene), paper)
}

/// Whether a picture goes to standard output.
#[must_use]
pub fn is_output(file: &Path) -> bool {
    file == Path::new("-")
}

/// Writes the picture of a scene to a file, whole or not at all, in place of an older one.
///
/// # Errors
/// [`PictureError::Taken`] if the file is not an SVG, [`PictureError::Write`].
pub fn write(scene: &Scene, file: &Path) -> Result<(), PictureError> {
    // A device is not replaced either.
    if file.exists() && !(file.is_file() && is_svg(file)) {
        return Err(PictureError::Taken { file: file.to_owned() });
    }
    write_at(file, picture(scene, Paper::File))
        .map_err(|reason| PictureError::Write { file: file.to_owned(), reason })
}

/// Whether a file begins as a picture does; an empty file may be replaced.
fn is_svg(file: &Path) -> bool {
    let Ok(content) = std::fs::File::open(file) else { return false };
    let mut head = Vec::new();
    let read = content.take(4).read_to_end(&mut head);
    read.is_ok_and(|count| count == 0 || head == b"<svg")
}
