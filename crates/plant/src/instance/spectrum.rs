//! Eigenvalues of a matrix, and the invariant subspace of its slowest motions.
//!
//! `A => eigenvalues`, `(A, n) => basis and dual basis of the n eigenvalues of least modulus`. The matrix is
//! balanced (Parlett & Reinsch 1969); eigenvalues come from its Schur form, whose iterations are bounded. The
//! subspace comes from inverse iteration (Golub & Van Loan, section 7.3), which resolves slow motions in the presence
//! of fast ones better than the Schur form.

use nalgebra::linalg::balancing::balance_parlett_reinsch;
use nalgebra::{Complex, ComplexField as _, DMatrix, Schur};

use crate::instance::error::InstanceError;

/// Minimum ratio of the slowest omitted to the fastest kept motion.
const GAP: f64 = 3.0;
/// Rounds of inverse iteration. Each reduces the fast motions' part by a factor of 1.9 at least.
const ROUNDS: usize = 40;
/// The fractions of its multiples by squares are spread evenly.
const GOLDEN: f64 = 0.618_033_988_749_894_9;
/// Iterations of the Schur form per row of the matrix; LAPACK allows 30.
const SCHUR_ITERATIONS: usize = 100;

/// The slowest motions of a matrix: A·basis = basis·S, dual·A = S·dual, dual·basis = 1.
#[derive(Clone, Debug, PartialEq)]
pub struct Slow {
    /// Columns that span the subspace.
    pub basis: DMatrix<f64>,
    /// Rows that read off a state's part in it.
    pub dual: DMatrix<f64>,
    /// \[rad/s\] the modulus of the slowest eigenvalue left out.
    pub slowest_left_out: f64,
}

/// The eigenvalues of a square matrix in ascending order of their moduli, the negative imaginary part first in
/// a pair.
///
/// # Errors
/// [`InstanceError::Linearisation`] where the iteration does not converge.
pub fn eigenvalues(matrix: &DMatrix<f64>) -> Result<Vec<Complex<f64>>, InstanceError> {
    let count = matrix.nrows();
    if count == 0 {
        return Ok(Vec::new());
    }
    let mut balanced = matrix.clone();
    balance_parlett_reinsch(&mut balanced);
    // An entry below the diagonal is small relative to its diagonal neighbours, which may be zero. A shift makes them
    // nonzero, at the cost of the eigenvalues' last digits.
    let size = balanced.norm();
    let found = [0.0, 1e-6 * size, size].into_iter().find_map(|shift| {
        let shifted = &balanced + DMatrix::identity(count, count) * shift;
        let schur = Schur::try_new(shifted, f64::EPSILON, SCHUR_ITERATIONS * count)?;
        let values = schur.complex_eigenvalues();
        Some(values.iter().map(|value| value - shift).collect::<Vec<_>>())
    });
    let mut values = found.ok_or_else(|| InstanceError::Linearisation {
        what: "the eigenvalues of this state cannot be computed".into(),
        remedy: "use another pose",
    })?;
    let by_size = |a: &Complex<f64>, b: &Complex<f64>| {
        a.modulus().total_cmp(&b.modulus()).then(a.re.total_cmp(&b.re)).then(a.im.total_cmp(&b.im))
    };
    values.sort_by(by_size);
    Ok(values)
}

/// The `count` slowest motions of A, whose first half of coordinates are displacements and second half their
/// rates.
///
/// # Errors
/// [`InstanceError::Linearisation`] where the next motion is less than three times as fast, or the
/// eigenvalues cannot be computed.
pub fn slowest(a: &DMatrix<f64>, count: usize) -> Result<Slow, InstanceError> {
    let size = a.nrows();
    let values = eigenvalues(a)?;
    let [last, next] = [count - 1, count].map(|row| values[row].modulus());
    let no_gap = || InstanceError::Linearisation {
        what: format!(
            "the {count} slowest motions are not separated: the next has {next:.3} rad/s after {last:.3} rad/s"
        ),
        remedy: "give two states per degree of freedom of the mechanism: a position and its rate",
    };
    if next < GAP * last || next == 0.0 {
        return Err(no_gap());
    }
    // Units in which displacements and rates of the fast motions have the same size.
    let unit = |row: usize| if row < size / 2 { 1.0 } else { next };
    // The pole is distinct from the slow eigenvalues, which may be zero, and far from the fast ones.
    let pole = if last > 1e-3 * next { -0.37 * last } else { -1e-2 * next };
    let shifted = DMatrix::from_fn(size, size, |row, column| {
        let on_diagonal = if row == column { pole } else { 0.0 };
        a[(row, column)] * unit(column) / unit(row) - on_diagonal
    });
    let inverse = shifted.try_inverse().ok_or_else(no_gap)?;
    let mut basis = spanned(&inverse, count);
    let mut dual = spanned(&inverse.transpose(), count).transpose();
    for row in 0..size {
        basis.row_mut(row).scale_mut(unit(row));
        dual.column_mut(row).unscale_mut(unit(row));
    }
    let dual = (&dual * &basis).lu().solve(&dual).ok_or_else(no_gap)?;
    Ok(Slow { basis, dual, slowest_left_out: next })
}

