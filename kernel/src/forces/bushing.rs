//! A point bushing.
//!
//! `(group, ends) => record`.

use crate::forces::record::{Dampers, Record};
use crate::geometry::Geometry;
use crate::model::{Group, ModelRef, Terms};
use crate::pose::End;
use crate::space::Vector as _;

/// A point bushing.
#[inline(always)]
pub(super) fn bushing<P: Geometry, T: Terms, D: Dampers>(
    model: &ModelRef<'_, P, T>,
    group: &Group,
    end_a: &End<'_, P>,
    end_b: &End<'_, P>,
) -> Record<P::Space> {
    let first = group.point as usize;
    let (Some(a), Some(b), Some(bushing)) = (
        model.points.get(first),
        model.points.get(first + 1),
        model.bushings.get(group.element as usize),
    ) else {
        return Record::ZERO;
    };
    let ((a, arm_a), (b, arm_b)) = (end_a.place(a), end_b.place(b));
    let d = P::displacement(&a, &b);
    let damper = match group.damper.row() {
        Some(row) if D::ACT && T::DAMPERS => model.dampers.get(row),
        _ => None,
    };
    let force = match damper {
        Some(&damping) => {
            let v_rel = end_b.point_velocity(arm_b) - end_a.point_velocity(arm_a);
            bushing.damped_force(damping, d, v_rel)
        }
        None => bushing.force(d),
    };
    Record { force, torque_a: arm_a.cross(force), torque_b: -arm_b.cross(force) }
}
