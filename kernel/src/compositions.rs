//! Symmetric compositions of drifts and kicks: the coefficients and their order conditions.
//!
//! A composition of order four splits a flow into two parts A and B, `A(a₁) B(b₁) A(a₂) …`: a step into drifts and
//! kicks, a free rotor into rotations about two axes. Coefficients are fractions of a step; some are negative.

use crate::real::Constant;

/// Fractions of a step: one drift more than kicks, beginning and ending with a drift.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Composition {
    /// Fractions of the drifts.
    pub(crate) drifts: &'static [Constant],
    /// Fractions of the kicks.
    pub(crate) kicks: &'static [Constant],
}

/// Omelyan, Mryglod & Folk (2002, eq. 20–22): drifts ξ, χ, 1 − 2(χ + ξ), χ, ξ around kicks
/// ½ − λ, λ, λ, ½ − λ.
pub(crate) const PEFRL: Composition = Composition {
    drifts: &[
        Constant::new(0.178_617_895_844_809_1),
        Constant::new(-0.066_264_582_669_818_5),
        Constant::new(0.775_293_373_650_018_9),
        Constant::new(-0.066_264_582_669_818_5),
        Constant::new(0.178_617_895_844_809_1),
    ],
    kicks: &[
        Constant::new(0.712_341_831_062_605_4),
        Constant::new(-0.212_341_831_062_605_4),
        Constant::new(-0.212_341_831_062_605_4),
        Constant::new(0.712_341_831_062_605_4),
    ],
};

/// Blanes & Moan's S6 (2002, table 2): drifts a₁ a₂ a₃ a₄ a₃ a₂ a₁ around kicks b₁ b₂ b₃ b₃ b₂ b₁,
/// with a₃ to one digit more than published (Ostmeyer 2023, eq. 46).
pub(crate) const BLANES_MOAN_S6: Composition = Composition {
    drifts: &[
        Constant::new(0.079_203_696_431_195_7),
        Constant::new(0.353_172_906_049_774),
        Constant::new(-0.042_065_080_357_719_55),
        Constant::new(0.219_376_955_753_499_66),
        Constant::new(-0.042_065_080_357_719_55),
        Constant::new(0.353_172_906_049_774),
        Constant::new(0.079_203_696_431_195_7),
    ],
    kicks: &[
        Constant::new(0.209_515_106_613_362),
        Constant::new(-0.143_851_773_179_818),
        Constant::new(0.434_336_666_566_456),
        Constant::new(0.434_336_666_566_456),
        Constant::new(-0.143_851_773_179_818),
        Constant::new(0.209_515_106_613_362),
    ],
};

#[cfg(test)]
mod tests {
    use super::*;

    /// The fractions add up to a step, and the two conditions of third order are fulfilled; those of second and fourth
    /// order follow from symmetry.
    #[test]
    fn the_coefficients_fulfil_the_conditions_of_order_four() {
        for composition in [PEFRL, BLANES_MOAN_S6] {
            let [drifts, kicks] = [composition.drifts, composition.kicks]
                .map(|parts| parts.iter().map(|part| part.double).collect::<std::vec::Vec<f64>>());
            let (mut drifted, mut kicked, mut first, mut second) = (0.0_f64, 0.0, 0.0, 0.0);
            for (i, drift) in drifts.iter().enumerate() {
                assert_eq!(drift, &drifts[drifts.len() - 1 - i]);
                second += drift * kicked * kicked;
                drifted += drift;
                if let Some(kick) = kicks.get(i) {
                    assert_eq!(kick, &kicks[kicks.len() - 1 - i]);
                    first += kick * drifted * drifted;
                    kicked += kick;
                }
            }
            let sums = [(drifted, 1.0), (kicked, 1.0), (first, 1.0 / 3.0), (second, 1.0 / 3.0)];
            for (sum, expected) in sums {
                assert!((sum - expected).abs() < 5e-16, "{sum} {expected}");
            }
        }
    }
}