/// An orthonormal basis of the `count` dominant motions of a matrix.
fn spanned(inverse: &DMatrix<f64>, count: usize) -> DMatrix<f64> {
    // Columns with a part in every motion: iteration cannot bring in a motion that nothing couples to them.
    let mut basis = DMatrix::from_fn(inverse.nrows(), count, |row, column| {
        let at = (row * count + column + 1) as f64;
        (at * at * GOLDEN).fract() - 0.5
    });
    for _ in 0..ROUNDS {
        basis = (inverse * basis).qr().q();
    }
    basis
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Zero eigenvalues in a Jordan block, a vibration, two decays.
    #[test]
    fn eigenvalues_are_those_on_paper() {
        let matrix = DMatrix::from_row_slice(
            6,
            6,
            &[
                0.0, 1.0, 0.0, 0.0, 0.0, 0.0, //
                0.0, 0.0, 0.0, 0.0, 0.0, 0.0, //
                0.0, 0.0, 0.0, 1.0, 0.0, 0.0, //
                0.0, 0.0, -1e8, -2e3, 0.0, 0.0, //
                0.0, 0.0, 0.0, 0.0, -3.0, 0.0, //
                0.0, 0.0, 0.0, 0.0, 0.0, -4.0, //
            ],
        );
        let found = eigenvalues(&matrix).unwrap();
        let high = (1e8_f64 - 1e6).sqrt();
        let known = [(0.0, 0.0), (0.0, 0.0), (-3.0, 0.0), (-4.0, 0.0), (-1e3, -high), (-1e3, high)];
        for (found, (re, im)) in found.iter().zip(known) {
            assert!((found - Complex::new(re, im)).norm() < 1e-9 * (1.0 + high), "{found}");
        }
    }

    #[test]
    fn the_slowest_motions_are_an_invariant_subspace() {
        // Mixed by a rotation, a slow oscillator and a fast one: displacements, then rates.
        let (c, s) = (0.6, 0.8);
        let turn = DMatrix::from_row_slice(2, 2, &[c, -s, s, c]);
        let squares = DMatrix::from_row_slice(2, 2, &[4.0, 0.0, 0.0, 1e10]);
        let stiffness = &turn * squares * turn.transpose();
        let mut a = DMatrix::zeros(4, 4);
        a.view_mut((0, 2), (2, 2)).fill_with_identity();
        a.view_mut((2, 0), (2, 2)).copy_from(&-stiffness);
        let slow = slowest(&a, 2).unwrap();
        assert!((slow.slowest_left_out - 1e5).abs() < 1e-3);
        let reduced = &slow.dual * &a * &slow.basis;
        let off = &a * &slow.basis - &slow.basis * &reduced;
        assert!(off.norm() < 1e-13 * a.norm(), "{off}");
        assert!((&slow.dual * &slow.basis - DMatrix::identity(2, 2)).norm() < 1e-12);
        for value in eigenvalues(&reduced).unwrap() {
            assert!((value.norm() - 2.0).abs() < 1e-6, "{value}");
        }
        let refused = slowest(&a, 1).unwrap_err();
        assert!(refused.sentence().contains("the 1 slowest motions"), "{refused}");
    }

    /// A free cart beside vibrations that nothing couples to it.
    #[test]
    fn motions_that_nothing_couples_are_found() {
        let mut a = DMatrix::zeros(6, 6);
        a.view_mut((0, 3), (3, 3)).fill_with_identity();
        [1e6, 4e6].into_iter().enumerate().for_each(|(row, k)| a[(row + 4, row + 1)] = -k);
        let slow = slowest(&a, 2).unwrap();
        assert!((slow.slowest_left_out - 1e3).abs() < 1e-6);
        for fast in [1, 2, 4, 5] {
            assert!(slow.basis.row(fast).norm() < 1e-9 * slow.basis.norm(), "{}", slow.basis);
        }
        assert!((&slow.dual * &slow.basis - DMatrix::identity(2, 2)).norm() < 1e-12);
    }
}
