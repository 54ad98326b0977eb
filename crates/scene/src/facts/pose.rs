//! The initial pose.
//!
//! `scene => frames of bodies, axes of joints`.

use dbd_kernel::model::Law;
use dbd_kernel::{F64, Geometry, Vec3};

use crate::direction::unit;
use crate::scene::Scene;

/// The bodies' frames at the initial pose.
pub(crate) fn frames(scene: &Scene) -> Vec<<F64 as Geometry>::Frame> {
    let states = scene.model.initial.iter();
    states.map(|state| F64::frame(&state.position, &state.orientation)).collect()
}

/// The axis of a joint at the initial pose, world: the line through a revolute's axis points, the direction of a
/// guide's lines. `group` belongs to the joint; other joints have no axis.
pub(crate) fn axis_w(scene: &Scene, group: usize) -> Option<Vec3<f64>> {
    let model = &scene.model;
    let group = model.groups.get(group)?;
    let axis = if group.law == Law::PointOnLine {
        model.lines.get(group.element as usize)?.direction
    } else if group.law == Law::Revolute {
        model.revolutes.get(group.element as usize)?.levers[0]
    } else if group.shared && group.triples == 2 {
        let first = group.point as usize;
        *model.points.get(first + 1)? - *model.points.get(first)?
    } else {
        return None;
    };
    let axis = match model.initial.get(group.a.row()) {
        Some(state) => state.orientation.rotation().to_world(axis),
        None => axis,
    };
    unit(axis)
}
