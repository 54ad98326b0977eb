//! Rank and least-norm solutions of a dense linear system.
//!
//! `rows => rank; (rows, residuals, damping) => the shortest step`. Orthonormal directions by Gram and Schmidt with
//! the longest remaining row first, each twice over (Giraud et al. 2005: twice is enough): the rank is the number of
//! rows with a remainder above a fraction of the longest row. With dependent rows or damping the components in these
//! directions are found by least squares with Householder reflections, not by normal equations. Uncoupled unknowns
//! stay uncoupled to the last bit, so planar systems stay planar. Sums have a fixed order, unlike those of linear
//! algebra libraries, so the bits are the same on every host.

/// A matrix as orthonormal directions and the components of its rows in them.
pub(super) struct Factors {
    /// Components of each row in the directions, in the order of processing.
    shares: Vec<Vec<f64>>,
    /// Original index of each row.
    order: Vec<usize>,
    /// Orthonormal basis of the row space.
    directions: Vec<Vec<f64>>,
    columns: usize,
}

/// `x ↦ x − v·(2·v·x/v·v)`, for the entries from a given index on.
struct Reflection {
    from: usize,
    v: Vec<f64>,
    /// 2/v·v.
    scale: f64,
}

impl Factors {
    /// From rows of equal length. A row depends on the others if its remainder is below `threshold` times the longest
    /// row.
    pub(super) fn of(rows: &[Vec<f64>], columns: usize, threshold: f64) -> Self {
        let mut left = rows.to_vec();
        let mut shares = vec![Vec::new(); rows.len()];
        let mut order: Vec<usize> = (0..rows.len()).collect();
        let mut directions: Vec<Vec<f64>> = Vec::new();
        let mut least = 0.0;
        for step in 0..rows.len().min(columns) {
            let rest = left[step..].iter().map(|row| dot(row, row));
            let (longest, square) = rest
                .enumerate()
                .fold((0, 0.0), |best, (i, s)| if s > best.1 { (i, s) } else { best });
            if step == 0 {
                least = threshold * threshold * square;
            }
            if square.is_nan() || square <= least {
                break;
            }
            left.swap(step, step + longest);
            shares.swap(step, step + longest);
            order.swap(step, step + longest);
            let mut direction = core::mem::take(&mut left[step]);
            for (known, share) in directions.iter().zip(&mut shares[step]) {
                *share += take_out(&mut direction, known);
            }
            let norm = libm::sqrt(dot(&direction, &direction));
            direction.iter_mut().for_each(|x| *x /= norm);
            shares[step].push(norm);
            for (row, shares) in left.iter_mut().zip(&mut shares).skip(step + 1) {
                shares.push(take_out(row, &direction));
            }
            directions.push(direction);
        }
        shares.iter_mut().for_each(|row| row.resize(directions.len(), 0.0));
        Self { shares, order, directions, columns }
    }

    /// Independent rows.
    pub(super) fn rank(&self) -> usize {
        self.directions.len()
    }

    /// The least-norm step towards zero `residuals`: `δ = −J⁺·r`; with damping > 0 it minimises
    /// `|J·δ + r|² + (damping·|δ|)²`.
    pub(super) fn step(&self, residuals: &[f64], damping: f64) -> Vec<f64> {
        let rank = self.rank();
        let targets = self.order.iter().map(|row| -residuals[*row]);
        let shares = if self.shares.len() == rank && damping == 0.0 {
            forward(&self.shares, targets)
        } else {
            let mut columns: Vec<Vec<f64>> = (0..rank)
                .map(|column| self.shares.iter().map(|row| row[column]).collect())
                .collect();
            let mut targets: Vec<f64> = targets.collect();
            if damping > 0.0 {
                for (i, column) in columns.iter_mut().enumerate() {
                    column.extend((0..rank).map(|j| if i == j { damping } else { 0.0 }));
                }
                targets.resize(targets.len() + rank, 0.0);
            }
            least_squares(columns, targets)
        };
        let mut step = vec![0.0; self.columns];
        for (direction, share) in self.directions.iter().zip(shares) {
            step.iter_mut().zip(direction).for_each(|(x, d)| *x += share * d);
        }
        step
    }

    /// The component of a vector in the null space of the rows.
    pub(super) fn free_part(&self, vector: &[f64]) -> Vec<f64> {
        let mut free = vector.to_vec();
        for _ in 0..2 {
            for direction in &self.directions {
                take_out(&mut free, direction);
            }
        }
        free
    }
}

/// Removes the component along a unit vector from a vector and returns it.
fn take_out(vector: &mut [f64], direction: &[f64]) -> f64 {
    let share = dot(vector, direction);
    if share != 0.0 {
        vector.iter_mut().zip(direction).for_each(|(x, d)| *x -= share * d);
    }
    share
}

impl Reflection {
    /// The reflection of the nonzero entries from a given index on to the first of these axes, and their resulting
    /// length.
    fn onto_first(vector: &[f64], from: usize) -> (Self, f64) {
        let mut v = vector[from..].to_vec();
        let norm = libm::sqrt(dot(&v, &v));
        // With the sign opposite to the entry, which avoids cancellation.
        let diagonal = if v[0] > 0.0 { -norm } else { norm };
        v[0] -= diagonal;
        let square = dot(&v, &v);
        let scale = if square > 0.0 { 2.0 / square } else { 0.0 };
        (Self { from, v, scale }, diagonal)
    }

    fn apply(&self, vector: &mut [f64]) {
        let part = &mut vector[self.from..];
        let share = self.scale * dot(&self.v, part);
        if share != 0.0 {
            part.iter_mut().zip(&self.v).for_each(|(x, v)| *x -= share * v);
        }
    }
}

