//! `host-sim check --watch`: a file is looked at again each time it has changed.
//!
//! `file => its changes, one after the other`. It is read a few times a second: that meets editors that write in place and
//! those that put another file in its place, network folders, and links alike, and a scene is small.

use std::fmt;
use std::io;
use std::path::{Path, PathBuf};
use std::thread::sleep;
use std::time::Duration;

use dbd_scene::file::{MAX_BYTES, read};
use miette::Diagnostic;
use thiserror::Error;

/// Between two looks.
const PAUSE: Duration = Duration::from_millis(150);

/// Looks at nothing after which a file counts as gone: an editor may take it away for a moment.
const PATIENCE: u32 = 7;

/// Why a scene is not watched.
#[derive(Debug, Error)]
pub enum WatchError {
    /// It is no file.
    #[error("{scene} is no file that could change")]
    NoFile {
        /// What was named.
        scene: String,
    },
    /// Texts for one reader cannot follow each other on standard output.
    #[error("--watch prints checks, and --svg - or --write - something else")]
    Output,
    /// Each check would change it.
    #[error("--write {} is the scene that is watched", file.display())]
    Itself {
        /// The file.
        file: PathBuf,
    },
}

impl Diagnostic for WatchError {
    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        Some(Box::new(match self {
            Self::NoFile { .. } => {
                "a path to a .toml file; host-sim new scene NAME --from SCENE writes a copy of a \
                 scene that is built in"
            }
            Self::Output => "a file in place of -, which is written anew at each check",
            Self::Itself { .. } => "another file",
        }))
    }
}

/// A file that is watched.
pub struct Watched {
    file: PathBuf,
    /// What was seen last; an error by its kind.
    last: Option<Seen>,
}

type Seen = Result<Vec<u8>, io::ErrorKind>;

impl Watched {
    /// Of a file that nobody has looked at yet.
    #[must_use]
    pub fn new(file: &Path) -> Self {
        Self { file: file.to_owned(), last: None }
    }

    /// Waits until the file holds something else than when it was last looked at, or is gone for good; at first it does
    /// not wait.
    pub fn wait(&mut self) {
        let mut before = self.look();
        if self.last.is_some() {
            let mut alike = 0;
            loop {
                let is_news = self.last.as_ref() != Some(&before);
                // What is written piece by piece is seen twice alike when it is complete.
                let needed = if before.is_ok() { 1 } else { PATIENCE };
                if is_news && alike >= needed {
                    break;
                }
                sleep(PAUSE);
                let now = self.look();
                alike = if now == before { alike + 1 } else { 0 };
                before = now;
            }
        }
        self.last = Some(before);
    }

    fn look(&self) -> Seen {
        read(&self.file, MAX_BYTES).map_err(|error| error.kind())
    }
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;

    /// Written in place, replaced by another file, away for a moment: each change is seen once it is whole.
    #[test]
    fn a_change_is_seen_however_it_is_made() {
        let here = tempfile::tempdir().unwrap();
        let file = here.path().join("a.toml");
        fs::write(&file, "1").unwrap();
        let mut watched = Watched::new(&file);
        watched.wait();
        assert_eq!(watched.last, Some(Ok(b"1".to_vec())));
        let other = here.path().join("b.toml");
        for (number, text) in ["2", "3", "4"].into_iter().enumerate() {
            match number {
                0 => fs::write(&file, text).unwrap(),
                1 => {
                    fs::write(&other, text).unwrap();
                    fs::rename(&other, &file).unwrap();
                }
                _ => {
                    fs::remove_file(&file).unwrap();
                    fs::write(&file, text).unwrap();
                }
            }
            watched.wait();
            assert_eq!(watched.last, Some(Ok(text.as_bytes().to_vec())));
        }
        fs::remove_file(&file).unwrap();
        watched.wait();
        assert_eq!(watched.last, Some(Err(io::ErrorKind::NotFound)));
    }
}
