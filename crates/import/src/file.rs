//! Files referenced by a model.
//!
//! `folder, file => path within the folder`.

use std::io;
use std::path::{Path, PathBuf};

/// Resolves a path relative to a folder, including symbolic links; the target must be within the folder.
///
/// # Errors
/// If the file does not exist or is outside the folder.
pub(crate) fn within(folder: &Path, file: &str) -> io::Result<PathBuf> {
    let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    let path = folder.join(file).canonicalize()?;
    if path.starts_with(folder.canonicalize()?) {
        Ok(path)
    } else {
        Err(io::Error::other("it is outside the model's folder"))
    }
}
