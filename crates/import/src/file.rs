//! Files that a model names.
//!
//! `folder, file => path within the folder`.

use std::io;
use std::path::{Path, PathBuf};

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
