//! Straight lines and planes through points, by least squares.

use nalgebra::{DMatrix, DVector};

/// The coefficients of `y = Σ cᵢ·xᵢ` and the root mean square of the residual, over the points minus the coefficients;
/// `None` if the points do not determine them.
#[must_use]
pub fn least_squares(rows: &[Vec<f64>], y: &[f64]) -> Option<(Vec<f64>, f64)> {
    let columns = rows.first()?.len();
    let matrix = DMatrix::from_fn(rows.len(), columns, |row, column| rows[row][column]);
    let right = DVector::from_column_slice(y);
    let found = matrix.clone().svd(true, true).solve(&right, 1e-12).ok()?;
    let spare = rows.len().saturating_sub(columns).max(1) as f64;
    let left = (matrix * &found - right).norm() / spare.sqrt();
    Some((found.iter().copied().collect(), left))
}

/// The slope of log y over log x: the exponent of a power law; `None` with fewer than two points.
#[must_use]
pub fn exponent(points: &[[f64; 2]]) -> Option<f64> {
    if points.len() < 2 {
        return None;
    }
    let rows: Vec<Vec<f64>> = points.iter().map(|[x, _]| vec![1.0, x.ln()]).collect();
    let y: Vec<f64> = points.iter().map(|[_, y]| y.ln()).collect();
    least_squares(&rows, &y).map(|(found, _)| found[1])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_plane_and_a_power_law_are_found_again() {
        let at = [[1.0, 2.0], [2.0, 1.0], [3.0, 5.0], [4.0, 4.0]];
        let rows: Vec<Vec<f64>> = at.iter().map(|[a, b]| vec![1.0, *a, *b]).collect();
        let y: Vec<f64> = at.iter().map(|[a, b]| 0.5 + 2.0 * a - 0.25 * b).collect();
        let (found, left) = least_squares(&rows, &y).unwrap();
        for (found, expected) in found.iter().zip([0.5, 2.0, -0.25]) {
            assert!((found - expected).abs() < 1e-12, "{found} for {expected}");
        }
        assert!(left < 1e-12);
        let power: Vec<[f64; 2]> = [1.0, 2.0, 5.0].map(|x: f64| [x, 3.0 * x.powf(1.7)]).into();
        assert!((exponent(&power).unwrap() - 1.7).abs() < 1e-12);
        assert_eq!(exponent(&power[..1]), None);
    }
}
