//! What random texts begin with: the scenes that ship, small ones that use every key once, and the
//! inputs that failed before.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::LazyLock;

/// The folder of this package.
fn here() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// The folder of inputs that failed before: `TARGET-NAME`.
#[must_use]
pub fn failed() -> PathBuf {
    here().join("corpus/failed")
}

/// Small scenes that use every key once.
pub static SMALL: LazyLock<Vec<String>> = LazyLock::new(|| texts(&here().join("corpus/scene")));

/// The scenes that ship.
pub static SHIPPED: LazyLock<Vec<String>> = LazyLock::new(|| texts(&here().join("../../scenes")));

/// The files of a folder by their names: the same order on every machine.
///
/// # Panics
/// Where the folder cannot be read: it is part of the repository.
#[must_use]
pub fn files(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).unwrap_or_else(|e| panic!("{}: {e}", folder.display()));
    let mut files: Vec<PathBuf> = entries.filter_map(|entry| Some(entry.ok()?.path())).collect();
    files.sort();
    files
}

fn texts(folder: &Path) -> Vec<String> {
    let read = |path: &PathBuf| fs::read_to_string(path).ok();
    let texts: Vec<String> = files(folder).iter().filter_map(read).collect();
    assert!(!texts.is_empty(), "{} holds no scene", folder.display());
    texts
}
