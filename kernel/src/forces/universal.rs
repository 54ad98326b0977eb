//! Universal joints without a spider.
//!
//! `(group, ends) => record`. The force at the points, then the torque of the lean.

use crate::elements::universal::{Lean, Universal};
use crate::forces::record::{Dampers, Record};
use crate::geometry::Geometry;
use crate::model::{Group, ModelRef, Terms};
use crate::pose::End;
use crate::space::Linear as _;

/// A universal joint. Two bodies, or the ground and a body, go a straight line: none asks whose a point is.
#[inline(always)]
pub(super) fn universal<P: Geometry, T: Terms, D: Dampers>(
    model: &ModelRef<'_, P, T>,
    group: &Group,
    end_a: &End<'_, P>,
    end_b: &End<'_, P>,
) -> Option<Record<P::Space>> {
    let first = group.point as usize;
    let points = model.points.get(first..first + 2)?.first_chunk()?;
    let universal = model.universals.get(group.element as usize)?;
    let damping = match group.damper.row() {
        Some(row) if D::ACT && T::DAMPERS => model.dampers.get(row),
        _ => None,
    };
    Some(match (end_a.body(), end_b.body()) {
        (Some(a), Some(b)) => between(points, universal, damping, &a, &b),
        (None, Some(b)) => between(points, universal, damping, &end_a.ground(), &b),
        (Some(a), None) => between(points, universal, damping, &a, &end_b.ground()),
        (None, None) => return None,
    })
}

#[inline(always)]
fn between<P: Geometry>(
    [a, b]: &[P::Local; 2],
    universal: &Universal<P::Space>,
    damping: Option<&P::Real>,
    end_a: &End<'_, P>,
    end_b: &End<'_, P>,
) -> Record<P::Space> {
    let ((a, arm_a), (b, arm_b)) = (end_a.place(a), end_b.place(b));
    let d = P::displacement(&a, &b);
    let lean: Lean<P::Space> =
        Lean::new(end_a.to_world(universal.lever), end_b.to_world(universal.axis));
    let (mut force, mut size) = (d * universal.stiffness, lean.by * universal.stiffness);
    if let Some(&damping) = damping {
        let v_rel = end_b.point_velocity(arm_b) - end_a.point_velocity(arm_a);
        force = force + v_rel * damping;
        size = size + lean.gradient.dot(end_b.spin - end_a.spin) * damping;
    }
    let torque = lean.gradient * size;
    let (torque_a, torque_b) = (end_a.moment(arm_a, force), end_b.moment(arm_b, force));
    Record { force, torque_a: torque_a + torque, torque_b: torque_b + torque }
}
