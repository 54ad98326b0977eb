//! What the initial velocities do to the joints.
//!
//! `scene => per joint the largest rate of a TSDA's length at t = 0`. A consistent state has none;
//! a scene need not have one, its joints then ring at their own frequencies.

use std::ops::Range;

use dbd_kernel::model::Group;
use dbd_kernel::{BodyIndex, BodyState, F64, Geometry, Vec3};
use dbd_scene::Scene;

use crate::joint_groups::joint_groups;

/// \[m/s\] per joint, in scene order.
#[must_use]
pub fn joint_rates(scene: &Scene) -> Vec<f64> {
    let rate_of_joint = |groups: Range<usize>| {
        let rates = scene.model.groups[groups].iter().map(|group| rate_of_group(scene, group));
        rates.fold(0.0, f64::max)
    };
    joint_groups(scene).into_iter().map(rate_of_joint).collect()
}

fn rate_of_group(scene: &Scene, group: &Group) -> f64 {
    let points = &scene.model.points[group.point as usize..];
    let (stars, arms) = (group.stars as usize, group.arms as usize);
    let mut largest = 0.0_f64;
    for i in 0..group.elements() {
        let tip = stars + if group.shared { i % arms } else { i };
        let (a, v_a) = point_and_velocity(scene, group.a, points[i / arms]);
        let (b, v_b) = point_and_velocity(scene, group.b, points[tip]);
        let d = b - a;
        let length = d.dot(d).sqrt();
        if length > 0.0 {
            largest = largest.max((d.dot(v_b - v_a) / length).abs());
        }
    }
    largest
}

/// A point of a body in the world, and its velocity `v + ω × r`.
fn point_and_velocity(scene: &Scene, body: BodyIndex, local: Vec3<f64>) -> (Vec3<f64>, Vec3<f64>) {
    let Some(BodyState { position, orientation, velocity, angular_velocity }) =
        scene.model.initial.get(body.row())
    else {
        return (local, Vec3::ZERO);
    };
    let frame = F64::frame(position, orientation);
    let (location, arm) = F64::place(&frame, &local);
    let spin = F64::to_world(&frame, *angular_velocity);
    (location, *velocity + spin.cross(arm))
}
