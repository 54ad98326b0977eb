//! The scene that instances are made from.
//!
//! `(file, text, changes) => scene, with parameters in place`.

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Arc;

use dbd_scene::file::read_text;
use dbd_scene::{Scene, SceneError};

/// A scene's text with changes of its values.
#[derive(Clone, Debug, PartialEq)]
pub struct Blueprint {
    /// Name of the text in messages.
    pub file: String,
    /// The scene in TOML.
    pub text: Arc<str>,
    /// Changes, each `PATH=VALUE`; later ones go before earlier ones.
    pub changes: Vec<String>,
}

impl Blueprint {
    /// A scene from its text; `file` is its name in messages.
    pub fn new(file: impl Into<String>, text: impl Into<Arc<str>>) -> Self {
        Self { file: file.into(), text: text.into(), changes: Vec::new() }
    }

    /// A scene file. It is not checked before an instance is made.
    ///
    /// # Errors
    /// Where the file cannot be read.
    pub fn load(path: impl AsRef<Path>) -> Result<Self, SceneError> {
        let file = path.as_ref().display().to_string();
        match read_text(path) {
            Ok(text) => Ok(Self::new(file, text)),
            Err(reason) => Err(SceneError::Unreadable { file, reason }),
        }
    }

    /// Adds a change, `PATH=VALUE`.
    #[must_use]
    pub fn with(mut self, change: impl Into<String>) -> Self {
        self.changes.push(change.into());
        self
    }

    /// The scene with parameters set by their paths.
    pub(crate) fn scene(&self, parameters: &BTreeMap<String, f64>) -> Result<Scene, SceneError> {
        let set = parameters.iter().map(|(path, value)| format!("{path}={value:?}"));
        let changes: Vec<String> = self.changes.iter().cloned().chain(set).collect();
        Scene::parse_with(&self.text, &self.file, &changes)
    }
}
