//! Files that appear complete or not at all.
//!
//! Each is written under a temporary name in its folder and renamed when complete, so that a run
//! that ends early leaves nothing half-written under a final name.

use std::fs;
use std::io::{self, BufWriter, Write as _};
use std::path::{Path, PathBuf};

use tempfile::NamedTempFile;

/// A file on its way to its final name.
pub struct PendingFile {
    file: BufWriter<NamedTempFile>,
    path: PathBuf,
}

impl PendingFile {
    /// A new file in a folder that exists.
    ///
    /// # Errors
    /// Where the folder cannot be written to.
    pub fn create(folder: &Path, name: &str) -> io::Result<Self> {
        let prefix = format!(".{name}.");
        let mut builder = tempfile::Builder::new();
        builder.prefix(&prefix);
        #[cfg(unix)]
        {
            // Like any file a program writes, not private as temporary files are by default.
            use std::os::unix::fs::PermissionsExt as _;
            builder.permissions(fs::Permissions::from_mode(0o666));
        }
        let file = builder.tempfile_in(folder)?;
        Ok(Self { file: BufWriter::new(file), path: folder.join(name) })
    }

    /// Gives the file its final name, in place of an older one.
    ///
    /// # Errors
    /// Where what is buffered cannot be written or the name cannot be taken.
    pub fn complete(self) -> io::Result<()> {
        let file = self.file.into_inner().map_err(io::IntoInnerError::into_error)?;
        file.persist(&self.path).map_err(|error| error.error)?;
        Ok(())
    }
}

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
pub fn write(folder: &Path, name: &str, content: &str) -> io::Result<()> {
    let mut file = PendingFile::create(folder, name)?;
    file.write_all(content.as_bytes())?;
    file.complete()
}

/// The folder of a scene's results below `out`, made where it is not there yet.
///
/// # Errors
/// Where it cannot be made, or no folder can have the name.
pub fn folder(out: &Path, name: &str) -> io::Result<PathBuf> {
    let forbidden = |c: char| c.is_control() || "/\\:*?\"<>|".contains(c);
    if name.is_empty() || name.starts_with('.') || name.contains(forbidden) {
        let why = match name.chars().find(|c| forbidden(*c)) {
            Some(character) => format!("it contains {character:?}"),
            None if name.is_empty() => "it is empty".into(),
            None => "it begins with a point".into(),
        };
        let reason = format!("`{name}` cannot be the name of a folder: {why}");
        return Err(io::Error::new(io::ErrorKind::InvalidInput, reason));
    }
    let folder = out.join(name);
    fs::create_dir_all(&folder)?;
    // A folder that cannot be written to is found out now, not after the run.
    drop(tempfile::Builder::new().prefix(".").tempfile_in(&folder)?);
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
    fn a_name_cannot_lead_out_of_the_folder() {
        let out = tempfile::tempdir().unwrap();
        for name in ["../up", "a/b", "", ".", "..", "a\\b", "nul\0"] {
            assert!(folder(out.path(), name).is_err(), "{name}");
        }
        assert!(names(out.path()).is_empty());
    }
}
