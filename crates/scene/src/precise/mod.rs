//! Numbers with 32 digits, so that values computed from points are rounded once: the number in the model is the double
//! nearest to the exact one, regardless of the calculation.
//!
//! `sums of two doubles => sums, products, quotients, roots; sine, cosine, arctangent; vectors`.
//! Source: Dekker, Numer. Math. 18 (1971) 224; Hida, Li & Bailey, ARITH-15 (2001) 155. Only sums,
//! products and libm's functions of doubles, so the bits are the same on every host.

mod number;
mod trigonometry;
mod vector;

pub(crate) use number::Precise;
pub(crate) use trigonometry::{PI, arctangent, sine_and_cosine};
pub(crate) use vector::PreciseVector;

#[cfg(test)]
mod tests {
    use super::*;

    /// Compares a number with a 40-digit reference, split into two doubles by another program.
    fn near(found: Precise, high: f64, low: f64) -> bool {
        (found - Precise::new(high, low)).nearest().abs() < 1e-31 * high.abs()
    }

    #[test]
    fn sums_products_quotients_and_roots_have_32_digits() {
        let [one, three, seven] = [1.0, 3.0, 7.0].map(Precise::from);
        let third = one / three;
        assert!(near(third, 0.333_333_333_333_333_3, 1.850_371_707_708_594e-17));
        assert!(near(third * three, 1.0, 0.0) && near(third + third + third, 1.0, 0.0));
        assert!(near(seven.root() * seven.root(), 7.0, 0.0));
        assert!(near(
            Precise::from(2.0).root(),
            core::f64::consts::SQRT_2,
            -9.667_293_313_452_913e-17
        ));
        let small = Precise::new(1.0, 1e-20);
        assert_eq!((small - one).nearest(), 1e-20);
        assert_eq!((Precise::ZERO.root(), (-one).root()), (Precise::ZERO, Precise::ZERO));
    }

    #[test]
    fn whole_degrees_have_their_own_sine_and_cosine() {
        let half_root_of_3 = Precise::from(3.0).root() / Precise::from(2.0);
        for (degrees, sine, cosine) in [
            (0.0, 0.0, Some(1.0)),
            (30.0, 0.5, None),
            (90.0, 1.0, Some(0.0)),
            (150.0, 0.5, None),
            (180.0, 0.0, Some(-1.0)),
            (210.0, -0.5, None),
            (270.0, -1.0, Some(0.0)),
            (-30.0, -0.5, None),
            (-90.0, -1.0, Some(0.0)),
            (3690.0, 1.0, Some(0.0)),
        ] {
            let (s, c) = sine_and_cosine(f64::to_radians(degrees));
            assert_eq!(s.nearest(), sine, "{degrees}");
            match cosine {
                Some(cosine) => assert_eq!(c.nearest(), cosine, "{degrees}"),
                None => assert_eq!(c.nearest().abs(), half_root_of_3.nearest(), "{degrees}"),
            }
        }
        // 22.5 degrees: tan is √2 − 1.
        let (s, c) = sine_and_cosine(22.5_f64.to_radians());
        assert!(((s / c) - (Precise::from(2.0).root() - Precise::ONE)).nearest().abs() < 1e-31);
    }

    #[test]
    fn sine_and_cosine_are_on_the_circle_and_the_arctangent_leads_back() {
        for i in -40..=40 {
            let angle = f64::from(i) * 0.0783 + 1e-7;
            let (s, c) = sine_and_cosine(angle);
            assert!(near(s * s + c * c, 1.0, 0.0), "{angle}");
            assert!((s.nearest() - angle.sin()).abs() < 2e-16, "{angle}");
            assert!((c.nearest() - angle.cos()).abs() < 2e-16, "{angle}");
            if angle.abs() < core::f64::consts::PI {
                assert_eq!(arctangent(s, c), angle);
            }
            // Twice the angle.
            let (s2, c2) = sine_and_cosine(2.0 * angle);
            assert!((s2 - (s * c + s * c)).nearest().abs() < 1e-30, "{angle}");
            assert!((c2 - (c * c - s * s)).nearest().abs() < 1e-30, "{angle}");
        }
        assert_eq!(arctangent(Precise::ONE, Precise::ZERO), core::f64::consts::FRAC_PI_2);
        assert_eq!(arctangent(Precise::ZERO, -Precise::ONE), core::f64::consts::PI);
        // Beyond the resolution of an angle in a double.
        let (s, c) = sine_and_cosine(1e300);
        assert!((s.nearest().hypot(c.nearest()) - 1.0).abs() < 1e-12);
    }
}
