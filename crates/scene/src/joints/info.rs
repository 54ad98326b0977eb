//! Description of a joint for reports.

use std::ops::Range;

use dbd_kernel::Vec3;

use crate::hinge::Hinge;
use crate::joints::kind::Realisation;

/// Description of a joint for reports.
#[derive(Clone, Debug, PartialEq)]
pub struct JointInfo {
    /// Its name.
    pub name: String,
    /// Its type as in the scene file, e.g. `revolute`.
    pub kind: &'static str,
    /// The names of its two bodies (`world` for the ground).
    pub between: [String; 2],
    /// \[m\] its position, world, where [`Scene::assembled_states`](crate::Scene::assembled_states) puts its bodies.
    pub at: Vec3<f64>,
    /// \[1\] unit axis of its first body and of its second, world, there; equal except for a universal joint, and z for a
    /// spherical one.
    pub axes: [Vec3<f64>; 2],
    /// Its realisation.
    pub realisation: Realisation,
    /// Degrees of freedom that it constrains: 5 for a revolute, 3 for a spherical joint. A universal joint of TSDAs
    /// constrains 10, because it adds a body with 6; the pair loses 4.
    pub holds: u32,
    /// The name of the body that it adds, `JOINT.spider` for a universal joint of TSDAs.
    pub spider: Option<String>,
    /// Its groups in the model.
    pub groups: Range<usize>,
    /// The axes of rotation of its second body: one for a revolute or cylindrical joint, two for a universal joint,
    /// otherwise empty.
    pub hinges: Vec<Hinge>,
    /// Its TSDAs, points on lines and bushings included.
    pub tsdas: usize,
    /// \[m\] its size: the free length of its TSDAs or, for a bushing, of the equivalent TSDAs.
    pub size: f64,
    /// \[kg\] mass of a spider that a bushing does not use.
    pub mass_left_out: f64,
    /// \[m\] the largest |L − L0| of its elements at the initial pose.
    pub assembly_error: f64,
}
