//! Files that a command writes, and replaces if it wrote them.
//!
//! `(file, text, beginning of its texts) => file, or an error where it has other contents`.

use std::io::{self, Read as _};
use std::path::{Path, PathBuf};

use dbd_report::output::file::write_at;
use miette::Diagnostic;
use thiserror::Error;

/// Why a file was not written.
#[derive(Debug, Error, Diagnostic)]
pub enum ReplaceError {
    /// The file has other contents.
    #[error("{} was not written by host-sim {command}", file.display())]
    #[diagnostic(help("choose another file with --out, or remove that one"))]
    Taken {
        /// The file.
        file: PathBuf,
        /// The command that would write it.
        command: &'static str,
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

/// Writes a file, atomically, in place of an older one of the same command: one that is empty or begins with `head`.
///
/// # Errors
/// [`ReplaceError`].
pub fn replace(
    file: &Path,
    text: &str,
    (head, command): (&str, &'static str),
) -> Result<(), ReplaceError> {
    // A device, which seems empty, is not replaced either.
    if file.exists() && !(file.is_file() && begins(file, head)) {
        return Err(ReplaceError::Taken { file: file.to_owned(), command });
    }
    write_at(file, text).map_err(|reason| ReplaceError::Write { file: file.to_owned(), reason })
}

fn begins(file: &Path, head: &str) -> bool {
    let Ok(content) = std::fs::File::open(file) else { return false };
    let mut begin = Vec::new();
    let read = content.take(head.len() as u64).read_to_end(&mut begin);
    read.is_ok_and(|count| count == 0 || begin == head.as_bytes())
}
