//! Golden files: compared, or written on request.
//!
//! `(path, recording, tolerance, blessing) => verdict`. A run that differs is written next to the golden file,
//! atomically. The golden file is written only on request, and a file that is not a golden file is never replaced.

use std::borrow::ToOwned as _;
use std::boxed::Box;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::string::{String, ToString as _};
use std::{eprintln, fmt, format};

use crate::bands::Tolerance;
use crate::blessing::{Blessing, VARIABLE, WORD};
use crate::compare::{Comparison, Summary};
use crate::mismatch::{Damage, Mismatch};
use crate::recording::Recording;
use crate::text::Golden;

/// \[byte\] limit of the size of a golden file.
const MAX_BYTES: u64 = 1 << 30;

/// A golden file by its path.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct GoldenFile {
    path: PathBuf,
}

/// A run and its golden file agree.
#[derive(Clone, Debug, PartialEq)]
pub enum Verdict {
    /// Bit for bit, or within the bands.
    Same(Summary<String>),
    /// The file was written.
    Blessed {
        /// The file.
        path: PathBuf,
        /// How the previous file differed; `None` if there was none or it was equal.
        before: Option<Box<Mismatch<String>>>,
    },
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Verdict::Same(summary) if summary.is_equal() => {
                write!(f, "{} samples equal, bit for bit", summary.samples)
            }
            Verdict::Same(Summary { samples, furthest }) => {
                write!(f, "{samples} samples within their bands{furthest}")
            }
            Verdict::Blessed { path, before } => {
                write!(f, "blessed: {} is rewritten", path.display())?;
                before.as_ref().map_or(Ok(()), |before| write!(f, "; before: {before}"))
            }
        }
    }
}

/// Why a run and its golden file do not agree.
#[derive(thiserror::Error)]
pub enum GoldenError {
    /// There is no file.
    #[error(
        "there is no golden file {}; if this run is right, record it: run the same command once with \
         {VARIABLE}={WORD} in the environment", path.display()
    )]
    Missing {
        /// Its path.
        path: PathBuf,
    },
    /// It cannot be read.
    #[error("cannot read {}: {reason}", path.display())]
    Unreadable {
        /// Its path.
        path: PathBuf,
        /// The reason.
        reason: io::Error,
    },
    /// It does not match the run: damaged, or of another version, scene, scheme, precision or step.
    #[error("{} does not match this run: {mismatch}", path.display())]
    Unlike {
        /// Its path.
        path: PathBuf,
        /// What differs.
        mismatch: Box<Mismatch<String>>,
    },
    /// The run differs.
    #[error("the run differs from {}: {mismatch}\n{}", path.display(), left(new, *own))]
    Different {
        /// The golden file's path.
        path: PathBuf,
        /// How.
        mismatch: Box<Mismatch<String>>,
        /// Whether the run uses the file's method, so that it may become the golden one.
        own: bool,
        /// Where the run was written, or why it was not.
        new: Result<PathBuf, String>,
    },
    /// Files are not blessed on a build server.
    #[error(
        "{} is not written: {VARIABLE}={WORD} is not allowed in CI; bless it where the difference can be \
         reviewed, and commit it", path.display()
    )]
    OnServer {
        /// The file's path.
        path: PathBuf,
    },
    /// A new golden file cannot be written.
    #[error("cannot write {}: {reason}", path.display())]
    Unwritable {
        /// Its path.
        path: PathBuf,
        /// The reason.
        reason: io::Error,
    },
}

/// The message on the file that a run wrote.
fn left(new: &Result<PathBuf, String>, own: bool) -> String {
    let path = match new {
        Ok(path) => path.display(),
        Err(reason) => return format!("the run cannot be written: {reason}"),
    };
    match own {
        true => format!(
            "the run is written to {path}; if it is right, run the same command once with \
             {VARIABLE}={WORD} in the environment"
        ),
        false => format!("the run is written to {path}"),
    }
}

impl fmt::Debug for GoldenError {
    /// The message, which a test that returns an error shows.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

/// A golden file that was checked before its run.
#[derive(Clone, Debug)]
pub struct Opened {
    path: PathBuf,
    /// Its contents, if it exists.
    text: Option<String>,
    bless: bool,
}

impl GoldenFile {
    /// The file at a path, which in a test is relative to the package's folder.
    #[must_use]
    pub fn new(path: impl Into<PathBuf>) -> Self {
        Self { path: path.into() }
    }

    /// Compares a run with the file, or writes the file if the environment requests it
    /// ([`Blessing::from_environment`]).
    ///
    /// # Errors
    /// A [`GoldenError`].
    pub fn check(
        &self,
        recording: &Recording,
        tolerance: &Tolerance<'_>,
    ) -> Result<Verdict, GoldenError> {
        self.open(recording, tolerance, Blessing::from_environment())?.check(recording, tolerance)
    }

    /// [`Self::check`] for a test: prints a note if the file was written.
    ///
    /// # Panics
    /// With the message of the [`GoldenError`].
    #[track_caller]
    pub fn assert(&self, recording: &Recording, tolerance: &Tolerance<'_>) {
        match self.check(recording, tolerance) {
            Ok(Verdict::Same(_)) => {}
            Ok(blessed) => eprintln!("{blessed}"),
            Err(error) => panic!("{error}"),
        }
    }

