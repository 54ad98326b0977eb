//! From poses where the joints are closed to the nearest such: what is free moves back.
//!
//! `(given poses, closed poses) => closed poses`. A step takes what of the way since the given poses no
//! constraint holds back, then the joints are closed again; shorter where that is no nearer. At the end that
//! way is normal to all motions that joints allow.

use crate::closure::island::System;
use crate::closure::least_norm::{Factors, dot};
use crate::closure::newton::{Budget, CAREFUL, newton};
use crate::closure::pose::Pose;

/// The share of the way that may be left of what is free.
const FREE_SHARE: f64 = 1e-6;

/// Most steps back, and halvings of one.
const MOST: [usize; 2] = [20, 6];

/// Moves closed poses as near to the given ones as can be.
pub(super) fn approach(
    system: &System<'_>,
    given: &[Pose],
    poses: &mut Vec<Pose>,
    budget: &mut Budget,
) {
    let mut way = system.since(poses, given);
    for _ in 0..MOST[0] {
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
        let mut halvings = 0..MOST[1];
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
