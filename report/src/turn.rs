//! How far a body has turned since t = 0, without jumps.
//!
//! `(orientation at t = 0, orientation, last turn) => turn \[rad\]`: a vector along the world's axis of
//! the rotation, as long as its angle. Of the angles that are whole turns apart it is the one nearest
//! to the last, so that a crank counts on.

use std::f64::consts::TAU;

/// Below this sine of half an angle the axis is round-off.
const NO_AXIS: f64 = 1e-9;

/// The turn \[rad\], world axes, from one orientation to another, nearest to `last`. Unit
/// quaternions, scalar first, body → world.
#[must_use]
pub fn turn(from: [f64; 4], to: [f64; 4], last: [f64; 3]) -> [f64; 3] {
    let [a, b, c, d] = from;
    let [w, x, y, z] = to;
    // to · conjugate(from)
    let scalar = w * a + x * b + y * c + z * d;
    let vector = [
        -w * b + x * a - y * d + z * c,
        -w * c + x * d + y * a - z * b,
        -w * d - x * c + y * b + z * a,
    ];
    let sine = dot(vector, vector).sqrt();
    if sine < NO_AXIS {
        let so_far = dot(last, last).sqrt();
        let whole = TAU * (so_far / TAU).round();
        // What is left of the vector is twice the rest of the angle, either sign.
        let rest = 2.0 * scalar.signum();
        let along = if so_far > 1.0 { whole / so_far } else { 0.0 };
        return [0, 1, 2].map(|i| along * last[i] + rest * vector[i]);
    }
    let angle = 2.0 * sine.atan2(scalar);
    let axis = vector.map(|component| component / sine);
    let turns = ((dot(last, axis) - angle) / TAU).round();
    axis.map(|component| component * (angle + TAU * turns))
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn about_z(angle: f64) -> [f64; 4] {
        let half = 0.5 * angle;
        [half.cos(), 0.0, 0.0, half.sin()]
    }

    #[test]
    fn a_crank_counts_on_either_way() {
        for way in [1.0, -1.0] {
            let mut last = [0.0; 3];
            // Whole turns exactly among them.
            for tenth in 0..=400 {
                let angle = way * f64::from(tenth) * TAU / 40.0;
                last = turn(about_z(0.3), about_z(0.3 + angle), last);
                assert!((last[2] - angle).abs() < 1e-9, "{angle} {last:?}");
                assert!(last[0].abs() < 1e-9 && last[1].abs() < 1e-9);
            }
        }
    }

    #[test]
    fn it_is_about_the_axes_of_the_world() {
        // A body that lies on its side turns about the vertical.
        let side = [0.5_f64.sqrt(), 0.5_f64.sqrt(), 0.0, 0.0];
        let half = 0.1_f64;
        let [w, x] = [side[0] * half.cos(), side[1] * half.cos()];
        let [y, z] = [side[1] * half.sin(), side[0] * half.sin()];
        let found = turn(side, [w, x, y, z], [0.0; 3]);
        assert!((found[2] - 0.2).abs() < 1e-12, "{found:?}");
        assert!(found[0].abs() < 1e-12 && found[1].abs() < 1e-12);
        // The opposite quaternion is the same orientation.
        let found = turn(side, [-w, -x, -y, -z], [0.0; 3]);
        assert!((found[2] - 0.2).abs() < 1e-12, "{found:?}");
    }
}
