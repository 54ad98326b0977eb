//! One program at a time changes the names in a folder.
//!
//! `folder => lock`, the system's own on the folder itself: it leaves no file behind, and ends with the
//! program however that ends. Where there is none (Windows, some network drives) nothing is locked.

use std::fs::File;
use std::path::Path;

/// Held while names change.
pub(crate) struct FolderLock(#[allow(dead_code, reason = "held, not read")] Option<File>);

impl FolderLock {
    /// Waits for the lock of a folder.
    pub(crate) fn of(folder: &Path) -> Self {
        Self(File::open(folder).ok().filter(|folder| folder.lock().is_ok()))
    }
}
