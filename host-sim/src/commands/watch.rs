//! `host-sim check --watch`: a file is checked again after each change.
//!
//! `file => its changes in order`. It is read a few times a second: this works with editors that write in place or
//! replace the file, with network folders and with links, and a scene is small.

use std::fmt;
use std::io;
use std::path::{Path, PathBuf};
use std::thread::sleep;
use std::time::Duration;

use dbd_scene::file::{MAX_BYTES, read};
use miette::Diagnostic;
use thiserror::Error;

/// Polling interval.
const PAUSE: Duration = Duration::from_millis(150);

/// Failed reads after which a file counts as removed: an editor may remove it for a moment.
const PATIENCE: u32 = 7;

/// Why a scene is not watched.
#[derive(Debug, Error)]
pub enum WatchError {
    /// Not a file.
    #[error("--watch needs a scene file; {scene} is not one")]
    NoFile {
        /// What was named.
        scene: String,
    },
    /// Two outputs cannot share standard output.
    #[error("--watch, and --svg - or --write -, both write to standard output")]
    Output,
    /// Each check would change the scene.
    #[error("--write {} would overwrite the watched scene", file.display())]
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
            Self::Output => "give a file instead of -; it is rewritten at each check",
            Self::Itself { .. } => "choose another file",
        }))
    }
}

/// A watched file.
pub struct Watched {
    file: PathBuf,
    /// The last contents; an error by its kind.
    last: Option<Seen>,
}

type Seen = Result<Vec<u8>, io::ErrorKind>;

impl Watched {
    /// For a file that has not been read yet.
    #[must_use]
    pub fn new(file: &Path) -> Self {
        Self { file: file.to_owned(), last: None }
    }

    /// Waits until the file's contents have changed or the file is removed; the first call does
    /// not wait.
    pub fn wait(&mut self) {
        let mut before = self.look();
        if self.last.is_some() {
            let mut alike = 0;
            loop {
                let is_news = self.last.as_ref() != Some(&before);
                // A file written in parts is complete once two reads are equal.
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

    /// Written in place, replaced, removed for a moment: each change is seen once, when complete.
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
