//! Semi-implicit Euler: kick, then drift (symplectic Euler; de Vogelaere 1956).
//!
//! Equal to [`crate::schemes::Dbd`] without dampers, at a third of its evaluations; the free rotor is a splitting that
//! conserves the world's angular momentum. First order, one evaluation, stable for `ω_max·h < 2`. Symplectic without
//! dampers: the energy oscillates by O(h) and does not drift; linear and, with quaternions, angular momentum are
//! conserved to rounding; with damped bushings and points on lines, whose law does not conserve it, only the linear
//! one. With dampers the kick is split into halves, each followed by a pairwise damper pass that includes it (see
//! [`crate::damping`]); damper passes around the drift as well would lower the limit towards √2.

use crate::damping::Damping;
use crate::forces::{At, Dampers, DampersLeft};
use crate::geometry::Geometry;
use crate::keep::NoStorage;
use crate::model::Terms;
use crate::real::Real;
use crate::schemes::{Kicked, Scheme};
use crate::status::Cause;
use crate::step::Stepper;

/// Kick, then drift.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(all(feature = "defmt", target_os = "none"), derive(defmt::Format))]
pub struct SemiImplicitEuler;

impl Scheme for SemiImplicitEuler {
    const NAME: &'static str = "semi-implicit-euler";
    const ORDER: u32 = 1;
    const ORDER_DAMPED: u32 = 1;
    const DAMPING: Damping = Damping::Sweeps;
    const DRIVES: bool = true;
    type Memory<P: Geometry> = ();
    type Storage = NoStorage;

    fn evaluations(&self) -> u32 {
        1
    }

    fn stability_limit(&self) -> f64 {
        2.0
    }

    #[inline(always)]
    fn step<P: Geometry, T: Terms<P>>(
        &self,
        stepper: &mut Stepper<'_, '_, P, T, ()>,
    ) -> Result<(), Cause> {
        Self::step_with::<P, T, DampersLeft>(stepper)
    }
}

impl Kicked for SemiImplicitEuler {
    const EXPLICIT_EVALUATIONS: u32 = 1;

    #[inline(always)]
    fn step_with<P: Geometry, T: Terms<P>, D: Dampers>(
        stepper: &mut Stepper<'_, '_, P, T, ()>,
    ) -> Result<(), Cause> {
        stepper.evaluate_once::<D>(At::Boundary, false)?;
        if D::ACT || !stepper.has_dampers() {
            stepper.kick_and_drift(P::Real::ONE, stepper.h);
        } else {
            stepper.damped_kick::<D, false>();
            stepper.damped_kick::<D, true>();
            stepper.drift(stepper.h);
        }
        Ok(())
    }
}
