//! The step of Discrete Body Dynamics in another reading: positions are predicted, too (P1).
//!
//! As [`crate::schemes::Dbd`] (Franco & Degani 2026, section 2.3), but the second evaluation of the AM2 mean is at the
//! predicted pose, `a(q_n ∘ h·v_p, v_p)`, and there is no BDF1 velocity in between. First order; two evaluations, one
//! more per Newton iteration; explicit dampers. It dissipates: a mode loses `½·h·ω²·E`, with iterations `h·ω²·E`.
//! Stable for `ω_max·h < √2`, and less with two iterations or more. Conserves linear momentum to rounding. For
//! reference only: the energies reported in the paper exclude it.

use crate::damping::Damping;
use crate::forces::{At, ExplicitDampers};
use crate::geometry::Geometry;
use crate::keep::NoStorage;
use crate::model::Terms;
use crate::real::Real;
use crate::schemes::dbd::iterate;
use crate::schemes::{DbdMemory, Scheme};
use crate::status::Cause;
use crate::step::Stepper;

/// Limits by number of iterations, rounded down: the bound at which `s ← 1 − z²·s` from `1 − z²/2` leaves (0, 1].
const LIMITS: [f64; 9] = [1.414, 1.414, 1.242, 1.242, 1.178, 1.178, 1.143, 1.143, 1.12];

/// Predict–evaluate–correct of positions and velocities, then Newton iterations, 0 by default.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(all(feature = "defmt", target_os = "none"), derive(defmt::Format))]
pub struct DbdP1 {
    /// Newton iterations with the two-diagonal inverse Jacobian.
    pub newton: u32,
}

impl Scheme for DbdP1 {
    const NAME: &'static str = "dbd-p1";
    const ORDER: u32 = 1;
    const ORDER_DAMPED: u32 = 1;
    const DAMPING: Damping = Damping::Explicit;
    const DRIVES: bool = true;
    type Memory<P: Geometry> = DbdMemory<P>;
    type Storage = NoStorage;

    fn evaluations(&self) -> u32 {
        2 + self.newton
    }

    fn stability_limit(&self) -> f64 {
        // With more iterations it decreases towards 1.
        LIMITS.get(self.newton as usize).copied().unwrap_or(1.0)
    }

    #[inline(always)]
    fn step<P: Geometry, T: Terms<P>>(
        &self,
        stepper: &mut Stepper<'_, '_, P, T, DbdMemory<P>>,
    ) -> Result<(), Cause> {
        stepper.evaluate::<ExplicitDampers>(At::Boundary)?;
        stepper.each(|memory, state, increment, h| {
            memory.predict(state, increment);
            memory.reposition(state, h);
        });
        stepper.sample_inputs(P::Real::ONE);
        stepper.evaluate::<ExplicitDampers>(At::Stage)?;
        stepper.each(|memory, state, last, h| {
            memory.correct(state, memory.mean(last));
            memory.reposition(state, h);
        });
        iterate(stepper, self.newton)
    }
}
