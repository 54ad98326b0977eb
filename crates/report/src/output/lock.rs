//! One program at a time changes the names in a folder.
//!
//! `folder => lock`, a system lock on the folder itself: it leaves no file, and ends with the program. On systems
//! without it (Windows, some network drives) nothing is locked.

use std::fs::File;
use std::path::Path;

/// Held while names change.
pub(crate) struct FolderLock(#[allow(dead_code, reason = "held, not read")] Option<File>);

impl FolderLock {
    /// Waits for the lock of a folder.
    pub(crate) fn of(folder: &Path) -> Self {
        // To open a pipe would wait for its other end.
        let folder = Some(folder).filter(|folder| folder.is_dir());
        let folder = folder.and_then(|folder| File::open(folder).ok());
        Self(folder.filter(|folder| folder.lock().is_ok()))
    }
}
