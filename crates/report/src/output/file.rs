//! Files that appear complete or not at all.
//!
//! Each is written under a temporary name in its folder and renamed when complete, so that a run
//! that ends early leaves nothing half-written under a final name. A program that is terminated calls [`give_up_all`]
//! first, which removes temporary files. Files left by a killed program have no lock any more: [`sweep`] removes them.

use std::fs;
use std::io::{self, BufWriter, Write as _};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

use tempfile::NamedTempFile;

use crate::output::lock::FolderLock;

/// A file that has a temporary name.
pub struct PendingFile {
    file: BufWriter<NamedTempFile>,
    path: PathBuf,
    listed: Listed,
}

/// The temporary names that are in use in this process.
static IN_USE: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

fn in_use() -> MutexGuard<'static, Vec<PathBuf>> {
    // A list of paths stays valid after a panic.
    IN_USE.lock().unwrap_or_else(PoisonError::into_inner)
}

/// A temporary name's entry in the list, while this lives.
struct Listed(PathBuf);

impl Drop for Listed {
    fn drop(&mut self) {
        in_use().retain(|path| *path != self.0);
    }
}

/// Removes every incomplete file. Until the returned guard is dropped no file is begun or completed: a terminating
/// program keeps it.
#[must_use = "files can be begun again once it is dropped"]
pub fn give_up_all() -> impl Sized {
    let names = in_use();
    for path in names.iter() {
        // One that is gone by now needs no removing.
        let _ = fs::remove_file(path);
    }
    names
}

impl PendingFile {
    /// A new file in a folder that exists.
    ///
    /// # Errors
    /// Where the folder cannot be written to.
    pub fn create(folder: &Path, name: &str) -> io::Result<Self> {
        let prefix = format!(".{name}.");
        // Held until the file is locked, so that no other program removes it.
        let _lock = FolderLock::of(folder);
        // Held until the name is in the list: no file is made unseen.
        let mut names = in_use();
        let mut builder = tempfile::Builder::new();
        builder.prefix(&prefix).rand_bytes(RANDOM);
        #[cfg(unix)]
        {
            // Like any file a program writes, not private as temporary files are by default.
            use std::os::unix::fs::PermissionsExt as _;
            builder.permissions(fs::Permissions::from_mode(0o666));
        }
        let file = builder.tempfile_in(folder)?;
        // Without system locks nothing is removed.
        let _ = file.as_file().try_lock();
        names.push(file.path().to_owned());
        let listed = Listed(file.path().to_owned());
        Ok(Self { file: BufWriter::new(file), path: folder.join(name), listed })
    }

    /// Gives the file its final name, in place of an older one.
    ///
    /// # Errors
    /// If the buffer cannot be written or the file cannot be renamed.
    pub fn complete(self) -> io::Result<()> {
        publish(vec![self.finish()?])
    }

    /// Writes the buffer.
    ///
    /// # Errors
    /// Where it cannot be written.
    pub(crate) fn finish(self) -> io::Result<WholeFile> {
        let Self { file, path, listed } = self;
        let file = file.into_inner().map_err(io::IntoInnerError::into_error)?;
        Ok(WholeFile { file, path, listed })
    }
}

/// A complete file without its final name.
pub(crate) struct WholeFile {
    file: NamedTempFile,
    path: PathBuf,
    listed: Listed,
}

impl WholeFile {
    /// Its final name.
    pub(crate) fn path(&self) -> &Path {
        &self.path
    }
}

/// Gives files their final names in their order, in place of older ones.
///
/// # Errors
/// If a file cannot be renamed; the following ones are dropped.
pub(crate) fn publish(files: Vec<WholeFile>) -> io::Result<()> {
    // The list is held, so that nobody removes a file between its two names.
    let names = in_use();
    let mut done = Vec::new();
    // Those that are given up are dropped after the list, which they leave then.
    let mut files = files.into_iter();
    let published = files.by_ref().try_for_each(|WholeFile { file, path, listed }| {
        // A name leaves the list when the guard is dropped.
        done.push(listed);
        file.persist(&path).map(drop).map_err(|error| error.error)
    });
    drop(names);
    drop(done);
    published
}

/// Removes temporary files of these names that killed programs left in a folder.
pub fn sweep(folder: &Path, names: &[&str]) {
    let _lock = FolderLock::of(folder);
    let Ok(entries) = fs::read_dir(folder) else { return };
    for entry in entries.flatten() {
        let name = entry.file_name();
        let is_pending = |of: &&&str| {
            let rest = name.to_str().and_then(|name| name.strip_prefix(&format!(".{of}.")));
            rest.is_some_and(|rest| {
                rest.len() == RANDOM && rest.bytes().all(|b| b.is_ascii_alphanumeric())
            })
        };
        if names.iter().any(|of| is_pending(&of)) {
            let path = entry.path();
            // Whoever writes to it has its lock.
            if path.is_file() && fs::File::open(&path).is_ok_and(|file| file.try_lock().is_ok()) {
                let _ = fs::remove_file(path);
            }
        }
    }
}

/// Random characters of a temporary name.
const RANDOM: usize = 6;

