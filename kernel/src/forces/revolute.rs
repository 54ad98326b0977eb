//! Revolute joints of bushings.
//!
//! `(group, ends) => record`. The force at the point of the second body, then the torque of the axes.

use crate::forces::record::{Dampers, Record};
use crate::geometry::Geometry;
use crate::model::{Group, ModelRef, Terms};
use crate::pose::End;
use crate::space::Vector as _;

/// A revolute joint.
#[inline(always)]
pub(super) fn revolute<P: Geometry, T: Terms, D: Dampers>(
    model: &ModelRef<'_, P, T>,
    group: &Group,
    end_a: &End<'_, P>,
    end_b: &End<'_, P>,
) -> Record<P::Space> {
    let first = group.point as usize;
    let (Some([a, b]), Some(revolute)) = (
        model.points.get(first..first + 2).and_then(<[_]>::first_chunk::<2>),
        model.revolutes.get(group.element as usize),
    ) else {
        return Record::ZERO;
    };
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
    let torque_b = -(arm_b.cross(force) + torque);
    Record { force, torque_a: arm_a.cross(force) + torque, torque_b }
}
