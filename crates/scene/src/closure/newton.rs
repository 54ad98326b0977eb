//! Steps of least norm to where all joints are closed, or as nearly so as can be.
//!
//! `(equations, poses) => poses`. Gauss and Newton; a step that does not shrink the residuals is damped
//! (Levenberg 1944, Marquardt 1963). Constraints that almost follow from others hold nothing at first: written
//! digits make them contradict each other in the last of these. Only where that does not close the joints
//! they count as well.

use crate::closure::island::System;
use crate::closure::least_norm::Factors;
use crate::closure::pose::Pose;

/// A constraint of which less is left beside the others than this share of the longest follows from
/// them.
pub(super) const CAREFUL: f64 = 1e-4;

/// The same where it is the last hope.
const DARING: f64 = 1e-9;

/// The same where a motion is looked for that is as good as free.
const SINGULAR: f64 = 1e-2;

/// Unknowns along which that is tried.
const KICKS: usize = 3;

/// \[rad\] the largest turn of a step; a step that turns further is not to be trusted.
const LARGEST_TURN: f64 = 0.7;

/// A step helps that shrinks the residuals by this share.
const HELPS: f64 = 1e-4;

/// The first damping, of the longest row, and the last.
const DAMPING: [f64; 2] = [1e-3, 1e3];

/// Steps that may yet be computed.
pub(super) struct Budget {
    left: usize,
    given: usize,
}

impl Budget {
    /// So many.
    pub(super) fn of(given: usize) -> Self {
        Self { left: given, given }
    }

    /// How many were computed.
    pub(super) fn spent(&self) -> usize {
        self.given - self.left
    }

    /// Takes one, where there is one left.
    pub(super) fn take(&mut self) -> bool {
        let some = self.left > 0;
        self.left = self.left.saturating_sub(1);
        some
    }
}

/// Brings the joints of a system together, or as near as can be.
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

/// Steps away from where no motion of first order closes the joints any further: at a dead centre one of
/// second order may. Along the unknowns that are most free, as far as the square of which is what stays open.
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
    // Of equal ones the first.
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

/// Steps of least norm while they shrink the residuals. Constraints of which less than `threshold` of the
/// longest is left beside the others hold nothing.
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
            // At the end of the digits, or at the least there is.
            if norm <= system.done(poses) || damping >= DAMPING[1] {
                return;
            }
            damping = if damping == 0.0 { DAMPING[0] } else { 10.0 * damping };
        }
    }
}

/// A step, shortened where it turns a body too far.
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
