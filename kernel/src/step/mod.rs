//! The building blocks of schemes: evaluation, kick, drift, on the memory of one plant.
//!
//! [`Workspace`] borrows model, state and scratch for steps. A kick changes velocities by
//! `(h·D⁻¹)·Q`, a drift changes poses; the diagonal ½·h·D⁻¹ is computed once per (model, step),
//! D the diagonal of masses and principal inertias (Franco & Degani 2026, eq. 7–8).

mod body;
mod damped;
mod drift;
mod driven;
mod solved;

pub(crate) use body::kick_body;
pub(crate) use driven::drive;

use core::ops::{Deref, DerefMut};

pub use crate::body::Diagonal;
use crate::body::{BodyState, Fall, Increment};
pub use crate::damping::Damping;
use crate::damping::{DampingMode, Share};
use crate::elements::input::Input;
use crate::forces::{self, Evaluation, Instant, Memories, Unpushed, Wrench};
pub use crate::forces::{At, Dampers, DampersLeft, DampersOfJoints, ExplicitDampers};
use crate::geometry::Geometry;
use crate::laws::Laws;
use crate::lockstep;
use crate::model::{LawsIn, ModelRef, Plan, SharesIn, StatesIn, Terms};
use crate::pose::Places;
use crate::real::Real;
use crate::rotation;
use crate::schedule::{self, KnotStep, LoadWindow, Signal, StageTime};
use crate::solve::LumpedJoint;
use crate::sources::{self, SourceStep};
use crate::space::{BlockOf, Linear as _, Moment as _, Space as _};
use crate::status::Cause;

/// The evaluation cache of a plant. Never part of the state: evaluating again gives the same bits.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(all(feature = "defmt", target_os = "none"), derive(defmt::Format))]
pub(crate) struct Cache {
    /// Force evaluations performed since t = 0.
    pub(crate) evaluations: u64,
    /// Whether frames and wrenches are those of the present pose except for inputs, without dampers and with updated
    /// revolution counts: a scheme that ends with an evaluation need not begin with one.
    pub(crate) fresh: bool,
    /// Whether the inputs' forces among them are those of the present signals.
    pub(crate) pushed: bool,
    /// Whether the joints' damping modes are those of the present pose, with its kick in place of the wrenches.
    pub(crate) ready: bool,
    /// Whether there was a drift since the laws' memories were last advanced.
    pub(crate) moved: bool,
    /// The number of entries of a joint-wise damper pass.
    pub(crate) stops: u16,
    /// Whether a scheme's memory belongs to the present state. Unlike the others part of a snapshot.
    pub(crate) begun: bool,
}

impl Cache {
    /// Records that an input has a new signal; `moves` tells whether it moves the ground.
    #[inline(always)]
    pub(crate) fn note_input<P: Geometry, T: Terms<P>>(
        &mut self,
        model: &ModelRef<'_, P, T>,
        moves: bool,
    ) {
        self.pushed = false;
        self.fresh &= !(moves || model.laws.is_driven());
    }
}

/// Samples the tables of a model's inputs at the start of a step.
#[inline(always)]
pub(crate) fn sample_start<P: Geometry, T: Terms<P>>(
    model: &ModelRef<'_, P, T>,
    (knots, sources): (&[KnotStep<P::Real>], &[SourceStep]),
    start: StageTime<P::Real>,
    signals: &mut [Signal<P::Real>],
    cache: &mut Cache,
) {
    if T::INPUTS {
        let mut changed = schedule::sample(model.inputs, model.knots, knots, start, signals);
        if T::SOURCES && !model.sources.is_empty() {
            changed |= sources::sample(model.sources, model.knots, sources, knots, start, signals);
        }
        if changed {
            cache.note_input(model, model.inputs.iter().any(Input::moves_ground));
        }
    }
}

