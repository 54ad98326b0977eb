//! Universal joints without a spider.
//!
//! `(group, ends) => record`. The force at the points, then the torque of the lean.

use crate::elements::universal::Lean;
use crate::forces::record::{Dampers, Record};
use crate::geometry::Geometry;
use crate::model::{Group, ModelRef, Terms};
use crate::pose::End;
use crate::space::{Linear as _, Vector as _};

/// A universal joint.
#[inline(always)]
pub(super) fn universal<P: Geometry, T: Terms, D: Dampers>(
    model: &ModelRef<'_, P, T>,
    group: &Group,
    end_a: &End<'_, P>,
    end_b: &End<'_, P>,
) -> Record<P::Space> {
    let first = group.point as usize;
    let (Some(a), Some(b), Some(universal)) = (
        model.points.get(first),
        model.points.get(first + 1),
        model.universals.get(group.element as usize),
    ) else {
        return Record::ZERO;
    };
    let ((a, arm_a), (b, arm_b)) = (end_a.place(a), end_b.place(b));
    let d = P::displacement(&a, &b);
    let lean: Lean<P::Space> =
        Lean::new(end_a.to_world(universal.lever), end_b.to_world(universal.axis));
    let damper = match group.damper.row() {
        Some(row) if D::ACT && T::DAMPERS => model.dampers.get(row),
        _ => None,
    };
    let (mut force, mut size) = (d * universal.stiffness, lean.by * universal.stiffness);
    if let Some(&damping) = damper {
        let v_rel = end_b.point_velocity(arm_b) - end_a.point_velocity(arm_a);
        force = force + v_rel * damping;
        size = size + lean.gradient.dot(end_b.spin - end_a.spin) * damping;
    }
    let torque = lean.gradient * size;
    let torque_b = -(arm_b.cross(force) + torque);
    Record { force, torque_a: arm_a.cross(force) + torque, torque_b }
}
