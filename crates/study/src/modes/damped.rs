//! Damping ratios of modes.
//!
//! `(frequencies, ΦᵀCΦ) => ratios`. The quadratic eigenproblem `λ² + λ·D + Ω² = 0`, D = Φᵀ·M⁻½·C·M⁻½·Φ, as the
//! first-order system `(Ω·q, q̇)`, whose matrix `[[0, Ω], [−Ω, −D]]` has the eigenvalues of all damped modes; each
//! undamped mode gets those nearest to its estimate from the diagonal of D.

use std::f64::consts::TAU;

use nalgebra::{Complex, DMatrix, Schur};

/// Parts of D below this fraction of its largest entry are rounding.
const ROUNDING: f64 = 1e-11;

/// Iterations per eigenvalue at most.
const ITERATIONS: usize = 60;

/// The ratios that the diagonal of D gives; `None` of modes without a frequency.
pub(super) fn by_diagonal(frequencies: &[f64], diagonal: &[f64]) -> Vec<Option<f64>> {
    let ratio = |(frequency, d): (&f64, &f64)| {
        (*frequency > 0.0).then(|| d.max(0.0) / (2.0 * TAU * frequency))
    };
    frequencies.iter().zip(diagonal).map(ratio).collect()
}

/// The two eigenvalues of one mode alone.
fn alone(omega: f64, d: f64) -> [Complex<f64>; 2] {
    let root = Complex::new(0.25 * d * d - omega * omega, 0.0).sqrt();
    [Complex::new(-0.5 * d, 0.0) + root, Complex::new(-0.5 * d, 0.0) - root]
}

/// The ratios of the quadratic eigenproblem; `None` where its iteration does not converge.
pub(super) fn by_eigenvalues(
    frequencies: &[f64],
    damping: &DMatrix<f64>,
) -> Option<Vec<Option<f64>>> {
    let largest = damping.amax();
    let diagonal: Vec<f64> = damping.diagonal().iter().copied().collect();
    let mut ratios = by_diagonal(frequencies, &diagonal);
    // Undamped modes keep their frequency and are uncoupled.
    let coupled: Vec<usize> = (0..frequencies.len())
        .filter(|row| damping.row(*row).amax() > ROUNDING * largest)
        .collect();
    let count = coupled.len();
    let mut system = DMatrix::zeros(2 * count, 2 * count);
    for (i, row) in coupled.iter().enumerate() {
        let omega = TAU * frequencies[*row];
        system[(i, count + i)] = omega.abs();
        system[(count + i, i)] = -omega;
        for (j, column) in coupled.iter().enumerate() {
            system[(count + i, count + j)] = -damping[(*row, *column)];
        }
    }
    if count == 0 {
        return Some(ratios);
    }
    let schur = Schur::try_new(system, f64::EPSILON, ITERATIONS * 2 * count)?;
    let mut left: Vec<Complex<f64>> = schur.complex_eigenvalues().iter().copied().collect();
    // Weakly damped modes first: their eigenvalues are nearest.
    let mut order = coupled.clone();
    order.sort_by(|a, b| {
        let ratio = |row: usize| ratios[row].unwrap_or(f64::INFINITY);
        ratio(*a).total_cmp(&ratio(*b))
    });
    for row in order {
        let guesses = alone(TAU * frequencies[row], diagonal[row]);
        let found = guesses.map(|guess| {
            let apart = |value: &Complex<f64>| (value - guess).norm();
            let nearest =
                (0..left.len()).min_by(|a, b| apart(&left[*a]).total_cmp(&apart(&left[*b])));
            nearest.map_or(guess, |place| left.swap_remove(place))
        });
        if let Some(ratio) = &mut ratios[row] {
            let size = (found[0].norm() * found[1].norm()).sqrt();
            *ratio = if size > 0.0 { -0.5 * (found[0].re + found[1].re) / size } else { 0.0 };
        }
    }
    Some(ratios)
}