/// The solution of a lower triangular system.
fn forward(rows: &[Vec<f64>], targets: impl Iterator<Item = f64>) -> Vec<f64> {
    let mut solution: Vec<f64> = Vec::with_capacity(rows.len());
    for (i, (row, target)) in rows.iter().zip(targets).enumerate() {
        let known = dot(&row[..i], &solution);
        solution.push((target - known) / row[i]);
    }
    solution
}

/// The coefficients of independent columns whose sum is nearest to the targets.
fn least_squares(mut columns: Vec<Vec<f64>>, mut targets: Vec<f64>) -> Vec<f64> {
    let count = columns.len();
    for i in 0..count {
        let (reflection, diagonal) = Reflection::onto_first(&columns[i], i);
        columns[i + 1..].iter_mut().for_each(|column| reflection.apply(column));
        reflection.apply(&mut targets);
        columns[i][i] = diagonal;
    }
    let mut solution = vec![0.0; count];
    for i in (0..count).rev() {
        let mut rest = targets[i];
        for j in i + 1..count {
            rest -= columns[j][i] * solution[j];
        }
        let diagonal = columns[i][i];
        solution[i] = if diagonal == 0.0 { 0.0 } else { rest / diagonal };
    }
    solution
}

/// `((s₀ + s₁) + (s₂ + s₃)) + rest`, sₖ over the entries k, k + 4, …; the up to three remaining entries are added
/// last.
pub(super) fn dot(a: &[f64], b: &[f64]) -> f64 {
    let (a, b) = (&a[..a.len().min(b.len())], &b[..a.len().min(b.len())]);
    let ((heads, rest), (tails, other_rest)) = (a.as_chunks::<4>(), b.as_chunks::<4>());
    let rest = rest.iter().zip(other_rest).fold(0.0, |sum, (a, b)| sum + a * b);
    let (mut s0, mut s1, mut s2, mut s3) = (0.0, 0.0, 0.0, 0.0);
    // Without an index: fast also where little is inlined.
    for ([a0, a1, a2, a3], [b0, b1, b2, b3]) in heads.iter().zip(tails) {
        s0 += a0 * b0;
        s1 += a1 * b1;
        s2 += a2 * b2;
        s3 += a3 * b3;
    }
    ((s0 + s1) + (s2 + s3)) + rest
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Numbers between −1 and 1 in a fixed order.
    fn noise(count: usize, mut seed: u64) -> Vec<f64> {
        let mut next = || {
            seed = seed
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            (seed >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
        };
        (0..count).map(|_| next()).collect()
    }

    fn of_rank(rows: usize, columns: usize, rank: usize) -> Vec<Vec<f64>> {
        let base: Vec<_> = (0..rank).map(|i| noise(columns, 7 + i as u64)).collect();
        let row = |i: usize| {
            let shares = noise(rank, 1000 + i as u64);
            (0..columns).map(|c| base.iter().zip(&shares).map(|(b, s)| b[c] * s).sum()).collect()
        };
        (0..rows).map(row).collect()
    }

    #[test]
    fn the_rank_is_that_of_the_rows() {
        for (rows, columns, rank) in [(5, 9, 5), (9, 5, 5), (9, 9, 4), (12, 30, 7), (3, 3, 0)] {
            let matrix = of_rank(rows, columns, rank);
            assert_eq!(Factors::of(&matrix, columns, 1e-9).rank(), rank, "{rows} {columns}");
        }
    }

    /// A step solves the consistent part and has no null-space component; the residual is normal to the columns.
    #[test]
    fn a_step_is_least_in_norm_and_in_what_is_left() {
        for (rows, columns, rank) in [(5, 9, 5), (9, 5, 5), (9, 9, 4), (12, 30, 7)] {
            let matrix = of_rank(rows, columns, rank);
            let factors = Factors::of(&matrix, columns, 1e-9);
            let residuals = noise(rows, 3);
            let step = factors.step(&residuals, 0.0);
            let left: Vec<f64> =
                matrix.iter().zip(&residuals).map(|(row, r)| dot(row, &step) + r).collect();
            for column in 0..columns {
                let share: f64 = matrix.iter().zip(&left).map(|(row, r)| row[column] * r).sum();
                assert!(share.abs() < 1e-12, "{rows} {columns}: {share:e}");
            }
            if rank == rows {
                assert!(left.iter().all(|r| r.abs() < 1e-13), "{left:?}");
            }
            let free = factors.free_part(&step);
            assert!(free.iter().all(|x| x.abs() < 1e-13), "{free:?}");
            // The null-space component changes no row, and the projection is idempotent.
            let some = factors.free_part(&noise(columns, 999));
            assert!(matrix.iter().all(|row| dot(row, &some).abs() < 1e-13));
            assert_eq!(rank == columns, some.iter().all(|x| x.abs() < 1e-13));
        }
    }

    #[test]
    fn a_damped_step_is_where_its_sum_is_least() {
        let matrix = of_rank(6, 8, 4);
        let residuals = noise(6, 5);
        let damping = 0.3;
        let step = Factors::of(&matrix, 8, 1e-9).step(&residuals, damping);
        // Jᵀ(J·δ + r) + damping²·δ = 0.
        let left: Vec<f64> =
            matrix.iter().zip(&residuals).map(|(row, r)| dot(row, &step) + r).collect();
        for column in 0..8 {
            let share: f64 = matrix.iter().zip(&left).map(|(row, r)| row[column] * r).sum();
            assert!((share + damping * damping * step[column]).abs() < 1e-14);
        }
    }
}
