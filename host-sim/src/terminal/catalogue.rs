//! Finding scenes by name, path or standard input.
//!
//! `name, path or - => scene and its origin`. The shipped scenes are built in, so that the
//! program needs no folder; files in `scenes/` below the current folder take precedence.

use std::fmt;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use dbd_scene::file::{read_stream, read_text};
use dbd_scene::{Scene, SceneError, nearest, shortened};
use miette::{Diagnostic, LabeledSpan, SourceCode};
use thiserror::Error;

mod built_in {
    include!(concat!(env!("OUT_DIR"), "/scenes.rs"));
}

const FOLDER: &str = "scenes";

/// The location of a built-in scene.
pub const BUILT_IN: &str = "built in";

/// The command-line name of standard input.
const STANDARD_INPUT: &str = "-";

/// The named scenes: those of a folder, then the built-in ones.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Catalogue {
    folder: PathBuf,
}

/// A scene and its origin.
#[derive(Clone, Debug)]
pub struct Found {
    /// The scene.
    pub scene: Scene,
    /// Its text's origin.
    pub file: SceneFile,
    /// The text.
    pub text: String,
}

/// The origin of a scene's text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SceneFile {
    /// The name of the folder of its results: the file's without its extension, a scene's own where
    /// it came from standard input.
    pub stem: String,
    /// The whole path of the file; else `built in` or `standard input`.
    pub place: String,
    /// FNV-1a 64 of the text, 16 hexadecimal digits.
    pub hash: String,
}

/// There is no scene of this name.
#[derive(Clone, Debug, PartialEq, Eq, Error, Diagnostic)]
#[error("no scene named \"{}\"", shortened(name))]
#[diagnostic(help("{}", self.help_text()))]
pub struct UnknownScene {
    name: String,
    /// The file that exists with `.toml` added.
    file: Option<String>,
    known: Vec<String>,
}

/// Why a scene could not be loaded.
#[derive(Debug, Error)]
pub enum LoadError {
    /// There is no such scene.
    #[error(transparent)]
    Unknown(#[from] UnknownScene),
    /// The scene is refused.
    #[error(transparent)]
    Scene(#[from] SceneError),
}

impl LoadError {
    fn inner(&self) -> &dyn Diagnostic {
        match self {
            Self::Unknown(error) => error,
            Self::Scene(error) => error,
        }
    }
}

// Not derived, because the derived calls would resolve to `SceneError::help`, an inherent method.
impl Diagnostic for LoadError {
    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        self.inner().help()
    }

    fn source_code(&self) -> Option<&dyn SourceCode> {
        self.inner().source_code()
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        self.inner().labels()
    }
}

impl UnknownScene {
    fn help_text(&self) -> String {
        let nearest = nearest(&self.name, self.known.iter().map(String::as_str));
        let meant = self.file.as_deref().or(nearest);
        let meant = meant.map(|name| format!("did you mean {name}? ")).unwrap_or_default();
        let known = self.known.join(", ");
        format!(
            "{meant}known scenes: {known}; or give a path to a .toml file, or - for standard input"
        )
    }
}

impl SceneFile {
    /// The origin of a text.
    #[must_use]
    pub fn new(stem: String, place: String, text: &str) -> Self {
        let hash = text.bytes().fold(0xcbf2_9ce4_8422_2325_u64, |hash, byte| {
            (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3)
        });
        Self { stem, place, hash: format!("{hash:016x}") }
    }
}

impl Default for Catalogue {
    /// The scenes in `scenes/`, then those that ship.
    fn default() -> Self {
        Self::new(PathBuf::from(FOLDER))
    }
}

impl Catalogue {
    /// The scenes of a folder, then those that ship.
    #[must_use]
    pub fn new(folder: PathBuf) -> Self {
        Self { folder }
    }

    /// Names in alphabetical order.
    #[must_use]
    pub fn names(&self) -> Vec<String> {
        let mut names = self.file_names();
        names.extend(built_in::SCENES.iter().map(|(name, _)| (*name).to_owned()));
        names.sort();
        names.dedup();
        names
    }

    /// The file that a user names: by a path, or by a name in the folder. `None` for built-in scenes, standard input
    /// and unknown names.
    #[must_use]
    pub fn file(&self, called: &str) -> Option<PathBuf> {
        if called == STANDARD_INPUT {
            return None;
        }
        if is_path(called) {
            return Some(PathBuf::from(called));
        }
        let is_here = self.file_names().iter().any(|name| name == called);
        is_here.then(|| self.folder.join(format!("{called}.toml")))
    }

    /// Names of the files in the folder.
    fn file_names(&self) -> Vec<String> {
        let Ok(entries) = fs::read_dir(&self.folder) else { return Vec::new() };
        let scene_name = |path: PathBuf| {
            let is_scene = path.extension().is_some_and(|extension| extension == "toml");
            if is_scene { path.file_stem()?.to_str().map(str::to_owned) } else { None }
        };
        entries.filter_map(|entry| scene_name(entry.ok()?.path())).collect()
    }

    /// The built-in scene of a name.
    #[must_use]
    pub fn shipped(name: &str) -> Option<Scene> {
        // They have the names of their files.
        let (_, text) = built_in::SCENES.iter().find(|(known, _)| *known == name)?;
        Scene::parse(text, name).ok()
    }

