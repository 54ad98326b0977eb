//! PEFRL: position-extended Forest–Ruth-like (Omelyan, Mryglod & Folk 2002, eq. 20–22).
//!
//! Drifts and kicks `ξ, ½ − λ, χ, λ, 1 − 2(χ + ξ), λ, χ, ½ − λ, ξ` of a step. Fourth order, four evaluations, stable
//! for `ω_max·h < 2.989`. Symplectic and reversible without dampers: the energy oscillates by O(h⁴) and does not drift;
//! linear and, with quaternions, angular momentum are conserved to rounding; with damped bushings and points on lines,
//! whose law does not conserve it, only the linear one. The free rotor is of fourth order; planar motion needs one
//! exact rotation. Dampers are pairwise damper passes of half a step before and after (see [`crate::damping`]), never
//! within a step, some of whose substeps are negative: second order then.

use crate::compositions::PEFRL;
use crate::damping::Damping;
use crate::geometry::Geometry;
use crate::keep::NoStorage;
use crate::model::Terms;
use crate::schemes::Scheme;
use crate::schemes::compose::compose;
use crate::status::Cause;
use crate::step::Stepper;

/// Five drifts around four kicks.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(all(feature = "defmt", target_os = "none"), derive(defmt::Format))]
pub struct Pefrl;

impl Scheme for Pefrl {
    const NAME: &'static str = "pefrl";
    const ORDER: u32 = 4;
    const ORDER_DAMPED: u32 = 2;
    const DAMPING: Damping = Damping::Sweeps;
    const SETTLES: bool = false;
    type Memory<P: Geometry> = ();
    type Storage = NoStorage;

    fn evaluations(&self) -> u32 {
        PEFRL.kicks.len() as u32
    }

    fn stability_limit(&self) -> f64 {
        2.989
    }

    #[inline(always)]
    fn step<P: Geometry, T: Terms<P>>(
        &self,
        stepper: &mut Stepper<'_, '_, P, T, ()>,
    ) -> Result<(), Cause> {
        compose(stepper, &PEFRL)
    }
}
