//! `host-sim play`: a page in which scenes run, with the kernel in WebAssembly.
//!
//! `(scenes, settings, module) => one file of HTML, or the same served on this machine`.

mod serve;

pub use serve::serve;

use std::fmt;
use std::io;
use std::path::{Path, PathBuf};

use dbd_plant::instance::Settings;
use dbd_play::page::{MODULE, Page, SceneText, html};
use dbd_play::session::{Change, MAX_TEXT, Session, Set};
use dbd_report::output::file::write_at;
use dbd_scene::file::read;
use miette::Diagnostic;
use thiserror::Error;

use crate::terminal::Found;

/// \[byte\] larger than any module.
const MAX_MODULE: u64 = 1 << 28;

/// Why there is no page.
#[derive(Debug, Error)]
pub enum PlayError {
    /// The scene does not run with these settings.
    #[error("{0}")]
    Refused(String, Option<String>),
    /// An invalid change of a number.
    #[error("`{0}` is not a change of a number")]
    Change(String),
    /// A text is too long for a page.
    #[error("the text of scene `{scene}` has {bytes} bytes, a page accepts at most {MAX_TEXT}")]
    Long {
        /// Its name.
        scene: String,
        /// How many.
        bytes: usize,
    },
    /// An invalid speed.
    #[error("invalid --speed {0}")]
    Speed(f64),
    /// The kernel in WebAssembly is missing.
    #[error("cannot read the module {}: {reason}", file.display())]
    Module {
        /// Where it was looked for.
        file: PathBuf,
        /// Why not.
        reason: io::Error,
    },
    /// Only a file can be served.
    #[error("--serve needs a scene file; {0} is not one")]
    NoFile(String),
    /// The file has other contents.
    #[error("{} is not a page of host-sim", file.display())]
    Taken {
        /// The file.
        file: PathBuf,
    },
    /// The page cannot be written.
    #[error("cannot write {}: {reason}", file.display())]
    Write {
        /// The file.
        file: PathBuf,
        /// Why.
        reason: io::Error,
    },
    /// The page cannot be served.
    #[error("cannot serve on 127.0.0.1:{port}: {reason}")]
    Serve {
        /// The port; 0 for any.
        port: u16,
        /// Why.
        reason: String,
    },
}

impl Diagnostic for PlayError {
    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        Some(match self {
            Self::Refused(_, help) => return help.clone().map(|help| Box::new(help) as _),
            Self::Change(_) => {
                Box::new("write PATH=NUMBER, with the number in the SI unit of the path")
            }
            Self::Long { .. } => Box::new("use host-sim run"),
            Self::Speed(_) => Box::new("give a number above 0; 0.1 is a tenth of real time"),
            Self::Module { .. } => Box::new(
                "build it next to host-sim with cargo xtask playground, in a checkout, or give its path with --module",
            ),
            Self::NoFile(_) => Box::new(
                "give a path to a .toml file; host-sim new scene NAME --from SCENE writes a copy of a built-in scene",
            ),
            Self::Taken { .. } => Box::new("choose another file with --out, or remove that one"),
            Self::Write { .. } => return None,
            Self::Serve { .. } => {
                Box::new("choose another one with --port; without it a free port is used")
            }
        })
    }
}

/// The request for a page.
pub struct Asked<'a> {
    /// The scenes.
    pub scenes: Vec<Found>,
    /// Changes of the first.
    pub changes: &'a [String],
    /// How they are stepped.
    pub settings: Settings,
    /// Ratio of simulated to real time.
    pub speed: Option<f64>,
}

/// The page of scenes; the first must run with the settings.
///
/// # Errors
/// If a scene is too long, or the first is not compatible with the settings.
pub fn page(asked: Asked<'_>) -> Result<Page, PlayError> {
    let Asked { scenes, changes, settings, speed } = asked;
    let set = numbers(changes)?;
    let mut texts = Vec::new();
    for found in scenes {
        if found.text.len() > MAX_TEXT {
            return Err(PlayError::Long { scene: found.scene.name, bytes: found.text.len() });
        }
        let file = format!("{}.toml", found.file.stem);
        if texts.is_empty() {
            let (text, settings) = (found.text.clone(), settings.clone());
            let change = Change { file: file.clone(), text, settings, set: set.clone() };
            Session::open(change).map_err(|no| PlayError::Refused(no.message, no.help))?;
        }
        let (name, description) = (found.file.stem, found.scene.description);
        texts.push(SceneText { name, file, description, text: found.text });
    }
    Ok(Page { scenes: texts, settings, set, speed, reload: None })
}

/// Changes of numbers by their paths: what a page's sliders change, too.
fn numbers(changes: &[String]) -> Result<Set, PlayError> {
    let number = |change: &String| {
        let (path, value) = change.split_once('=')?;
        Some((path.trim().to_owned(), value.trim().parse().ok()?))
    };
    changes
        .iter()
        .map(|change| number(change).ok_or_else(|| PlayError::Change(change.clone())))
        .collect()
}

/// The module in a file; by default the one next to this program.
///
/// # Errors
/// Where it cannot be read.
pub fn module(file: Option<&Path>) -> Result<Vec<u8>, PlayError> {
    let beside = || std::env::current_exe().unwrap_or_default().with_file_name(MODULE);
    let file = file.map_or_else(beside, Path::to_owned);
    read(&file, MAX_MODULE).map_err(|reason| PlayError::Module { file, reason })
}

/// The page as HTML.
///
/// # Errors
/// If the module is invalid.
pub fn made(page: &Page, module: &[u8]) -> Result<String, PlayError> {
    html(page, module).map_err(|reason| PlayError::Module { file: MODULE.into(), reason })
}

/// Writes a page; the file it is in.
///
/// # Errors
/// If the file is not a page, or cannot be written.
pub fn written(html: &str, out: Option<&Path>, page: &Page) -> Result<PathBuf, PlayError> {
    let usual = || match page.scenes.as_slice() {
        [one] => Path::new("out").join(&one.name).join("play.html"),
        _ => PathBuf::from("out/play.html"),
    };
    let file = out.map_or_else(usual, Path::to_owned);
    // A device, which seems empty, is not replaced either.
    if file.exists() && !(file.is_file() && is_page(&file)) {
        return Err(PlayError::Taken { file });
    }
    let write = || {
        if let Some(folder) = file.parent() {
            std::fs::create_dir_all(folder)?;
        }
        write_at(&file, html)
    };
    match write() {
        Ok(()) => Ok(file),
        Err(reason) => Err(PlayError::Write { file, reason }),
    }
}

/// Whether a file begins as a page does; an empty file may be replaced.
pub(crate) fn is_page(file: &Path) -> bool {
    let begins = |bytes: Vec<u8>| bytes.is_empty() || bytes.starts_with(b"<!doctype html>");
    read(file, MAX_MODULE).is_ok_and(begins)
}
