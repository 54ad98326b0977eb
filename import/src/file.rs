//! Files that a user or a model names.
//!
//! `path => text`. A device or a pipe may have no end, and opening it may never return: only regular files
//! up to [`MAX_BYTES`] are read.

use std::fs::{self, File};
use std::io::{self, Read as _};
use std::path::{Path, PathBuf};

/// \[byte\] a text has at most this size.
pub const MAX_BYTES: u64 = 64 << 20;

/// The text of a regular file.
///
/// # Errors
/// Where it is no regular file, larger than [`MAX_BYTES`], or no UTF-8.
pub fn read_text(path: &Path) -> io::Result<String> {
    if !fs::metadata(path)?.is_file() {
        return Err(io::Error::other("it is not a regular file"));
    }
    let mut text = String::new();
    File::open(path)?.take(MAX_BYTES + 1).read_to_string(&mut text)?;
    if text.len() as u64 > MAX_BYTES {
        return Err(io::Error::other(format!("it is larger than {} MiB", MAX_BYTES >> 20)));
    }
    Ok(text)
}

/// A path from a folder that leads to something within that folder, symbolic links resolved.
///
/// # Errors
/// Where there is no such file, or it lies elsewhere.
pub(crate) fn within(folder: &Path, file: &str) -> io::Result<PathBuf> {
    let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    let path = folder.join(file).canonicalize()?;
    if path.starts_with(folder.canonicalize()?) {
        Ok(path)
    } else {
        Err(io::Error::other("it lies outside the model's folder"))
    }
}
