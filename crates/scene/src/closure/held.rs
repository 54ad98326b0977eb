//! The joints of an island, brought together.
//!
//! `(island, poses) => poses where its joints are closed, what they hold`.

use crate::closure::constraint::Closure;
use crate::closure::island::Island;
use crate::closure::least_norm::Factors;
use crate::closure::nearest::approach;
use crate::closure::newton::{Budget, CAREFUL, newton};
use crate::closure::pose::Pose;

/// What the joints of an island hold.
pub(super) struct Held {
    /// Constraints.
    pub(super) rows: usize,
    /// Of which none follows from the others.
    pub(super) rank: usize,
}

/// Brings the joints of an island together where they are not; what they then hold.
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
