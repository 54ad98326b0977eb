//! Elements between a point of A and one of B.
//!
//! `(group, ends) => record`. The walk from a group to its points is one for all of them; what they do
//! there, a law says by [`TwoPoints`].

use crate::forces::record::{Dampers, Record};
use crate::geometry::Geometry;
use crate::model::{Group, ModelRef, Terms};
use crate::pose::End;

/// What a law does between two points.
pub(super) trait TwoPoints<P: Geometry> {
    /// Its record, with `damping` where dampers act. Inlined: what an end is known to be is known to it.
    fn record(
        &self,
        points: &[P::Local; 2],
        damping: Option<&P::Real>,
        end_a: &End<'_, P>,
        end_b: &End<'_, P>,
    ) -> Record<P::Space>;
}

/// The record of a group of one of the model's `elements`. Two bodies, or the ground and a body, go a
/// straight line: none asks whose a point is.
#[inline(always)]
pub(super) fn two_points<P: Geometry, T: Terms<P>, D: Dampers, L: TwoPoints<P>>(
    model: &ModelRef<'_, P, T>,
    elements: &[L],
    group: &Group,
    end_a: &End<'_, P>,
    end_b: &End<'_, P>,
) -> Option<Record<P::Space>> {
    let first = group.point as usize;
    let points = model.points.get(first..first + 2)?.first_chunk()?;
    let element = elements.get(group.element as usize)?;
    let damping = match group.damper.row() {
        Some(row) if D::ACT && T::DAMPERS => model.dampers.get(row),
        _ => None,
    };
    Some(match (end_a.body(), end_b.body()) {
        (Some(a), Some(b)) => element.record(points, damping, &a, &b),
        (None, Some(b)) => element.record(points, damping, &end_a.ground(), &b),
        (Some(a), None) => element.record(points, damping, &a, &end_b.ground()),
        (None, None) => return None,
    })
}
