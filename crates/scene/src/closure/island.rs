//! Bodies connected by joints, and the constraints of these joints.
//!
//! `(joints, which bodies may move) => islands; (island, poses) => rows and residuals`. The world and fixed bodies
//! connect nothing.

use crate::closure::constraint::{Closure, Opening};
use crate::closure::least_norm::dot;
use crate::closure::pose::Pose;
use crate::parts::Parts;
use dbd_kernel::Vec3;

/// Connected bodies.
pub(super) struct Island {
    /// Their rows, ascending.
    pub(super) bodies: Vec<usize>,
    /// Rows of their joints, ascending.
    closures: Vec<usize>,
}

/// The equations of an island at some poses.
pub(super) struct Equations {
    /// Per constraint, six columns per body of the island.
    pub(super) rows: Vec<Vec<f64>>,
    /// \[m\] per constraint.
    pub(super) residuals: Vec<f64>,
}

/// Scaling of the equations of an island.
pub(super) struct System<'s> {
    pub(super) island: &'s Island,
    pub(super) closures: &'s [Closure],
    /// \[m\] the length at which a radian counts as a metre.
    pub(super) length: f64,
}

/// A joint counts as closed if its squared gap is below this fraction of the sum of all squared gaps.
const ALMOST_CLOSED: f64 = 1e-12;

/// A joint counts as initially closed if its squared gap was below this fraction of the largest.
const SHUT: f64 = 1e-2;

impl Island {
    /// All islands with a joint, in the order of their first bodies.
    pub(super) fn all(closures: &[Closure], movable: &[bool]) -> Vec<Self> {
        let moves = |row: usize| movable.get(row).copied().unwrap_or(false);
        let mut parts = Parts::apart(movable.len());
        for closure in closures {
            if let [a, b] = closure.ends.map(|end| end.row())
                && moves(a)
                && moves(b)
            {
                parts.join(a, b);
            }
        }
        let mut island_of = vec![None; movable.len()];
        let mut islands: Vec<Self> = Vec::new();
        for (row, closure) in closures.iter().enumerate() {
            let Some(body) = closure.ends.iter().map(|end| end.row()).find(|row| moves(*row))
            else {
                continue;
            };
            let first = parts.first(body);
            let island = *island_of[first].get_or_insert_with(|| {
                islands.push(Self { bodies: Vec::new(), closures: Vec::new() });
                islands.len() - 1
            });
            islands[island].closures.push(row);
        }
        for body in (0..movable.len()).filter(|row| moves(*row)) {
            if let Some(island) = island_of[parts.first(body)] {
                islands[island].bodies.push(body);
            }
        }
        islands.sort_by_key(|island| island.bodies.first().copied());
        islands
    }

    /// Gaps of the joints that were open most at first when all others are closed, from the result in which the gap
    /// is spread over all of them: the part of the residuals r that no motion changes is r·r/|r|, whichever joints
    /// have it.
    pub(super) fn gather(&self, length: f64, first: &[Opening], openings: &mut [Opening]) {
        let square = |opening: &Opening| {
            let angle = length * opening.angle;
            opening.distance * opening.distance + angle * angle
        };
        let all = self.closures.iter().fold(0.0, |sum, row| sum + square(&openings[*row]));
        let widest =
            self.closures.iter().fold(0.0, |most: f64, row| most.max(square(&first[*row])));
        let least = f64::max(all * ALMOST_CLOSED, widest * SHUT);
        let was_open = |row: &&usize| square(&first[**row]) > least;
        let open = self.closures.iter().filter(was_open);
        let in_open = open.fold(0.0, |sum, row| sum + square(&openings[*row]));
        if in_open <= all * ALMOST_CLOSED {
            return;
        }
        for row in &self.closures {
            let share = if was_open(&row) { all / in_open } else { 0.0 };
            let Opening { distance, angle } = openings[*row];
            openings[*row] = Opening { distance: distance * share, angle: angle * share };
        }
    }

    /// The equations of its joints.
    pub(super) fn system<'s>(&'s self, closures: &'s [Closure], length: f64) -> System<'s> {
        System { island: self, closures, length }
    }
}

impl System<'_> {
    /// Unknowns: six per body.
    pub(super) fn columns(&self) -> usize {
        6 * self.island.bodies.len()
    }

    /// The equations at some poses.
    pub(super) fn equations(&self, poses: &[Pose]) -> Equations {
        let mut equations = Equations { rows: Vec::new(), residuals: Vec::new() };
        for closure in self.island.closures.iter().map(|row| &self.closures[*row]) {
            for row in closure.rows(poses, self.length) {
                let mut columns = vec![0.0; self.columns()];
                for (end, slopes) in closure.ends.iter().zip(row.slopes) {
                    if let Ok(body) = self.island.bodies.binary_search(&end.row()) {
                        let own = &mut columns[6 * body..6 * body + 6];
                        own.iter_mut().zip(slopes).for_each(|(x, slope)| *x = slope);
                    }
                }
                equations.rows.push(columns);
                equations.residuals.push(row.residual);
            }
        }
        equations
    }

    /// \[m\] residuals of closed joints that rounding explains.
    pub(super) fn rounding(&self, poses: &[Pose]) -> f64 {
        let far = |v: Vec3<f64>| v.x.abs().max(v.y.abs()).max(v.z.abs());
        let bodies = self.island.bodies.iter().map(|body| far(poses[*body].position));
        let closures = self.island.closures.iter().map(|row| &self.closures[*row]);
        let points = closures.flat_map(|closure| closure.points).map(far);
        8.0 * f64::EPSILON * bodies.chain(points).fold(self.length, f64::max)
    }

    /// \[m\] residuals below which a step without improvement ends the search.
    pub(super) fn done(&self, poses: &[Pose]) -> f64 {
        1e3 * self.rounding(poses)
    }

    /// The poses after a step.
    pub(super) fn moved(&self, poses: &[Pose], step: &[f64]) -> Vec<Pose> {
        let mut moved = poses.to_vec();
        for (body, step) in self.island.bodies.iter().zip(step.chunks_exact(6)) {
            let turn = Vec3::new(step[3], step[4], step[5]) * (1.0 / self.length);
            moved[*body] = poses[*body].moved(Vec3::new(step[0], step[1], step[2]), turn);
        }
        moved
    }

    /// Displacement from some poses to others, in the columns of the equations.
    pub(super) fn since(&self, poses: &[Pose], others: &[Pose]) -> Vec<f64> {
        let of_body = |body: &usize| {
            let [shift, turn] = poses[*body].since(&others[*body]);
            [shift.to_f64(), (turn * self.length).to_f64()]
        };
        self.island.bodies.iter().flat_map(|body| of_body(body).into_iter().flatten()).collect()
    }
}

impl Equations {
    /// \[m\] root of the sum of the residuals' squares.
    pub(super) fn norm(&self) -> f64 {
        libm::sqrt(dot(&self.residuals, &self.residuals))
    }
}
