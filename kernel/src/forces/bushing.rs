//! Point bushings.
//!
//! `(group, ends) => record`, star by star: a point of A and its own of B each.

use crate::forces::record::{Dampers, Record};
use crate::geometry::Geometry;
use crate::model::{Group, ModelRef, Terms};
use crate::pose::End;
use crate::space::Vector as _;

/// A group of point bushings.
#[inline(always)]
pub(super) fn bushings<P: Geometry, T: Terms, D: Dampers>(
    model: &ModelRef<'_, P, T>,
    group: &Group,
    end_a: &End<'_, P>,
    end_b: &End<'_, P>,
) -> Option<Record<P::Space>> {
    let stars = group.stars as usize;
    let (first, element) = (group.point as usize, group.element as usize);
    let (centres, tips) = model.points.get(first..first + 2 * stars)?.split_at_checked(stars)?;
    let bushings = model.bushings.get(element..element + stars)?;
    let mut dampers = match group.damper.row() {
        Some(row) if D::ACT && T::DAMPERS => model.dampers.get(row..).unwrap_or_default(),
        _ => &[],
    }
    .iter();
    let stars = centres.iter().zip(tips).zip(bushings);
    let records = stars.map(|((a, b), bushing)| {
        let ((a, arm_a), (b, arm_b)) = (end_a.place(a), end_b.place(b));
        let d = P::displacement(&a, &b);
        let force = match dampers.next() {
            Some(&damping) => {
                let v_rel = end_b.point_velocity(arm_b) - end_a.point_velocity(arm_a);
                bushing.damped_force(damping, d, v_rel)
            }
            None => bushing.force(d),
        };
        Record { force, torque_a: arm_a.cross(force), torque_b: -arm_b.cross(force) }
    });
    // The first is no sum: one star alone keeps the signs of its zeros.
    records.reduce(|sum, next| sum.with(&next))
}
