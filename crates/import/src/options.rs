//! What is stated rather than read: stiffness and size of joints, what is left out.
//!
//! `arguments => options`.

use crate::omission::Kind;

/// What becomes of a body without a joint.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Weld {
    /// It is one with its parent: no joint, no stiffness, as rigid as in MuJoCo.
    #[default]
    Merge,
    /// It is a body of its own with a fixed joint, whose force can be read.
    Fixed,
}

/// By how much a loop may stay open, as a fraction of the mechanism's size: CAD programs write poses
/// with about six digits, and the errors of several add up in a loop.
pub const TOLERANCE: f64 = 1e-4;

/// What is stated rather than read.
#[derive(Clone, Debug, PartialEq)]
pub struct Options {
    /// The name of the scene; else that of the model, else of the file.
    pub name: Option<String>,
    /// \[N/m\] stiffness of each TSDA of a joint, > 0.
    pub stiffness: f64,
    /// \[N·s/m\] its damping, ≥ 0.
    pub damping: f64,
    /// \[m\] span of each joint, > 0; else twice the radius of gyration of the smaller of its bodies.
    pub span: Option<f64>,
    /// \[m\] by how much a loop may stay open, > 0; else [`TOLERANCE`] times the size of the mechanism.
    pub tolerance: Option<f64>,
    /// Fraction of a body's mass that a body between two of its joints takes where none is exact, > 0 and
    /// < 1; else such a body is refused.
    pub carriers: Option<f64>,
    /// \[s\] simulated time, > 0.
    pub duration: f64,
    /// What becomes of bodies without joints.
    pub weld: Weld,
    /// The keyframe at which the scene begins; else the file's pose.
    pub keyframe: Option<String>,
    /// Kinds of things that are left out.
    pub ignored: Vec<Kind>,
}

impl Options {
    /// \[N·m/rad, N/m\] how stiff limits of a hinge, of a slide are, whose joint has this span \[m\].
    pub(crate) fn stiffness_of_limits(&self, is_hinge: bool, span: f64) -> f64 {
        let arm = if is_hinge { 0.5 * span } else { 1.0 };
        self.stiffness * arm * arm
    }
}

impl Default for Options {
    fn default() -> Self {
        Self {
            name: None,
            stiffness: 1e7,
            damping: 0.0,
            span: None,
            tolerance: None,
            carriers: None,
            duration: 1.0,
            weld: Weld::Merge,
            keyframe: None,
            ignored: Vec::new(),
        }
    }
}
