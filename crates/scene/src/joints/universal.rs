//! Universal joint: a spider between two revolutes (Franco & Degani 2026, section 2.4.2).
//!
//! The spider is a body `JOINT.spider` at `at` with the axes (a1, a2, a1 × a2), moving with the first body or, where
//! [assemble] sets velocities, with both. A revolute about a1 joins it to the first body, one about a2 to the second.
//! a2 is made normal to a1 to the last bit. As a bushing it has no spider: springs connect a point of its two bodies
//! and keep their axes perpendicular.

use dbd_kernel::{BodyState, Vec3};

use crate::assembly::Assembly;
use crate::body::mass_and_inertia;
use crate::closure::{Place, Turn};
use crate::direction::normals;
use crate::error::SceneError;
use crate::hinge::Hinge;
use crate::joints::kind::{Joint, JointType, Realisation};
use crate::joints::revolute::{self, Size};
use crate::joints::triad;
use crate::orientation::of_axes;
use crate::pair::Pair;
use crate::points::Heading;
use crate::text::{Kind, Number, Numbers, Table, Value};

pub(super) const TYPE: JointType = JointType {
    name: "universal",
    holds: 10,
    brings: 6,
    keys: &["axes", "spider", "reference", "span", "ring", "realisation"],
    asks: (Place::Point, Turn::Across),
    expand,
};

/// Largest cosine of the angle between axes that count as orthogonal.
const ORTHOGONAL: f64 = 1e-6;

fn expand(
    table: &Table<'_>,
    joint: &Joint,
    assembly: &mut Assembly,
) -> Result<Vec<Hinge>, SceneError> {
    let axes = orthogonal(table, joint.axes)?;
    let [a1, a2, _] = axes;
    let triads =
        [triad::about(table, a1, joint.reference)?, triad::about(table, a2, joint.reference)?];
    let size = Size::read(table)?;
    if joint.realisation == Realisation::Bushing {
        return bushing(table, joint, axes, size, assembly);
    }
    let (body, spin) = table.required("spider", Spider)?;

    let name = format!("{}.spider", joint.name);
    if assembly.body(&name).is_some() {
        let problem = format!("creates a body `{name}`, which already exists");
        let help = "the spider is named after its joint; rename the joint or the body";
        return Err(table.refuse_key("spider", &problem, help));
    }
    let Pair { a, b, names } = joint.pair.clone();
    let (velocity, mut spin_w) = assembly.motion(a, joint.at_w);
    if assembly.is_assembled() {
        // Velocities agree with the joints: the relative rotation about the first axis is that of the spider.
        let (_, other_w) = assembly.motion(b, joint.at_w);
        spin_w = spin_w + a1 * a1.dot(other_w - spin_w);
    }
    let orientation = of_axes(axes);
    let rotation = dbd_kernel::Quaternion::from_f64(orientation).rotation();
    let turning = match &spin {
        Some(spin) => *spin,
        None => rotation.to_body(spin_w).to_f64(),
    };
    let state = BodyState::from_f64(joint.at_w.to_f64(), orientation, velocity.to_f64(), turning);
    let [first, second] = names;
    let spider = assembly.add_body(&name, body, state).map_err(|defect| defect.refuse(table))?;
    let pairs = [
        Pair { a, b: spider, names: [first, name.clone()] },
        Pair { a: spider, b, names: [name, second] },
    ];
    for (pair, triad) in pairs.iter().zip(triads) {
        revolute::add(pair, joint, triad, size, assembly).map_err(|defect| defect.refuse(table))?;
    }
    let hinges = pairs.iter().zip(triads).map(|(pair, triad)| assembly.hinge(pair, triad.axis));
    Ok(hinges.collect())
}

/// Adds the joint without a spider: a point bushing with half the stiffness of a revolute joint, and the same
/// stiffness at half a span that keeps the axes perpendicular.
fn bushing(
    table: &Table<'_>,
    joint: &Joint,
    [a1, a2, _]: [Vec3<f64>; 3],
    size: Size,
    assembly: &mut Assembly,
) -> Result<Vec<Hinge>, SceneError> {
    // A bushing does not use it; it is read only to report errors.
    let spider = table.optional("spider", Spider)?;
    if !size.is_isotropic() {
        let problem = "leads to a stiffness that a bushing cannot represent";
        let help = "remove `ring`, which is then span/√2 for equal stiffness in every direction, or use \
                    `realisation = \"tsda\"` for this joint";
        return Err(table.refuse_value("ring", problem, help));
    }
    let Pair { a, b, .. } = joint.pair;
    let lever = assembly.vector_in(a, a1) * size.half();
    let axis = assembly.vector_in(b, a2);
    assembly
        .add_universal(&joint.pair, joint.at_w, [lever, axis], size.length(), joint.spring)
        .map_err(|defect| defect.refuse(table))?;
    if let Some((body, _)) = spider {
        assembly.leave_out(body.mass);
    }
    // The second axis belongs to the second body, so the angle about it is that of the first body, reversed.
    Ok(vec![assembly.hinge(&joint.pair, a1), assembly.hinge(&joint.pair.reversed(), -a2)])
}

