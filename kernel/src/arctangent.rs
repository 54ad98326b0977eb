//! The arctangent of the torsion spring: plain arithmetic, the same bits everywhere.
//!
//! `(y, x) => angle in (−π, π]`. The quotient of the smaller by the larger magnitude is reduced
//! to |t| ≤ tan(π/8) by `atan t = π/4 + atan((t − 1)/(t + 1))`, then a polynomial in t²
//! ([`Real::ATAN`]). Error below 2 ulp of π in either precision (tested against libm).

use crate::real::{Real, choose};

/// The angle of the point (x, y), rad; 0 at the origin.
#[inline(always)]
pub fn atan2<R: Real>(y: R, x: R) -> R {
    if R::ONE_LANE { atan2_apart(y, x) } else { atan2_here(y, x) }
}

#[inline]
fn atan2_apart<R: Real>(y: R, x: R) -> R {
    atan2_here(y, x)
}

#[inline(always)]
fn atan2_here<R: Real>(y: R, x: R) -> R {
    let (ay, ax) = (y.abs(), x.abs());
    let steep = ax.less_than(ay);
    let (small, large) = choose!(R, steep, (ax, ay), (ay, ax));
    choose!(R, large.equals(R::ZERO), R::ZERO, {
        let t = small / large;
        let angle = choose!(
            R,
            R::TAN_PI_8.less_than(t),
            {
                let u = (t - R::ONE) / (t + R::ONE);
                R::FRAC_PI_4 + u * (u * u).polynomial(R::ATAN)
            },
            t * (t * t).polynomial(R::ATAN)
        );
        let angle = choose!(R, steep, R::FRAC_PI_2 - angle, angle);
        let angle = choose!(R, x.less_than(R::ZERO), R::PI - angle, angle);
        choose!(R, y.less_than(R::ZERO), -angle, angle)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn agrees_with_libm_all_around() {
        let (mut worst64, mut worst32) = (0.0_f64, 0.0_f64);
        for i in -20_000..20_000 {
            let angle = f64::from(i) * core::f64::consts::PI / 20_000.0;
            for radius in [1e-3, 1.0, 7.5e4] {
                let (y, x) = (radius * libm::sin(angle), radius * libm::cos(angle));
                worst64 = worst64.max((atan2(y, x) - libm::atan2(y, x)).abs());
                let (y, x) = (y as f32, x as f32);
                let exact = libm::atan2(f64::from(y), f64::from(x));
                worst32 = worst32.max((f64::from(atan2(y, x)) - exact).abs());
            }
        }
        assert!(worst64 < 2.0 * 4.5e-16, "{worst64:e}");
        assert!(worst32 < 2.0 * 2.4e-7, "{worst32:e}");
    }

    #[test]
    fn small_angles_keep_their_relative_accuracy_and_the_axes_are_exact() {
        assert_eq!(atan2(0.0, 0.0), 0.0);
        assert_eq!(atan2(0.0, 2.0), 0.0);
        assert_eq!(atan2(3.0, 0.0), core::f64::consts::FRAC_PI_2);
        assert_eq!(atan2(0.0, -1.0), core::f64::consts::PI);
        assert_eq!(atan2(1e-200, 1.0), 1e-200);
    }
}
