//! Runs of single TSDAs between the same two bodies: lists of raw springs, imported meshes of springs.
//!
//! `(groups, ends) => wrenches`. Ends and wrenches of a run are read once; each spring adds to the wrenches in the order of
//! the groups, with the bits of one group after the other. For models whose size is known at run time.

use crate::elements::tsda::Tsda;
use crate::forces::force_pair::{Dampers, ForcePair, Wrench, apply};
use crate::geometry::Geometry;
use crate::model::{Group, Law, ModelRef, Terms};
use crate::pose::{End, Places};
use crate::real::Real as _;

/// Whether a model's groups are searched for runs.
pub(super) const fn are_sought<P: Geometry, T: Terms<P>>() -> bool {
    T::ALL && T::TSDAS && !P::RESTS && P::Real::ONE_LANE
}

/// Whether a group is a single TSDA without a clearance and dampers that act.
#[inline(always)]
fn is_single<P: Geometry, T: Terms<P>, D: Dampers>(group: &Group) -> bool {
    (group.law, group.triples, group.arms) == (Law::Tsda, 1, 1)
        && group.clearance.row().is_none()
        && !(D::ACT && T::DAMPERS && group.damper.row().is_some())
}

/// The number of groups at the start of a list that are single TSDAs between the bodies of the first, their points and
/// constants one after the other; 0 if the first is another kind of group.
#[inline(always)]
pub(super) fn run<P: Geometry, T: Terms<P>, D: Dampers>(groups: &[Group]) -> usize {
    let Some((first, others)) = groups.split_first() else { return 0 };
    if !is_single::<P, T, D>(first) {
        return 0;
    }
    let (mut point, mut element) = (first.point, first.element);
    let follows = |group: &&Group| {
        (point, element) = (point.wrapping_add(2), element.wrapping_add(1));
        (group.a, group.b, group.point, group.element) == (first.a, first.b, point, element)
            && is_single::<P, T, D>(group)
    };
    1 + others.iter().take_while(follows).count()
}

/// Adds the forces of a run of `count` springs. Not inlined: the path of joints keeps its registers.
#[inline(never)]
pub(super) fn add<P: Geometry, T: Terms<P>>(
    model: &ModelRef<'_, P, T>,
    places: Places<'_, P>,
    (first, count): (&Group, usize),
    wrenches: &mut [Wrench<P::Space>],
) {
    let (a, b) = (End::new(model, places, first.a, None), End::new(model, places, first.b, None));
    let (point, element) = (first.point as usize, first.element as usize);
    let springs = model.tsdas.get(element..element + count).unwrap_or_default();
    let points = model.points.get(point..).unwrap_or_default().as_chunks().0;
    let rows = [first.a.row(), first.b.row()];
    let sums = rows.map(|row| wrenches.get(row).copied().unwrap_or_default());
    let sums = match (a.body(), b.body()) {
        (Some(a), Some(b)) => sum::<P>(points, springs, [&a, &b], sums),
        (None, Some(b)) => sum::<P>(points, springs, [&a.ground(), &b], sums),
        _ => sum::<P>(points, springs, [&a, &b.ground()], sums),
    };
    for (row, sum) in rows.into_iter().zip(sums) {
        if let Some(wrench) = wrenches.get_mut(row) {
            *wrench = sum;
        }
    }
}

/// The wrenches of both ends with those of springs.
#[inline(always)]
fn sum<P: Geometry>(
    points: &[[P::Local; 2]],
    springs: &[Tsda<P::Real>],
    [end_a, end_b]: [&End<'_, P>; 2],
    mut sums: [Wrench<P::Space>; 2],
) -> [Wrench<P::Space>; 2] {
    for (spring, [a, b]) in springs.iter().zip(points) {
        let ((a, arm_a), (b, arm_b)) = (end_a.place(a), end_b.place(b));
        let elongation = P::elongation(&a, &b, spring.free_length);
        let [force] = Tsda::pulls(&[*spring], &[elongation]);
        let (torque_a, torque_b) = (end_a.moment(arm_a, force), end_b.moment(arm_b, force));
        apply(&mut sums, 0, 1, &ForcePair { force, torque_a, torque_b });
    }
    sums
}
