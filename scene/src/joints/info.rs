//! What reports say of a joint.

use std::ops::Range;

use crate::hinge::Hinge;

/// What reports say of a joint.
#[derive(Clone, Debug, PartialEq)]
pub struct JointInfo {
    /// Its name.
    pub name: String,
    /// Its type as in the scene file, e.g. `revolute`.
    pub kind: &'static str,
    /// The names of its two bodies (`world` for the ground).
    pub between: [String; 2],
    /// Degrees of freedom that it holds: 5 for a revolute, 3 for a spherical joint. A universal
    /// joint holds 10, for it brings a body with 6 of its own; the pair loses 4.
    pub holds: u32,
    /// The name of the body that it brings, `JOINT.spider` for a universal joint.
    pub spider: Option<String>,
    /// Its groups in the model.
    pub groups: Range<usize>,
    /// The axes about which its second body turns: one of a revolute and a cylindrical joint, the
    /// two of a universal joint, empty where there is none or any will do.
    pub hinges: Vec<Hinge>,
    /// Its TSDAs, points on lines included.
    pub tsdas: usize,
    /// \[m\] the largest |L − L0| of its elements at the initial pose.
    pub assembly_error: f64,
}
