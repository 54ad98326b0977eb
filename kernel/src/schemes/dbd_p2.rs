//! The step of Discrete Body Dynamics in another reading: positions follow every velocity (P2).
//!
//! As [`crate::schemes::DbdP1`] (Franco & Degani 2026, section 2.3), and the second evaluation of the AM2 mean is at
//! the BDF1-corrected state: `v_c = v_n + h·a(q_n ∘ h·v_p, v_p)`, then `a(q_n ∘ h·v_c, v_c)`. First order; three
//! evaluations, one more per Newton iteration; explicit dampers. It dissipates as P1 does, `½·h·ω²·E` per mode, with
//! iterations `h·ω²·E`. Stable for `ω_max·h < 1`. Conserves linear momentum to rounding. For reference only: the
//! energies reported in the paper exclude it.

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

/// Predict–evaluate–correct–evaluate of positions and velocities, then Newton iterations, 0 by
/// default.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(all(feature = "defmt", target_os = "none"), derive(defmt::Format))]
pub struct DbdP2 {
    /// Newton iterations with the two-diagonal inverse Jacobian.
    pub newton: u32,
}

impl Scheme for DbdP2 {
    const NAME: &'static str = "dbd-p2";
    const ORDER: u32 = 1;
    const ORDER_DAMPED: u32 = 1;
    const DAMPING: Damping = Damping::Explicit;
    const DRIVES: bool = true;
    type Memory<P: Geometry> = DbdMemory<P>;
    type Storage = NoStorage;

    fn evaluations(&self) -> u32 {
        3 + self.newton
    }

    fn stability_limit(&self) -> f64 {
        1.0
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
        stepper.each(|memory, state, increment, h| {
            memory.correct(state, increment);
            memory.reposition(state, h);
        });
        stepper.evaluate::<ExplicitDampers>(At::Stage)?;
        stepper.each(|memory, state, last, h| {
            memory.correct(state, memory.mean(last));
            memory.reposition(state, h);
        });
        iterate(stepper, self.newton)
    }
}
