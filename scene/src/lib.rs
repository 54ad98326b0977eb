//! Scenes: a TOML file becomes a checked, assembled model.
//!
//! `text → tables with spans → checked elements → assembled model`. Every refusal names file,
//! line, column, what is wrong and what would be right. The sums and roots of the assembly have
//! one written order and trigonometry is libm's, so a scene gives the same bits on every host.

mod assembly;
mod body;
mod direction;
mod error;
pub mod export;
mod joints;
mod load;
mod names;
mod nearest;
mod orientation;
mod pair;
mod runtime;
mod spring;
mod text;
mod torsion_spring;
mod tsda;

use std::path::Path;

pub use error::{Refusal, SceneError};
pub use runtime::{SceneModel, widen};

use dbd_kernel::F64;

use crate::assembly::Assembly;
use crate::error::Source;
use crate::text::{Number, Numbers, Text};

const KEYS: &[&str] = &[
    "name",
    "description",
    "gravity",
    "duration",
    "step",
    "every",
    "body",
    "joint",
    "tsda",
    "torsion_spring",
    "load",
];

/// A checked and assembled scene.
#[derive(Clone, Debug)]
pub struct Scene {
    /// The scene's name.
    pub name: String,
    /// What it is, free text; empty where the file gives none.
    pub description: String,
    /// \[s\] simulated time.
    pub duration: f64,
    /// \[s\] the step, where the scene gives one.
    pub step: Option<f64>,
    /// \[s\] the sampling interval, where the scene gives one.
    pub every: Option<f64>,
    /// Names of the bodies in the model's order.
    pub body_names: Vec<String>,
    /// The joints in scene order.
    pub joints: Vec<JointInfo>,
    /// What messages call the torsion springs, in the model's order:
    /// `torsion_spring 1 (world–crank)`.
    pub torsion_names: Vec<String>,
    /// The assembled model in double precision; every other precision is a rounding of it.
    pub model: SceneModel<F64>,
}

/// What reports say of a joint.
#[derive(Clone, Debug, PartialEq)]
pub struct JointInfo {
    /// Its name.
    pub name: String,
    /// Its type as in the scene file, e.g. `revolute`.
    pub kind: &'static str,
    /// The names of its two bodies (`world` for the ground).
    pub between: [String; 2],
    /// Degrees of freedom of the pair that it holds: 5 for a revolute, 3 for a spherical joint.
    pub holds: u32,
    /// Its TSDAs.
    pub tsdas: usize,
    /// \[m\] the largest |L − L0| of its elements at the initial pose.
    pub assembly_error: f64,
}

impl Scene {
    /// Reads a scene file.
    ///
    /// # Errors
    /// Where the file cannot be read or the scene is refused.
    pub fn load(path: &Path) -> Result<Self, SceneError> {
        let file = path.display().to_string();
        match std::fs::read_to_string(path) {
            Ok(text) => Self::parse(&text, &file),
            Err(reason) => Err(SceneError::Unreadable { file, reason }),
        }
    }

    /// Reads a scene from its text; `file` is what messages call it.
    ///
    /// # Errors
    /// Where the scene is refused.
    pub fn parse(text: &str, file: &str) -> Result<Self, SceneError> {
        let source = Source { file, text };
        let document = text::parse(source)?;
        let root = text::root(source, &document);
        root.only(&[KEYS])?;
        let name = root.required("name", Text::Name)?;
        let description = root.optional("description", Text::Any)?.unwrap_or_default();
        let duration = root.required("duration", Number::positive("s"))?;
        let step = root.optional("step", Number::positive("s"))?;
        let every = root.optional("every", Number::positive("s"))?;
        let gravity = root.optional("gravity", Numbers(Number::any("m/s²")))?;

        let mut assembly = Assembly::default();
        assembly.set_gravity(gravity.unwrap_or_default());
        body::read_all(&root, &mut assembly)?;
        let joints = joints::read_all(&root, &mut assembly)?;
        tsda::read_all(&root, &mut assembly)?;
        let torsion_names = torsion_spring::read_all(&root, &mut assembly)?;
        load::read_all(&root, &mut assembly)?;
        let (model, body_names) = assembly.finish();
        Ok(Self {
            name,
            description,
            duration,
            step,
            every,
            body_names,
            joints,
            torsion_names,
            model,
        })
    }
}
