//! The step of Discrete Body Dynamics (Franco & Degani 2026, section 2.3; 2023).
//!
//! Predict–evaluate–correct of the velocities at frozen positions, then semi-implicit positions,
//! then N Newton iterations of the first-order BDF:
//!
//! - predict (AB1): `v_p = v_n + (h·D⁻¹)·Q(q_n, v_n)`
//! - correct (BDF1): `v_c = v_n + (h·D⁻¹)·Q(q_n, v_p)`
//! - AM2: `v = v_n + ½·(h·D⁻¹)·(Q(q_n, v_n) + Q(q_n, v_c))`
//! - positions: `q = q_n ∘ h·v`
//! - each iteration, with `J⁻¹ = [h·D⁻¹ 0; h²·D⁻¹ −h·I]` on the BDF1 residual at (q, v):
//!   `v ← v_n + (h·D⁻¹)·Q`, `q ← q_n ∘ (h·v_n + (h²·D⁻¹)·Q)`
//!
//! Deviations from the paper's print: the gyroscopic term is `−ω × (I·ω)` (its eq. 4 has the sign
//! reversed), `h` stands where eq. 8 and 9 need it dimensionally, linear velocities are world,
//! orientations are quaternions, the number of iterations is fixed.
//! First order; three evaluations, one more per iteration. Without velocity-dependent forces and
//! iterations it is semi-implicit Euler: stable for `ω_max·h < 2`, the energy oscillates. Any
//! iteration halves the limit and dissipates `h·ω²·E` per mode. Dampers are explicit forces.

use crate::geometry::Geometry;
use crate::model::Terms;
use crate::real::Real;
use crate::rotation;
use crate::schemes::Scheme;
use crate::state::BodyState;
use crate::status::Cause;
use crate::step::{Increment, Stepper};

/// The paper's step with a fixed number of Newton iterations, 0 by default.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Dbd {
    /// Newton iterations with the two-diagonal inverse Jacobian.
    pub newton: u32,
}

/// What a step of [`Dbd`] remembers of one body.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct DbdMemory<P: Geometry> {
    /// The state at the step's start.
    start: BodyState<P>,
    /// `(h·D⁻¹)·Q(q_n, v_n)`.
    first: Increment<P::Real>,
}

impl Scheme for Dbd {
    const NAME: &'static str = "dbd";
    const ORDER: u32 = 1;
    const STABILITY_LIMIT: f64 = 2.0;
    type Memory<P: Geometry> = DbdMemory<P>;

    fn evaluations(&self) -> u32 {
        3 + self.newton
    }

    #[inline]
    fn step<P: Geometry, T: Terms>(
        &self,
        stepper: &mut Stepper<'_, '_, P, T, DbdMemory<P>>,
    ) -> Result<(), Cause> {
        stepper.evaluate::<true>(true)?;
        each(stepper, |memory, state, increment, _| {
            *memory = DbdMemory { start: *state, first: increment };
            accelerate(state, increment);
        });
        stepper.evaluate::<true>(false)?;
        each(stepper, |memory, state, increment, _| {
            restore_velocities(state, &memory.start);
            accelerate(state, increment);
        });
        stepper.evaluate::<true>(false)?;
        let half = P::Real::HALF;
        each(stepper, |memory, state, last, h| {
            let mean = Increment {
                linear: (memory.first.linear + last.linear) * half,
                angular: (memory.first.angular + last.angular) * half,
            };
            restore_velocities(state, &memory.start);
            accelerate(state, mean);
            P::translate(&mut state.position, P::velocity(&state.velocity) * h);
            let rate = P::velocity(&state.angular_velocity);
            rotation::turn_by::<P>(&mut state.orientation, rate * (half * h));
        });
        for _ in 0..self.newton {
            stepper.evaluate::<true>(false)?;
            each(stepper, |memory, state, increment, h| {
                *state = memory.start;
                // h·v_n + (h²·D⁻¹)·Q, with h²·D⁻¹ = h·(h·D⁻¹).
                let linear = P::velocity(&state.velocity) * h + increment.linear * h;
                let angular = P::velocity(&state.angular_velocity) * h + increment.angular * h;
                accelerate(state, increment);
                P::translate(&mut state.position, linear);
                rotation::turn_by::<P>(&mut state.orientation, angular * half);
            });
        }
        Ok(())
    }
}

/// Visits every body with its memory, its state, `(h·D⁻¹)·Q` and h.
#[inline(always)]
fn each<P: Geometry, T: Terms>(
    stepper: &mut Stepper<'_, '_, P, T, DbdMemory<P>>,
    mut visit: impl FnMut(&mut DbdMemory<P>, &mut BodyState<P>, Increment<P::Real>, P::Real),
) {
    let h = stepper.h;
    let rows = stepper
        .bodies
        .iter_mut()
        .zip(stepper.memory.iter_mut())
        .zip(stepper.model.bodies)
        .zip(stepper.wrenches.iter().zip(stepper.diagonals));
    for (((state, memory), body), (wrench, diagonal)) in rows {
        let increment =
            Stepper::<'_, '_, P, T, DbdMemory<P>>::increment(body, state, wrench, diagonal);
        visit(memory, state, increment, h);
    }
}

#[inline(always)]
fn accelerate<P: Geometry>(state: &mut BodyState<P>, increment: Increment<P::Real>) {
    P::accelerate(&mut state.velocity, increment.linear);
    P::accelerate(&mut state.angular_velocity, increment.angular);
}

#[inline(always)]
fn restore_velocities<P: Geometry>(state: &mut BodyState<P>, start: &BodyState<P>) {
    state.velocity = start.velocity;
    state.angular_velocity = start.angular_velocity;
}