/// Model, state and scratch of one plant, borrowed for one step, with the scheme's memory `S` per body.
///
/// A scheme is written with the methods of its [`Workspace`]: [`Workspace::evaluate`], [`Workspace::kick`],
/// [`Workspace::drift`], the damper passes, and with [`Self::each`] for scheme-specific operations.
pub struct Stepper<'s, 'm, P: Geometry, T: Terms<P>, S> {
    /// The part that does not depend on the scheme.
    pub(crate) workspace: Workspace<'s, 'm, P, T>,
    /// The scheme's memory per body.
    pub(crate) memory: &'s mut [S],
}

impl<'s, 'm, P: Geometry, T: Terms<P>, S> Deref for Stepper<'s, 'm, P, T, S> {
    type Target = Workspace<'s, 'm, P, T>;

    #[inline(always)]
    fn deref(&self) -> &Self::Target {
        &self.workspace
    }
}

impl<P: Geometry, T: Terms<P>, S> DerefMut for Stepper<'_, '_, P, T, S> {
    #[inline(always)]
    fn deref_mut(&mut self) -> &mut Self::Target {
        &mut self.workspace
    }
}

/// Model, state and scratch of one plant, borrowed for one step: the same for all schemes, so that its methods are
/// compiled once for all of them.
pub struct Workspace<'s, 'm, P: Geometry, T: Terms<P>> {
    /// The model.
    pub(crate) model: ModelRef<'m, P, T>,
    /// \[s\] the step size, rounded to the precision.
    pub(crate) h: P::Real,
    /// ½·h·D⁻¹ per body.
    pub(crate) diagonals: &'s [Diagonal<P::Space>],
    /// The reference data of TSDAs.
    pub(crate) rests: &'s [P::Rest],
    /// The dampers' weights.
    pub(crate) shares: &'s [Share<P::Real>],
    /// The joints' damping modes, empty where dampers act otherwise.
    pub(crate) modes: &'s mut [DampingMode<P>],
    /// The elimination order of the matrix, its lumped joints and its blocks; empty where the scheme has no matrix.
    pub(crate) plan: Plan<'m>,
    pub(crate) lumped_joints: &'s [LumpedJoint<P::Space>],
    /// The same for half a step, empty where the scheme has none.
    pub(crate) half_lumped_joints: &'s [LumpedJoint<P::Space>],
    pub(crate) blocks: &'s mut [BlockOf<P::Space>],
    pub(crate) pair_blocks: &'s mut [BlockOf<P::Space>],
    /// The loads' windows.
    pub(crate) windows: &'s [LoadWindow],
    /// The tables' knots among the steps.
    pub(crate) knots: &'s [KnotStep<P::Real>],
    /// The sources among the steps.
    pub(crate) sources: &'s [SourceStep],
    /// The inputs' signals.
    pub(crate) signals: &'s mut [Signal<P::Real>],
    /// The bodies' states.
    pub(crate) bodies: &'s mut [BodyState<P>],
    /// The torsion springs' revolution counts.
    pub(crate) turns: &'s mut [i32],
    /// The laws' memories.
    pub(crate) law_states: &'s mut StatesIn<P, T>,
    /// The weights of the laws' dampers.
    pub(crate) law_shares: &'s SharesIn<P, T>,
    /// The number of this step, from 0.
    pub(crate) step: u64,
    /// The bodies' frames.
    pub(crate) frames: &'s mut [P::Frame],
    /// The bodies' wrenches.
    pub(crate) wrenches: &'s mut [Wrench<P::Space>],
    /// The wrenches without inputs of each input's bodies.
    pub(crate) unpushed: &'s mut [Unpushed<P::Space>],
    /// The sums of a damper pass per body; may be empty without dampers.
    pub(crate) sums: &'s mut [P::PassSum],
    /// Whether the groups are uniform, see [`forces::are_in_line`].
    pub(crate) in_line: bool,
    /// Whether any law has dampers that may act.
    pub(crate) damped_laws: bool,
    /// The number of evaluations and the validity of the wrenches.
    pub(crate) cache: &'s mut Cache,
}

