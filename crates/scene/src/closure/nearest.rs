//! From closed poses to the closed poses nearest to the given ones.
//!
//! `(given poses, closed poses) => closed poses`. A step removes the unconstrained part of the displacement from the
//! given poses, then the joints are closed again; the step is shortened if the result is not nearer. The final
//! displacement is normal to all motions that the joints allow.

use crate::closure::island::System;
use crate::closure::least_norm::{Factors, dot};
use crate::closure::newton::{Budget, CAREFUL, newton};
use crate::closure::pose::Pose;

/// Largest free fraction of the displacement at the end.
const FREE_SHARE: f64 = 1e-6;

/// Maximum number of steps, and of halvings per step.
const MAX: [usize; 2] = [20, 6];

/// Moves closed poses to the closed poses nearest to the given ones.
pub(super) fn approach(
    system: &System<'_>,
    given: &[Pose],
    poses: &mut Vec<Pose>,
    budget: &mut Budget,
) {
    let mut way = system.since(poses, given);
    for _ in 0..MAX[0] {
        let distance = dot(&way, &way);
        if !budget.take() {
            return;
        }
        let factors = Factors::of(&system.equations(poses).rows, system.columns(), CAREFUL);
        let free = factors.free_part(&way);
        if dot(&free, &free) <= FREE_SHARE * FREE_SHARE * distance {
            return;
        }
        let mut share = 1.0;
        let mut halvings = 0..MAX[1];
        let nearer = halvings.find_map(|_| {
            let back: Vec<f64> = free.iter().map(|x| -share * x).collect();
            share *= 0.5;
            let mut there = system.moved(poses, &back);
            newton(system, &mut there, budget);
            let way = system.since(&there, given);
            let closed = system.equations(&there).norm() <= system.done(&there);
            (closed && dot(&way, &way) < distance).then_some((there, way))
        });
        let Some((there, next)) = nearer else { return };
        (*poses, way) = (there, next);
    }
}
