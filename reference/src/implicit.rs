//! Linearly implicit Euler with one sparse solve, as real-time models of suspensions take it.
//!
//! `(mechanism, state, step) => state`:
//! `(M + h·C + h²·K)·Δv = h·F(q, v) − h²·K·v`, `v ← v + Δv`, `q ← q ∘ h·v` (Baraff & Witkin 1998).
//! K and C are the elements' analytic tangents without the share of their tension, symmetric and
//! positive semidefinite whatever the pose, so that a Cholesky factor exists for every step; the
//! pattern and its order of elimination are found once. First order, and it damps whatever
//! vibrates fast against the step.

use std::collections::BTreeSet;

use nalgebra::{DVector, Matrix6, Vector3, Vector6};
use nalgebra_sparse::factorization::{CscCholesky, CscSymbolicCholesky};
use nalgebra_sparse::pattern::SparsityPattern;

use crate::elements::Spring;
use crate::instant::{End, Instant};
use crate::mechanism::Mechanism;
use crate::ordering::least_degree;
use crate::signals::Clock;
use crate::state::State;

/// A mechanism on its way through time.
pub struct Implicit<'m> {
    mechanism: &'m Mechanism,
    /// The present state.
    pub state: State,
    step: f64,
    steps: u64,
    matrix: BlockMatrix,
}

impl<'m> Implicit<'m> {
    /// A run from `state` at t = 0 with a step \[s\].
    #[must_use]
    pub fn new(mechanism: &'m Mechanism, state: State, step: f64) -> Self {
        let between = mechanism.elements.iter().filter_map(|element| element.between());
        let pairs = between.filter_map(|ends| match ends {
            [End::Body(a), End::Body(b)] => Some((a, b)),
            _ => None,
        });
        let matrix = BlockMatrix::new(mechanism.bodies.len(), &pairs.collect());
        Self { mechanism, state, step, steps: 0, matrix }
    }

    /// \[s\] the present time.
    #[must_use]
    pub fn time(&self) -> f64 {
        self.steps as f64 * self.step
    }

    /// A step: one evaluation, one factorisation, one solve.
    ///
    /// # Panics
    /// Where the state is not finite; the matrix then has no factor.
    pub fn step(&mut self) {
        let h = self.step;
        let mut right = DVector::zeros(6 * self.mechanism.bodies.len());
        self.matrix.clear();
        let at = self.mechanism.at(&self.state, Clock::at(self.time()));
        for (row, acceleration) in self.mechanism.respond(&at).iter().enumerate() {
            let body = &self.mechanism.bodies[row];
            let mass = join(Vector3::repeat(body.mass), body.inertia);
            let change = join(acceleration.linear, acceleration.angular) * h;
            self.matrix.add(row, row, &Matrix6::from_diagonal(&mass));
            self.matrix.add_right(&mut right, row, &mass.component_mul(&change));
        }
        let matrix = &mut self.matrix;
        for element in &self.mechanism.elements {
            element.springs(&at, &mut |spring| implicit(matrix, &mut right, &at, &spring, h));
        }
        drop(at);
        let change = self.matrix.solve(&right);
        for (row, body) in self.state.bodies.iter_mut().enumerate() {
            let change = self.matrix.part(&change, row);
            body.velocity += change.fixed_rows::<3>(0);
            body.rate += change.fixed_rows::<3>(3);
        }
        self.state.drift(h);
        self.mechanism.settle(&mut self.state);
        self.steps += 1;
    }
}

fn join(linear: Vector3<f64>, angular: Vector3<f64>) -> Vector6<f64> {
    Vector6::new(linear.x, linear.y, linear.z, angular.x, angular.y, angular.z)
}

