//! The folder of a scene's results.
//!
//! `(--out, scene's file) => OUT/STEM`, made where it is not there yet. Results of another scene are
//! never replaced unasked: `summary.json`, `trade.json` and `modes.json` say whose they are.

use std::fmt;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use dbd_report::output::file;
use dbd_scene::file::read_text;
use miette::Diagnostic;
use serde::Deserialize;
use thiserror::Error;

use crate::terminal::SceneFile;

/// Files of a run and of a trade-off study; the last of each marks the set complete and names its scene.
const OF_A_RUN: [&str; 3] = ["trace.csv", "report.html", "summary.json"];
const OF_A_SURVEY: [&str; 5] =
    ["trade.csv", "trade.svg", "trade-cortex-m4f.svg", "trade.html", "trade.json"];
/// Files of `modes`; the last again names the scene.
const OF_MODES: [&str; 6] =
    ["modes.csv", "modes.html", "mass.mtx", "stiffness.mtx", "damping.mtx", "modes.json"];

/// Where results go.
#[derive(Clone, Debug, PartialEq)]
pub struct Destination {
    /// The folder below which they go.
    pub out: PathBuf,
    /// The scene's file, after which their folder is named.
    pub file: SceneFile,
    /// Whether results of another scene are replaced.
    pub overwrite: bool,
}

/// There is no folder for the results.
#[derive(Debug, Error)]
pub enum FolderError {
    /// It cannot be made or written to.
    #[error("cannot write to {}: {reason}", folder.display())]
    Unwritable {
        /// The folder.
        folder: PathBuf,
        /// The reason; part of the message and therefore not a source, which would repeat it.
        reason: io::Error,
    },
    /// It holds the results of another scene.
    #[error("{} contains the results of another scene: {other}", folder.display())]
    Taken {
        /// The folder.
        folder: PathBuf,
        /// The other scene's file.
        other: String,
    },
}

impl Diagnostic for FolderError {
    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        Some(Box::new(match self {
            Self::Taken { .. } => {
                "choose another folder with --out DIR, or replace those results with --overwrite"
            }
            Self::Unwritable { reason, .. } if reason.kind() == io::ErrorKind::InvalidInput => {
                "results lie in a folder named after the scene's file, or by its `name` where it \
                 came from standard input: change that"
            }
            Self::Unwritable { .. } => "choose another folder with --out DIR",
        }))
    }
}

/// The scene as a results file records it. Earlier versions recorded only its name.
#[derive(Deserialize)]
struct Owner {
    scene: String,
    scene_file: Option<String>,
    scene_hash: Option<String>,
}

/// Files of results that name their scene.
const NAMING: [&str; 3] = ["summary.json", "trade.json", "modes.json"];

impl Destination {
    /// The file of a run's animation, within the folder.
    #[must_use]
    pub fn animation(&self) -> String {
        format!("{}.glb", self.file.stem)
    }

    /// The folder of a scene's results, made where it is not there yet. Of another scene's results,
    /// where they are to be replaced, nothing is left: old and new are never mixed. What a program
    /// that was killed has left is removed.
    ///
    /// # Errors
    /// Where it cannot be made or written to, no folder can have the file's name, or it holds the
    /// results of another scene.
    pub fn folder(&self, scene: &str) -> Result<PathBuf, FolderError> {
        let wanted = self.out.join(&self.file.stem);
        let failed = |reason| FolderError::Unwritable { folder: wanted.clone(), reason };
        let folder = file::folder(&self.out, &self.file.stem).map_err(failed)?;
        let animation = self.animation();
        let own = [animation.as_str(), "writable"];
        file::sweep(&folder, &[&OF_A_RUN[..], &OF_A_SURVEY, &OF_MODES, &own].concat());
        self.claim(&folder, scene)?;
        Ok(folder)
    }

    /// Ensures that a folder has no results of another scene; removes them if they
    /// are to be replaced.
    ///
    /// # Errors
    /// If it has such results, or they cannot be removed.
    pub fn claim(&self, folder: &Path, scene: &str) -> Result<(), FolderError> {
        let failed = |reason| FolderError::Unwritable { folder: folder.to_owned(), reason };
        for name in NAMING {
            let Some(owner) = Owner::of(&folder.join(name)) else { continue };
            if owner.is_this(scene, &self.file) {
                continue;
            }
            if !self.overwrite {
                let other = owner.scene_file.unwrap_or_else(|| format!("`{}`", owner.scene));
                return Err(FolderError::Taken { folder: folder.to_owned(), other });
            }
            clear(folder).map_err(failed)?;
        }
        Ok(())
    }
}

impl Owner {
    fn of(file: &Path) -> Option<Self> {
        serde_json::from_str(&read_text(file).ok()?).ok()
    }

    /// Whether it is the scene of this name from this file, changed since or not.
    fn is_this(&self, scene: &str, file: &SceneFile) -> bool {
        let Some(place) = &self.scene_file else { return self.scene == scene };
        // A copy counts as the same scene.
        if *place == file.place || self.scene_hash.as_ref() == Some(&file.hash) {
            return true;
        }
        // A file that was moved with its results.
        let gone = Path::new(place).is_absolute() && !Path::new(place).exists();
        gone && self.scene == scene
    }
}

/// Removes the files that commands write into a folder; other files remain.
fn clear(folder: &Path) -> io::Result<()> {
    // The file that marks the set complete is removed first.
    for name in NAMING {
        match fs::remove_file(folder.join(name)) {
            Err(error) if error.kind() != io::ErrorKind::NotFound => return Err(error),
            _ => {}
        }
    }
    let animation = folder.file_name().map(|name| format!("{}.glb", name.to_string_lossy()));
    for entry in fs::read_dir(folder)? {
        let entry = entry?;
        let name = entry.file_name().to_string_lossy().into_owned();
        let of_a_run = OF_A_RUN.contains(&name.as_str()) || animation.as_ref() == Some(&name);
        let of_a_survey = name.starts_with("trade")
            && [".csv", ".json", ".svg", ".html", ".cache"].iter().any(|end| name.ends_with(end));
        if of_a_run || of_a_survey || OF_MODES.contains(&name.as_str()) {
            fs::remove_file(entry.path())?;
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn owner(scene: &str, file: Option<&str>, hash: Option<&str>) -> Owner {
        let text = |text: &str| text.to_owned();
        Owner { scene: scene.into(), scene_file: file.map(text), scene_hash: hash.map(text) }
    }

    #[test]
    fn results_belong_to_a_file_and_its_copies() {
        let here = tempfile::tempdir().unwrap();
        let there = here.path().join("there.toml");
        fs::write(&there, "").unwrap();
        let there = there.to_str().unwrap();
        let gone = here.path().join("gone.toml");
        let ours = SceneFile { stem: "a".into(), place: "/a.toml".into(), hash: "1".into() };
        let cases = [
            (owner("arm", Some("/a.toml"), Some("0")), true),
            (owner("leg", Some("/a.toml"), Some("0")), true),
            (owner("arm", Some(there), Some("1")), true),
            (owner("arm", Some(there), Some("0")), false),
            (owner("arm", Some("built in"), Some("0")), false),
            (owner("arm", gone.to_str(), Some("0")), true),
            (owner("leg", gone.to_str(), Some("0")), false),
            (owner("arm", None, None), true),
            (owner("leg", None, None), false),
        ];
        for (row, (owner, same)) in cases.into_iter().enumerate() {
            assert_eq!(owner.is_this("arm", &ours), same, "{row}");
        }
    }
}
