//! Context of every item: scenes, methods, errors.

use dbd_plant::{AnyPlant, Method, MethodError, PlantError, PrecisionName, SchemeName};
use dbd_scene::{Scene, SceneError};
use miette::Diagnostic;
use thiserror::Error;

use crate::modes::ModesError;

/// Where the scenes come from.
pub type Scenes<'s> = dyn Fn(&str) -> Option<Scene> + Sync + 's;

/// Why an item could not be measured.
#[derive(Debug, Error, Diagnostic)]
pub enum PaperError {
    /// A scene is not among those that ship.
    #[error("the scene {0} is not part of this program: build it from a complete source tree")]
    Scene(String),
    /// A scene lacks a body that is measured.
    #[error("the scene {scene} has no body {body}")]
    Body {
        /// The scene.
        scene: String,
        /// The body.
        body: String,
    },
    /// There are no modes about a pose.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Modes(#[from] ModesError),
    /// A changed scene is refused.
    #[error(transparent)]
    Changed(#[from] SceneError),
    /// A method is not in this build.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Method(#[from] MethodError),
    /// A scene cannot be stepped.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Plant(#[from] PlantError),
    /// Nothing vibrates.
    #[error("the model has no vibration about this pose")]
    Still,
    /// A run fails where the paper's does not.
    #[error("the run fails after {time} s: the method cannot be measured on this scene")]
    Failed {
        /// \[s\] time of the failure.
        time: f64,
    },
}

/// Context of an item.
pub struct Context<'c> {
    pub(super) scenes: &'c Scenes<'c>,
}

impl Context<'_> {
    /// A scene that ships.
    pub(super) fn scene(&self, name: &str) -> Result<Scene, PaperError> {
        (self.scenes)(name).ok_or_else(|| PaperError::Scene(name.into()))
    }
}

/// Every scene of Table 7, in its order.
pub const TEN: [&str; 10] = [
    "four-bar",
    "five-bar-a",
    "3rrr-2",
    "3rrr-1",
    "3rrr",
    "3ruu-2",
    "3ruu-1",
    "3ruu",
    "two-3ruu",
    "three-systems",
];

/// The paper's scheme with the given number of Newton iterations, in double precision.
pub(super) fn dbd(newton: u32) -> Result<Method, PaperError> {
    Ok(Method::new(SchemeName::Dbd, Some(newton), PrecisionName::F64)?)
}

/// Another scheme in double precision.
pub(super) fn scheme(scheme: SchemeName) -> Result<Method, PaperError> {
    Ok(Method::new(scheme, None, PrecisionName::F64)?)
}

/// Advances by the given number of steps.
pub(super) fn advance(plant: &mut dyn AnyPlant, steps: u64) -> Result<(), PaperError> {
    if plant.advance(steps).is_ok() {
        Ok(())
    } else {
        Err(PaperError::Failed { time: plant.time() })
    }
}

/// The index of a body.
pub(super) fn place(scene: &Scene, body: &str) -> Result<usize, PaperError> {
    let found = scene.body_names.iter().position(|name| name == body);
    found.ok_or_else(|| PaperError::Body { scene: scene.name.clone(), body: body.into() })
}
