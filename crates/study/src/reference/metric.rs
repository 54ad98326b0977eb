//! Distance of two poses of a mechanism, with and without attitudes.
//!
//! `(bodies, poses, poses) => \[m\]`: per body the square of the distance of the centres of mass plus
//! the square of the angle between the attitudes times the square of a radius: the root mean square
//! distance of the body's mass from its centre, trace(I)/(2m). The trace makes it a mean over directions: a rotation
//! about a thin rod's axis counts like one about any other. Then the mean over bodies, and the root. [`distance`] is
//! the same of positions alone.

use nalgebra::Vector3;

use crate::reference::mechanism::Mechanism;
use crate::reference::state::State;

/// The measure of a scene's bodies.
#[derive(Clone, Debug, PartialEq)]
pub struct Metric {
    /// \[m²\] one per body.
    squares: Vec<f64>,
}

impl Metric {
    /// The metric of a mechanism.
    #[must_use]
    pub fn of(mechanism: &Mechanism) -> Self {
        let bodies = mechanism.bodies.iter();
        Self { squares: bodies.map(|body| body.inertia.sum() / (2.0 * body.mass)).collect() }
    }

    /// \[m\] the root mean square over bodies of their distance.
    #[must_use]
    pub fn distance(&self, a: &State, b: &State) -> f64 {
        let pairs = a.bodies.iter().zip(&b.bodies).zip(&self.squares);
        let sum: f64 = pairs
            .map(|((a, b), square)| {
                let angle = a.orientation.angle_to(&b.orientation);
                (a.position - b.position).norm_squared() + angle * angle * square
            })
            .sum();
        (sum / self.squares.len().max(1) as f64).sqrt()
    }

    /// \[m\] the root mean square over samples of the distance of a run from the reference solution; infinite if the
    /// run lacks samples or is not finite.
    #[must_use]
    pub fn error(&self, reference_solution: &[State], run: &[State]) -> f64 {
        let squares = reference_solution.iter().zip(run).map(|(a, b)| self.distance(a, b).powi(2));
        let mean = squares.sum::<f64>() / reference_solution.len().max(1) as f64;
        if run.len() == reference_solution.len() && mean.is_finite() {
            mean.sqrt()
        } else {
            f64::INFINITY
        }
    }
}

/// \[m\] the root mean square over bodies of the distance of their positions.
#[must_use]
pub fn distance(a: &[Vector3<f64>], b: &[Vector3<f64>]) -> f64 {
    let squares: f64 = a.iter().zip(b).map(|(a, b)| (a - b).norm_squared()).sum();
    (squares / a.len().max(1) as f64).sqrt()
}

#[cfg(test)]
mod tests {
    use nalgebra::UnitQuaternion;

    use super::*;
    use crate::reference::state::BodyState;

    fn body(position: Vector3<f64>, turn: Vector3<f64>) -> BodyState {
        BodyState {
            position,
            orientation: UnitQuaternion::from_scaled_axis(turn),
            velocity: Vector3::zeros(),
            rate: Vector3::zeros(),
        }
    }

    #[test]
    fn a_turn_counts_with_the_radius_of_gyration() {
        // 2 kg at a distance of 3 m and 4 m.
        let metric = Metric { squares: vec![9.0, 16.0] };
        let pose =
            |bodies: &[BodyState]| State { bodies: bodies.to_vec(), torsion_angles: Vec::new() };
        let still = body(Vector3::zeros(), Vector3::zeros());
        let turned = |angle: f64| body(Vector3::zeros(), Vector3::y() * angle);
        let far = metric.distance(&pose(&[still, still]), &pose(&[turned(1e-9), still]));
        assert!((far / (3e-9 / 2_f64.sqrt()) - 1.0).abs() < 1e-6, "{far:e}");
        let moved = body(Vector3::new(0.3, 0.0, 0.4), Vector3::x() * -0.1);
        let far = metric.distance(&pose(&[still, still]), &pose(&[still, moved]));
        assert!((far - ((0.25 + 0.01 * 16.0) / 2.0_f64).sqrt()).abs() < 1e-12);
        assert!(metric.distance(&pose(&[still]), &pose(&[turned(std::f64::consts::TAU)])) < 1e-12);
        let reference_solution = vec![pose(&[still, still]); 2];
        let run = vec![pose(&[still, still]), pose(&[still, moved])];
        assert!((metric.error(&reference_solution, &run) * 2_f64.sqrt() / far - 1.0).abs() < 1e-12);
        assert!(metric.error(&reference_solution, &run[..1]).is_infinite());
    }
}
