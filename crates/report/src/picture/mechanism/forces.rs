//! Loads and inputs: where they act and in which direction.

use dbd_kernel::elements::input::InputKind;
use dbd_kernel::{BodyIndex, LoadFrame, Vec3};
use dbd_scene::Scene;

use super::attached::{Pivots, centres, row, tips};
use super::parts::{Along, ForceKind, ForceMark, Place, length};

/// The loads in scene order, then the inputs; two for a load with force and torque.
pub(super) fn forces(scene: &Scene, pivots: &Pivots) -> Vec<ForceMark> {
    let mut forces = Vec::new();
    for load in &scene.model.loads {
        let at = Place { body: row(load.body), point: [0.0; 3] };
        let body = (load.frame == LoadFrame::Body).then_some(at.body).flatten();
        for (kind, vector) in [(ForceKind::Force, load.force), (ForceKind::Torque, load.torque)] {
            let size = length(vector);
            if size > 0.0 && size.is_finite() {
                let direction = Along { body, vector: (vector * (1.0 / size)).to_f64() };
                let unit = if kind == ForceKind::Torque { "N·m" } else { "N" };
                forces.push(ForceMark { input: None, kind, unit, at, direction });
            }
        }
    }
    for (number, info) in scene.inputs.iter().enumerate() {
        let Some(input) = scene.model.inputs.get(usize::from(info.index.0)) else { continue };
        let mut add = |kind, at, body, vector: Vec3<f64>| {
            let direction = Along { body, vector: vector.to_f64() };
            let (input, unit) = (Some(info.name.clone()), info.unit);
            forces.push(ForceMark { input, kind, unit, at, direction });
        };
        match input.kind {
            InputKind::Force { body, point, direction, frame } => {
                let at = Place { body: row(body), point: point.to_f64() };
                let axes = if frame == LoadFrame::Body { at.body } else { None };
                add(ForceKind::Force, at, axes, direction);
            }
            InputKind::Torque { body, axis, frame } => {
                let at = Place { body: row(body), point: [0.0; 3] };
                let axes = if frame == LoadFrame::Body { at.body } else { None };
                add(ForceKind::Torque, at, axes, axis);
            }
            InputKind::JointTorque { a, b, axes: [axis, _] } => {
                let (first, second) = (row(a), row(b));
                let at = pivots.between(first, second);
                let at = at.unwrap_or(Place { body: second.or(first), point: [0.0; 3] });
                add(ForceKind::Torque, at, first, axis);
            }
            InputKind::JointForce { a, b, point, axis } => {
                let at = Place { body: row(b), point: point.to_f64() };
                add(ForceKind::Force, at, row(a), axis);
            }
            InputKind::Velocity { body, direction } => {
                let at = Place { body: row(body), point: [0.0; 3] };
                add(ForceKind::Shift, at, None, direction);
            }
            // The spring itself is marked; gravity and a rotation have no mark.
            InputKind::Actuator { .. }
            | InputKind::Gravity { .. }
            | InputKind::AngularVelocity { .. } => {}
            InputKind::Signal => {
                let mut laws = dbd_scene::interactions(scene).into_iter();
                let Some(drive) = laws.find(|law| law.name() == Some(&info.name)) else { continue };
                let [first, second] = drive.bodies.map(row);
                if let Some(axis) = drive.axis {
                    let at = pivots.between(first, second);
                    let at = at.unwrap_or(Place { body: second.or(first), point: [0.0; 3] });
                    add(ForceKind::Torque, at, first, Vec3::from_f64(axis));
                } else if let (Some([_, point]), Some(axis)) = (drive.points, drive.normal) {
                    let at = Place { body: second, point };
                    add(ForceKind::Force, at, first, Vec3::from_f64(axis));
                }
            }
            InputKind::Anchor { direction } => {
                let mut seen: Vec<Place> = Vec::new();
                for (group, point) in moved(scene, number) {
                    let point = pivots.of_group(group).unwrap_or(point);
                    let at = Place { body: None, point: point.to_f64() };
                    if !seen.contains(&at) {
                        seen.push(at);
                        add(ForceKind::Shift, at, None, direction);
                    }
                }
            }
        }
    }
    forces
}

/// The groups whose ground an input moves, each with the first of the points that it moves.
fn moved(scene: &Scene, input: usize) -> impl Iterator<Item = (usize, Vec3<f64>)> {
    let moves = move |body: BodyIndex| body.anchor_row() == Some(input);
    scene.model.groups.iter().enumerate().filter_map(move |(number, group)| {
        let points = match () {
            () if moves(group.a) => centres(scene, group),
            () if moves(group.b) => tips(scene, group),
            () => return None,
        };
        points.first().map(|point| (number, *point))
    })
}
