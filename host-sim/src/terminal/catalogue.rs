//! The scenes that ship, and the way from what a user names to a scene.
//!
//! `name or path => scene`. Scenes lie in `scenes/` below the current folder, or else in that of
//! the sources this program was built from.

use std::fmt;
use std::fs;
use std::path::{Path, PathBuf};

use dbd_scene::{Scene, SceneError, nearest};
use miette::{Diagnostic, LabeledSpan, SourceCode};
use thiserror::Error;

const FOLDER: &str = "scenes";

/// A folder of scenes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Catalogue {
    folder: PathBuf,
}

/// There is no scene of this name.
#[derive(Clone, Debug, PartialEq, Eq, Error, Diagnostic)]
#[error("there is no scene named \"{name}\"")]
#[diagnostic(help("{}", self.help_text()))]
pub struct UnknownScene {
    name: String,
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

// Not derived: the derive's calls would meet `SceneError::help`, which is a method of its own.
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
        let meant = nearest.map(|name| format!("did you mean {name}? ")).unwrap_or_default();
        let known = if self.known.is_empty() { "none".into() } else { self.known.join(", ") };
        format!("{meant}the scenes in {FOLDER}/: {known}; or a path to a .toml file")
    }
}

impl Catalogue {
    /// The scenes of a folder.
    #[must_use]
    pub fn new(folder: PathBuf) -> Self {
        Self { folder }
    }

    /// The scenes that ship.
    #[must_use]
    pub fn find() -> Self {
        let here = PathBuf::from(FOLDER);
        if here.is_dir() {
            return Self::new(here);
        }
        let sources = Path::new(env!("CARGO_MANIFEST_DIR"));
        Self::new(sources.parent().unwrap_or(sources).join(FOLDER))
    }

    /// Names in alphabetical order.
    #[must_use]
    pub fn names(&self) -> Vec<String> {
        let Ok(entries) = fs::read_dir(&self.folder) else { return Vec::new() };
        let scene_name = |path: PathBuf| {
            let is_scene = path.extension().is_some_and(|extension| extension == "toml");
            if is_scene { path.file_stem()?.to_str().map(str::to_owned) } else { None }
        };
        let mut names: Vec<String> =
            entries.filter_map(|entry| scene_name(entry.ok()?.path())).collect();
        names.sort();
        names
    }

    /// Whether a scene is the one of its name in the catalogue, wherever it was loaded from.
    #[must_use]
    pub fn ships(&self, scene: &Scene) -> bool {
        // The catalogue's own are named as their files are. What steps is the model.
        let text = |scene: &Scene| format!("{:?}", scene.model);
        let own = if is_path(&scene.name) { None } else { self.load(&scene.name).ok() };
        own.is_some_and(|own| text(&own) == text(scene))
    }

    /// Loads what a user names: a scene of the catalogue, or a path to a `.toml` file.
    ///
    /// # Errors
    /// Where there is no such scene, or it is refused.
    pub fn load(&self, scene: &str) -> Result<Scene, LoadError> {
        if is_path(scene) {
            return Ok(Scene::load(Path::new(scene))?);
        }
        let known = self.names();
        if !known.iter().any(|name| name == scene) {
            return Err(UnknownScene { name: scene.into(), known }.into());
        }
        Ok(Scene::load(&self.folder.join(format!("{scene}.toml")))?)
    }
}

fn is_path(scene: &str) -> bool {
    scene.ends_with(".toml") || scene.contains(['/', '\\'])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_scene_ships_by_its_content_and_not_by_its_path() {
        let body = "[[body]]\nname = \"b\"\nmass = 1.0\nposition = [0.0, 0.0, 0.0]\ninertia = [1.0, 1.0, 1.0]\n";
        let text = format!("name = \"ball\"\nduration = 1.0\n{body}");
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("ball.toml"), &text).unwrap();
        let catalogue = Catalogue::new(folder.path().into());
        assert!(catalogue.ships(&catalogue.load("ball").unwrap()));
        assert!(catalogue.ships(&Scene::parse(&text, "elsewhere/copy.toml").unwrap()));
        for changed in [text.replace("mass = 1.0", "mass = 2.0"), text.replace("ball", "other")] {
            assert!(!catalogue.ships(&Scene::parse(&changed, "ball.toml").unwrap()));
        }
    }

    #[test]
    fn an_unknown_name_is_refused_with_those_that_exist() {
        let folder = tempfile::tempdir().unwrap();
        for name in ["four-bar.toml", "pendulum.toml", "notes.md"] {
            fs::write(folder.path().join(name), "").unwrap();
        }
        let catalogue = Catalogue::new(folder.path().into());
        assert_eq!(catalogue.names(), ["four-bar", "pendulum"]);
        let Err(error) = catalogue.load("fourbar") else { panic!() };
        let help = error.help().unwrap().to_string();
        assert!(help.contains("did you mean four-bar?"), "{help}");
        assert!(help.contains("four-bar, pendulum"), "{help}");
        let Err(error) = catalogue.load("rocket") else { panic!() };
        assert!(!error.help().unwrap().to_string().contains("did you mean"));
    }
}
