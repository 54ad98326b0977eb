//! Revolute joints of bushings.
//!
//! `(group, ends) => record`. The force at the point of the second body, then the torque of the axes.

use crate::elements::revolute::Revolute;
use crate::forces::record::{Dampers, Record};
use crate::geometry::Geometry;
use crate::model::{Group, ModelRef, Terms};
use crate::pose::End;

/// A revolute joint. Two bodies, or the ground and a body, go a straight line: none asks whose a point is.
#[inline(always)]
pub(super) fn revolute<P: Geometry, T: Terms, D: Dampers>(
    model: &ModelRef<'_, P, T>,
    group: &Group,
    end_a: &End<'_, P>,
    end_b: &End<'_, P>,
) -> Option<Record<P::Space>> {
    let first = group.point as usize;
    let points = model.points.get(first..first + 2)?.first_chunk()?;
    let revolute = model.revolutes.get(group.element as usize)?;
    let damping = match group.damper.row() {
        Some(row) if D::ACT && T::DAMPERS => model.dampers.get(row),
        _ => None,
    };
    Some(match (end_a.body(), end_b.body()) {
        (Some(a), Some(b)) => between(points, revolute, damping, &a, &b),
        (None, Some(b)) => between(points, revolute, damping, &end_a.ground(), &b),
        (Some(a), None) => between(points, revolute, damping, &a, &end_b.ground()),
        (None, None) => return None,
    })
}

#[inline(always)]
fn between<P: Geometry>(
    [a, b]: &[P::Local; 2],
    revolute: &Revolute<P::Space>,
    damping: Option<&P::Real>,
    end_a: &End<'_, P>,
    end_b: &End<'_, P>,
) -> Record<P::Space> {
    let ((a, arm_a), (b, arm_b)) = (end_a.place(a), end_b.place(b));
    let d = P::displacement(&a, &b);
    let arm_a = end_a.arm_at(arm_a, d);
    let [lever_a, lever_b] = revolute.levers;
    let levers = [end_a.to_world(lever_a), end_b.to_world(lever_b)];
    let torque = revolute.torque(levers);
    let (force, torque) = match damping {
        Some(&damping) => {
            let v_rel = end_b.point_velocity(arm_b) - end_a.point_velocity(arm_a);
            let damped = revolute.damping_torque(damping, end_b.spin - end_a.spin, levers[0]);
            (revolute.damped_force(damping, d, v_rel, levers[0]), torque + damped)
        }
        None => (revolute.force(d, levers[0]), torque),
    };
    let (torque_a, torque_b) = (end_a.moment(arm_a, force), end_b.moment(arm_b, force));
    Record { force, torque_a: torque_a + torque, torque_b: torque_b + torque }
}