/// Two orthogonal axes and the one normal to both.
fn orthogonal(table: &Table<'_>, [a1, a2]: [Vec3<f64>; 2]) -> Result<[Vec3<f64>; 3], SceneError> {
    let cosine = a1.dot(a2);
    match normals(a1, a2) {
        Some([a2, a3]) if cosine.abs() <= ORTHOGONAL => Ok([a1, a2, a3]),
        _ => {
            let angle = libm::acos(cosine.clamp(-1.0, 1.0)).to_degrees();
            let problem = format!("are {angle:.6} degrees apart");
            let help = "the axes of a universal joint are orthogonal within 1e-6; two \
                        revolutes and a body between them join axes at another angle";
            Err(table.refuse_value("axes", &problem, help))
        }
    }
}

/// Two directions, the first of the first body, the second of the second.
#[derive(Clone, Copy)]
pub(super) struct Axes<'a>(pub(super) &'a Assembly);

impl Kind for Axes<'_> {
    type Output = [Vec3<f64>; 2];

    fn expected(&self) -> String {
        "two orthogonal directions in world axes, [[x, y, z], [x, y, z]]".into()
    }

    fn read(&self, value: &Value<'_>) -> Result<[Vec3<f64>; 2], SceneError> {
        let entries = value.entries(2, || self.expected())?;
        Ok([Heading(self.0).read(&entries[0])?, Heading(self.0).read(&entries[1])?])
    }
}

/// The keys of `spider`.
pub(super) const SPIDER: &[&str] = &["mass", "inertia", "angular_velocity"];

/// The spider's mass and inertia, and \[rad/s\] its angular velocity about its own axes, if given.
struct Spider;

impl Kind for Spider {
    type Output = (dbd_kernel::Body<f64>, Option<[f64; 3]>);

    fn expected(&self) -> String {
        "{ mass = kg, inertia = [Ix, Iy, Iz] } of the body between the two axes".into()
    }

    fn read(&self, value: &Value<'_>) -> Result<Self::Output, SceneError> {
        let table = value.table(&self.expected())?;
        table.only(&[SPIDER])?;
        let spin = table.optional("angular_velocity", Numbers(Number::any("rad/s")))?;
        Ok((mass_and_inertia(&table)?, spin))
    }
}

#[cfg(test)]
mod tests {
    use dbd_kernel::{BodyIndex, F64, Geometry, Vec3};

    use crate::example;

    /// The spider comes after the scene's bodies, turned to the axes, and moves as the point of
    /// the first body does; a load may name it.
    #[test]
    fn the_spider_stands_at_the_axes_and_moves_with_the_first_body() {
        let joint = |name: &str, between: &str| {
            format!(
                "[[joint]]\nname = \"{name}\"\ntype = \"universal\"\nbetween = {between}\n\
                 at = [1.5, 0.5, 0]\naxes = [[0, 0, 2], [1, 1, 1e-7]]\nstiffness = 1e5\nspan = 0.1\n\
                 spider = {{ mass = 0.2, inertia = [1e-3, 1e-3, 2e-3] }}\n"
            )
        };
        let scene = example::with(&format!(
            "{}{}[[load]]\nbody = \"knee.spider\"\nforce = [1, 0, 0]",
            joint("knee", "[\"hand\", \"arm\"]"),
            joint("hip", "[\"world\", \"arm\"]"),
        ));
        assert_eq!(scene.body_names, ["arm", "hand", "knee.spider", "hip.spider"]);
        let knee = &scene.joints[0];
        assert_eq!((knee.kind, knee.holds, knee.tsdas), ("universal", 10, 12));
        assert_eq!((knee.spider.as_deref(), knee.groups.clone()), (Some("knee.spider"), 0..2));
        assert_eq!(
            (scene.joints[1].spider.as_deref(), scene.joints[1].groups.clone()),
            (Some("hip.spider"), 2..4)
        );
        let model = &scene.model;
        let bodies: Vec<_> = model.groups.iter().map(|group| (group.a, group.b)).collect();
        let [arm, hand, knee, hip] = [0, 1, 2, 3].map(BodyIndex);
        let world = BodyIndex::WORLD;
        assert_eq!(bodies, [(hand, knee), (knee, arm), (world, hip), (hip, arm)]);
        assert_eq!(model.loads[0].body, knee);

        let near = |v: Vec3<f64>, expected: [f64; 3]| {
            let gap = v - Vec3::from_f64(expected);
            assert!(libm::sqrt(gap.dot(gap)) < 1e-14, "{v:?} {expected:?}");
        };
        let spider = &model.initial[2];
        near(spider.position, [1.5, 0.5, 0.0]);
        let half = core::f64::consts::FRAC_1_SQRT_2;
        let rotation = spider.orientation.rotation();
        let [x, y, z] = Vec3::axes().map(|axis| rotation.to_world(axis));
        near(x, [0.0, 0.0, 1.0]);
        near(y, [half, half, 0.0]);
        near(z, [-half, half, 0.0]);
        // The hand is at (1, 0, 0); its angular velocity of 3 rad/s is about its own z.
        let body = &model.initial[1];
        let frame = F64::frame(&body.position, &body.orientation);
        let spin = F64::to_world(&frame, Vec3::new(0.0, 0.0, 3.0));
        near(spider.velocity, spin.cross(Vec3::new(0.5, 0.5, 0.0)).to_f64());
        near(rotation.to_world(spider.angular_velocity), spin.to_f64());
        let resting = &model.initial[3];
        assert_eq!((resting.velocity, resting.angular_velocity), (Vec3::ZERO, Vec3::ZERO));
    }
}