/// Adds a spring's `(h·c + h²·k)·j·jᵀ` and `−h²·k·rate·j`.
fn implicit(
    matrix: &mut BlockMatrix,
    right: &mut DVector<f64>,
    at: &Instant<'_>,
    spring: &Spring,
    h: f64,
) {
    let row = |end: usize, sign: f64| match spring.ends[end] {
        End::Body(body) => {
            let moment = at.to_body(body, spring.moments[end]);
            Some((body, join(spring.direction, moment) * sign))
        }
        End::World | End::Anchor(_) => None,
    };
    let rows = [row(0, -1.0), row(1, 1.0)];
    let weight = h * spring.damping + h * h * spring.stiffness;
    for (a, j_a) in rows.iter().flatten() {
        matrix.add_right(right, *a, &(j_a * (-h * h * spring.stiffness * spring.rate)));
        for (b, j_b) in rows.iter().flatten() {
            matrix.add(*a, *b, &(j_a * j_b.transpose() * weight));
        }
    }
}

/// A symmetric positive definite matrix of 6×6 blocks, its pattern fixed.
struct BlockMatrix {
    /// The place of each body in the order of elimination.
    places: Vec<usize>,
    /// Per block column its block rows, ascending.
    columns: Vec<Vec<usize>>,
    /// Where each block column's values begin.
    starts: Vec<usize>,
    values: Vec<f64>,
    pattern: SparsityPattern,
    factor: Option<CscCholesky<f64>>,
}

impl BlockMatrix {
    fn new(bodies: usize, pairs: &BTreeSet<(usize, usize)>) -> Self {
        let mut places = vec![0; bodies];
        for (place, body) in least_degree(bodies, pairs).into_iter().enumerate() {
            places[body] = place;
        }
        let mut columns: Vec<_> = (0..bodies).map(|place| BTreeSet::from([place])).collect();
        for &(a, b) in pairs {
            columns[places[a]].insert(places[b]);
            columns[places[b]].insert(places[a]);
        }
        let columns: Vec<Vec<usize>> =
            columns.into_iter().map(|rows| rows.into_iter().collect()).collect();
        let (mut starts, mut offsets, mut indices) = (Vec::new(), vec![0], Vec::new());
        for rows in &columns {
            starts.push(indices.len());
            for _ in 0..6 {
                indices.extend(rows.iter().flat_map(|row| 6 * row..6 * row + 6));
                offsets.push(indices.len());
            }
        }
        let values = vec![0.0; indices.len()];
        let size = 6 * bodies;
        let pattern = SparsityPattern::try_from_offsets_and_indices(size, size, offsets, indices)
            .expect("block rows ascend");
        Self { places, columns, starts, values, pattern, factor: None }
    }

    fn clear(&mut self) {
        self.values.fill(0.0);
    }

    fn add(&mut self, row: usize, column: usize, block: &Matrix6<f64>) {
        let (row, column) = (self.places[row], self.places[column]);
        let rows = &self.columns[column];
        let position = rows.binary_search(&row).expect("the pattern has every pair of elements");
        for (i, part) in block.column_iter().enumerate() {
            let first = self.starts[column] + 6 * (i * rows.len() + position);
            for (value, add) in self.values[first..first + 6].iter_mut().zip(&part) {
                *value += add;
            }
        }
    }

    fn add_right(&self, right: &mut DVector<f64>, row: usize, part: &Vector6<f64>) {
        let mut rows = right.fixed_rows_mut::<6>(6 * self.places[row]);
        rows += part;
    }

    fn part(&self, solution: &DVector<f64>, row: usize) -> Vector6<f64> {
        solution.fixed_rows::<6>(6 * self.places[row]).into()
    }

    fn solve(&mut self, right: &DVector<f64>) -> DVector<f64> {
        let factor = self.factor.take();
        let done = match factor {
            Some(mut factor) => factor.refactor(&self.values).map(|()| factor),
            None => {
                let symbolic = CscSymbolicCholesky::factor(self.pattern.clone());
                CscCholesky::factor_numerical(symbolic, &self.values)
            }
        };
        let factor = done.expect("the matrix is positive definite where the state is finite");
        let solution = factor.solve(right);
        self.factor = Some(factor);
        solution.column(0).into_owned()
    }
}
