//! The step of Discrete Body Dynamics (Franco & Degani 2026, section 2.3; 2023).
//!
//! Predict–evaluate–correct of the velocities at frozen positions (AB1, BDF1, AM2), then semi-implicit positions, then
//! N Newton iterations of the first-order BDF at (q, v), with `J⁻¹ = [h·D⁻¹ 0; h²·D⁻¹ −h·I]`. For deviations from the
//! printed paper see `docs/schemes.md`. First order; three evaluations, one more per iteration. Without
//! velocity-dependent forces and iterations it is semi-implicit Euler: stable for `ω_max·h < 2`, the energy oscillates.
//! Any iteration halves the limit and dissipates `h·ω²·E` per mode. Dampers are explicit forces. Conserves linear
//! momentum to rounding, angular momentum to first order.

use crate::body::{BodyState, Increment};
use crate::damping::Damping;
use crate::forces::{At, ExplicitDampers};
use crate::geometry::Geometry;
use crate::keep::NoStorage;
use crate::model::Terms;
use crate::real::Real;
use crate::rotation;
use crate::schemes::Scheme;
use crate::status::Cause;
use crate::step::Stepper;

/// The paper's step with a fixed number of Newton iterations, 0 by default.
///
/// - predict (AB1): `v_p = v_n + (h·D⁻¹)·Q(q_n, v_n)`
/// - correct (BDF1): `v_c = v_n + (h·D⁻¹)·Q(q_n, v_p)`
/// - AM2: `v = v_n + ½·(h·D⁻¹)·(Q(q_n, v_n) + Q(q_n, v_c))`
/// - positions: `q = q_n ∘ h·v`
/// - each iteration: `v ← v_n + (h·D⁻¹)·Q`, `q ← q_n ∘ (h·v_n + (h²·D⁻¹)·Q)`
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(all(feature = "defmt", target_os = "none"), derive(defmt::Format))]
pub struct Dbd {
    /// Newton iterations with the two-diagonal inverse Jacobian.
    pub newton: u32,
}

/// The memory of the dbd schemes for one body within a step.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct DbdMemory<P: Geometry> {
    /// The state at the step's start.
    start: BodyState<P>,
    /// `(h·D⁻¹)·Q(q_n, v_n)`.
    first: Increment<P::Space>,
}

impl<P: Geometry> DbdMemory<P> {
    /// Stores the step's start; advances the state's velocity by AB1.
    #[inline(always)]
    pub(super) fn predict(&mut self, state: &mut BodyState<P>, first: Increment<P::Space>) {
        *self = DbdMemory { start: *state, first };
        accelerate(state, first);
    }

    /// Advances the velocities of the start by `increment`.
    #[inline(always)]
    pub(super) fn correct(&self, state: &mut BodyState<P>, increment: Increment<P::Space>) {
        state.velocity = self.start.velocity;
        state.angular_velocity = self.start.angular_velocity;
        accelerate(state, increment);
    }

    /// AM2 with the last evaluation: the mean of it and of the first.
    #[inline(always)]
    pub(super) fn mean(&self, last: Increment<P::Space>) -> Increment<P::Space> {
        let half = P::Real::HALF;
        Increment {
            linear: (self.first.linear + last.linear) * half,
            angular: (self.first.angular + last.angular) * half,
        }
    }

    /// Advances the pose of the start by the present velocities.
    #[inline(always)]
    pub(super) fn reposition(&self, state: &mut BodyState<P>, h: P::Real) {
        state.position = self.start.position;
        state.orientation = self.start.orientation;
        advance(state, h);
    }
}

impl Scheme for Dbd {
    const NAME: &'static str = "dbd";
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
        if self.newton == 0 { 2.0 } else { 1.0 }
    }

    #[inline(always)]
    fn step<P: Geometry, T: Terms<P>>(
        &self,
        stepper: &mut Stepper<'_, '_, P, T, DbdMemory<P>>,
    ) -> Result<(), Cause> {
        stepper.evaluate::<ExplicitDampers>(At::Boundary)?;
        stepper.each(|memory, state, increment, _| memory.predict(state, increment));
        stepper.evaluate::<ExplicitDampers>(At::Stage)?;
        stepper.each(|memory, state, increment, _| memory.correct(state, increment));
        stepper.evaluate::<ExplicitDampers>(At::Stage)?;
        stepper.each(|memory, state, last, h| {
            memory.correct(state, memory.mean(last));
            advance(state, h);
        });
        iterate(stepper, self.newton)
    }
}

/// The Newton iterations of the dbd schemes.
#[inline(always)]
pub(super) fn iterate<P: Geometry, T: Terms<P>>(
    stepper: &mut Stepper<'_, '_, P, T, DbdMemory<P>>,
    iterations: u32,
) -> Result<(), Cause> {
    let half = P::Real::HALF;
    for _ in 0..iterations {
        stepper.evaluate::<ExplicitDampers>(At::Stage)?;
        stepper.each(|memory, state, increment, h| {
            *state = memory.start;
            // h·v_n + (h²·D⁻¹)·Q, with h²·D⁻¹ = h·(h·D⁻¹).
            let linear = P::velocity(&state.velocity) * h + increment.linear * h;
            let angular = P::spin(&state.angular_velocity) * h + increment.angular * h;
            accelerate(state, increment);
            P::translate(&mut state.position, linear);
            rotation::turn_by::<P>(&mut state.orientation, angular * half);
        });
    }
    Ok(())
}

/// Adds an increment to the velocities.
#[inline(always)]
pub(super) fn accelerate<P: Geometry>(state: &mut BodyState<P>, increment: Increment<P::Space>) {
    P::accelerate(&mut state.velocity, increment.linear);
    P::spin_up(&mut state.angular_velocity, increment.angular);
}

/// `q ← q ∘ h·v`.
#[inline(always)]
fn advance<P: Geometry>(state: &mut BodyState<P>, h: P::Real) {
    P::translate(&mut state.position, P::velocity(&state.velocity) * h);
    let rate = P::spin(&state.angular_velocity);
    rotation::turn_by::<P>(&mut state.orientation, rate * (P::Real::HALF * h));
}
