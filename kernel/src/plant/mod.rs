//! A plant: a model, a scheme, a step and their state.
//!
//! `(model, scheme, h) => plant; step: state => state`. Nothing is allocated; all memory is part of the plant, in the
//! shape of its model. A plant refers to its model by any pointer: `&M` borrows it, from flash or from a stack; with a
//! heap, `Arc<M>` or `Box<M>` owns it.

pub(crate) mod base;

use core::ops::Deref;

use crate::body::BodyState;
use crate::damping::Damping;
use crate::geometry::Geometry;
use crate::guards::{first_beyond, first_fault};
use crate::index::InputIndex;
use crate::keep::{Kept, Storage};
use crate::model::{ModelOwner, ModelRef, RealOf, Terms};
use crate::pose::Places;
use crate::real::Real;
pub use crate::refusal::{InputError, PlantError, StateError};
use crate::schemes::Scheme;
use crate::state::State;
use crate::status::{Cause, Failure, MAX_TURN};
use crate::step::{Stepper, Workspace};

use base::{Base, PerBody, SignalsOf};

/// A model stepped by a scheme at a fixed step. `H` points to the model: `&M`, or a pointer that owns it.
pub struct Plant<H, S>
where
    H: Deref<Target: ModelOwner + Sized>,
    S: Scheme,
{
    pub(crate) base: Base<H>,
    scheme: S,
    kept: Kept<S::Storage, H::Target>,
    memory: MemoryOf<H, S>,
}

/// A scheme's memory per body of the model that `H` points to.
pub(crate) type MemoryOf<H, S> =
    PerBody<H, <S as Scheme>::Memory<<<H as Deref>::Target as ModelOwner>::Precision>>;