impl<P: Geometry, T: Terms<P>> Workspace<'_, '_, P, T> {
    /// \[s\] the step size, rounded to the precision.
    #[must_use]
    pub fn step_size(&self) -> P::Real {
        self.h
    }

    /// The bodies' states.
    #[must_use]
    pub fn bodies(&self) -> &[BodyState<P>] {
        self.bodies
    }

    /// Whether the model has any damper.
    #[inline]
    #[must_use]
    pub fn has_dampers(&self) -> bool {
        (T::DAMPERS && !self.model.dampers.is_empty())
            || (<LawsIn<P, T> as Laws<P>>::DAMPED && self.damped_laws)
    }

    /// Samples the tables of inputs for the coming step.
    #[inline(always)]
    pub(crate) fn sample_start(&mut self, step: u64) {
        let start = StageTime { step, part: P::Real::ZERO, h: self.h };
        let steps = (self.knots, self.sources);
        sample_start(&self.model, steps, start, self.signals, self.cache);
        if T::DRIVEN {
            drive(&self.model, self.signals, self.bodies);
        }
    }

    /// Sets the velocities of driven bodies for this step.
    #[inline(always)]
    pub(crate) fn drive_midway(&mut self) {
        if T::DRIVEN {
            let steps = (self.knots, self.sources);
            let at = (self.step, self.h);
            driven::drive_midway(&self.model, steps, at, self.signals, self.bodies);
        }
    }

    /// Samples the tables of inputs at the time of a stage, at `part` of this step, 0 to 1. A step begins with part 0;
    /// a scheme that never calls this holds its inputs over the step. A table over a sensor is held over the step by
    /// every scheme.
    #[inline(always)]
    pub fn sample_inputs(&mut self, part: P::Real) {
        if T::INPUTS {
            let at = StageTime { step: self.step, part, h: self.h };
            let ModelRef { inputs, knots, sources, .. } = self.model;
            let mut changed = schedule::sample(inputs, knots, self.knots, at, self.signals);
            if T::SOURCES && !self.sources.is_empty() {
                let (steps, knot_steps) = (self.sources, self.knots);
                changed |= sources::sample(sources, knots, steps, knot_steps, at, self.signals);
            }
            if changed {
                self.cache.fresh = false;
            }
        }
    }

    /// A force evaluation at the present pose: dampers act at the present velocities with [`ExplicitDampers`]; with
    /// [`DampersLeft`] they are left to [`Self::sweep_forward`] and its reverse. A step has at least one evaluation
    /// [`At::Boundary`].
    ///
    /// # Errors
    /// [`Cause::UndefinedTorsionAngle`] names the torsion spring whose torsion angle is undefined, [`Cause::Undefined`] the
    /// law.
    #[inline(always)]
    pub fn evaluate<D: Dampers>(&mut self, at: At) -> Result<(), Cause> {
        if P::Real::ONE_LANE {
            self.evaluate_apart::<D::Forces>(at, false)
        } else {
            self.evaluate_here::<D::Forces>(at, false)
        }
    }

    // Compiled once for all of a scheme's evaluations.
    fn evaluate_apart<D: Dampers>(&mut self, at: At, placed: bool) -> Result<(), Cause> {
        self.evaluate_here::<D>(at, placed)
    }

    /// [`Self::evaluate`] for a scheme with a single call; `placed` states whether the frames are those of the present
    /// pose. A model of all kinds, whose evaluation is large, has one copy of it for all schemes.
    ///
    /// # Errors
    /// As [`Self::evaluate`].
    #[inline(always)]
    pub(crate) fn evaluate_once<D: Dampers>(&mut self, at: At, placed: bool) -> Result<(), Cause> {
        if P::Real::ONE_LANE && T::ALL {
            self.evaluate_apart::<D::Forces>(at, placed)
        } else {
            self.evaluate_here::<D::Forces>(at, placed)
        }
    }

