//! A symmetric positive semi-definite matrix of six rows by its factors.
//!
//! `K = L·D·Lᵀ`, L with ones on its diagonal and zeros above it, D diagonal (Golub & Van Loan, Matrix Computations,
//! section 4.1). With `y = Lᵀ·e` the energy `½·eᵀ·K·e` is that of six springs, `½·Σ Dᵢ·yᵢ²`: it is never negative after
//! rounding, either, and a column of L is the direction of a spring or a damper.

use crate::real::Real;

/// The factors of a matrix.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ldl<R> {
    /// \[units of the matrix\] the diagonal of D, ≥ 0.
    pub diagonal: [R; 6],
    /// \[units of the matrix over those of D\] L below its diagonal, column by column.
    pub below: [R; 15],
}

/// Relative to the diagonal: the largest difference of two entries that count as equal, and the largest part of an
/// entry that counts as 0.
const NEAR: f64 = 1e-9;

/// A pivot above this fraction of its diagonal entry is not the result of rounding.
const ROUNDING: f64 = 1e-12;

impl Ldl<f64> {
    /// Row and column of the first entry below the diagonal that differs from its counterpart above it.
    #[must_use]
    pub fn asymmetry(matrix: &[[f64; 6]; 6]) -> Option<[usize; 2]> {
        let mut pairs = (0..6).flat_map(|row| (0..row).map(move |column| [row, column]));
        pairs.find(|&[row, column]| {
            let (below, above) = (matrix[row][column], matrix[column][row]);
            (below - above).abs() > NEAR * below.abs().max(above.abs())
        })
    }

    /// The factors of a matrix, by its entries on and below the diagonal; `None` where it is not positive
    /// semi-definite.
    #[must_use]
    pub fn of(matrix: &[[f64; 6]; 6]) -> Option<Self> {
        let (mut diagonal, mut below) = ([0.0; 6], [0.0; 15]);
        let mut places = below.iter_mut();
        // The matrix less the parts of the columns before.
        let mut left = *matrix;
        for column in 0..6 {
            let (pivot, own) = (left[column][column], matrix[column][column]);
            let is_zero = pivot <= ROUNDING * own;
            if pivot.is_nan() || is_zero && pivot < -NEAR * own.max(0.0) {
                return None;
            }
            diagonal[column] = if is_zero { 0.0 } else { pivot };
            for row in column + 1..6 {
                let entry = left[row][column];
                let most = NEAR * NEAR * own.max(0.0) * matrix[row][row].max(0.0);
                if is_zero && entry * entry > most {
                    return None;
                }
                let factor = if is_zero { 0.0 } else { entry / pivot };
                *places.next()? = factor;
                let of_column = left.map(|row| row[column]);
                let entries = left[row].iter_mut().zip(of_column).take(row + 1);
                entries.skip(column + 1).for_each(|(entry, other)| *entry -= factor * other);
            }
        }
        diagonal
            .iter()
            .chain(&below)
            .all(|number| number.is_finite())
            .then_some(Self { diagonal, below })
    }

    /// The factors in another precision, each rounded once.
    #[must_use]
    pub fn rounded<R: Real>(&self) -> Ldl<R> {
        Ldl { diagonal: self.diagonal.map(R::from_f64), below: self.below.map(R::from_f64) }
    }
}

impl<R: Real> Ldl<R> {
    /// `Lᵀ·e`.
    #[inline(always)]
    #[must_use]
    pub fn along(&self, e: [R; 6]) -> [R; 6] {
        let mut sums = e;
        let mut below = self.below.iter();
        for (column, sum) in sums.iter_mut().enumerate() {
            for (value, factor) in e.iter().skip(column + 1).zip(below.by_ref()) {
                *sum = *sum + *factor * *value;
            }
        }
        sums
    }

    /// `L·D·y`.
    #[inline(always)]
    #[must_use]
    pub fn loads(&self, y: [R; 6]) -> [R; 6] {
        let mut sums = [R::ZERO; 6];
        let mut below = self.below.iter();
        for (column, (value, stiffness)) in y.into_iter().zip(self.diagonal).enumerate() {
            let load = stiffness * value;
            let mut rows = sums.iter_mut().skip(column);
            if let Some(own) = rows.next() {
                *own = *own + load;
            }
            for (sum, factor) in rows.zip(below.by_ref()) {
                *sum = *sum + *factor * load;
            }
        }
        sums
    }

