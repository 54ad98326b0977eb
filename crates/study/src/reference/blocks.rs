//! A sparse matrix of 6×6 blocks, one per body and per pair of bodies that act on each other.
//!
//! `(mechanism, blocks, right side) => solution`. The pattern and its order of elimination are found once.

use std::collections::BTreeSet;

use nalgebra::{DMatrix, DVector, Matrix6, Vector3, Vector6};
use nalgebra_sparse::factorization::{CscCholesky, CscSymbolicCholesky};
use nalgebra_sparse::pattern::SparsityPattern;

use crate::reference::elements::Spring;
use crate::reference::instant::{End, Instant};
use crate::reference::mechanism::Mechanism;
use crate::reference::ordering::least_degree;

/// Three numbers along the world's axes and three about the body's.
pub(crate) fn join(linear: Vector3<f64>, angular: Vector3<f64>) -> Vector6<f64> {
    Vector6::new(linear.x, linear.y, linear.z, angular.x, angular.y, angular.z)
}

/// Gradient of a spring's length with respect to the motion of either body; `None` at the ground.
pub(crate) fn levers(at: &Instant<'_>, spring: &Spring) -> [Option<(usize, Vector6<f64>)>; 2] {
    let row = |end: usize, sign: f64| match spring.ends[end] {
        End::Body(body) => {
            let moment = at.to_body(body, spring.moments[end]);
            Some((body, join(spring.direction, moment) * sign))
        }
        End::World | End::Anchor(_) => None,
    };
    [row(0, -1.0), row(1, 1.0)]
}

/// A symmetric positive definite matrix of 6×6 blocks, its pattern fixed.
pub(crate) struct BlockMatrix {
    /// The index of each body in the order of elimination.
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
    /// The matrix of a mechanism: a block for each body, and for each pair that an element lies between.
    pub(crate) fn of(mechanism: &Mechanism) -> Self {
        let between = mechanism.elements.iter().filter_map(|element| element.between());
        let pairs = between.filter_map(|ends| match ends {
            [End::Body(a), End::Body(b)] => Some((a, b)),
            _ => None,
        });
        Self::new(mechanism.bodies.len(), &pairs.collect())
    }

    /// A matrix with a block for each body and for each pair.
    pub(crate) fn new(bodies: usize, pairs: &BTreeSet<(usize, usize)>) -> Self {
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

    /// All of it 0.
    pub(crate) fn clear(&mut self) {
        self.values.fill(0.0);
    }

    /// Adds a block at a pair of bodies that it has.
    pub(crate) fn add(&mut self, row: usize, column: usize, block: &Matrix6<f64>) {
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

    /// Adds a body's part to a right side.
    pub(crate) fn add_right(&self, right: &mut DVector<f64>, row: usize, part: &Vector6<f64>) {
        let mut rows = right.fixed_rows_mut::<6>(6 * self.places[row]);
        rows += part;
    }

    /// A body's part of a solution.
    pub(crate) fn part(&self, solution: &DVector<f64>, row: usize) -> Vector6<f64> {
        solution.fixed_rows::<6>(6 * self.places[row]).into()
    }

    /// Its factor; `None` where it is not positive definite.
    pub(crate) fn factored(&self) -> Option<CscCholesky<f64>> {
        let symbolic = CscSymbolicCholesky::factor(self.pattern.clone());
        CscCholesky::factor_numerical(symbolic, &self.values).ok()
    }

    /// Rows of a matrix, six per body, in the order of elimination.
    pub(crate) fn ordered(&self, rows: &DMatrix<f64>) -> DMatrix<f64> {
        let mut ordered = rows.clone();
        for (body, place) in self.places.iter().enumerate() {
            ordered.rows_mut(6 * place, 6).copy_from(&rows.rows(6 * body, 6));
        }
        ordered
    }

    /// The opposite of [`Self::ordered`].
    pub(crate) fn unordered(&self, rows: &DMatrix<f64>) -> DMatrix<f64> {
        let mut unordered = rows.clone();
        for (body, place) in self.places.iter().enumerate() {
            unordered.rows_mut(6 * body, 6).copy_from(&rows.rows(6 * place, 6));
        }
        unordered
    }

    /// The solution.
    ///
    /// # Panics
    /// Where the matrix has no factor: it is not finite.
    pub(crate) fn solve(&mut self, right: &DVector<f64>) -> DVector<f64> {
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
