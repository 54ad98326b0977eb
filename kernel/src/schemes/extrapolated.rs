//! Generalised-α extrapolated: third order at any stiffness, three linear solves per step.
//!
//! Richardson (1911): a step h of [`GeneralizedAlpha`] and two of h/2 start from the same state; their errors have the
//! ratio 4 : 1. A third of their difference, filtered, is added to y₂, the state after the two:
//!
//! `y⁺ = y₂ + ⅓·W²·(y₂ − y₁)`, `W = (μ·M + γ·h·C + β·h²·K)⁻¹·μ·M`
//!
//! W is the identity for slow motion and removes fast motion: the errors of a vibration that the step does not
//! resolve do not have the ratio 4 : 1, and without W one of ω·h = 4.2 would grow by 1.2 per step. With W² and ρ∞ = ½
//! every vibration decays, at any frequency and damping; with W one of ω·h = 1.7 would grow by 1.002.
//!
//! The accelerations of the steps h and h/2 are stored separately, because they belong to different times. The step h
//! comes last, so that its factored matrix can be used for W. Where a step does not resolve the motion, this scheme may
//! gain energy, while [`GeneralizedAlpha`] loses it.

use core::mem::swap;

use crate::attitude::Attitude as _;
use crate::body::{BodyState, Increment};
use crate::damping::Damping;
use crate::forces::At;
use crate::geometry::Geometry;
use crate::keep::Matrices;
use crate::model::Terms;
use crate::real::{Constant, Real};
use crate::rotation;
use crate::schemes::Scheme;
use crate::schemes::generalized_alpha::{
    GeneralizedAlpha, GeneralizedAlphaMemory, Part, Remembers,
};
use crate::solve::MatrixWeights;
use crate::space::{Linear as _, Moment as _, Turn as _};
use crate::status::Cause;
use crate::step::Stepper;
use crate::words::{WordSource, WordVisitor};

/// Generalised-α of third order, three linear solves per step.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(all(feature = "defmt", target_os = "none"), derive(defmt::Format))]
pub struct GeneralizedAlpha3;

/// The extrapolated scheme. With ρ∞ below 0.45 some vibration grows; above, errors grow with ρ∞.
const STEPS: GeneralizedAlpha = GeneralizedAlpha::DEFAULT;
const THIRD: Constant = Constant::new(1.0 / 3.0);

/// The memory of [`GeneralizedAlpha3`] for one body: accelerations for the next step, poses within the step.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct GeneralizedAlpha3Memory<P: Geometry> {
    /// The accelerations of the half steps; during the step h those of that step.
    present: GeneralizedAlphaMemory<P>,
    /// The other accelerations.
    other: GeneralizedAlphaMemory<P>,
    /// The state at the step's start, then that after two half steps.
    kept: BodyState<P>,
}

impl<P: Geometry> Remembers<P> for GeneralizedAlpha3Memory<P> {
    #[inline(always)]
    fn accelerations(&mut self) -> &mut GeneralizedAlphaMemory<P> {
        &mut self.present
    }
}

impl Scheme for GeneralizedAlpha3 {
    const NAME: &'static str = "generalized-alpha-3";
    const ORDER: u32 = 3;
    // Third order where a step resolves the decay by dampers.
    const ORDER_DAMPED: u32 = 2;
    const DAMPING: Damping = Damping::Implicit;
    const REMEMBERS: bool = true;
    const MAX_TURN: Constant = GeneralizedAlpha::MAX_TURN;
    const MAX_VIBRATION: Option<Constant> = GeneralizedAlpha::MAX_VIBRATION;
    type Memory<P: Geometry> = GeneralizedAlpha3Memory<P>;
    type Storage = Matrices;

    fn evaluations(&self) -> u32 {
        3
    }

    fn stability_limit(&self) -> f64 {
        f64::INFINITY
    }

    #[inline(always)]
    fn matrix_weights<R: Real>(&self, h: R) -> MatrixWeights<R> {
        STEPS.matrix_weights(h)
    }

    fn visit_memory<P: Geometry>(memory: &Self::Memory<P>, visitor: &mut impl WordVisitor) {
        for accelerations in [&memory.present, &memory.other] {
            GeneralizedAlpha::visit_memory(accelerations, visitor);
        }
    }

    fn fill_memory<P: Geometry>(memory: &mut Self::Memory<P>, source: &mut impl WordSource) {
        for accelerations in [&mut memory.present, &mut memory.other] {
            GeneralizedAlpha::fill_memory(accelerations, source);
        }
    }