    // Inlined for lanes: they are stepped by a function with more target features than its callees.
    #[inline(always)]
    fn evaluate_here<D: Dampers>(&mut self, at: At, placed: bool) -> Result<(), Cause> {
        self.cache.evaluations += 1;
        self.cache.fresh = false;
        self.cache.ready = false;
        let moved = <LawsIn<P, T> as Laws<P>>::ADVANCES && at == At::Boundary && self.cache.moved;
        let advance = if moved { Some(self.h) } else { None };
        self.cache.moved &= !moved;
        forces::evaluate::<P, T, D>(
            &self.model,
            Instant {
                step: self.step,
                windows: self.windows,
                signals: self.signals,
                bodies: self.bodies,
                in_line: self.in_line,
                rests: self.rests,
                placed,
            },
            Memories { turns: self.turns, laws: self.law_states, at, advance },
            Evaluation { frames: self.frames, wrenches: self.wrenches, unpushed: self.unpushed },
        )?;
        self.cache.fresh = !D::ACT && at == At::Boundary;
        self.cache.pushed = true;
        Ok(())
    }

    /// Whether the wrenches are those of the present pose, its inputs and this step's loads, without dampers: the last
    /// evaluation was with [`DampersLeft`], [`At::Boundary`], and nothing has moved since,
    /// even in the last step.
    #[inline]
    #[must_use]
    pub fn is_fresh(&self) -> bool {
        self.is_placed() && self.cache.pushed
    }

    /// Updates the forces of inputs in the wrenches to the present signals where [`Self::is_fresh`] lacks only that: a
    /// controller that sets an input in every step costs no evaluation. Returns whether the wrenches are then valid, or,
    /// joint by joint, the kick in their place.
    #[inline(always)]
    pub fn refresh<D: Dampers>(&mut self) -> bool {
        if !self.is_placed() {
            return false;
        }
        if T::INPUTS && !self.cache.pushed {
            let places = Places { frames: &*self.frames, signals: &*self.signals };
            if !forces::take_back(&self.model, self.unpushed, self.wrenches) {
                return false;
            }
            forces::push(&self.model, places, self.wrenches);
            if D::JOINT_WISE && self.cache.ready {
                self.renew_kicks();
            }
            self.cache.pushed = true;
        }
        true
    }

    /// Whether the wrenches are those of the present pose and this step's loads except for inputs.
    #[inline(always)]
    fn is_placed(&self) -> bool {
        let step = self.step;
        self.cache.fresh && !(T::LOADS && self.windows.iter().any(|w| w.changes_at(step)))
    }

    /// Adds `scale·(h·D⁻¹)·Q` to the velocities, without the gyroscopic term.
    #[inline(always)]
    pub fn kick(&mut self, scale: P::Real) {
        if P::Real::ONE_LANE {
            if P::RESTS { self.kick_alone(scale) } else { self.kick_apart(scale) }
        } else {
            self.kick_here(scale);
        }
    }

    // Not inlined: long code would take registers from longer code.
    #[inline(never)]
    fn kick_alone(&mut self, scale: P::Real) {
        self.kick_here(scale);
    }

    #[inline]
    fn kick_apart(&mut self, scale: P::Real) {
        self.kick_here(scale);
    }

    #[inline(always)]
    fn kick_here(&mut self, scale: P::Real) {
        let fall = self.fall(scale);
        let rows = self.bodies.iter_mut().zip(self.wrenches.iter()).zip(self.diagonals);
        for ((state, wrench), diagonal) in rows {
            kick_body(state, wrench, diagonal, (scale, fall));
        }
    }

    /// \[m/s²\] gravity, `None` where weights are part of the wrenches.
    #[inline(always)]
    pub(crate) fn field(&self) -> Option<P::Vector> {
        let field = || self.model.gravity.first().copied().unwrap_or(P::Vector::ZERO);
        if P::HAS_GRAVITY_STEP && T::GRAVITY { Some(field()) } else { None }
    }

