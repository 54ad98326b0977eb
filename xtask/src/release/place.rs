//! Where artefacts lie.

use std::fs;
use std::path::{Path, PathBuf};

use anyhow::{Context as _, Result};

use crate::command::root;

/// A folder of artefacts, which is created.
///
/// # Errors
/// Where it cannot be created.
pub fn folder(name: &str) -> Result<PathBuf> {
    let folder = root().join("target/artefacts").join(name);
    fs::create_dir_all(&folder).with_context(|| format!("cannot create {}", folder.display()))?;
    Ok(folder)
}

/// The same folder without what an earlier release left in it.
///
/// # Errors
/// Where it cannot be emptied or created.
pub fn emptied(name: &str) -> Result<PathBuf> {
    let old = folder(name)?;
    fs::remove_dir_all(&old).with_context(|| format!("cannot empty {}", old.display()))?;
    folder(name)
}

/// The first file of a folder with this ending.
///
/// # Errors
/// Where no file has it.
pub fn only(folder: &Path, ending: &str) -> Result<PathBuf> {
    let files = fs::read_dir(folder)?.filter_map(Result::ok).map(|entry| entry.path());
    let mut files = files.filter(|file| file.to_string_lossy().ends_with(ending));
    files.next().with_context(|| format!("no {ending} in {}", folder.display()))
}
