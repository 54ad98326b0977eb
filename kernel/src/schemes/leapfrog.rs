//! Leapfrog: kick–drift–kick (velocity Verlet; Verlet 1967, Swope et al. 1982).
//!
//! Second order, symplectic and reversible without dampers: the energy oscillates and does not drift, also for a
//! tumbling body, whose free rotor is a splitting of second order. Linear and, with quaternions, angular momentum are
//! conserved to rounding; with damped bushings and points on lines, whose law does not conserve it, only the linear
//! one. One force evaluation per step: the last of a step is the first of the next, unless a load begins or ends or an
//! input changes that moves the ground, is gravity or is part of a law's force. Stable for `ω_max·h < 2`. Dampers are pairwise
//! damper passes of half a step, each including the preceding half kick (see [`crate::damping`]); they do not reduce
//! stability and keep second order.

use crate::damping::Damping;
use crate::forces::{At, Dampers, DampersLeft};
use crate::geometry::Geometry;
use crate::keep::NoStorage;
use crate::model::Terms;
use crate::real::Real;
use crate::schemes::{Kicked, Scheme};
use crate::status::Cause;
use crate::step::Stepper;

/// Kick–drift–kick.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(all(feature = "defmt", target_os = "none"), derive(defmt::Format))]
pub struct Leapfrog;

impl Scheme for Leapfrog {
    const NAME: &'static str = "leapfrog";
    const ORDER: u32 = 2;
    const ORDER_DAMPED: u32 = 2;
    const DAMPING: Damping = Damping::Sweeps;
    const ADVANCES: bool = true;
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

impl Kicked for Leapfrog {
    const EXPLICIT_EVALUATIONS: u32 = 2;

    #[inline(always)]
    fn step_with<P: Geometry, T: Terms<P>, D: Dampers>(
        stepper: &mut Stepper<'_, '_, P, T, ()>,
    ) -> Result<(), Cause> {
        // One call of the evaluation for both cases, so that it is inlined and a step is one function.
        let mut known = !D::ACT && stepper.refresh::<D>();
        let h = stepper.h;
        loop {
            if known {
                if D::ACT || !stepper.has_dampers() {
                    stepper.kick_drift_and_place(P::Real::HALF, h);
                } else {
                    stepper.damped_kick::<D, false>();
                    stepper.drift_and_place(h);
                }
                stepper.sample_inputs(P::Real::ONE);
            }
            stepper.evaluate_once::<D>(At::Boundary, known)?;
            if known {
                break;
            }
            known = true;
        }
        if D::ACT {
            stepper.kick(P::Real::HALF);
        } else {
            stepper.damped_kick::<D, true>();
        }
        Ok(())
    }
}
