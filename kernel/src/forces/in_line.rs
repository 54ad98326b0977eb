//! Groups in line: all of one kind, their points and elements in the order of the groups.
//!
//! `(model, ends) => records, added to the wrenches`. None is asked what it is and where its parts lie:
//! what most mechanisms are, whose joints are all revolutes. What may be in line tell a model's kinds of
//! element to the compiler; a model of every kind, whose size is known at run time, goes the long way.

use crate::body::BodyState;
use crate::elements::element::Law;
use crate::forces::record::{Dampers, Record, Wrench, apply};
use crate::forces::stars::{grid, pull};
use crate::forces::two_points::TwoPoints;
use crate::geometry::Geometry;
use crate::model::{Group, ModelRef, Terms};
use crate::pose::{End, Places};
use crate::space::Space as _;

/// The kind of all groups of a model with these kinds of element, as far as they tell: its law, stars
/// and arms.
const fn kind<T: Terms>(planar: bool) -> Option<(Law, usize, usize)> {
    let others = T::LINES || T::UNIVERSALS || T::CLEARANCES || T::INPUTS;
    match (T::TSDAS, T::BUSHINGS, T::REVOLUTES) {
        _ if others => None,
        (true, false, false) if planar => Some((Law::Tsda, 1, 2)),
        (true, false, false) => Some((Law::Tsda, 2, 3)),
        (false, true, false) => Some((Law::PointBushing, 1, 1)),
        (false, false, true) => Some((Law::Revolute, 1, 1)),
        _ => None,
    }
}

/// Whether a model of these kinds of element may be in line.
pub(super) const fn may_be<P: Geometry, T: Terms>() -> bool {
    kind::<T>(P::Space::PLANAR).is_some()
}

/// Whether the groups of a model are in line, each to a body.
pub(crate) fn are_in_line<P: Geometry, T: Terms>(model: &ModelRef<'_, P, T>) -> bool {
    let Some((law, stars, arms)) = kind::<T>(P::Space::PLANAR) else { return false };
    let is_next = |(i, group): (usize, &Group)| {
        let (point, element) = (i * (stars + arms), i * stars * arms);
        group.law == law
            && (group.stars as usize, group.arms as usize) == (stars, arms)
            && group.shared == (stars > 1)
            && (group.point as usize, group.element as usize) == (point, element)
            && !group.b.is_world()
    };
    model.groups.iter().enumerate().all(is_next)
}

/// Adds the records of the groups of a model that [`are_in_line`].
#[inline(always)]
pub(super) fn add<P: Geometry, T: Terms, D: Dampers>(
    model: &ModelRef<'_, P, T>,
    places: Places<'_, P>,
    bodies: &[BodyState<P>],
    wrenches: &mut [Wrench<P::Space>],
) {
    let at = (places, bodies);
    match kind::<T>(P::Space::PLANAR) {
        Some((Law::Tsda, 1, _)) => add_stars::<P, T, D, 1, 2, 3, 2>(model, at, wrenches),
        Some((Law::Tsda, _, _)) => add_stars::<P, T, D, 2, 3, 5, 6>(model, at, wrenches),
        Some((Law::PointBushing, _, _)) => {
            add_pairs::<P, T, D, _>(model, model.bushings, at, wrenches);
        }
        Some((Law::Revolute, _, _)) => {
            add_pairs::<P, T, D, _>(model, model.revolutes, at, wrenches);
        }
        _ => {}
    }
}

/// Where the bodies are, and how they move.
type Where<'s, P> = (Places<'s, P>, &'s [BodyState<P>]);

/// Stars that share their points of B.
#[inline(always)]
fn add_stars<
    P: Geometry,
    T: Terms,
    D: Dampers,
    const STARS: usize,
    const ARMS: usize,
    const POINTS: usize,
    const SPRINGS: usize,
>(
    model: &ModelRef<'_, P, T>,
    at: Where<'_, P>,
    wrenches: &mut [Wrench<P::Space>],
) {
    let (places, bodies) = at;
    let points = model.points.as_chunks::<POINTS>().0;
    let springs = model.tsdas.as_chunks::<SPRINGS>().0;
    for (group, (points, springs)) in model.groups.iter().zip(points.iter().zip(springs)) {
        let moving = D::ACT && T::DAMPERS && group.damper.row().is_some();
        let moving = if moving { Some(bodies) } else { None };
        let end_a = End::new(model, places, group.a, moving);
        let Some(b) = End::new(model, places, group.b, moving).body() else {
            if P::Space::PLANAR {
                break;
            }
            continue;
        };
        let Some(springs) = grid(springs, 0) else { break };
        let parts = (points.as_slice(), springs);
        let record: Option<Record<_>> = match end_a.body() {
            Some(a) => pull::<P, T, D, STARS, ARMS>(model, group, parts, &a, &b),
            None => pull::<P, T, D, STARS, ARMS>(model, group, parts, &end_a.ground(), &b),
        };
        let Some(record) = record else { break };
        apply(wrenches, group.a.row(), group.b.row(), &record);
    }
}

/// A point of either body and one element.
#[inline(always)]
fn add_pairs<P: Geometry, T: Terms, D: Dampers, L: TwoPoints<P>>(
    model: &ModelRef<'_, P, T>,
    elements: &[L],
    at: Where<'_, P>,
    wrenches: &mut [Wrench<P::Space>],
) {
    let (places, bodies) = at;
    let points = model.points.as_chunks().0;
    for (group, (points, element)) in model.groups.iter().zip(points.iter().zip(elements)) {
        let moving = D::ACT && T::DAMPERS && group.damper.row().is_some();
        let moving = if moving { Some(bodies) } else { None };
        let end_a = End::new(model, places, group.a, moving);
        let Some(b) = End::new(model, places, group.b, moving).body() else { continue };
        let damping = match group.damper.row() {
            Some(row) if D::ACT && T::DAMPERS => model.dampers.get(row),
            _ => None,
        };
        let record = match end_a.body() {
            Some(a) => element.record(points, damping, &a, &b),
            None => element.record(points, damping, &end_a.ground(), &b),
        };
        apply(wrenches, group.a.row(), group.b.row(), &record);
    }
}
