//! Cylindrical joint: four points of the second body projected on a line of the first (Franco &
//! Degani 2026, Fig. 7).
//!
//! The line runs through `at` along the axis; its defining points lie at ±span/2. At each end two points of the
//! second body are at the distance `offset` from the line, along the reference and along axis × reference, the end at
//! −span/2 first. Rotation and translation keep this distance.

use crate::assembly::{Assembly, Lines, Points};
use crate::closure::{Place, Turn};
use crate::error::SceneError;
use crate::hinge::Hinge;
use crate::joints::kind::{Joint, JointType};
use crate::text::{Number, Table};

pub(super) const TYPE: JointType = JointType {
    name: "cylindrical",
    holds: 4,
    brings: 0,
    keys: &[
        "axis",
        "reference",
        "span",
        "offset",
        "turn_limits",
        "turn_rotor",
        "slide_rotor",
        "turn_friction",
        "slide_limits",
        "slide_friction",
    ],
    asks: (Place::Line, Turn::Axis),
    expand,
};

fn expand(
    table: &Table<'_>,
    joint: &Joint,
    assembly: &mut Assembly,
) -> Result<Vec<Hinge>, SceneError> {
    let triad = joint.triad(table)?;
    let span = table.required("span", Number::positive("m"))?;
    let offset = table.required("offset", Number::positive("m"))?;
    let ends = [-0.5 * span, 0.5 * span].map(|s| joint.at_w + triad.axis * s);
    let centres = ends.map(|end| assembly.point_in(joint.pair.a, end));
    let tips = ends
        .map(|end| [triad.e1, triad.e2].map(|e| assembly.point_in(joint.pair.b, end + e * offset)));
    let points = Points { centres: &centres, tips: tips.as_flattened(), shared: false };
    let lines =
        Lines { direction: assembly.vector_in(joint.pair.a, triad.axis), free_length: offset };
    assembly
        .add_lines(&joint.pair, points, lines, joint.spring)
        .map_err(|defect| defect.refuse(table))?;
    Ok(vec![assembly.hinge(&joint.pair, triad.axis)])
}

#[cfg(test)]
mod tests {
    use dbd_kernel::Vec3;

    use crate::example;

    #[test]
    fn the_line_is_the_first_bodys_and_the_points_the_seconds() {
        let scene = example::with(
            "[[joint]]\nname = \"c\"\ntype = \"cylindrical\"\nbetween = [\"arm\", \"world\"]\n\
             at = [1, 2, 3]\naxis = [0, 0, -7]\nstiffness = 1e5\nspan = 2\noffset = 0.25",
        );
        let joint = &scene.joints[0];
        assert_eq!((joint.kind, joint.holds, joint.tsdas), ("cylindrical", 4, 4));
        assert!(joint.assembly_error < 1e-15);
        let model = &scene.model;
        let group = model.groups[0];
        assert_eq!((group.triples, group.arms, group.shared), (2, 2, false));
        // The points belong to the world; the reference is x, so axis × reference is −y.
        for (point, expected) in model.points[2..].iter().zip([
            [1.25, 2.0, 4.0],
            [1.0, 1.75, 4.0],
            [1.25, 2.0, 2.0],
            [1.0, 1.75, 2.0],
        ]) {
            assert_eq!(*point, Vec3::from_f64(expected));
        }
        let rotation = model.initial[0].orientation.rotation();
        let gap = rotation.to_world(model.lines[3].direction) - Vec3::new(0.0, 0.0, -1.0);
        assert!(libm::sqrt(gap.dot(gap)) < 1e-15);
    }
}
