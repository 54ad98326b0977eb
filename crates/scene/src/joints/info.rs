//! What reports say of a joint.

use std::ops::Range;

use crate::hinge::Hinge;
use crate::joints::kind::Realisation;

/// What reports say of a joint.
#[derive(Clone, Debug, PartialEq)]
pub struct JointInfo {
    /// Its name.
    pub name: String,
    /// Its type as in the scene file, e.g. `revolute`.
    pub kind: &'static str,
    /// The names of its two bodies (`world` for the ground).
    pub between: [String; 2],
    /// What it is made of.
    pub realisation: Realisation,
    /// Degrees of freedom that it holds: 5 for a revolute, 3 for a spherical joint. A universal
    /// joint of TSDAs holds 10, for it brings a body with 6 of its own; the pair loses 4.
    pub holds: u32,
    /// The name of the body that it brings, `JOINT.spider` for a universal joint of TSDAs.
    pub spider: Option<String>,
    /// Its groups in the model.
    pub groups: Range<usize>,
    /// The axes about which its second body turns: one of a revolute and a cylindrical joint, the
    /// two of a universal joint, empty where there is none or any will do.
    pub hinges: Vec<Hinge>,
    /// Its TSDAs, points on lines and bushings included.
    pub tsdas: usize,
    /// \[m\] how large it is: the free length of its TSDAs, of a bushing that of those it stands for.
    pub size: f64,
    /// \[kg\] of a spider that the scene gives and a bushing has no use for.
    pub mass_left_out: f64,
    /// \[m\] the largest |L − L0| of its elements at the initial pose.
    pub assembly_error: f64,
}