    #[inline]
    fn step<P: Geometry, T: Terms<P>>(
        &self,
        stepper: &mut Stepper<'_, '_, P, T, Self::Memory<P>>,
    ) -> Result<(), Cause> {
        let jumps = stepper.ground_jumps();
        let begins = !stepper.cache.begun || jumps;
        let (h, half, one) = (stepper.h, P::Real::HALF, P::Real::ONE);
        let states = stepper.workspace.bodies.iter();
        for (memory, state) in stepper.memory.iter_mut().zip(states) {
            memory.kept = *state;
        }
        let parts = [
            Part { h: h * half, end: half, half: true, begins, at: At::Stage },
            Part { h: h * half, end: one, half: true, begins: jumps, at: At::Boundary },
            Part { h, end: one, half: false, begins, at: At::Stage },
        ];
        for part in parts {
            if !part.half {
                // From the start again, with the memory of whole steps.
                stepper.sample_inputs(P::Real::ZERO);
                exchange(stepper);
            }
            STEPS.advance(stepper, part)?;
        }
        extrapolate(stepper);
        stepper.cache.begun = true;
        Ok(())
    }
}

/// Exchanges every body's state and memory with the stored state and the other memory.
#[inline(always)]
fn exchange<P: Geometry, T: Terms<P>>(
    stepper: &mut Stepper<'_, '_, P, T, GeneralizedAlpha3Memory<P>>,
) {
    for (state, memory) in stepper.workspace.bodies.iter_mut().zip(stepper.memory.iter_mut()) {
        swap(state, &mut memory.kept);
        swap(&mut memory.present, &mut memory.other);
    }
}

/// Restores the stored state after two half steps and adds the correction.
#[inline(always)]
fn extrapolate<P: Geometry, T: Terms<P>>(
    stepper: &mut Stepper<'_, '_, P, T, GeneralizedAlpha3Memory<P>>,
) {
    exchange(stepper);
    let third = P::Real::constant(THIRD);
    filter(stepper, |fine, coarse| pose_change::<P>(coarse, fine));
    stepper.correct(|state, _, change| {
        P::translate(&mut state.position, change.linear * third);
        rotation::turn_by::<P>(&mut state.orientation, change.angular * (P::Real::HALF * third));
    });
    filter(stepper, |fine, coarse| Increment {
        linear: P::velocity_change(&coarse.velocity, &fine.velocity),
        angular: P::spin_change(&coarse.angular_velocity, &fine.angular_velocity),
    });
    stepper.correct(|state, _, change| {
        P::accelerate(&mut state.velocity, change.linear * third);
        P::spin_up(&mut state.angular_velocity, change.angular * third);
    });
}

/// W² times the difference of both results, in place of the wrenches, its rotations in world axes.
#[inline(always)]
fn filter<P: Geometry, T: Terms<P>>(
    stepper: &mut Stepper<'_, '_, P, T, GeneralizedAlpha3Memory<P>>,
    difference: impl Fn(&BodyState<P>, &BodyState<P>) -> Increment<P::Space>,
) {
    let MatrixWeights { mass, .. } = STEPS.matrix_weights(stepper.h);
    for again in [false, true] {
        let Stepper { workspace, memory } = stepper;
        let rows = workspace.bodies.iter().zip(workspace.model.bodies).zip(memory.iter());
        let rows = rows.zip(workspace.frames.iter().zip(workspace.wrenches.iter_mut()));
        for (((state, body), memory), (frame, wrench)) in rows {
            let change = if again {
                let angular = P::moment_to_body(frame, wrench.torque);
                Increment { linear: wrench.force, angular }
            } else {
                difference(state, &memory.kept)
            };
            wrench.force = change.linear * (mass * body.mass);
            let torque = body.inertia.scale(change.angular) * mass;
            wrench.torque = P::moment_to_world(frame, torque);
        }
        workspace.solve_again();
    }
}

/// The difference of a body's pose to another, the rotation in body axes.
#[inline(always)]
fn pose_change<P: Geometry>(from: &BodyState<P>, to: &BodyState<P>) -> Increment<P::Space> {
    let centre = |state: &BodyState<P>| {
        let frame = P::frame(&state.position, &state.orientation);
        P::place(&frame, &P::Local::default()).0
    };
    let turn = P::Orientation::relative(Some(&from.orientation), Some(&to.orientation));
    let mut angular = P::Moment::ZERO;
    for axis in P::Moment::axes() {
        // For a small rotation twice the vector part is the rotation vector, up to its third power.
        angular = angular + axis * (P::Real::TWO * turn.about(axis).1);
    }
    Increment { linear: P::displacement(&centre(from), &centre(to)), angular }
}
