//! The contents of an FMU's `resources/`.
//!
//! `(blueprint, settings) <=> scene.toml, scene.json`. The library reads them to make an instance.

use std::io;
use std::path::Path;

use dbd_plant::instance::{Blueprint, Instance, InstanceError, Settings};
use dbd_scene::file::read_text;
use serde::{Deserialize, Serialize};
use thiserror::Error;

/// The scene's text.
pub const SCENE: &str = "scene.toml";
/// Its changes and method.
pub const PLAN: &str = "scene.json";

/// A scene and its method.
#[derive(Clone, Debug, PartialEq)]
pub struct Resource {
    /// The scene.
    pub blueprint: Blueprint,
    /// The method and the step.
    pub settings: Settings,
}

/// The text of [`PLAN`].
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Plan {
    file: String,
    changes: Vec<String>,
    settings: Settings,
}

/// Why a scene cannot be read.
#[derive(Debug, Error)]
pub enum ResourceError {
    /// A file is missing or unreadable.
    #[error("cannot read {file} of the FMU's resources: {reason}")]
    Unreadable {
        /// The file.
        file: &'static str,
        /// The reason.
        reason: io::Error,
    },
    /// The plan is damaged.
    #[error("{PLAN} of the FMU's resources is damaged: {0}")]
    Damaged(serde_json::Error),
}

impl Resource {
    /// A scene with a fixed step, which parameters do not change later; and an instance of it.
    ///
    /// # Errors
    /// If the scene or the settings are refused.
    pub fn new(
        blueprint: Blueprint,
        settings: Settings,
    ) -> Result<(Self, Instance), InstanceError> {
        let instance = Instance::new(blueprint.clone(), settings.clone())?;
        let settings = Settings { step: Some(instance.step_size()), ..settings };
        let instance = Instance::new(blueprint.clone(), settings.clone())?;
        Ok((Self { blueprint, settings }, instance))
    }

    /// The files: names and texts.
    #[must_use]
    pub fn files(&self) -> [(&'static str, String); 2] {
        let Blueprint { file, text, changes } = self.blueprint.clone();
        let plan = Plan { file, changes, settings: self.settings.clone() };
        // Strings and finite numbers always become JSON.
        let plan = serde_json::to_string_pretty(&plan).unwrap_or_default();
        [(SCENE, text.to_string()), (PLAN, plan)]
    }

    /// Reads the resources in a folder.
    ///
    /// # Errors
    /// [`ResourceError`].
    pub fn read(folder: &Path) -> Result<Self, ResourceError> {
        let read = |file: &'static str| {
            let text = read_text(folder.join(file));
            text.map_err(|reason| ResourceError::Unreadable { file, reason })
        };
        let Plan { file, changes, settings } =
            serde_json::from_str(&read(PLAN)?).map_err(ResourceError::Damaged)?;
        let blueprint = Blueprint { file, text: read(SCENE)?.into(), changes };
        Ok(Self { blueprint, settings })
    }
}
