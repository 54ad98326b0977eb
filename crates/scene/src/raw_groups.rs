//! Raw TSDAs that write a joint out, as one group.
//!
//! `TSDAs in scene order => groups`. Three in a row from one point to three others are the triple of a spherical joint;
//! six that join each of two points to each of three others are those of a revolute joint. As one group each of their
//! points is computed once, in the joint's order of sums, so that the list has the joint's bits and costs what it does.

use dbd_kernel::{BodyIndex, Vec3};

use crate::spring::Spring;

/// Free lengths within this fraction of each other are equal: they may be distances that were rounded.
const EQUAL: f64 = 1e-12;

/// A raw TSDA.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Leg {
    pub(crate) bodies: [BodyIndex; 2],
    /// \[m\] in the axes of the bodies.
    pub(crate) points: [Vec3<f64>; 2],
    /// \[m\].
    pub(crate) free_length: f64,
    pub(crate) spring: Spring,
    /// Whether it stays a group of its own: it has a name that an input or a read-out may use, limits, or no length.
    pub(crate) is_alone: bool,
}

/// One group of raw TSDAs.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct RawGroup {
    /// The first row of its TSDAs, which are consecutive.
    first: usize,
    /// Their number.
    count: usize,
    /// Rows of TSDAs with its centres, and with its endpoints.
    ends: [Vec<usize>; 2],
    /// Whether its centres are on the second body of its first TSDA.
    pub(crate) is_reversed: bool,
}

impl RawGroup {
    /// The rows of its TSDAs.
    pub(crate) fn rows(&self) -> std::ops::Range<usize> {
        self.first..self.first + self.count
    }

    /// Its points on the first body, one per spring triple.
    pub(crate) fn centres(&self, legs: &[Leg]) -> Vec<Vec3<f64>> {
        self.points(legs, 0)
    }

    /// Its points on the second body.
    pub(crate) fn tips(&self, legs: &[Leg]) -> Vec<Vec3<f64>> {
        self.points(legs, 1)
    }

    fn points(&self, legs: &[Leg], end: usize) -> Vec<Vec3<f64>> {
        let side = end ^ usize::from(self.is_reversed);
        let first = &legs[self.first];
        self.ends[end]
            .iter()
            .map(|row| legs[*row].towards(first).unwrap_or_default()[side])
            .collect()
    }
}

impl Leg {
    /// Its points, in the order of another's bodies; `None` between other bodies.
    fn towards(&self, other: &Self) -> Option<[Vec3<f64>; 2]> {
        let [a, b] = self.bodies;
        let [from, to] = self.points;
        match other.bodies {
            bodies if bodies == [a, b] => Some([from, to]),
            bodies if bodies == [b, a] => Some([to, from]),
            _ => None,
        }
    }

    /// Whether it may be in a group with another.
    fn is_like(&self, other: &Self) -> bool {
        let lengths = [self.free_length, other.free_length];
        !self.is_alone
            && self.spring == other.spring
            && (lengths[0] - lengths[1]).abs() <= EQUAL * lengths[0]
    }
}

/// The groups of raw TSDAs, in scene order; in a plane two from one point to two others are a revolute joint.
pub(crate) fn raw_groups(legs: &[Leg], planar: bool) -> Vec<RawGroup> {
    let shapes: &[[usize; 2]] = if planar { &[[1, 2]] } else { &[[2, 3], [1, 3]] };
    let mut groups = Vec::new();
    let mut row = 0;
    while row < legs.len() {
        let alone =
            || RawGroup { first: row, count: 1, ends: [vec![row], vec![row]], is_reversed: false };
        let group = shapes.iter().find_map(|shape| grid(legs, row, *shape)).unwrap_or_else(alone);
        row += group.count;
        groups.push(group);
    }
    groups
}

/// The group of so many centres and endpoints whose first TSDA is at a row.
fn grid(legs: &[Leg], first: usize, [centres, tips]: [usize; 2]) -> Option<RawGroup> {
    let count = centres * tips;
    let all = legs.get(first..first + count)?;
    if !all.iter().all(|leg| leg.is_like(&all[0])) {
        return None;
    }
    // The distinct points of each body by the first row that has them, and which of them each TSDA joins.
    let mut ends: [Vec<(usize, Vec3<f64>)>; 2] = [Vec::new(), Vec::new()];
    let mut joined = Vec::new();
    for (row, leg) in (first..).zip(all) {
        let points = leg.towards(&all[0])?;
        let mut places = [0; 2];
        for ((end, point), place) in ends.iter_mut().zip(points).zip(&mut places) {
            *place = end.iter().position(|(_, known)| *known == point).unwrap_or(end.len());
            if *place == end.len() {
                end.push((row, point));
            }
        }
        joined.push(places);
    }
    joined.sort_unstable();
    joined.dedup();
    let is_reversed = ends[0].len() == tips;
    let [from, to] = ends.map(|end| end.into_iter().map(|(row, _)| row).collect::<Vec<_>>());
    let ends = if is_reversed { [to, from] } else { [from, to] };
    (joined.len() == count && [ends[0].len(), ends[1].len()] == [centres, tips])
        .then_some(RawGroup { first, count, ends, is_reversed })
}
