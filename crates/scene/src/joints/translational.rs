//! Translational joint: eight points of the second body projected on two parallel lines of the
//! first (Franco & Degani 2026, Fig. 8).
//!
//! The lines run along the axis, `gauge` apart along the reference, with `at` half way between them; their defining
//! points lie at ±span/2. At each end of each line two points of the second body are at the distance `offset`, along
//! the reference and along axis × reference; with outward offsets the line at −gauge/2 has its first point along the
//! reference's opposite, so that the joint is its own mirror image. Order: the end at −span/2, there the line at
//! −gauge/2, first. The two lines prevent rotation about the axis.

use crate::assembly::{Assembly, Lines, Points};
use crate::closure::{Place, Turn};
use crate::error::SceneError;
use crate::hinge::Hinge;
use crate::joints::kind::{Joint, JointType};
use crate::text::{Choice, Number, Table};

pub(super) const TYPE: JointType = JointType {
    name: "translational",
    holds: 5,
    brings: 0,
    keys: &[
        "axis",
        "reference",
        "span",
        "gauge",
        "offset",
        "offsets",
        "limits",
        "friction",
        "rotor",
    ],
    asks: (Place::Line, Turn::All),
    expand,
};

fn expand(
    table: &Table<'_>,
    joint: &Joint,
    assembly: &mut Assembly,
) -> Result<Vec<Hinge>, SceneError> {
    let triad = joint.triad(table)?;
    let span = table.required("span", Number::positive("m"))?;
    let gauge = table.required("gauge", Number::positive("m"))?;
    let offset = table.required("offset", Number::positive("m"))?;
    let outward = table.optional("offsets", Choice(&["alike", "outward"]))? == Some(1);
    let ends = [-0.5 * span, 0.5 * span].map(|along| {
        let end = joint.at_w + triad.axis * along;
        [-0.5 * gauge, 0.5 * gauge].map(|across| end + triad.e1 * across)
    });
    let ends = ends.as_flattened();
    let centres: Vec<_> = ends.iter().map(|end| assembly.point_in(joint.pair.a, *end)).collect();
    let sides = [if outward { -triad.e1 } else { triad.e1 }, triad.e1];
    let tips: Vec<_> = ends
        .iter()
        .zip(sides.into_iter().cycle())
        .flat_map(|(end, side)| [side, triad.e2].map(|e| *end + e * offset))
        .map(|tip| assembly.point_in(joint.pair.b, tip))
        .collect();
    let points = Points { centres: &centres, tips: &tips, shared: false };
    let lines =
        Lines { direction: assembly.vector_in(joint.pair.a, triad.axis), free_length: offset };
    assembly
        .add_lines(&joint.pair, points, lines, joint.spring)
        .map_err(|defect| defect.refuse(table))?;
    Ok(Vec::new())
}

#[cfg(test)]
mod tests {
    use dbd_kernel::Vec3;

    use crate::example;

    #[test]
    fn lines_and_points_lie_as_their_definition_says() {
        let scene = example::with(
            "[[joint]]\nname = \"t\"\ntype = \"translational\"\nbetween = [\"world\", \"hand\"]\n\
             at = [1, 2, 3]\naxis = [5, 0, 0]\nreference = [1, 1, 0]\nstiffness = 1e5\nspan = 4\n\
             gauge = 2\noffset = 0.5",
        );
        let joint = &scene.joints[0];
        assert_eq!((joint.kind, joint.holds, joint.tsdas), ("translational", 5, 8));
        assert!(joint.assembly_error < 1e-15 && joint.spider.is_none());
        let model = &scene.model;
        let group = model.groups[0];
        assert_eq!((group.triples, group.arms, group.shared), (4, 2, false));
        let state = &model.initial[1];
        let world =
            |point: &Vec3<f64>| state.position + state.orientation.rotation().to_world(*point);
        let lines = [[-1.0, 1.0], [-1.0, 3.0], [3.0, 1.0], [3.0, 3.0]];
        for (i, [x, y]) in lines.into_iter().enumerate() {
            assert_eq!(model.points[i], Vec3::new(x, y, 3.0));
            for (tip, expected) in model.points[4 + 2 * i..][..2]
                .iter()
                .zip([Vec3::new(x, y + 0.5, 3.0), Vec3::new(x, y, 3.5)])
            {
                let gap = world(tip) - expected;
                assert!(libm::sqrt(gap.dot(gap)) < 1e-14, "{i}: {gap:?}");
            }
        }
        for line in &model.lines {
            assert_eq!((line.direction, line.free_length), (Vec3::new(1.0, 0.0, 0.0), 0.5));
        }
    }
}
