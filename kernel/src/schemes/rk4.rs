//! The classical Runge–Kutta scheme (Kutta 1901), orientations on their group (Munthe-Kaas 1999).
//!
//! Positions and velocities as in the textbook; an orientation is `q_n ∘ exp(u)`, and u is integrated by the same
//! weights with `u̇ = ω + ½·u×ω + ¹⁄₁₂·u×(u×ω)`, whose next term is of fifth order. Fourth order with and without
//! dampers, which are explicit forces; four evaluations. Stable for `ω_max·h < 2.828`; it dissipates `(ω·h)⁶/72` of a
//! mode's energy per step, and a damper limits the step to about 2.78·m/c. Conserves linear momentum to rounding,
//! angular momentum and energy to fourth order only: they drift.

use crate::body::{BodyState, Increment};
use crate::damping::Damping;
use crate::forces::{At, ExplicitDampers};
use crate::geometry::Geometry;
use crate::keep::NoStorage;
use crate::model::Terms;
use crate::real::Real as _;
use crate::rotation;
use crate::schemes::Scheme;
use crate::schemes::dbd::accelerate;
use crate::space::{Moment as _, Space};
use crate::status::Cause;
use crate::step::Stepper;

/// Four stages at the start, twice the middle and the end.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(all(feature = "defmt", target_os = "none"), derive(defmt::Format))]
pub struct Rk4;

/// The memory of [`Rk4`] for one body within a step.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Rk4Memory<P: Geometry> {
    /// The state at the step's start.
    start: BodyState<P>,
    /// The present stage's u, body axes.
    turned: P::Moment,
    /// Weighted sum of the stages' h·v̇.
    accelerations: Increment<P::Space>,
    /// Weighted sum of the stages' velocities and u̇.
    velocities: Increment<P::Space>,
}

impl Scheme for Rk4 {
    const NAME: &'static str = "rk4";
    const ORDER: u32 = 4;
    const ORDER_DAMPED: u32 = 4;
    const DAMPING: Damping = Damping::Explicit;
    type Memory<P: Geometry> = Rk4Memory<P>;
    type Storage = NoStorage;

    fn evaluations(&self) -> u32 {
        4
    }

    fn stability_limit(&self) -> f64 {
        2.828
    }

    #[inline(always)]
    fn step<P: Geometry, T: Terms<P>>(
        &self,
        stepper: &mut Stepper<'_, '_, P, T, Rk4Memory<P>>,
    ) -> Result<(), Cause> {
        let states = stepper.workspace.bodies.iter();
        for (memory, state) in stepper.memory.iter_mut().zip(states) {
            *memory = Rk4Memory { start: *state, ..Rk4Memory::default() };
        }
        let (half, one, two) = (P::Real::HALF, P::Real::ONE, P::Real::TWO);
        // The weight of each of the first three stages and the fraction of a step from the start to the next stage.
        for (i, (weight, part)) in [(one, half), (two, half), (two, one)].into_iter().enumerate() {
            let at = if i == 0 { At::Boundary } else { At::Stage };
            stepper.evaluate::<ExplicitDampers>(at)?;
            stepper.each(|memory, state, acceleration, h| {
                let velocity = memory.add(state, acceleration, weight);
                *state = memory.start;
                accelerate(state, scaled(acceleration, part));
                memory.turned = advance::<P>(state, velocity, part * h);
            });
            stepper.sample_inputs(part);
        }
        stepper.evaluate::<ExplicitDampers>(At::Stage)?;
        let sixth = P::Real::from_f64(1.0 / 6.0);
        stepper.each(|memory, state, acceleration, h| {
            memory.add(state, acceleration, one);
            *state = memory.start;
            accelerate(state, scaled(memory.accelerations, sixth));
            advance::<P>(state, memory.velocities, sixth * h);
        });
        Ok(())
    }
}

impl<P: Geometry> Rk4Memory<P> {
    /// Adds a stage to the sums; its velocity and u̇.
    #[inline(always)]
    fn add(
        &mut self,
        state: &BodyState<P>,
        acceleration: Increment<P::Space>,
        weight: P::Real,
    ) -> Increment<P::Space> {
        let (u, w) = (self.turned, P::spin(&state.angular_velocity));
        let across = u.commutator(w);
        let angular =
            w + across * P::Real::HALF + u.commutator(across) * P::Real::from_f64(1.0 / 12.0);
        let velocity = Increment { linear: P::velocity(&state.velocity), angular };
        self.accelerations = sum(self.accelerations, scaled(acceleration, weight));
        self.velocities = sum(self.velocities, scaled(velocity, weight));
        velocity
    }
}

/// Advances the pose by `velocity` over `time`; returns the rotation vector.
#[inline(always)]
fn advance<P: Geometry>(
    state: &mut BodyState<P>,
    velocity: Increment<P::Space>,
    time: P::Real,
) -> P::Moment {
    let turn = velocity.angular * time;
    P::translate(&mut state.position, velocity.linear * time);
    rotation::turn_by::<P>(&mut state.orientation, turn * P::Real::HALF);
    turn
}

#[inline(always)]
fn scaled<S: Space>(a: Increment<S>, factor: S::Real) -> Increment<S> {
    Increment { linear: a.linear * factor, angular: a.angular * factor }
}

#[inline(always)]
fn sum<S: Space>(a: Increment<S>, b: Increment<S>) -> Increment<S> {
    Increment { linear: a.linear + b.linear, angular: a.angular + b.angular }
}
