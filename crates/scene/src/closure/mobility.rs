//! Freedoms that joints leave at a pose, beyond the first order.
//!
//! `(joints, closed poses) => freedoms, bodies that move`. The rank of the constraints counts motions of first order;
//! at a singular pose some of these do not exist, and others begin only at second order. So a random combination of
//! them is followed to a closed pose nearby, and the rank is taken there. From that pose random motions of first
//! order are followed again. Where all of them lead to closed poses, the rank is right. Where they do not, because
//! the poses nearby are singular, too (a shaky linkage: Müller, J. Mechanisms Robotics 8 (2016) 041013), the number
//! of freedoms is the number of independent displacements found.

use crate::closure::constraint::Closure;
use crate::closure::island::{Island, System};
use crate::closure::least_norm::{Factors, dot};
use crate::closure::newton::{Budget, CAREFUL, descend};
use crate::closure::pose::{Pose, length};

/// \[rad\] length by which a motion is followed first, and from there.
const FOLLOWED: [f64; 2] = [0.1, 0.05];

/// A motion is discarded if it keeps less than this fraction of its displacement.
const LOST: f64 = 0.1;

/// A motion is kept if it deviates by less than this fraction of its displacement; all are kept if this number of
/// random ones are.
const KEPT: f64 = 0.05;
const ENOUGH: usize = 3;

/// A body counts as fixed if it moves by less than this fraction of the displacement, ten times the closing error.
const STILL: f64 = 2e-3;

/// A body is fixed to first order if along each axis less than this fraction of the square of a unit velocity is
/// free.
const HELD: f64 = 1e-4;

/// Maximum number of steps to close the joints again.
const STEPS: usize = 40;

/// Numbers of freedoms.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Mobility {
    /// Motions that exist at poses nearby.
    pub(crate) freedoms: usize,
    /// Motions to first order at these poses: 6 per body less the rank.
    pub(crate) first_order: usize,
}

/// Freedoms that joints leave to all bodies at closed poses.
pub(crate) fn mobility(closures: &[Closure], poses: &[Pose], scale: f64) -> Mobility {
    let mut all = Mobility::default();
    let mut joined = 0;
    for island in Island::all(closures, &vec![true; poses.len()]) {
        let system = island.system(closures, scale);
        let (free, redundant) = Free::at(&system, poses);
        joined += island.bodies.len();
        all.first_order += free.count();
        // With independent constraints the rank is exact (implicit function theorem).
        all.freedoms += if redundant { free.nearby(&system, poses) } else { free.count() };
    }
    let approximate = 6 * (poses.len() - joined);
    Mobility { freedoms: all.freedoms + approximate, first_order: all.first_order + approximate }
}

/// Bodies that joints fix to first order, excluding those that may not move.
pub(crate) fn still(
    closures: &[Closure],
    poses: &[Pose],
    movable: &[bool],
    scale: f64,
) -> Vec<usize> {
    let mut still = Vec::new();
    for island in Island::all(closures, movable) {
        let system = island.system(closures, scale);
        let (free, _) = Free::at(&system, poses);
        let held = |column: usize| {
            let mut unit = vec![0.0; system.columns()];
            unit[column] = 1.0;
            free.0.free_part(&unit)[column] < HELD
        };
        let bodies = island.bodies.iter().enumerate();
        let of_island = bodies.filter(|(row, _)| (6 * row..6 * row + 6).all(held));
        still.extend(of_island.map(|(_, body)| *body));
    }
    still
}

/// Whether each body moves in the free motions of any order.
pub(crate) fn moving(
    closures: &[Closure],
    poses: &[Pose],
    movable: &[bool],
    scale: f64,
) -> Vec<bool> {
    let mut moving = vec![false; poses.len()];
    for island in Island::all(closures, movable) {
        let system = island.system(closures, scale);
        let (free, _) = Free::at(&system, poses);
        let Some((_, there)) = free.follow(&system, poses, FOLLOWED[0], 0) else { continue };
        for body in &island.bodies {
            let [shift, turn] = there[*body].since(&poses[*body]).map(length);
            moving[*body] = turn.max(shift / scale) > STILL * FOLLOWED[0];
        }
    }
    moving
}

/// The motions of first order of an island at some poses.
struct Free(Factors, usize);

impl Free {
    /// Also whether there are redundant constraints.
    fn at(system: &System<'_>, poses: &[Pose]) -> (Self, bool) {
        let rows = system.equations(poses).rows;
        let factors = Factors::of(&rows, system.columns(), CAREFUL);
        let redundant = factors.rank() < rows.len();
        (Self(factors, system.columns()), redundant)
    }

    fn count(&self) -> usize {
        self.1 - self.0.rank()
    }

    /// How many motions the closed poses nearby have.
    fn nearby(&self, system: &System<'_>, poses: &[Pose]) -> usize {
        let Some((_, near)) = self.follow(system, poses, FOLLOWED[0], 0) else { return 0 };
        let (free, _) = Self::at(system, &near);
        let mut displacements = Vec::new();
        let mut kept = true;
        for sample in 1..=free.count() {
            let Some((way, there)) = free.follow(system, &near, FOLLOWED[1], sample) else {
                return 0;
            };
            // A path deviates from the motions of first order at second order normal to them and at third order along
            // them.
            let moved = free.0.free_part(&system.since(&there, &near));
            let strayed: Vec<f64> =
                moved.iter().zip(&way).map(|(moved, way)| moved - way).collect();
            let square = dot(&way, &way);
            kept &= dot(&strayed, &strayed) < KEPT * KEPT * square;
            if kept && sample == ENOUGH.min(free.count()) {
                return free.count();
            }
            let long = libm::sqrt(square);
            displacements.push(moved.into_iter().map(|x| x / long).collect());
        }
        independent(&displacements, self.1)
    }

    /// A random motion of first order and the closed poses to which it leads; `None` if there are none.
    fn follow(
        &self,
        system: &System<'_>,
        poses: &[Pose],
        angle: f64,
        sample: usize,
    ) -> Option<(Vec<f64>, Vec<Pose>)> {
        if self.count() == 0 {
            return None;
        }
        let random = (0..self.1).map(|column| random(sample * self.1 + column)).collect::<Vec<_>>();
        let mut way = self.0.free_part(&random);
        let largest =
            way.chunks_exact(3).map(|part| libm::sqrt(dot(part, part))).fold(0.0, f64::max);
        way.iter_mut().for_each(|x| *x *= angle * system.length / largest);
        let mut there = system.moved(poses, &way);
        descend(system, &mut there, CAREFUL, &mut Budget::of(STEPS));
        Some((way, there))
    }
}

/// Number of independent displacements, relative to their lengths.
fn independent(displacements: &[Vec<f64>], columns: usize) -> usize {
    let longest = displacements.iter().map(|row| dot(row, row)).fold(0.0, f64::max);
    let threshold = LOST / libm::sqrt(longest).max(LOST);
    if longest <= LOST * LOST { 0 } else { Factors::of(displacements, columns, threshold).rank() }
}

/// From −1 to 1, the same for the same number: SplitMix64 (Steele, Lea, Flood 2014).
fn random(number: usize) -> f64 {
    let z = (number as u64 + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    let z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
}
