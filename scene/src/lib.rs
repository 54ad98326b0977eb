//! Scenes: a TOML file becomes a checked, assembled model.
//!
//! `text → tables with spans → checked description → assembled model`.

mod runtime;

pub use runtime::{SceneModel, widen};

use dbd_kernel::F64;

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
