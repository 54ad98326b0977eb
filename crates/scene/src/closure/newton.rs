//! Least-norm steps to poses where all joints are closed, or to the smallest gaps.
//!
//! `(equations, poses) => poses`. Gauss–Newton; a step that does not reduce the residuals is damped (Levenberg 1944,
//! Marquardt 1963). Almost redundant constraints are ignored at first, because decimal rounding in the scene makes
//! them contradict each other. They count only if the joints do not close without them.

use crate::closure::island::System;
use crate::closure::least_norm::Factors;
use crate::closure::pose::Pose;

/// A constraint is redundant if its remainder is below this fraction of the longest row.
pub(super) const CAREFUL: f64 = 1e-4;

/// The same in the last attempt.
const DARING: f64 = 1e-9;

/// The same in the search for an almost free motion.
const SINGULAR: f64 = 1e-2;

/// Number of unknowns along which this is tried.
const KICKS: usize = 3;

/// \[rad\] largest rotation in a step.
const LARGEST_TURN: f64 = 0.7;

/// A step is accepted if it reduces the residuals by this fraction.
const HELPS: f64 = 1e-4;

/// First and last damping, relative to the longest row.
const DAMPING: [f64; 2] = [1e-3, 1e3];

/// Remaining steps.
pub(super) struct Budget {
    left: usize,
    given: usize,
}

impl Budget {
    /// A budget of this number of steps.
    pub(super) fn of(given: usize) -> Self {
        Self { left: given, given }
    }

    /// Number of steps computed.
    pub(super) fn spent(&self) -> usize {
        self.given - self.left
    }

    /// Uses one step if any is left.
    pub(super) fn take(&mut self) -> bool {
        let some = self.left > 0;
        self.left = self.left.saturating_sub(1);
        some
    }
}

/// Closes the joints of a system, or minimises their gaps.
pub(super) fn newton(system: &System<'_>, poses: &mut Vec<Pose>, budget: &mut Budget) {
    for threshold in [CAREFUL, DARING] {
        descend(system, poses, threshold, budget);
        if system.equations(poses).norm() <= system.done(poses) {
            return;
        }
    }
    for kick in kicks(system, poses) {
        let mut there = system.moved(poses, &kick);
        descend(system, &mut there, CAREFUL, budget);
        if system.equations(&there).norm() <= system.done(&there) {
            *poses = there;
            return;
        }
    }
}

/// Steps away from poses where no motion of first order closes the joints further: at a dead centre one of second
/// order may. The step is along the freest unknowns, and its length is the square root of the gap.
fn kicks(system: &System<'_>, poses: &[Pose]) -> Vec<Vec<f64>> {
    let equations = system.equations(poses);
    let norm = equations.norm();
    let factors = Factors::of(&equations.rows, system.columns(), SINGULAR);
    let mut free: Vec<(f64, Vec<f64>)> = Vec::new();
    for column in 0..system.columns() {
        let mut unit = vec![0.0; system.columns()];
        unit[column] = 1.0;
        let part = factors.free_part(&unit);
        free.push((part[column], part));
    }
    // The first of equal ones.
    free.sort_by(|a, b| b.0.total_cmp(&a.0));
    free.truncate(KICKS);
    free.retain(|(share, _)| *share > 1e-6);
    let size = libm::sqrt(norm * (norm + system.length));
    let kick = |(share, part): (f64, Vec<f64>)| {
        let scale = size / libm::sqrt(share);
        [scale, -scale].map(|scale| part.iter().map(|x| x * scale).collect())
    };
    free.into_iter().flat_map(kick).collect()
}

/// Least-norm steps while they reduce the residuals. Constraints with a remainder below `threshold` times the longest
/// row are ignored.
pub(super) fn descend(
    system: &System<'_>,
    poses: &mut Vec<Pose>,
    threshold: f64,
    budget: &mut Budget,
) {
    let mut damping = 0.0;
    let mut equations = system.equations(poses);
    let mut norm = equations.norm();
    while norm > system.rounding(poses) && budget.take() {
        let factors = Factors::of(&equations.rows, system.columns(), threshold);
        loop {
            let step = within(system, factors.step(&equations.residuals, damping));
            let there = system.moved(poses, &step);
            let next = system.equations(&there);
            let reached = next.norm();
            if reached <= norm * (1.0 - HELPS) {
                (*poses, equations, norm) = (there, next, reached);
                damping = if damping <= DAMPING[0] { 0.0 } else { 0.1 * damping };
                break;
            }
            // At rounding error, or at a minimum.
            if norm <= system.done(poses) || damping >= DAMPING[1] {
                return;
            }
            damping = if damping == 0.0 { DAMPING[0] } else { 10.0 * damping };
        }
    }
}

/// A step, shortened if it rotates a body too far.
fn within(system: &System<'_>, mut step: Vec<f64>) -> Vec<f64> {
    let turns = step
        .chunks_exact(6)
        .map(|own| libm::sqrt(own[3] * own[3] + own[4] * own[4] + own[5] * own[5]) / system.length);
    let largest = turns.fold(0.0, f64::max);
    if largest > LARGEST_TURN {
        step.iter_mut().for_each(|x| *x *= LARGEST_TURN / largest);
    }
    step
}
