//! Axial bushings.
//!
//! `(group, ends) => record`. Star by star; force and torques act at the point of the second body.

use crate::forces::record::{Dampers, Record};
use crate::geometry::Geometry;
use crate::model::{Group, ModelRef, Terms};
use crate::pose::End;
use crate::space::Vector as _;

/// A group of axial bushings.
#[inline(always)]
pub(super) fn axial<P: Geometry, T: Terms, D: Dampers>(
    model: &ModelRef<'_, P, T>,
    group: &Group,
    end_a: &End<'_, P>,
    end_b: &End<'_, P>,
) -> Record<P::Space> {
    let mut record = Record::ZERO;
    let stars = group.stars as usize;
    let (Some(points), Some(bushings)) =
        (model.points.get(group.point as usize..), model.axials.get(group.element as usize..))
    else {
        return record;
    };
    let Some((centres, tips)) = points.split_at_checked(stars) else { return record };
    let dampers = match group.damper.row() {
        Some(row) if D::ACT && T::DAMPERS => model.dampers.get(row..).unwrap_or(&[]),
        _ => &[],
    };
    let mut dampers = dampers.iter();
    for ((a, b), bushing) in centres.iter().zip(tips).zip(bushings) {
        let ((a, arm_a), (b, arm_b)) = (end_a.place(a), end_b.place(b));
        let d = P::displacement(&a, &b);
        let arm_a = end_a.arm_at(arm_a, d);
        let axis = end_a.to_world(bushing.axis);
        let force = match dampers.next() {
            Some(&damping) => {
                let v_rel = end_b.point_velocity(arm_b) - end_a.point_velocity(arm_a);
                bushing.damped_force(damping, d, v_rel, axis)
            }
            None => bushing.force(d, axis),
        };
        record.force = record.force + force;
        record.torque_a = record.torque_a + arm_a.cross(force);
        record.torque_b = record.torque_b - arm_b.cross(force);
    }
    record
}
