//! Fixed joint: three orthogonal tripods, nine TSDAs.
//!
//! The centres lie on the first body, at −span/2 and +span/2 on the axis and at span/2 along the reference, three
//! points that are not collinear. Each is connected to three points of the second body at the distance `arm` along
//! the reference, axis × reference and the axis, or by a bushing to the coincident point.

use crate::assembly::{Assembly, Points};
use crate::closure::{Place, Turn};
use crate::error::SceneError;
use crate::hinge::Hinge;
use crate::joints::kind::{Joint, JointType, Realisation};
use crate::joints::realisation;
use crate::joints::triad::Triad;
use crate::text::{Number, Table};

pub(super) const TYPE: JointType = JointType {
    name: "fixed",
    holds: 6,
    brings: 0,
    keys: &["axis", "reference", "span", "arm", "realisation"],
    asks: (Place::Point, Turn::All),
    expand,
};

fn expand(
    table: &Table<'_>,
    joint: &Joint,
    assembly: &mut Assembly,
) -> Result<Vec<Hinge>, SceneError> {
    let Triad { e1, e2, axis } = joint.triad(table)?;
    let half = 0.5 * table.required("span", Number::positive("m"))?;
    let places = [axis * -half, axis * half, e1 * half].map(|place| joint.at_w + place);
    if joint.realisation == Realisation::Bushing {
        let arm = table.optional("arm", Number::positive("m"))?.unwrap_or(2.0 * half);
        let [centres, tips] = realisation::ends(joint, places, assembly);
        let points = Points { centres: &centres, tips: &tips, shared: false };
        let added = assembly.add_bushings(&joint.pair, points, arm, joint.spring);
        return added.map(|()| Vec::new()).map_err(|defect| defect.refuse(table));
    }
    let arm = table.required("arm", Number::positive("m"))?;
    let centres = places.map(|place| assembly.point_in(joint.pair.a, place));
    let tips = places
        .map(|place| [e1, e2, axis].map(|e| assembly.point_in(joint.pair.b, place + e * arm)));
    let points = Points { centres: &centres, tips: tips.as_flattened(), shared: false };
    assembly
        .add_tsdas(&joint.pair, points, arm, joint.spring)
        .map_err(|defect| defect.refuse(table))?;
    Ok(Vec::new())
}

#[cfg(test)]
mod tests {
    use dbd_kernel::Vec3;

    use crate::example;

    #[test]
    fn three_tripods_stand_along_the_joints_axes() {
        let scene = example::with(
            "[[joint]]\nname = \"f\"\ntype = \"fixed\"\nbetween = [\"hand\", \"world\"]\n\
             at = [1, 2, 3]\naxis = [0, 1, 0]\nstiffness = 1e5\nspan = 1\narm = 0.25",
        );
        let joint = &scene.joints[0];
        assert_eq!((joint.kind, joint.holds, joint.tsdas), ("fixed", 6, 9));
        assert!(joint.assembly_error < 1e-15);
        let model = &scene.model;
        let group = model.groups[0];
        assert_eq!((group.triples, group.arms, group.shared), (3, 3, false));
        // The reference is x, so axis × reference is −z.
        let places = [[1.0, 1.5, 3.0], [1.0, 2.5, 3.0], [1.5, 2.0, 3.0]].map(Vec3::from_f64);
        let arms = [[0.25, 0.0, 0.0], [0.0, 0.0, -0.25], [0.0, 0.25, 0.0]].map(Vec3::from_f64);
        for (tips, place) in model.points[3..].chunks(3).zip(places) {
            for (tip, arm) in tips.iter().zip(arms) {
                assert_eq!(*tip, place + arm);
            }
        }
    }
}
