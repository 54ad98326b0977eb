//! Parameters that the file does not contain: stiffness and size of joints, ignored kinds.
//!
//! `arguments => options`.

use crate::omission::Kind;

/// Treatment of bodies without joints.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Weld {
    /// Merge it with its parent: no joint, rigid as in MuJoCo.
    #[default]
    Merge,
    /// Keep it as a separate body with a fixed joint, whose force can be read.
    Fixed,
}

/// Allowed gap of a loop as a fraction of the mechanism's size: CAD programs write poses with about six digits, and
/// their errors add up in a loop.
pub const TOLERANCE: f64 = 1e-4;

/// Parameters that the file does not contain.
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
    /// \[m\] allowed gap of a loop, > 0; else [`TOLERANCE`] times the size of the mechanism.
    pub tolerance: Option<f64>,
    /// Fraction of a body's mass given to a body between two of its joints if no exact mass exists, > 0 and < 1; else
    /// such a body is refused.
    pub carriers: Option<f64>,
    /// \[s\] simulated time, > 0.
    pub duration: f64,
    /// Treatment of bodies without joints.
    pub weld: Weld,
    /// The keyframe at which the scene starts; else the file's pose.
    pub keyframe: Option<String>,
    /// Ignored kinds.
    pub ignored: Vec<Kind>,
}

impl Options {
    /// \[N·m/rad, N/m\] stiffness of the limits of a hinge and a slide with this joint span \[m\].
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