    /// Reads the file and compares its head with that of a recording, which may still be without samples, so that a
    /// mismatch is found before the run.
    ///
    /// With [`Tolerance::AnyMethod`] a file is never written: it belongs to another run.
    ///
    /// # Errors
    /// [`GoldenError::OnServer`], [`GoldenError::Missing`], [`GoldenError::Unreadable`],
    /// [`GoldenError::Unlike`].
    pub fn open(
        &self,
        recording: &Recording,
        tolerance: &Tolerance<'_>,
        blessing: Blessing,
    ) -> Result<Opened, GoldenError> {
        let path = self.path.clone();
        if blessing == Blessing::Refused {
            return Err(GoldenError::OnServer { path });
        }
        let bless = blessing == Blessing::Yes && !matches!(tolerance, Tolerance::AnyMethod(_));
        let text = match dbd_scene::file::read(&path, MAX_BYTES) {
            Ok(bytes) => {
                let text = Golden::of_bytes(&bytes).map(|_| ()).map_err(owned);
                match text {
                    Err(mismatch) if !bless || is_foreign(&mismatch) => {
                        return Err(GoldenError::Unlike { path, mismatch });
                    }
                    _ => Some(String::from_utf8_lossy(&bytes).into_owned()),
                }
            }
            Err(reason) if reason.kind() == io::ErrorKind::NotFound && bless => None,
            Err(reason) if reason.kind() == io::ErrorKind::NotFound => {
                return Err(GoldenError::Missing { path });
            }
            Err(reason) => return Err(GoldenError::Unreadable { path, reason }),
        };
        if let Some(text) = text.as_deref().filter(|_| !bless) {
            let fits = recording.head().with(|head| {
                let fits = Golden::read(text)
                    .and_then(|golden| Comparison::new(golden, head, *tolerance).map(drop));
                fits.map_err(owned)
            });
            if let Err(mismatch) = fits {
                return Err(GoldenError::Unlike { path, mismatch });
            }
        }
        Ok(Opened { path, text, bless })
    }
}

fn owned(mismatch: Mismatch<&str>) -> Box<Mismatch<String>> {
    Box::new(mismatch.map(|name| name.to_string()))
}

/// Whether a file is not a golden file, which is never replaced.
fn is_foreign(mismatch: &Mismatch<String>) -> bool {
    matches!(mismatch, Mismatch::Damaged { damage: Damage::Foreign | Damage::Text, .. })
}

impl Opened {
    /// Compares the whole run, or writes the file.
    ///
    /// # Errors
    /// [`GoldenError::Different`], [`GoldenError::Unwritable`]; [`GoldenError::Unlike`] if the file does not match the
    /// run after all.
    pub fn check(
        self,
        recording: &Recording,
        tolerance: &Tolerance<'_>,
    ) -> Result<Verdict, GoldenError> {
        let Self { path, text, bless } = self;
        // A run by another method writes a separate file: it may be compared at the same time.
        let own = !matches!(tolerance, Tolerance::AnyMethod(_));
        let ending = if own {
            ".new".to_owned()
        } else {
            let identity = recording.identity();
            format!(".{}-{}.new", identity.scheme.name, identity.precision.name)
        };
        let new = beside(&path, &ending);
        let compared = text.map(|text| recording.compare(&text, tolerance));
        match compared {
            Some(Ok(summary)) if !bless => {
                // The file of an earlier run is obsolete.
                let _ = fs::remove_file(new);
                Ok(Verdict::Same(summary))
            }
            Some(Ok(summary)) if summary.is_equal() => Ok(Verdict::Same(summary)),
            compared if bless => {
                put(&path, &recording.text())
                    .map_err(|reason| GoldenError::Unwritable { path: path.clone(), reason })?;
                let _ = fs::remove_file(new);
                Ok(Verdict::Blessed { path, before: compared.and_then(Result::err) })
            }
            Some(Err(mismatch)) if mismatch.is_difference() => {
                let written = put(&new, &recording.text());
                let new = written.map(|()| new).map_err(|reason| reason.to_string());
                Err(GoldenError::Different { path, mismatch, own, new })
            }
            Some(Err(mismatch)) => Err(GoldenError::Unlike { path, mismatch }),
            _ => Err(GoldenError::Missing { path }),
        }
    }
}

/// The path with an ending after its name.
fn beside(path: &Path, ending: &str) -> PathBuf {
    let mut name = path.file_name().unwrap_or_default().to_owned();
    name.push(ending);
    path.with_file_name(name)
}

/// Writes a file atomically; creates its folder if necessary.
fn put(path: &Path, text: &str) -> io::Result<()> {
    let name = path.file_name().and_then(|name| name.to_str()).ok_or_else(|| {
        io::Error::new(
            io::ErrorKind::InvalidInput,
            "the path does not end with a file name in UTF-8",
        )
    })?;
    let folder = match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    };
    fs::create_dir_all(folder)?;
    let half = folder.join(format!(".{name}.{}.half", std::process::id()));
    let written = fs::write(&half, text).and_then(|()| fs::rename(&half, path));
    written.inspect_err(|_| drop(fs::remove_file(&half)))
}
