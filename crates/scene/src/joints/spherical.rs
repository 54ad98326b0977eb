//! Spherical joint: one orthogonal tripod.
//!
//! The centre `at` on the first body, three points of the second at the distance `arm` along the world's x, y and z
//! at the initial pose. Its translational stiffness at the centre is k·I, as that of one bushing there.

use dbd_kernel::Vec3;

use crate::assembly::{Assembly, Points};
use crate::closure::{Place, Turn};
use crate::error::SceneError;
use crate::hinge::Hinge;
use crate::joints::kind::{Joint, JointType, Realisation};
use crate::joints::realisation;
use crate::text::{Number, Table};

pub(super) const TYPE: JointType = JointType {
    name: "spherical",
    holds: 3,
    brings: 0,
    keys: &["arm", "clearance", "realisation"],
    asks: (Place::Point, Turn::Free),
    expand,
};

fn expand(
    table: &Table<'_>,
    joint: &Joint,
    assembly: &mut Assembly,
) -> Result<Vec<Hinge>, SceneError> {
    let pair = &joint.pair;
    if joint.realisation == Realisation::Bushing {
        let arm = table.optional("arm", Number::positive("m"))?.unwrap_or(0.0);
        let [centres, tips] = realisation::ends(joint, [joint.at_w], assembly);
        let points = Points { centres: &centres, tips: &tips, shared: false };
        let added = assembly.add_bushings(pair, points, arm, joint.spring);
        return added.map(|()| Vec::new()).map_err(|defect| defect.refuse(table));
    }
    let arm = table.required("arm", Number::positive("m"))?;
    let centre = assembly.point_in(pair.a, joint.at_w);
    let axes = [Vec3::new(arm, 0.0, 0.0), Vec3::new(0.0, arm, 0.0), Vec3::new(0.0, 0.0, arm)];
    let tips = axes.map(|axis| assembly.point_in(pair.b, joint.at_w + axis));
    let points = Points { centres: &[centre], tips: &tips, shared: false };
    assembly.add_tsdas(pair, points, arm, joint.spring).map_err(|defect| defect.refuse(table))?;
    Ok(Vec::new())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::example;

    #[test]
    fn the_tripod_stands_along_the_world_axes_at_free_length() {
        let scene = example::with(
            "[[joint]]\nname = \"s\"\ntype = \"spherical\"\nbetween = [\"arm\", \"hand\"]\n\
             at = [0.5, 0.2, -0.1]\nstiffness = 1e5\narm = 0.03",
        );
        let joint = &scene.joints[0];
        assert_eq!((joint.kind, joint.holds, joint.tsdas), ("spherical", 3, 3));
        assert_eq!(joint.between, ["arm", "hand"]);
        assert!(joint.assembly_error < 1e-15, "{:e}", joint.assembly_error);
        let world = |row: usize, point: Vec3<f64>| {
            let state = &scene.model.initial[row];
            state.position + state.orientation.rotation().to_world(point)
        };
        let points = &scene.model.points;
        let centre = world(0, points[0]);
        for (axis, point) in points[1..].iter().enumerate() {
            let mut expected = [0.0; 3];
            expected[axis] = 0.03;
            let gap = world(1, *point) - centre - Vec3::from_f64(expected);
            assert!(libm::sqrt(gap.dot(gap)) < 1e-15, "{axis}: {gap:?}");
        }
        assert_eq!(scene.model.tsdas[0].free_length, 0.03);
    }
}