impl io::Write for PendingFile {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.file.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}

/// Writes a whole file under its final name.
///
/// # Errors
/// Where the folder cannot be written to.
pub fn write(folder: &Path, name: &str, content: impl AsRef<[u8]>) -> io::Result<()> {
    let mut file = PendingFile::create(folder, name)?;
    file.write_all(content.as_ref())?;
    file.complete()
}

/// Writes a whole file at a path, likewise.
///
/// # Errors
/// Where the path names no file, or its folder cannot be written to.
pub fn write_at(file: &Path, content: impl AsRef<[u8]>) -> io::Result<()> {
    let name = file.file_name().and_then(|name| name.to_str());
    let name = name.ok_or_else(|| io::Error::other("not a valid file name"))?;
    let folder = file.parent().filter(|folder| *folder != Path::new(""));
    write(folder.unwrap_or(Path::new(".")), name, content)
}

/// The folder of a scene's results below `out`, made where it is not there yet.
///
/// # Errors
/// Where it cannot be made, or no folder can have the name.
pub fn folder(out: &Path, name: &str) -> io::Result<PathBuf> {
    /// Maximum length of file systems.
    const LONGEST: usize = 255;
    let forbidden = |c: char| c.is_control() || "/\\:*?\"<>|".contains(c);
    if name.is_empty() || name.len() > LONGEST || name.starts_with('.') || name.contains(forbidden)
    {
        let why = match name.chars().find(|c| forbidden(*c)) {
            Some(character) => format!("it contains {character:?}"),
            None if name.is_empty() => "it is empty".into(),
            None if name.len() > LONGEST => format!("it has {} bytes", name.len()),
            None => "it begins with a dot".into(),
        };
        let shown: String = name.chars().take(80).collect();
        let reason = format!("`{shown}` is not a valid folder name: {why}");
        return Err(io::Error::new(io::ErrorKind::InvalidInput, reason));
    }
    let folder = out.join(name);
    fs::create_dir_all(&folder)?;
    // A folder that cannot be written to is found out now, not after the run.
    drop(PendingFile::create(&folder, "writable")?);
    Ok(folder)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(folder: &Path) -> Vec<String> {
        let entries = fs::read_dir(folder).unwrap();
        entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect()
    }

    #[test]
    fn a_file_appears_when_complete_and_replaces_an_older_one() {
        let out = tempfile::tempdir().unwrap();
        let folder = folder(out.path(), "scene").unwrap();
        fs::write(folder.join("a.txt"), "old").unwrap();
        let mut file = PendingFile::create(&folder, "a.txt").unwrap();
        file.write_all(b"new").unwrap();
        assert_eq!(fs::read_to_string(folder.join("a.txt")).unwrap(), "old");
        file.complete().unwrap();
        assert_eq!(fs::read_to_string(folder.join("a.txt")).unwrap(), "new");
        assert_eq!(names(&folder), ["a.txt"]);
    }

    #[test]
    fn a_file_that_is_given_up_leaves_nothing() {
        let out = tempfile::tempdir().unwrap();
        let mut file = PendingFile::create(out.path(), "a.txt").unwrap();
        file.write_all(b"half").unwrap();
        drop(file);
        assert!(names(out.path()).is_empty());
    }

    #[test]
    fn what_was_left_is_swept_and_what_is_written_to_is_not() {
        let out = tempfile::tempdir().unwrap();
        let mut file = PendingFile::create(out.path(), "a.txt").unwrap();
        for name in [".a.txt.q1W2e3", ".a.txt.toolong", ".a.txt.12345é", ".b.txt.q1W2e3", "a.txt"]
        {
            fs::write(out.path().join(name), "left").unwrap();
        }
        let before = names(out.path()).len();
        sweep(out.path(), &["a.txt", "c.txt"]);
        let after = names(out.path());
        assert!(after.len() == before - 1 && !after.iter().any(|name| name == ".a.txt.q1W2e3"));
        file.write_all(b"whole").unwrap();
        file.complete().unwrap();
        assert_eq!(fs::read_to_string(out.path().join("a.txt")).unwrap(), "whole");
    }

    #[test]
    fn a_temporary_name_is_listed_for_as_long_as_it_is_in_use() {
        let out = tempfile::tempdir().unwrap();
        let listed = || in_use().iter().filter(|path| path.starts_with(out.path())).count();
        let given_up = PendingFile::create(out.path(), "a.txt").unwrap();
        let completed = PendingFile::create(out.path(), "b.txt").unwrap();
        assert_eq!(listed(), 2);
        drop(given_up);
        assert_eq!(listed(), 1);
        completed.complete().unwrap();
        assert_eq!(listed(), 0);
    }

    #[test]
    fn a_name_cannot_lead_out_of_the_folder() {
        let out = tempfile::tempdir().unwrap();
        for name in ["../up", "a/b", "", ".", "..", "a\\b", "nul\0", &"n".repeat(256)] {
            assert!(folder(out.path(), name).is_err(), "{name}");
        }
        assert!(names(out.path()).is_empty());
    }
}
