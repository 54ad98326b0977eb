//! Torsion springs, loads and inputs in a plane.
//!
//! `scene, plane => the same in the plane, what leaves it`.

use dbd_kernel::attitude::Attitude as _;
use dbd_kernel::elements::input::{Input, InputKind};
use dbd_kernel::index::DamperIndex;
use dbd_kernel::{BodyIndex, F64, Load, LoadFrame, Quaternion, TorsionSpring, Vec3};

use crate::planar::{ALIKE, Plane, short};
use crate::reduction::departure::{Leaves, Part};
use crate::runtime::SceneModel;
use crate::scene::Scene;

/// Adds torsion springs, loads, inputs and their tables.
pub(super) fn read(
    scene: &Scene,
    plane: &Plane,
    near: f64,
    model: &mut SceneModel<F64>,
    leaves: &mut Leaves<'_>,
) {
    torsion_springs(scene, plane, model, leaves);
    for (row, load) in scene.model.loads.iter().enumerate() {
        let turn = |v: Vec3<f64>| within(plane, load.body, load.frame, v);
        let (force, torque) = (turn(load.force), turn(load.torque));
        let part = Part::Load(row);
        if force.z.abs() > ALIKE * length(force) {
            leaves(part, "force", &format!(": {} N along its normal", short(force.z)));
        }
        let beside = libm::hypot(torque.x, torque.y);
        if beside > ALIKE * length(torque) {
            let by = format!(": {} N·m about an axis that lies in it", short(beside));
            leaves(part, "torque", &by);
        }
        let (force, torque) = (flat(force), Vec3::new(0.0, 0.0, torque.z));
        model.loads.push(Load { force, torque, ..*load });
    }
    for (row, input) in scene.model.inputs.iter().enumerate() {
        let kind = kind(plane, near, input.kind, &mut |key, by| {
            leaves(Part::Input(row), key, by);
        });
        model.inputs.push(Input { kind, ..*input });
    }
    model.knots.clone_from(&scene.model.knots);
}

fn torsion_springs(
    scene: &Scene,
    plane: &Plane,
    model: &mut SceneModel<F64>,
    leaves: &mut Leaves<'_>,
) {
    for (row, spring) in scene.model.torsions.iter().enumerate() {
        let axis = plane.of_body_inward(spring.a.row(), spring.axis);
        if let Some(axis_error) = axis_error(axis) {
            let by =
                format!(": its axis is tilted by {} degrees from the normal", short(axis_error));
            leaves(Part::TorsionSpring(row), "axis", &by);
        }
        let orientation =
            |body: BodyIndex| model.initial.get(body.row()).map(|state| &state.orientation);
        let relative = Quaternion::relative(orientation(spring.a), orientation(spring.b));
        let damping = spring.damper.row().and_then(|row| scene.model.dampers.get(row));
        let damper = match damping {
            Some(damping) => {
                model.dampers.push(*damping);
                DamperIndex((model.dampers.len() - 1) as u16)
            }
            None => spring.damper,
        };
        let axis = Vec3::new(0.0, 0.0, if axis.z < 0.0 { -1.0 } else { 1.0 });
        let reference = relative.conjugate();
        model.torsions.push(TorsionSpring { axis, reference, damper, ..*spring });
    }
}

/// The input in the plane; `leaves` receives the key and the amount by which it leaves the plane.
fn kind(
    plane: &Plane,
    near: f64,
    kind: InputKind<F64>,
    leaves: &mut dyn FnMut(&'static str, &str),
) -> InputKind<F64> {
    let mut in_plane = |direction: Vec3<f64>| {
        if direction.z.abs() > ALIKE {
            let axis_error = libm::asin(direction.z.abs().min(1.0)).to_degrees();
            leaves("axis", &format!(": its axis is tilted by {} degrees", short(axis_error)));
        }
        flat(direction)
    };
    match kind {
        InputKind::Force { body, point, direction, frame } => {
            let direction = in_plane(within(plane, body, frame, direction));
            let point = plane.point_inward(body.row(), point);
            if point.z.abs() > near {
                leaves("point", &format!(" by {} m", short(point.z)));
            }
            InputKind::Force { body, point: flat(point), direction, frame }
        }
        InputKind::Torque { body, axis, frame } => {
            let axis = normal(within(plane, body, frame, axis), leaves);
            InputKind::Torque { body, axis, frame }
        }
        InputKind::JointTorque { a, b, axes } => {
            let axis = normal(plane.of_body_inward(a.row(), axes[0]), leaves);
            InputKind::JointTorque { a, b, axes: [axis; 2] }
        }
        InputKind::JointForce { a, b, point, axis } => {
            let axis = in_plane(plane.of_body_inward(a.row(), axis));
            let point = plane.point_inward(b.row(), point);
            if point.z.abs() > near {
                leaves("target", &format!(" by {} m", short(point.z)));
            }
            InputKind::JointForce { a, b, point: flat(point), axis }
        }
        InputKind::Actuator { .. } | InputKind::Signal => kind,
        InputKind::Gravity { direction } => {
            InputKind::Gravity { direction: in_plane(plane.inward(direction)) }
        }
        InputKind::Velocity { body, direction } => {
            InputKind::Velocity { body, direction: in_plane(plane.inward(direction)) }
        }
        InputKind::AngularVelocity { body, axis } => {
            InputKind::AngularVelocity { body, axis: normal(plane.inward(axis), leaves) }
        }
        InputKind::Anchor { direction } => {
            InputKind::Anchor { direction: in_plane(plane.inward(direction)) }
        }
    }
}

/// An axis that must be the normal.
fn normal(axis: Vec3<f64>, leaves: &mut dyn FnMut(&'static str, &str)) -> Vec3<f64> {
    if let Some(axis_error) = axis_error(axis) {
        leaves(
            "axis",
            &format!(": its axis is tilted by {} degrees from the normal", short(axis_error)),
        );
    }
    Vec3::new(0.0, 0.0, if axis.z < 0.0 { -1.0 } else { 1.0 })
}

/// \[degrees\] tilt of an axis against the normal, if any.
pub(super) fn axis_error(axis: Vec3<f64>) -> Option<f64> {
    let beside = libm::hypot(axis.x, axis.y);
    (beside > ALIKE).then(|| libm::atan2(beside, axis.z.abs()).to_degrees())
}

/// Converts a vector of the world or of a body to the plane's axes.
fn within(plane: &Plane, body: BodyIndex, frame: LoadFrame, v: Vec3<f64>) -> Vec3<f64> {
    match frame {
        LoadFrame::World => plane.inward(v),
        LoadFrame::Body => plane.of_body_inward(body.row(), v),
    }
}

fn flat(v: Vec3<f64>) -> Vec3<f64> {
    Vec3::new(v.x, v.y, 0.0)
}

fn length(v: Vec3<f64>) -> f64 {
    libm::sqrt(v.dot(v))
}
