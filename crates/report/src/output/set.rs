//! Files that belong together: all of one command or none.
//!
//! `files, the last one the seal => published together`. Each is written under a temporary name; when all are complete
//! the old seal is removed, the files are renamed, and the seal last. So if a seal exists, the files beside it belong
//! to it, even if a program was killed. A lock on the folder separates two programs.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use crate::output::file::{PendingFile, WholeFile, publish};
use crate::output::lock::FolderLock;

/// Files of a folder with temporary names.
pub struct FileSet {
    folder: PathBuf,
    files: Vec<PendingFile>,
    without: Vec<PathBuf>,
}

impl FileSet {
    /// No files yet, of a folder that exists.
    #[must_use]
    pub fn new(folder: &Path) -> Self {
        Self { folder: folder.to_owned(), files: Vec::new(), without: Vec::new() }
    }

    /// The folder.
    #[must_use]
    pub fn folder(&self) -> &Path {
        &self.folder
    }

    /// Begins a file, to be [added](Self::add) when it is complete.
    ///
    /// # Errors
    /// Where the folder cannot be written to.
    pub fn begin(&self, name: &str) -> io::Result<PendingFile> {
        PendingFile::create(&self.folder, name)
    }

    /// Adds a file of the folder.
    pub fn add(&mut self, file: PendingFile) {
        self.files.push(file);
    }

    /// Marks an older file of this name for removal.
    pub fn without(&mut self, name: &str) {
        self.without.push(self.folder.join(name));
    }

    /// Writes a whole file and adds it.
    ///
    /// # Errors
    /// Where the folder cannot be written to.
    pub fn write(&mut self, name: &str, content: &str) -> io::Result<()> {
        let mut file = self.begin(name)?;
        io::Write::write_all(&mut file, content.as_bytes())?;
        self.add(file);
        Ok(())
    }

    /// Writes the buffers, so that a full disk is detected before older files change, and waits for the folder.
    ///
    /// # Errors
    /// If the buffers cannot be written.
    pub fn finish(self) -> io::Result<WholeSet> {
        let files = self.files.into_iter().map(PendingFile::finish);
        let files = files.collect::<io::Result<Vec<WholeFile>>>()?;
        Ok(WholeSet { files, without: self.without, _lock: FolderLock::of(&self.folder) })
    }
}

/// Complete files, in a folder locked against other programs.
pub struct WholeSet {
    files: Vec<WholeFile>,
    without: Vec<PathBuf>,
    _lock: FolderLock,
}

impl WholeSet {
    /// Gives the files their names, in place of older ones.
    ///
    /// # Errors
    /// If a file cannot be renamed; then there is no seal.
    pub fn publish(self) -> io::Result<()> {
        let Some(seal) = self.files.last() else { return Ok(()) };
        for older in std::iter::once(seal.path()).chain(self.without.iter().map(PathBuf::as_path)) {
            match fs::remove_file(older) {
                Err(error) if error.kind() != io::ErrorKind::NotFound => return Err(error),
                _ => {}
            }
        }
        publish(self.files)
    }
}

#[cfg(test)]
mod tests {
    use std::io::Write as _;

    use super::*;

    fn content(folder: &Path) -> Vec<(String, String)> {
        let entries = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
        let mut files: Vec<_> = entries
            .map(|path| {
                let name = path.file_name().unwrap().to_str().unwrap().to_owned();
                (name, fs::read_to_string(path).unwrap_or_default())
            })
            .collect();
        files.sort();
        files
    }

    fn files(pairs: &[(&str, &str)]) -> Vec<(String, String)> {
        pairs.iter().map(|(name, text)| ((*name).into(), (*text).into())).collect()
    }

    #[test]
    fn files_appear_together_and_nothing_of_those_that_are_given_up() {
        let folder = tempfile::tempdir().unwrap();
        let folder = folder.path();
        let set = |text: &str| {
            let mut set = FileSet::new(folder);
            let mut file = set.begin("a").unwrap();
            file.write_all(text.as_bytes()).unwrap();
            set.add(file);
            set.write("seal", text).unwrap();
            set
        };
        let old = files(&[("a", "old"), ("seal", "old")]);
        set("old").finish().unwrap().publish().unwrap();
        assert_eq!(content(folder), old);
        drop(set("new"));
        drop(set("new").finish().unwrap());
        assert_eq!(content(folder), old);
        set("new").finish().unwrap().publish().unwrap();
        assert_eq!(content(folder), files(&[("a", "new"), ("seal", "new")]));
        let mut without = FileSet::new(folder);
        without.without("a");
        without.without("never there");
        without.write("seal", "newest").unwrap();
        assert_eq!(content(folder)[1..], files(&[("a", "new"), ("seal", "new")]));
        without.finish().unwrap().publish().unwrap();
        assert_eq!(content(folder), files(&[("seal", "newest")]));
    }

    /// Like a program killed in between: a file cannot be renamed.
    #[test]
    fn without_all_of_its_files_there_is_no_seal() {
        let folder = tempfile::tempdir().unwrap();
        let folder = folder.path();
        fs::create_dir(folder.join("b")).unwrap();
        fs::write(folder.join("seal"), "old").unwrap();
        let mut set = FileSet::new(folder);
        for name in ["a", "b", "seal"] {
            set.write(name, "new").unwrap();
        }
        assert!(set.finish().unwrap().publish().is_err());
        assert_eq!(content(folder), files(&[("a", "new"), ("b", "")]));
    }

    /// Two at once never mix.
    #[test]
    fn one_at_a_time_publishes() {
        let folder = tempfile::tempdir().unwrap();
        let folder = folder.path();
        std::thread::scope(|scope| {
            for text in ["one", "other"] {
                scope.spawn(move || {
                    for _ in 0..50 {
                        let mut set = FileSet::new(folder);
                        for name in ["a", "b", "seal"] {
                            set.write(name, text).unwrap();
                        }
                        let whole = set.finish().unwrap();
                        let before = content(folder);
                        let named = before.iter().filter(|(name, _)| !name.starts_with('.'));
                        let mut texts: Vec<_> = named.map(|(_, text)| text).collect();
                        texts.dedup();
                        // Where there are locks.
                        assert!(texts.len() < 2 || cfg!(not(unix)), "{before:?}");
                        whole.publish().unwrap();
                    }
                });
            }
        });
        assert_eq!(content(folder).len(), 3);
    }
}
