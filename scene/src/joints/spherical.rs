//! Spherical joint: one orthogonal tripod.
//!
//! The centre `at` on the first body, three points of the second at the distance `arm` along the
//! world's x, y and z at the initial pose. Its stiffness about the centre is k·I.

use dbd_kernel::Vec3;

use crate::assembly::{Assembly, Points};
use crate::error::SceneError;
use crate::joints::{Joint, JointType};
use crate::text::{Number, Table};

pub(super) const TYPE: JointType =
    JointType { name: "spherical", holds: 3, keys: &["arm"], expand };

fn expand(table: &Table<'_>, joint: &Joint, assembly: &mut Assembly) -> Result<(), SceneError> {
    let arm = table.required("arm", Number::positive("m"))?;
    let pair = &joint.pair;
    let centre = assembly.point_in(pair.a, joint.at_w);
    let axes = [Vec3::new(arm, 0.0, 0.0), Vec3::new(0.0, arm, 0.0), Vec3::new(0.0, 0.0, arm)];
    let tips = axes.map(|axis| assembly.point_in(pair.b, joint.at_w + axis));
    let points = Points { centres: &[centre], tips: &tips, shared: false };
    assembly.add_tsdas(pair, points, arm, joint.spring).map_err(|defect| defect.refuse(table))
}
