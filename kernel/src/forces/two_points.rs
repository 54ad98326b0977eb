//! Elements between a point of A and one of B.
//!
//! `(group, ends) => force_pair`. The loop from a group to its points is common to all of them; [`TwoPoints`] is the law.

use crate::forces::force_pair::{Dampers, ForcePair};
use crate::geometry::Geometry;
use crate::model::{Group, ModelRef, Terms};
use crate::pose::End;

/// A law between two points.
pub(super) trait TwoPoints<P: Geometry> {
    /// Its record, with `damping` where dampers act. Inlined, so that it is specialised for the ends.
    fn force_pair(
        &self,
        points: &[P::Local; 2],
        damping: Option<&P::Real>,
        end_a: &End<'_, P>,
        end_b: &End<'_, P>,
    ) -> ForcePair<P::Space>;
}

/// The record of a group of one of the model's `elements`. Two bodies, or the ground and a body, take the specialised
/// path: no point is tested for its owner.
#[inline(always)]
pub(super) fn two_points<P: Geometry, T: Terms<P>, D: Dampers, L: TwoPoints<P>>(
    model: &ModelRef<'_, P, T>,
    elements: &[L],
    group: &Group,
    end_a: &End<'_, P>,
    end_b: &End<'_, P>,
) -> Option<ForcePair<P::Space>> {
    let first = group.point as usize;
    let points = model.points.get(first..first + 2)?.first_chunk()?;
    let element = elements.get(group.element as usize)?;
    let damping = match group.damper.row() {
        Some(row) if D::ACT && T::DAMPERS => model.dampers.get(row),
        _ => None,
    };
    Some(match (end_a.body(), end_b.body()) {
        (Some(a), Some(b)) => element.force_pair(points, damping, &a, &b),
        (None, Some(b)) => element.force_pair(points, damping, &end_a.ground(), &b),
        (Some(a), None) => element.force_pair(points, damping, &a, &end_b.ground()),
        (None, None) => return None,
    })
}
