//! Bodies and gravity in a plane.
//!
//! `scene, plane => bodies that lie in z = 0, what leaves the plane`.

use dbd_kernel::{Body, F64, Vec3};

use crate::planar::{ALIKE, Axes, Plane, short};
use crate::reduction::departure::{Leaves, Part};
use crate::runtime::SceneModel;
use crate::scene::Scene;

/// \[m\] size of a model: the extent of its bodies and points.
pub(super) fn size(model: &SceneModel<F64>) -> f64 {
    let largest = |v: Vec3<f64>| v.to_f64().into_iter().map(f64::abs).fold(0.0, f64::max);
    let first = model.initial.first().map_or(Vec3::ZERO, |state| state.position);
    let spread = model.initial.iter().map(|state| largest(state.position - first));
    spread.chain(model.points.iter().map(|point| largest(*point))).fold(0.0, f64::max)
}

/// \[m\] position of the median body along a normal.
pub(super) fn height(model: &SceneModel<F64>, axes: &Axes, near: f64) -> f64 {
    let heights = model.initial.iter().map(|state| axes.inward(state.position).z);
    let mut heights: Vec<f64> = heights.collect();
    heights.sort_by(f64::total_cmp);
    let middle = heights.get(heights.len().saturating_sub(1) / 2).copied().unwrap_or(0.0);
    if middle.abs() <= near { 0.0 } else { middle }
}

/// Adds gravity and the bodies.
pub(super) fn read(
    scene: &Scene,
    plane: &mut Plane,
    near: f64,
    model: &mut SceneModel<F64>,
    leaves: &mut Leaves<'_>,
) {
    let own = &scene.model;
    for gravity in &own.gravity {
        let within = plane.inward(*gravity);
        if within.z.abs() > ALIKE * libm::sqrt(gravity.dot(*gravity)) {
            let by = format!(": {} m/s² along its normal", short(within.z));
            leaves(Part::Gravity, "gravity", &by);
        }
        model.gravity.push(Vec3::new(within.x, within.y, 0.0));
    }
    let length = |v: Vec3<f64>| libm::sqrt(v.dot(v));
    let fastest = own.initial.iter().map(|s| length(s.velocity)).fold(0.0, f64::max);
    let quickest = own.initial.iter().map(|s| length(s.angular_velocity)).fold(0.0, f64::max);
    for (row, (body, state)) in own.bodies.iter().zip(&own.initial).enumerate() {
        let part = Part::Body(row);
        let normal_b = state.orientation.rotation().to_body(plane.normal());
        let off = plane.place_inward(state.position).z;
        if off.abs() > near {
            leaves(part, "position", &format!(" by {} m", short(off)));
        }
        if let Some(axis_error) = axis_error(body, normal_b) {
            let by = format!(
                ": no principal axis is normal to it, the nearest is tilted by {} degrees",
                short(axis_error)
            );
            leaves(part, "orientation", &by);
        }
        let speed = plane.inward(state.velocity).z;
        if speed.abs() > ALIKE * fastest {
            leaves(part, "velocity", &format!(": {} m/s along its normal", short(speed)));
        }
        plane.add_body(normal_b);
        let spin = plane.of_body_inward(row, state.angular_velocity);
        let beside = libm::hypot(spin.x, spin.y);
        if beside > ALIKE * quickest {
            let by = format!(": {} rad/s about an axis that lies in it", short(beside));
            leaves(part, "angular_velocity", &by);
        }
        model.bodies.push(flat(body, plane, row));
        model.initial.push(plane.state_inward(row, state));
    }
}

/// \[degrees\] tilt of the nearest principal axis, where the normal is not one.
fn axis_error(body: &Body<f64>, normal_b: Vec3<f64>) -> Option<f64> {
    let moment = normal_b.scale(body.inertia);
    let across = moment.cross(normal_b);
    let whole = libm::sqrt(moment.dot(moment));
    if libm::sqrt(across.dot(across)) <= ALIKE * whole {
        return None;
    }
    let nearest = normal_b.to_f64().into_iter().map(f64::abs).fold(0.0, f64::max);
    Some(libm::acos(nearest.min(1.0)).to_degrees())
}

/// A body in the plane's axes: the moments about each.
fn flat(body: &Body<f64>, plane: &Plane, row: usize) -> Body<f64> {
    let moment = |axis: Vec3<f64>| {
        let axis = plane.of_body_outward(row, axis);
        body.inertia.dot(axis.scale(axis))
    };
    let flat = Body::from_f64(body.mass, Vec3::axes().map(moment));
    if body.is_driven() { flat.driven() } else { flat }
}