impl<H, S> Plant<H, S>
where
    H: Deref<Target: ModelOwner + Sized>,
    S: Scheme,
{
    /// A plant at its model's initial state, with the step `step_size` \[s\], which is rounded
    /// once to the precision. The diagonals of the inverse Jacobian are computed here.
    ///
    /// # Errors
    /// [`PlantError::Step`] where the rounded step is not positive and finite, [`PlantError::Extent`] where a part of
    /// the model is beyond the range of the precision.
    pub fn new(model: H, scheme: S, step_size: f64) -> Result<Self, PlantError> {
        let mut base = Base::new(model, step_size)?;
        base.check_memory(S::bears)?;
        base.check_driven(S::DRIVES)?;
        if S::Storage::MATRIX && !base::is_planned(&*base.model) {
            return Err(PlantError::Plan);
        }
        let mut kept = S::Storage::memory(&*base.model);
        // Constants: a plant of another scheme contains none of it.
        if const { !matches!(S::DAMPING, Damping::Explicit | Damping::Implicit) }
            && base.is_damped()
        {
            if const { matches!(S::DAMPING, Damping::JointWise) } {
                base.find_modes(kept.modes.as_mut());
            }
            base.find_shares(kept.modes.as_mut());
        }
        if S::Storage::MATRIX {
            if let Some(most) = S::MAX_VIBRATION {
                base.check_stiffness(most)?;
            }
            base.find_lumped_joints(scheme.matrix_weights(base.h), kept.lumped_joints.as_mut());
            if S::Storage::HALVES {
                let matrix_weights = scheme.matrix_weights(RealOf::<H::Target>::HALF * base.h);
                base.find_lumped_joints(matrix_weights, kept.half_lumped_joints.as_mut());
            }
        }
        let memory = base.model.per_body(S::Memory::default());
        base.sample();
        Ok(Self { base, scheme, kept, memory })
    }

    /// The signals of the inputs at `part` of the coming step, 0 to 1, for its stages. At 1 they are those before a
    /// jump there.
    pub fn signals_at(&self, part: RealOf<H::Target>) -> SignalsOf<H> {
        self.base.signals_at(part)
    }

    /// One step.
    ///
    /// # Errors
    /// [`Failure`] names the cause and the step. It latches: the state stays as the failed step left it, and later
    /// calls change nothing and return the same failure.
    #[inline]
    pub fn step(&mut self) -> Result<(), Failure> {
        if self.base.status.is_err() {
            return self.base.status;
        }
        // Incremented first, so that no register holds the counter during the step.
        let step = self.base.state.step;
        let Some(next) = step.checked_add(1) else { return self.fail(Cause::Steps) };
        self.base.state.step = next;
        let cause = match self.attempt(step) {
            Ok(()) => self.fault(),
            Err(cause) => Some(cause),
        };
        if let Some(cause) = cause {
            return self.fail(cause);
        }
        self.base.sample();
        Ok(())
    }

    /// The scheme's step of this number.
    #[inline(always)]
    fn attempt(&mut self, step: u64) -> Result<(), Cause> {
        let Self { base, scheme, kept, memory } = self;
        let (mut workspace, _) = base.workspace(kept);
        workspace.step = step;
        workspace.drive_midway();
        scheme.step(&mut Stepper { workspace, memory: memory.as_mut() })
    }

    /// `n` steps with held inputs, or as many as succeed. Cheaper than `n` calls of [`Self::step`] where `n` is large;
    /// dearer for a single one.
    ///
    /// # Errors
    /// As [`Self::step`].
    pub fn advance(&mut self, n: u64) -> Result<(), Failure> {
        // The whole plant samples tables over sensors, so it is borrowed for one step at a time.
        let stride = if self.base.samples_sensors() { 1 } else { n };
        let mut left = n;
        while left > 0 && self.base.status.is_ok() {
            left -= stride;
            if let Err(cause) = self.run(stride) {
                return self.fail(cause);
            }
            self.base.sample_sensors();
        }
        self.base.status
    }

    /// `n` steps with their guards; what the steps borrow is gathered once.
    #[inline(always)]
    fn run(&mut self, n: u64) -> Result<(), Cause> {
        let Self { base, scheme, kept, memory } = self;
        let (workspace, counter) = base.workspace(kept);
        let mut stepper = Stepper { workspace, memory: memory.as_mut() };
        for _ in 0..n {
            stepper.workspace.step = *counter;
            stepper.workspace.drive_midway();
            *counter = counter.checked_add(1).ok_or(Cause::Steps)?;
            scheme.step(&mut stepper)?;
            let Workspace { bodies, turns, h, .. } = &stepper.workspace;
            if let Some(cause) = fault::<_, <H::Target as ModelOwner>::Terms, S>(bodies, turns, *h)
            {
                return Err(cause);
            }
            stepper.workspace.sample_start(*counter);
        }
        Ok(())
    }

    /// One step without the guards, whatever the status, which is unchanged: for callers with guards of their own, as
    /// lanes need. A step counter at its maximum restarts.
    ///
    /// # Errors
    /// The failure of the scheme.
    #[inline(always)]
    pub fn step_unguarded(&mut self) -> Result<(), Cause> {
        let step = self.base.state.step;
        self.base.state.step = step.wrapping_add(1);
        let done = self.attempt(step);
        self.base.sample();
        done
    }

    /// Latches a failure.
    #[cold]
    pub(crate) fn fail(&mut self, cause: Cause) -> Result<(), Failure> {
        self.base.fail(cause)
    }

    /// Passes the state, with the bodies' frames brought up to date.
    pub(crate) fn with_places<A>(
        &mut self,
        look: impl FnOnce(
            &ModelRef<'_, <H::Target as ModelOwner>::Precision, <H::Target as ModelOwner>::Terms>,
            Places<'_, <H::Target as ModelOwner>::Precision>,
            &State<H::Target>,
        ) -> A,
    ) -> A {
        self.base.with_places(look)
    }

    /// Applies the guards of a step to the present state: a body that is not finite or rotates too far in a step, or a
    /// revolution count that overflowed. After a failure it may be its cause; before [`Self::clear`] it shows whether
    /// the next step can succeed.
    #[inline]
    #[must_use]
    pub fn fault(&self) -> Option<Cause> {
        let (bodies, turns) = (self.base.state.bodies.as_ref(), self.base.state.turns.as_ref());
        fault::<_, <H::Target as ModelOwner>::Terms, S>(bodies, turns, self.base.h)
    }

    /// Clears a failure and leaves the state as it is. A state that is not finite, rotates too fast or has overflowed
    /// fails again.
    pub fn clear(&mut self) {
        self.base.status = Ok(());
    }

    /// Sets an input \[N, N·m, or m for an anchor, then at rest\], within its range; it is held until set again.
    ///
    /// # Errors
    /// [`InputError`]; nothing is changed then.
    pub fn set_input(&mut self, input: InputIndex, value: f64) -> Result<(), InputError> {
        self.set_signal(input, value, 0.0)
    }

    /// [`Self::set_input`] with a value in the plant's own number, for a controller in single precision, without double
    /// precision.
    ///
    /// # Errors
    /// [`InputError`]; nothing is changed then.
    pub fn set_input_real(
        &mut self,
        input: InputIndex,
        value: RealOf<H::Target>,
    ) -> Result<(), InputError> {
        self.set_signal_real(input, value, RealOf::<H::Target>::ZERO)
    }

    /// Sets an input with its rate: for an anchor the displacement \[m\] and its velocity \[m/s\], on which its dampers
    /// act, for a signal what its law makes of both; the other kinds do not use the rate. Each number is rounded once
    /// to the precision.
    ///
    /// # Errors
    /// [`InputError`]; nothing is changed then.
    pub fn set_signal(
        &mut self,
        input: InputIndex,
        value: f64,
        rate: f64,
    ) -> Result<(), InputError> {
        let [value, rate] = [value, rate].map(RealOf::<H::Target>::from_f64);
        self.set_signal_real(input, value, rate)
    }

    /// [`Self::set_signal`] in the plant's own number.
    ///
    /// # Errors
    /// [`InputError`]; nothing is changed then.
    pub fn set_signal_real(
        &mut self,
        input: InputIndex,
        value: RealOf<H::Target>,
        rate: RealOf<H::Target>,
    ) -> Result<(), InputError> {
        self.base.set_signal_real(input, value, rate)
    }

    /// Returns to t = 0, as after [`Self::new`]: the model's initial state, a failure cleared.
    pub fn reset(&mut self) {
        self.base.cache.evaluations = 0;
        self.resume(State::initial(&*self.base.model));
    }

    /// Continues from `state`, including its step counter and signals; clears a failure.
    ///
    /// # Errors
    /// [`StateError`] where it is not of this model, not finite, or an orientation is not of unit
    /// length; nothing is changed then.
    pub fn set_state(&mut self, state: State<H::Target>) -> Result<(), StateError> {
        self.base.set_state(state)
    }

    /// The scheme.
    pub fn scheme(&self) -> &S {
        &self.scheme
    }

    /// The result of the last step.
    ///
    /// # Errors
    /// The latched failure.
    pub fn status(&self) -> Result<(), Failure> {
        self.base.status
    }

    /// The model.
    pub fn model(&self) -> &H::Target {
        &self.base.model
    }

    /// The state.
    pub fn state(&self) -> &State<H::Target> {
        &self.base.state
    }

    /// The step \[s\] as given.
    pub fn step_size(&self) -> f64 {
        self.base.step_size
    }

    /// The present time \[s\]: the number of steps times the step, never accumulated.
    pub fn time(&self) -> f64 {
        self.base.state.step as f64 * self.base.step_size
    }

    /// Force evaluations performed since t = 0.
    pub fn evaluations(&self) -> u64 {
        self.base.cache.evaluations
    }

    /// Continues from a state of this model without a check, a failure cleared: [`Self::set_state`] for a state of a
    /// plant of the same model.
    pub fn resume(&mut self, state: State<H::Target>) {
        self.base.resume(state);
    }

    /// The scheme's memory of the bodies, where it belongs to the present state.
    pub(crate) fn remembered(&self) -> Option<&MemoryOf<H, S>> {
        (S::REMEMBERS && self.base.cache.begun).then_some(&self.memory)
    }

    /// Continues from a state with the scheme's memory of it.
    pub(crate) fn resume_with(&mut self, state: State<H::Target>, memory: Option<MemoryOf<H, S>>) {
        self.resume(state);
        if let Some(memory) = memory {
            self.memory = memory;
            self.base.cache.begun = true;
        }
    }

    /// Storage for the scheme's memory.
    pub(crate) fn memory(&self) -> MemoryOf<H, S> {
        self.memory.clone()
    }

    /// FNV-1a 64 over the state's words.
    pub fn hash(&self) -> u64 {
        self.base.state.hash()
    }
}

/// The first fault of a state after a step `h` of a scheme.
#[inline]
fn fault<P: Geometry, T: Terms<P>, S: Scheme>(
    bodies: &[BodyState<P>],
    turns: &[i32],
    h: P::Real,
) -> Option<Cause> {
    match first_fault::<P, T>(bodies, turns, (h, S::MAX_TURN)) {
        Some(Cause::Spin { body }) if S::MAX_TURN.single < MAX_TURN as f32 => {
            Some(Cause::Turn { body })
        }
        None => first_beyond(bodies),
        some => some,
    }
}