    /// Loads a scene of the catalogue, a path to a `.toml` file, or `-` for
    /// standard input.
    ///
    /// # Errors
    /// Where there is no such scene, it cannot be read, or it is refused.
    pub fn load(&self, called: &str) -> Result<Found, LoadError> {
        self.load_with(called, &[])
    }

    /// Loads a scene by name, with values changed: `PATH=VALUE`.
    ///
    /// # Errors
    /// As [`Self::load`], or if a changed path does not exist.
    pub fn load_with(&self, called: &str, changes: &[String]) -> Result<Found, LoadError> {
        if called == STANDARD_INPUT {
            return from_standard_input(changes);
        }
        if let Some(file) = self.file(called) {
            return from_file(&file, changes);
        }
        match built_in::SCENES.iter().find(|(name, _)| *name == called) {
            Some((name, text)) => {
                let file = SceneFile::new((*name).into(), BUILT_IN.into(), text);
                let scene = Scene::parse_with(text, &format!("{name}.toml"), changes)?;
                Ok(Found { scene, file, text: (*text).into() })
            }
            None => {
                let file = Some(format!("{called}.toml")).filter(|file| Path::new(file).is_file());
                Err(UnknownScene { name: called.into(), file, known: self.names() }.into())
            }
        }
    }
}

fn from_file(path: &Path, changes: &[String]) -> Result<Found, LoadError> {
    let name = path.display().to_string();
    let text = match read_text(path) {
        Ok(text) => text,
        Err(reason) => return Err(SceneError::Unreadable { file: name, reason }.into()),
    };
    let scene = Scene::parse_with(&text, &name, changes)?;
    let stem = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    let whole = path.canonicalize().unwrap_or_else(|_| path.to_owned());
    let file = SceneFile::new(stem, whole.display().to_string(), &text);
    Ok(Found { scene, file, text })
}

fn from_standard_input(changes: &[String]) -> Result<Found, LoadError> {
    let place = "standard input";
    let text = match read_stream(io::stdin()) {
        Ok(text) => text,
        Err(reason) => return Err(SceneError::Unreadable { file: place.into(), reason }.into()),
    };
    let scene = Scene::parse_with(&text, place, changes)?;
    let file = SceneFile::new(scene.name.clone(), place.into(), &text);
    Ok(Found { scene, file, text })
}

/// Whether the argument is a path rather than a name.
#[must_use]
pub fn is_path(scene: &str) -> bool {
    scene.ends_with(".toml") || scene.contains(['/', '\\'])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn here(catalogue: &Catalogue, name: &str) -> Found {
        catalogue.load(name).unwrap_or_else(|error| panic!("{name}: {error}"))
    }

    /// Without a folder every scene that ships is there; a file of the same name comes before it.
    #[test]
    fn files_come_before_what_is_built_in() {
        let folder = tempfile::tempdir().unwrap();
        let catalogue = Catalogue::new(folder.path().join("none"));
        assert_eq!(catalogue.names().len(), built_in::SCENES.len());
        for (name, _) in built_in::SCENES {
            let found = here(&catalogue, name);
            let place = "built in".to_owned();
            assert_eq!((found.scene.name.as_str(), found.file.place), (name, place));
        }
        let (_, text) = built_in::SCENES.iter().find(|(name, _)| *name == "four-bar").unwrap();
        let file = folder.path().join("four-bar.toml");
        fs::write(&file, text.replace("duration = 0.5", "duration = 0.25")).unwrap();
        let catalogue = Catalogue::new(folder.path().into());
        assert_eq!(catalogue.names().len(), built_in::SCENES.len());
        let found = here(&catalogue, "four-bar");
        assert_eq!(found.scene.duration, 0.25);
        assert_eq!(found.file.place, file.canonicalize().unwrap().display().to_string());
        assert_eq!(found.file.stem, "four-bar");
        assert_eq!(here(&catalogue, "3rrr").file.place, "built in");
    }

    #[test]
    fn the_hash_of_a_text_is_fnv_1a() {
        let file = SceneFile::new("a".into(), "b".into(), "foobar");
        assert_eq!(file.hash, "85944171f73967e8");
    }

    #[test]
    fn an_unknown_name_is_refused_with_those_that_exist() {
        let folder = tempfile::tempdir().unwrap();
        for name in ["pendulum.toml", "notes.md"] {
            fs::write(folder.path().join(name), "").unwrap();
        }
        let catalogue = Catalogue::new(folder.path().into());
        let Err(error) = catalogue.load("fourbar") else { panic!() };
        let help = error.help().unwrap().to_string();
        assert!(help.contains("did you mean four-bar?"), "{help}");
        assert!(help.contains(", pendulum, ") && !help.contains("notes"), "{help}");
        let Err(error) = catalogue.load("rocket") else { panic!() };
        assert!(!error.help().unwrap().to_string().contains("did you mean"));
        // A file of that name but for its ending, here this crate's own.
        let Err(error) = catalogue.load("Cargo") else { panic!() };
        assert!(error.help().unwrap().to_string().contains("did you mean Cargo.toml?"));
    }
}
