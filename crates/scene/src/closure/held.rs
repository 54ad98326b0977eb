//! Closing the joints of an island.
//!
//! `(island, poses) => poses where its joints are closed, constraints`.

use crate::closure::constraint::Closure;
use crate::closure::island::Island;
use crate::closure::least_norm::Factors;
use crate::closure::nearest::approach;
use crate::closure::newton::{Budget, CAREFUL, newton};
use crate::closure::pose::Pose;

/// Constraints of the joints of an island.
pub(super) struct Held {
    /// Number of constraints.
    pub(super) rows: usize,
    /// Number of independent constraints.
    pub(super) rank: usize,
}

/// Closes the joints of an island and returns their constraints.
pub(super) fn close(
    island: &Island,
    closures: &[Closure],
    length: f64,
    poses: &mut Vec<Pose>,
    budget: &mut Budget,
) -> Held {
    let system = island.system(closures, length);
    let given = poses.clone();
    if system.equations(poses).norm() > system.rounding(poses) {
        newton(&system, poses, budget);
        if system.equations(poses).norm() <= system.done(poses) {
            approach(&system, &given, poses, budget);
        }
    }
    let equations = system.equations(poses);
    Held {
        rows: equations.rows.len(),
        rank: Factors::of(&equations.rows, system.columns(), CAREFUL).rank(),
    }
}