    /// \[m/s\] the increment by gravity in `scale` steps, likewise.
    #[inline(always)]
    pub(crate) fn fall(&self, scale: P::Real) -> Fall<P::Vector> {
        let change = self.field().map(|gravity| gravity * (scale * self.h));
        Fall { change, driven: T::DRIVEN }
    }

    /// Moves every body freely for `time` \[s\]: in translation, and as a free rotor (second order).
    #[inline(always)]
    pub fn drift(&mut self, time: P::Real) {
        self.move_all(None, time, false);
    }

    /// [`Self::kick`] and then [`Self::drift`], body by body: its velocities stay in registers.
    #[inline(always)]
    pub fn kick_and_drift(&mut self, scale: P::Real, time: P::Real) {
        self.move_all(Some(scale), time, false);
    }

    /// [`Self::drift`], including the bodies' frames.
    #[inline(always)]
    pub(crate) fn drift_and_place(&mut self, time: P::Real) {
        self.move_all(None, time, true);
    }

    /// [`Self::kick_and_drift`], including the bodies' frames.
    #[inline(always)]
    pub(crate) fn kick_drift_and_place(&mut self, scale: P::Real, time: P::Real) {
        // For a few bodies in the plane each of two loops is short enough to be unrolled, a combined one is not.
        if P::Space::PLANAR {
            self.kick(scale);
            return self.drift_and_place(time);
        }
        self.move_all(Some(scale), time, true);
    }

    /// [`Self::drift`] with a free rotor of fourth order; `time` may be negative.
    #[inline(always)]
    pub fn drift_of_order_four(&mut self, time: P::Real) {
        self.cache.fresh = false;
        self.cache.ready = false;
        for (state, body) in self.bodies.iter_mut().zip(self.model.bodies) {
            P::advance_position(&mut state.position, &state.velocity, time);
            let (q, w) = (&mut state.orientation, &mut state.angular_velocity);
            if P::Real::ONE_LANE {
                rotation::free_rotor_of_order_four::<P>(body, q, w, time);
            } else {
                lockstep::free_rotor_of_order_four::<P>(body, q, w, time);
            }
        }
    }
}

impl<P: Geometry, T: Terms<P>, S> Stepper<'_, '_, P, T, S> {
    /// [`Workspace::drift`].
    #[inline(always)]
    pub fn drift(&mut self, time: P::Real) {
        self.workspace.drift(time);
    }

    /// [`Workspace::kick_and_drift`].
    #[inline(always)]
    pub fn kick_and_drift(&mut self, scale: P::Real, time: P::Real) {
        self.workspace.kick_and_drift(scale, time);
    }

    /// [`Workspace::drift_of_order_four`].
    #[inline(always)]
    pub fn drift_of_order_four(&mut self, time: P::Real) {
        self.workspace.drift_of_order_four(time);
    }

    /// Visits every body with its memory, its state, `(h·D⁻¹)·Q` with its weight and the gyroscopic term
    /// `−ω × (I·ω)` at its present rate, Q its wrench at the last evaluation, and h.
    #[inline(always)]
    pub fn each(
        &mut self,
        mut visit: impl FnMut(&mut S, &mut BodyState<P>, Increment<P::Space>, P::Real),
    ) {
        let fall = self.workspace.fall(P::Real::ONE);
        let Workspace { bodies, model, wrenches, diagonals, cache, h, .. } = &mut self.workspace;
        cache.fresh = false;
        let rows = bodies
            .iter_mut()
            .zip(self.memory.iter_mut())
            .zip(model.bodies)
            .zip(wrenches.iter().zip(*diagonals));
        for (((state, memory), body), (wrench, diagonal)) in rows {
            let w = P::spin(&state.angular_velocity);
            let torque = wrench.torque - w.commutator(body.inertia.scale(w));
            let kick = diagonal.kick((wrench.force, torque), P::Real::ONE, fall);
            visit(memory, state, kick, *h);
        }
    }
}
