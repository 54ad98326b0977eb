//! Closing joints that are open: bodies move until every joint's two halves meet.
//!
//! `(joints' halves in body axes, poses) => poses, what stays open, freedoms`. On SE(3), by Gauss and
//! Newton with steps of least norm ([`newton`]), then along what is free back towards the given poses
//! ([`nearest`]), each group of bodies that hang together for itself. Velocities that the joints allow
//! are a linear problem more ([`rates`]). Arithmetic, roots and libm's functions in one written order: the same bits on every host.

mod constraint;
mod held;
mod island;
mod least_norm;
mod mobility;
mod nearest;
mod newton;
mod pose;
mod rates;

pub(crate) use constraint::{Closure, Opening, Place, Turn};
pub(crate) use mobility::{Mobility, mobility, moving, still};
pub(crate) use pose::{Pose, exponential, length};
pub(crate) use rates::{Contradiction, Motion, Prescribed, motions};

use crate::closure::island::Island;
use crate::closure::newton::Budget;

/// How bodies are brought together.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Settings {
    /// \[m\] the length at which a radian counts as a metre.
    pub(crate) length: f64,
    /// Most steps that are computed for bodies that hang together.
    pub(crate) iterations: usize,
}

/// Where bodies have come to.
#[derive(Clone, Debug, Default)]
pub(crate) struct Outcome {
    /// All bodies.
    pub(crate) poses: Vec<Pose>,
    /// What stays open, per joint.
    pub(crate) openings: Vec<Opening>,
    /// Steps that were computed.
    pub(crate) iterations: usize,
    /// What is left free of the bodies that may move.
    pub(crate) freedoms: usize,
    /// Constraints that others imply.
    pub(crate) held_twice: usize,
}

/// The largest island: the time grows with the third power.
pub(crate) const MOST_BODIES: usize = 200;

/// Bodies, of those that hang together and may move, of the largest island.
pub(crate) fn largest_island(closures: &[Closure], movable: &[bool]) -> usize {
    let islands = Island::all(closures, movable);
    islands.iter().map(|island| island.bodies.len()).max().unwrap_or(0)
}

/// \[m\] root mean square of the arms from centres of mass to joints of the bodies that may move: the length at
/// which a radian counts as a metre. 1 where all arms are rounding.
pub(crate) fn arm(closures: &[Closure], movable: &[bool]) -> f64 {
    /// An arm is rounding that is less than this share of the joint's coordinates in the world.
    const ROUNDING: f64 = 1e-12;
    let (mut sum, mut count, mut largest) = (0.0, 0.0, 0.0_f64);
    for closure in closures {
        for (end, point) in closure.ends.iter().zip(closure.points) {
            if movable.get(end.row()).copied().unwrap_or(false) {
                sum += point.dot(point);
                count += 1.0;
            } else {
                largest = largest.max(length(point));
            }
        }
    }
    let mean = if count > 0.0 { libm::sqrt(sum / count) } else { 0.0 };
    if mean > f64::max(ROUNDING * largest, f64::MIN_POSITIVE) && mean.is_finite() {
        mean
    } else {
        1.0
    }
}

/// Brings the joints together. Bodies that may not move are as the world is.
pub(crate) fn close(
    closures: &[Closure],
    given: &[Pose],
    movable: &[bool],
    settings: Settings,
) -> Outcome {
    let mut outcome = Outcome { poses: given.to_vec(), ..Default::default() };
    let mut joined = 0;
    for island in Island::all(closures, movable) {
        let mut budget = Budget::of(settings.iterations);
        let held = held::close(&island, closures, settings.length, &mut outcome.poses, &mut budget);
        outcome.iterations += budget.spent();
        outcome.freedoms += 6 * island.bodies.len() - held.rank;
        outcome.held_twice += held.rows - held.rank;
        joined += island.bodies.len();
    }
    let free = movable.iter().filter(|free| **free).count();
    outcome.freedoms += 6 * (free - joined);
    outcome.openings = closures.iter().map(|closure| closure.opening(&outcome.poses)).collect();
    outcome
}

/// How far the joints that were open at first are, about, when all others are closed: what an outcome has
/// spread over all of them.
pub(crate) fn gaps(
    closures: &[Closure],
    given: &[Pose],
    movable: &[bool],
    length: f64,
    outcome: &Outcome,
) -> Vec<Opening> {
    let first: Vec<_> = closures.iter().map(|closure| closure.opening(given)).collect();
    let mut gaps = outcome.openings.clone();
    for island in Island::all(closures, movable) {
        island.gather(length, &first, &mut gaps);
    }
    gaps
}
