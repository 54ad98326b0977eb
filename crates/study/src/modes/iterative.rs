//! The lowest and the highest modes of many bodies, by a block Krylov method on sparse matrices.
//!
//! `(model, state, how many) => modes`. Rayleigh–Ritz on the span of `X, B·X, …, Bᵏ·X`, restarted with its best vectors
//! (Saad, Numerical Methods for Large Eigenvalue Problems, 2011, chapter 6). B is `A = M⁻½·K·M⁻½` for the highest and
//! `(A + σ)⁻¹` for the lowest modes, whose σ makes A + σ positive definite. A block finds modes of one frequency.

use dbd_kernel::{F64, State};
use dbd_scene::SceneModel;
use nalgebra::{DMatrix, DVector, Matrix6, SymmetricEigen};
use nalgebra_sparse::{CooMatrix, CscMatrix};
use rand_xoshiro::Xoshiro256PlusPlus;
use rand_xoshiro::rand_core::{Rng as _, SeedableRng as _};

use super::matrices::{Entry, pairs, stiffness};
use super::{Modes, ModesError, frequency, resolution};
use crate::reference::BlockMatrix;

/// Vectors of a block beyond those that are wanted.
const SPARE: usize = 6;

/// Blocks of the span.
const BLOCKS: usize = 6;

/// Restarts at most.
const RESTARTS: usize = 200;

/// The largest residual of a wanted vector over the largest eigenvalue of B.
const TOLERANCE: f64 = 1e-10;

/// σ over the largest eigenvalue of A; grows by this until A + σ has a factor.
const SHIFT: f64 = 1e-9;
const GROWTH: f64 = 10.0;

/// The `lowest` lowest and `highest` highest modes about the pose of `state`, ascending.
///
/// # Errors
/// If a torsion angle is undefined, numbers overflow, or the iteration does not converge.
pub fn extremes(
    model: &SceneModel<F64>,
    state: &State<SceneModel<F64>>,
    [lowest, highest]: [usize; 2],
) -> Result<Modes, ModesError> {
    let size = 6 * model.bodies.len();
    let (lowest, highest) = (lowest.min(size / 4), highest.min(size / 4));
    let entries = stiffness(model, state)?;
    let (matrix, asymmetry) = symmetric(size, &entries);
    let (top, top_shapes) = largest(size, highest.max(1), &|x| &matrix * x)?;
    let most = top.first().copied().unwrap_or(0.0).abs();
    if most == 0.0 {
        return Err(ModesError::Slow);
    }
    let mut shift = SHIFT * most;
    let blocks = loop {
        let mut blocks = BlockMatrix::new(model.bodies.len(), &pairs(model));
        fill(&mut blocks, &matrix, shift);
        if let Some(factor) = blocks.factored() {
            break (blocks, factor);
        }
        shift *= GROWTH;
    };
    let (blocks, factor) = blocks;
    let solve = |x: &DMatrix<f64>| blocks.unordered(&factor.solve(&blocks.ordered(x)));
    let (inverse, low_shapes) = largest(size, lowest, &solve)?;
    let resolution = resolution(state, most);
    let low = inverse.iter().map(|value| 1.0 / value - shift);
    let squares: Vec<f64> = low.chain(top.iter().take(highest).rev().copied()).collect();
    let shapes =
        DMatrix::from_fn(size, squares.len(), |row, column| match column.checked_sub(lowest) {
            None => low_shapes[(row, column)],
            Some(place) => top_shapes[(row, highest - 1 - place)],
        });
    let frequencies = squares.iter().map(|square| frequency(*square, resolution)).collect();
    Ok(Modes { frequencies, shapes, asymmetry, resolution })
}

/// The symmetric part of the matrix of entries, and its asymmetry relative to its largest entry.
fn symmetric(size: usize, entries: &[Entry]) -> (CscMatrix<f64>, f64) {
    let mut coo = CooMatrix::new(size, size);
    entries.iter().for_each(|(row, column, value)| coo.push(*row, *column, *value));
    let matrix = CscMatrix::from(&coo);
    let transpose = matrix.transpose();
    let largest = entries.iter().fold(0.0, |most: f64, entry| most.max(entry.2.abs()));
    let apart = &matrix - &transpose;
    let asymmetry = apart.values().iter().fold(0.0, |most: f64, value| most.max(value.abs()));
    let share = if largest == 0.0 { 0.0 } else { asymmetry / largest };
    ((matrix + transpose) * 0.5, share)
}

/// Adds A + σ to a matrix of blocks.
fn fill(blocks: &mut BlockMatrix, matrix: &CscMatrix<f64>, shift: f64) {
    let mut all = std::collections::BTreeMap::new();
    for (row, column, value) in matrix.triplet_iter() {
        let block = all.entry((row / 6, column / 6)).or_insert_with(Matrix6::zeros);
        block[(row % 6, column % 6)] = *value;
    }
    for ((row, column), mut block) in all {
        if row == column {
            block += Matrix6::identity() * shift;
        }
        blocks.add(row, column, &block);
    }
}

/// The largest eigenvalues of a symmetric operator, descending, with their vectors in columns.
fn largest(
    size: usize,
    count: usize,
    apply: &dyn Fn(&DMatrix<f64>) -> DMatrix<f64>,
) -> Result<(Vec<f64>, DMatrix<f64>), ModesError> {
    let width = (count + SPARE).min(size);
    let blocks = BLOCKS.min(size / width).max(1);
    let mut random = Xoshiro256PlusPlus::seed_from_u64(1);
    let mut start = DMatrix::from_fn(size, width, |_, _| {
        f64::from((random.next_u64() >> 32) as u32) / f64::from(u32::MAX) - 0.5
    });
    for _ in 0..RESTARTS {
        let mut basis = DMatrix::zeros(size, 0);
        let mut images = DMatrix::zeros(size, 0);
        let mut next = start;
        for _ in 0..blocks {
            // Twice: once leaves rounding of a block that lies nearly in the span.
            for _ in 0..2 {
                let along = basis.transpose() * &next;
                next -= &basis * along;
                next = next.qr().q();
            }
            let image = apply(&next);
            basis = joined(&basis, &next);
            images = joined(&images, &image);
            next = image;
        }
        let projected = basis.transpose() * &images;
        let eigen = SymmetricEigen::new((&projected + projected.transpose()) * 0.5);
        let mut order: Vec<usize> = (0..eigen.eigenvalues.len()).collect();
        order.sort_by(|a, b| eigen.eigenvalues[*b].total_cmp(&eigen.eigenvalues[*a]));
        let chosen: Vec<DVector<f64>> =
            order[..width].iter().map(|i| eigen.eigenvectors.column(*i).into_owned()).collect();
        let chosen = DMatrix::from_columns(&chosen);
        let (vectors, applied) = (&basis * &chosen, &images * &chosen);
        let values: Vec<f64> = order[..width].iter().map(|i| eigen.eigenvalues[*i]).collect();
        let scale = eigen.eigenvalues.amax();
        let residual = |i: usize| (applied.column(i) - vectors.column(i) * values[i]).norm();
        if (0..count).all(|i| residual(i) <= TOLERANCE * scale) {
            return Ok((values[..count].to_vec(), vectors.columns(0, count).into_owned()));
        }
        start = vectors;
    }
    Err(ModesError::Slow)
}

/// Two matrices side by side.
fn joined(left: &DMatrix<f64>, right: &DMatrix<f64>) -> DMatrix<f64> {
    let columns: Vec<_> = left.column_iter().chain(right.column_iter()).collect();
    DMatrix::from_columns(&columns)
}
