//! Closing open joints: bodies are moved until the two halves of every joint meet.
//!
//! `(joints' halves in body axes, poses) => poses, what stays open, freedoms`. Gauss–Newton on SE(3) with least-norm
//! steps ([`newton`]), then along the free motions back towards the given poses ([`nearest`]), separately for each
//! group of connected bodies. Velocities that the joints allow are a further linear problem ([`rates`]). Operations
//! have a fixed order and use libm: the same bits on every host.

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

/// Settings of the closure.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Settings {
    /// \[m\] the length at which a radian counts as a metre.
    pub(crate) length: f64,
    /// Maximum number of steps for connected bodies.
    pub(crate) iterations: usize,
}

/// Result of the closure.
#[derive(Clone, Debug, Default)]
pub(crate) struct Outcome {
    /// Poses of all bodies.
    pub(crate) poses: Vec<Pose>,
    /// Remaining gap of each joint.
    pub(crate) openings: Vec<Opening>,
    /// Number of steps computed.
    pub(crate) iterations: usize,
    /// Freedoms of the bodies that may move.
    pub(crate) freedoms: usize,
    /// Redundant constraints.
    pub(crate) held_twice: usize,
}

/// Size limit of an island: the time grows with the third power.
pub(crate) const MAX_BODIES: usize = 200;

/// Number of movable bodies of the largest island.
pub(crate) fn largest_island(closures: &[Closure], movable: &[bool]) -> usize {
    let islands = Island::all(closures, movable);
    islands.iter().map(|island| island.bodies.len()).max().unwrap_or(0)
}

/// \[m\] root mean square of the distances from centres of mass to joints of the movable bodies: the length at which
/// a radian counts as a metre. 1 if all distances are rounding errors.
pub(crate) fn arm(closures: &[Closure], movable: &[bool]) -> f64 {
    /// A distance below this fraction of the joint's world coordinates is a rounding error.
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

/// Closes the joints. Bodies that may not move count as the world.
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

/// Approximate gaps of the initially open joints when all others are closed; a closure spreads these over all joints.
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
