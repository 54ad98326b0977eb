//! What a step's time is made of.
//!
//! `rows => time per body, TSDA, joint and torsion spring, each with its standard error; exponent of growth`. Least
//! squares of relative errors. Where bodies, TSDAs and joints go together from system to system, as they do in
//! mechanisms, the split between them is uncertain, which the errors say, and their sum is not.

use nalgebra::{DMatrix, DVector};
use serde::Serialize;

/// What a part costs.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Part {
    /// What: `step`, `body`, `tumbling body`, `TSDA`, `joint`, `torsion spring`.
    pub of: &'static str,
    /// \[s\] per step.
    pub time_s: f64,
    /// \[s\] its standard error.
    pub error_s: f64,
}

/// The parts of a step's time.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Fit {
    /// Each part, the step itself first.
    pub parts: Vec<Part>,
    /// Root mean square of the relative errors that are left.
    pub residual: f64,
}

const PARTS: [&str; 6] = ["step", "body", "tumbling body", "TSDA", "joint", "torsion spring"];

/// Singular values below this part of the largest one count as none: the systems do not tell the parts apart.
const SINGULAR: f64 = 1e-9;

/// How many of each part there are, but for the step.
pub type Counts = [usize; PARTS.len() - 1];

/// The fit of times \[s\] of systems; `None` where they are too few or too much alike.
#[must_use]
pub fn fit(rows: &[(Counts, f64)]) -> Option<Fit> {
    let free = rows.len().checked_sub(PARTS.len()).filter(|free| *free > 0)?;
    let weighted = DMatrix::from_fn(rows.len(), PARTS.len(), |row, part| {
        let (counts, time) = rows[row];
        part.checked_sub(1).map_or(1.0, |part| counts[part] as f64) / time
    });
    // Columns of like size, so that what is singular shows.
    let sizes: Vec<f64> = weighted.column_iter().map(|column| column.norm()).collect();
    if sizes.contains(&0.0) {
        return None;
    }
    let scaled =
        DMatrix::from_fn(rows.len(), PARTS.len(), |row, part| weighted[(row, part)] / sizes[part]);
    let ones = DVector::from_element(rows.len(), 1.0);
    let svd = scaled.clone().svd(true, true);
    if svd.singular_values.min() < SINGULAR * svd.singular_values.max() {
        return None;
    }
    let solved = svd.solve(&ones, 0.0).ok()?;
    let left = (&scaled * &solved - ones).norm_squared();
    let variance = left / free as f64;
    let inverse = (scaled.transpose() * &scaled).try_inverse()?;
    let part = |(row, of): (usize, &'static str)| Part {
        of,
        time_s: solved[row] / sizes[row],
        error_s: (variance * inverse[(row, row)]).sqrt() / sizes[row],
    };
    let residual = (left / rows.len() as f64).sqrt();
    Some(Fit { parts: PARTS.into_iter().enumerate().map(part).collect(), residual })
}

/// The exponent b of time = a·bodies^b, by least squares of the logarithms; `None` of fewer than two sizes.
#[must_use]
pub fn exponent(points: &[(f64, f64)]) -> Option<f64> {
    let logs: Vec<(f64, f64)> = points.iter().map(|(x, y)| (x.ln(), y.ln())).collect();
    let count = logs.len() as f64;
    let (x, y) = logs.iter().fold((0.0, 0.0), |sum, log| (sum.0 + log.0, sum.1 + log.1));
    let (x, y) = (x / count, y / count);
    let products: f64 = logs.iter().map(|log| (log.0 - x) * (log.1 - y)).sum();
    let squares: f64 = logs.iter().map(|log| (log.0 - x) * (log.0 - x)).sum();
    Some(products / squares).filter(|exponent| exponent.is_finite())
}

#[cfg(test)]
mod tests {
    use super::*;

    const SYSTEMS: [Counts; 9] = [
        [3, 0, 24, 4, 2],
        [5, 0, 36, 6, 3],
        [13, 10, 90, 15, 3],
        [20, 0, 60, 20, 0],
        [7, 0, 54, 9, 3],
        [1, 1, 3, 1, 0],
        [10, 0, 60, 10, 0],
        [26, 20, 180, 30, 6],
        [100, 0, 300, 100, 0],
    ];

    /// Times that are made of known parts give these parts, without error.
    #[test]
    fn what_times_are_made_of_is_found() {
        let made = [50.0, 20.0, 40.0, 9.0, 7.0, 60.0];
        let time = |counts: &Counts| {
            let parts = counts.iter().zip(&made[1..]);
            made[0] + parts.map(|(n, part)| *n as f64 * part).sum::<f64>()
        };
        let mut rows: Vec<(Counts, f64)> = SYSTEMS.iter().map(|c| (*c, time(c))).collect();
        let found = fit(&rows).unwrap();
        for (part, known) in found.parts.iter().zip(made) {
            assert!((part.time_s - known).abs() < 1e-6 && part.error_s < 1e-6, "{part:?}");
        }
        assert!(found.residual < 1e-9);
        // With one time ten per cent off, the errors are not small any more.
        rows[2].1 *= 1.1;
        assert!(fit(&rows).unwrap().parts.iter().all(|part| part.error_s > 0.1));
    }

    #[test]
    fn systems_too_few_or_too_much_alike_tell_nothing() {
        let rows = |count: usize| SYSTEMS[..count].iter().map(|c| (*c, 1.0)).collect::<Vec<_>>();
        assert!(fit(&rows(6)).is_none() && fit(&rows(9)).is_some());
        let chains: Vec<(Counts, f64)> = (1..9).map(|n| ([n, n, 6 * n, n, 1], 1.0)).collect();
        assert!(fit(&chains).is_none());
    }

    #[test]
    fn growth_has_an_exponent() {
        let points: Vec<(f64, f64)> =
            [10.0, 100.0, 1e4].map(|n: f64| (n, 3.0 * n.powf(1.5))).into();
        assert!((exponent(&points).unwrap() - 1.5).abs() < 1e-12);
        assert!(exponent(&points[..1]).is_none() && exponent(&[]).is_none());
    }
}