    /// The columns of L.
    #[inline(always)]
    #[must_use]
    pub fn columns(&self) -> [[R; 6]; 6] {
        let mut columns = [[R::ZERO; 6]; 6];
        let mut below = self.below.iter();
        for (number, column) in columns.iter_mut().enumerate() {
            let mut rows = column.iter_mut().skip(number);
            if let Some(own) = rows.next() {
                *own = R::ONE;
            }
            for (row, factor) in rows.zip(below.by_ref()) {
                *row = *factor;
            }
        }
        columns
    }

    /// The matrix.
    #[must_use]
    pub fn matrix(&self) -> [[R; 6]; 6] {
        let mut columns = [[R::ZERO; 6]; 6];
        for (number, column) in columns.iter_mut().enumerate() {
            let mut unit = [R::ZERO; 6];
            if let Some(one) = unit.get_mut(number) {
                *one = R::ONE;
            }
            *column = self.loads(self.along(unit));
        }
        columns
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// B·Bᵀ of a matrix without pattern with `rank` columns.
    fn product(rank: usize) -> [[f64; 6]; 6] {
        let b = |row: usize, column: usize| {
            ((row * row * column + 5 * column * column + 2 * row + 3) % 11) as f64 - 4.7
        };
        let entry = |i, j| (0..rank).map(|k| b(i, k) * b(j, k)).sum();
        core::array::from_fn(|i| core::array::from_fn(|j| entry(i, j)))
    }

    #[test]
    fn factors_have_the_product_of_their_matrix() {
        for rank in 0..=6 {
            let matrix = product(rank);
            let ldl = Ldl::of(&matrix).unwrap();
            let again = ldl.matrix();
            for (row, of) in again.as_flattened().iter().zip(matrix.as_flattened()) {
                assert!((row - of).abs() <= 1e-9 * matrix[0][0], "{rank}: {again:?} {matrix:?}");
            }
            assert_eq!(ldl.diagonal.iter().filter(|pivot| **pivot > 0.0).count(), rank);
            let e = [0.3, -1.0, 0.2, 2.0, -0.7, 1.1];
            let along = ldl.along(e);
            let twice: f64 = along.iter().zip(ldl.diagonal).map(|(y, d)| d * y * y).sum();
            let exact: f64 = (0..36).map(|n| matrix[n / 6][n % 6] * e[n / 6] * e[n % 6]).sum();
            assert!((twice - exact).abs() < 1e-9 * (1.0 + exact), "{rank}: {twice} {exact}");
            for (column, y) in ldl.columns().iter().zip(along) {
                let sum: f64 = column.iter().zip(e).map(|(l, e)| l * e).sum();
                assert!((sum - y).abs() < 1e-12 * (1.0 + y.abs()));
            }
        }
    }

    #[test]
    fn matrices_without_an_energy_are_refused() {
        let whole = product(6);
        assert_eq!(Ldl::asymmetry(&whole), None);
        let mut matrix = whole;
        matrix[4][1] *= 1.0 + 1e-8;
        assert_eq!(Ldl::asymmetry(&matrix), Some([4, 1]));
        for (row, column, value) in [(0, 0, -1.0), (3, 3, 0.0), (5, 5, f64::NAN), (5, 0, 1e9)] {
            let mut matrix = whole;
            matrix[row][column] = value;
            assert_eq!(Ldl::of(&matrix), None, "{row} {column} {value}");
        }
        // A coupling of what has no stiffness.
        let mut matrix = [[0.0; 6]; 6];
        (matrix[1][0], matrix[0][1]) = (1e-3, 1e-3);
        assert_eq!(Ldl::of(&matrix), None);
        // Slightly indefinite: a pivot of less than 0 by more than rounding.
        let mut matrix = product(2);
        matrix[4][4] *= 1.0 - 1e-6;
        assert_eq!(Ldl::of(&matrix), None);
    }
}
