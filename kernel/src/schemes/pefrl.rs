//! PEFRL: position-extended Forest–Ruth-like (Omelyan, Mryglod & Folk 2002, eq. 20–22).
//!
//! Drifts and kicks `ξ, ½ − λ, χ, λ, 1 − 2(χ + ξ), λ, χ, ½ − λ, ξ` of a step. Fourth order, four
//! evaluations, stable for `ω_max·h < 2.989`. Symplectic and reversible without dampers: the energy
//! oscillates by O(h⁴) and does not drift; linear and, with quaternions, angular momentum are kept
//! to rounding; with damped bushings and points on lines, whose law does not keep it, the linear
//! one alone. The free rotor is of fourth order; planar motion takes one exact turn.
//! Dampers are exact pairwise sweeps of half a step before and after (see [`crate::damping`]), never
//! within a step, some of whose parts go backwards: second order then.

use crate::damping::Damping;
use crate::geometry::Geometry;
use crate::model::Terms;
use crate::real::Real;
use crate::schemes::Scheme;
use crate::status::Cause;
use crate::step::Stepper;

/// Parts of a step by which the drifts go: ξ, χ, 1 − 2(χ + ξ), χ, ξ.
pub(crate) const DRIFTS: [f64; 5] = [
    0.178_617_895_844_809_1,
    -0.066_264_582_669_818_5,
    0.775_293_373_650_018_9,
    -0.066_264_582_669_818_5,
    0.178_617_895_844_809_1,
];
/// Parts of a step by which the kicks go: ½ − λ, λ, λ, ½ − λ.
pub(crate) const KICKS: [f64; 4] = [
    0.712_341_831_062_605_4,
    -0.212_341_831_062_605_4,
    -0.212_341_831_062_605_4,
    0.712_341_831_062_605_4,
];

/// Five drifts around four kicks.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Pefrl;

impl Scheme for Pefrl {
    const NAME: &'static str = "pefrl";
    const ORDER: u32 = 4;
    const ORDER_DAMPED: u32 = 2;
    const DAMPING: Damping = Damping::Sweeps;
    const STABILITY_LIMIT: f64 = 2.989;
    type Memory<P: Geometry> = ();

    fn evaluations(&self) -> u32 {
        KICKS.len() as u32
    }

    #[inline]
    fn step<P: Geometry, T: Terms>(
        &self,
        stepper: &mut Stepper<'_, '_, P, T, ()>,
    ) -> Result<(), Cause> {
        compose(stepper, &DRIFTS, &KICKS)
    }
}

/// Drifts around kicks, first and last a drift; turn counts settle at the first evaluation.
#[inline]
pub(super) fn compose<P: Geometry, T: Terms>(
    stepper: &mut Stepper<'_, '_, P, T, ()>,
    drifts: &[f64],
    kicks: &[f64],
) -> Result<(), Cause> {
    stepper.place_for_sweep();
    stepper.sweep_forward();
    let mut kicks = kicks.iter();
    for (i, &drift) in drifts.iter().enumerate() {
        stepper.drift_of_order_four(P::Real::from_f64(drift) * stepper.h);
        if let Some(&kick) = kicks.next() {
            stepper.evaluate::<false>(i == 0)?;
            stepper.kick(P::Real::from_f64(kick));
        }
    }
    stepper.place_for_sweep();
    stepper.sweep_reverse();
    Ok(())
}

/// What a symmetric composition of order four must fulfil: the parts add up to a step, and the
/// two conditions of third order hold (those of second and fourth follow from symmetry).
#[cfg(test)]
pub(super) fn assert_order_four(drifts: &[f64], kicks: &[f64]) {
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
    for (sum, expected) in [(drifted, 1.0), (kicked, 1.0), (first, 1.0 / 3.0), (second, 1.0 / 3.0)]
    {
        assert!((sum - expected).abs() < 5e-16, "{sum} {expected}");
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_coefficients_fulfil_the_conditions_of_order_four() {
        assert_order_four(&DRIFTS, &KICKS);
    }
}
