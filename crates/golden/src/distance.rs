//! Distance of two bodies in a quantity.
//!
//! `two rows of numbers => m, rad, m/s or rad/s`.

use crate::component::Quantity;
use crate::subject::BodyNumbers;

impl Quantity {
    /// Distance of two bodies in this quantity, in its [unit](Self::unit): the length of the difference, for
    /// orientations the angle \[rad\] of the rotation between the two, regardless of the signs of their quaternions.
    #[must_use]
    pub fn distance(self, a: &BodyNumbers, b: &BodyNumbers) -> f64 {
        let columns = self.columns();
        let (a, b) = (&a[columns.clone()], &b[columns]);
        match self {
            Quantity::Orientation => turn(a, b),
            _ => length(a.iter().zip(b).map(|(a, b)| b - a)),
        }
    }
}

fn length(components: impl Iterator<Item = f64>) -> f64 {
    libm::sqrt(components.map(|component| component * component).sum())
}

/// \[rad\] the angle of the rotation between two unit quaternions, regardless of their signs.
fn turn(a: &[f64], b: &[f64]) -> f64 {
    let apart = length(a.iter().zip(b).map(|(a, b)| b - a));
    let opposite = length(a.iter().zip(b).map(|(a, b)| b + a));
    let chord = if opposite < apart { opposite } else { apart };
    // The sine of a quarter of the angle; a NaN is propagated.
    let sine = 0.5 * chord;
    4.0 * libm::asin(if sine > 1.0 { 1.0 } else { sine })
}

#[cfg(test)]
mod tests {
    use super::turn;

    #[test]
    fn a_turn_is_the_angle_between() {
        let about_z = |angle: f64| [(0.5 * angle).cos(), 0.0, 0.0, (0.5 * angle).sin()];
        for angle in [0.0, 1e-12, 1e-3, 1.0, 3.0] {
            let (a, b) = (about_z(0.3), about_z(0.3 + angle));
            for b in [b, b.map(|c| -c)] {
                assert!((turn(&a, &b) - angle).abs() < 1e-15 + 1e-14 * angle, "{angle}");
            }
        }
        assert!(turn(&[f64::NAN, 0.0, 0.0, 0.0], &[1.0, 0.0, 0.0, 0.0]).is_nan());
    }
}
