//! Revolute joints of bushings.
//!
//! `(group, ends) => record`. The force at the point of the second body, then the torque of the axes.

use crate::forces::record::{Dampers, Record};
use crate::geometry::Geometry;
use crate::model::{Group, ModelRef, Terms};
use crate::pose::End;

/// A revolute joint. Twice the same, as for stars: where an end is known to be a body or the ground,
/// none of its points asks.
#[inline(always)]
pub(super) fn revolute<P: Geometry, T: Terms, D: Dampers>(
    model: &ModelRef<'_, P, T>,
    group: &Group,
    end_a: &End<'_, P>,
    end_b: &End<'_, P>,
) -> Option<Record<P::Space>> {
    match (end_a.body(), end_b.body()) {
        (Some(a), Some(b)) => between::<P, T, D>(model, group, &a, &b),
        (None, Some(b)) => between::<P, T, D>(model, group, &end_a.ground(), &b),
        _ => between::<P, T, D>(model, group, end_a, end_b),
    }
}

/// Between two ends.
#[inline(always)]
fn between<P: Geometry, T: Terms, D: Dampers>(
    model: &ModelRef<'_, P, T>,
    group: &Group,
    end_a: &End<'_, P>,
    end_b: &End<'_, P>,
) -> Option<Record<P::Space>> {
    let first = group.point as usize;
    let [a, b] = model.points.get(first..first + 2)?.first_chunk::<2>()?;
    let revolute = model.revolutes.get(group.element as usize)?;
    let ((a, arm_a), (b, arm_b)) = (end_a.place(a), end_b.place(b));
    let d = P::displacement(&a, &b);
    let arm_a = end_a.arm_at(arm_a, d);
    let [lever_a, lever_b] = revolute.levers;
    let levers = [end_a.to_world(lever_a), end_b.to_world(lever_b)];
    let damper = match group.damper.row() {
        Some(row) if D::ACT && T::DAMPERS => model.dampers.get(row),
        _ => None,
    };
    let torque = revolute.torque(levers);
    let (force, torque) = match damper {
        Some(&damping) => {
            let v_rel = end_b.point_velocity(arm_b) - end_a.point_velocity(arm_a);
            let damped = revolute.damping_torque(damping, end_b.spin - end_a.spin, levers[0]);
            (revolute.damped_force(damping, d, v_rel, levers[0]), torque + damped)
        }
        None => (revolute.force(d, levers[0]), torque),
    };
    let (torque_a, torque_b) = (end_a.moment(arm_a, force), end_b.moment(arm_b, force));
    Some(Record { force, torque_a: torque_a + torque, torque_b: -(torque_b + torque) })
}
