//! The part of a plant that is independent of its scheme: compiled once per kind of model.
//!
//! `(model, h) => diagonals, windows, state; signals, state => base`.

use core::ops::Deref;

use crate::attitude::Attitude as _;
use crate::body::Body;
use crate::damping::{DampingMode, Held, Pose, Share, find, share, weigh};
use crate::elements::input::Input;
use crate::elements::source::{Source, SourceLaw};
use crate::extents::first_excess;
use crate::forces::{Unpushed, Wrench, are_in_line, find_rests};
use crate::frequency::bound;
use crate::geometry::Geometry;
use crate::index::{BodyIndex, InputIndex};
use crate::keep::{Kept, Storage};
use crate::laws::{Laws as _, Need};
use crate::model::{FrameOf, LawShares, LawsIn, ModelOwner, ModelRef, RealOf, SpaceOf, Terms};
use crate::pose::{Places, place_bodies};
use crate::real::{Constant, Real};
use crate::refusal::{InputError, PlantError, StateError};
use crate::schedule::{KnotStep, LoadWindow, Signal, StageTime, sample};
use crate::sensors::sample_over;
use crate::solve::{self, LumpedJoint, MatrixWeights};
use crate::sources::{self, SourceStep};
use crate::state::State;
use crate::status::{Cause, Failure};
use crate::step::{Cache, Diagonal, Workspace, drive, sample_start};
use crate::words::{Finite, is_finite};

/// A model, a step and a state.
pub(crate) struct Base<H>
where
    H: Deref<Target: ModelOwner + Sized>,
{
    pub(crate) model: H,
    pub(crate) step_size: f64,
    pub(crate) h: RealOf<H::Target>,
    pub(crate) diagonals: PerBody<H, Diagonal<SpaceOf<H::Target>>>,
    pub(crate) rests: PerTsda<H>,
    pub(crate) shares: <H::Target as ModelOwner>::PerDamper<Share<RealOf<H::Target>>>,
    pub(crate) law_shares: LawShares<H::Target>,
    pub(crate) windows: <H::Target as ModelOwner>::PerLoad,
    pub(crate) knots: <H::Target as ModelOwner>::PerKnot,
    pub(crate) sources: <H::Target as ModelOwner>::PerSource,
    pub(crate) state: State<H::Target>,
    pub(crate) frames: PerBody<H, FrameOf<H::Target>>,
    pub(crate) wrenches: PerBody<H, Wrench<SpaceOf<H::Target>>>,
    pub(crate) unpushed: <H::Target as ModelOwner>::PerInput<Unpushed<SpaceOf<H::Target>>>,
    pub(crate) sums:
        <H::Target as ModelOwner>::PerDampedBody<<PrecisionOf<H> as Geometry>::PassSum>,
    pub(crate) in_line: bool,
    pub(crate) damped_laws: bool,
    pub(crate) cache: Cache,
    pub(crate) status: Result<(), Failure>,
}

/// The reference data of TSDAs in the precision of the model that `H` points to.
pub(crate) type PerTsda<H> =
    <<H as Deref>::Target as ModelOwner>::PerTsda<<PrecisionOf<H> as Geometry>::Rest>;
/// The precision of the model that `H` points to.
pub(crate) type PrecisionOf<H> = <<H as Deref>::Target as ModelOwner>::Precision;
/// The signals of the inputs of the model that `H` points to.
pub(crate) type SignalsOf<H> =
    <<H as Deref>::Target as ModelOwner>::PerInput<Signal<RealOf<<H as Deref>::Target>>>;
/// What a step of the model that `H` points to borrows.
pub(crate) type WorkspaceOf<'s, H> =
    Workspace<'s, 's, PrecisionOf<H>, <<H as Deref>::Target as ModelOwner>::Terms>;
/// One `T` per body of the model that `H` points to.
pub(crate) type PerBody<H, T> = <<H as Deref>::Target as ModelOwner>::PerBody<T>;

impl<H> Base<H>
where
    H: Deref<Target: ModelOwner + Sized>,
{
    /// At the model's initial state, with the step `step_size` \[s\].
    ///
    /// # Errors
    /// [`PlantError::Step`], [`PlantError::Extent`].
    pub(crate) fn new(model: H, step_size: f64) -> Result<Self, PlantError> {
        let h = RealOf::<H::Target>::from_f64(step_size);
        if !(h > RealOf::<H::Target>::ZERO && h.is_finite()) {
            return Err(PlantError::Step(step_size));
        }
        let owner = &*model;
        let view = owner.view();
        let excess = first_excess::<<H::Target as ModelOwner>::Precision, _, _>;
        if let Some(excess) = excess(&view, owner.initial(), step_size) {
            return Err(PlantError::Extent(excess));
        }
        let mut diagonals = owner.per_body(Diagonal::default());
        for (diagonal, body) in diagonals.as_mut().iter_mut().zip(view.bodies) {
            *diagonal = Diagonal::new(body, h);
            if <H::Target as ModelOwner>::Terms::DRIVEN && body.is_driven() {
                *diagonal = Diagonal::default();
            }
        }
        let mut windows = owner.per_load();
        for (window, load) in windows.as_mut().iter_mut().zip(view.loads) {
            *window = LoadWindow::new(load.from, load.until, step_size);
        }
        let mut knots = owner.per_knot();
        for (step, knot) in knots.as_mut().iter_mut().zip(view.knots) {
            *step = KnotStep::new(knot.time, step_size);
        }
        let mut sources = owner.per_source();
        if <H::Target as ModelOwner>::Terms::SOURCES {
            sources::place_knots(view.sources, view.knots, knots.as_mut());
            for (step, source) in sources.as_mut().iter_mut().zip(view.sources) {
                *step = SourceStep::new(source, view.knots, step_size);
            }
        }
        let state = State::initial(owner);
        let mut frames = owner.per_body(FrameOf::<H::Target>::default());
        let mut rests = owner.per_tsda(Default::default());
        if <H::Target as ModelOwner>::Precision::RESTS {
            place_bodies(state.bodies.as_ref(), frames.as_mut());
            find_rests(&view, frames.as_ref(), rests.as_mut());
        }
        let shares = owner.per_damper(Share::ALONE);
        let law_shares = view.laws.shares();
        let wrenches = owner.per_body(Wrench::default());
        let unpushed = owner.per_input([Wrench::default(); 2]);
        let sums = owner.per_damped_body(Default::default());
        let (in_line, damped_laws) = (are_in_line(&view), view.laws.is_damped());
        Ok(Self {
            model,
            step_size,
            h,
            diagonals,
            rests,
            shares,
            law_shares,
            windows,
            knots,
            sources,
            state,
            frames,
            wrenches,
            unpushed,
            sums,
            in_line,
            damped_laws,
            cache: Cache::default(),
            status: Ok(()),
        })
    }

    /// Refuses laws whose memories a scheme does not support.
    ///
    /// # Errors
    /// [`PlantError::Memory`].
    pub(crate) fn check_memory(&self, bears: fn(Need) -> bool) -> Result<(), PlantError> {
        match self.model.view().laws.memory() {
            Some((law, need)) if !bears(need) => Err(PlantError::Memory(law)),
            _ => Ok(()),
        }
    }

    /// Refuses driven bodies where a scheme does not support them.
    ///
    /// # Errors
    /// [`PlantError::Driven`] with the first of them.
    pub(crate) fn check_driven(&self, drives: bool) -> Result<(), PlantError> {
        if !<H::Target as ModelOwner>::Terms::DRIVEN || drives {
            return Ok(());
        }
        let driven = self.model.view().bodies.iter().position(Body::is_driven);
        driven.map_or(Ok(()), |row| Err(PlantError::Driven(BodyIndex(row as u16))))
    }

    /// Whether anything is damped.
    pub(crate) fn is_damped(&self) -> bool {
        <H::Target as ModelOwner>::Terms::DAMPERS || self.damped_laws
    }

    /// The damping modes of joints that are damped as a whole.
    pub(crate) fn find_modes(&mut self, modes: &mut [DampingMode<PrecisionOf<H>>]) {
        place_bodies(self.state.bodies.as_ref(), self.frames.as_mut());
        let places = Places { frames: self.frames.as_ref(), signals: self.state.signals.as_ref() };
        let half = RealOf::<H::Target>::HALF * self.h;
        self.cache.stops = find(&self.model.view(), places, half, modes);
    }

    /// The weight of each damper, and the damping modes of joints that are damped as a whole.
    pub(crate) fn find_shares(&mut self, modes: &mut [DampingMode<PrecisionOf<H>>]) {
        place_bodies(self.state.bodies.as_ref(), self.frames.as_mut());
        let view = self.model.view();
        let (bodies, signals) = (self.state.bodies.as_ref(), self.state.signals.as_ref());
        let places = Places { frames: self.frames.as_ref(), signals };
        let half = RealOf::<H::Target>::HALF * self.h;
        let mut held = self.model.per_body(Held::default());
        let shares = self.shares.as_mut();
        let memories = (self.state.turns.as_ref(), &self.state.laws);
        let pose = Pose { model: &view, places, bodies, memories, modes: &*modes };
        share(&pose, held.as_mut(), (&mut *shares, &mut self.law_shares));
        weigh(&view, shares, half, modes);
    }

    /// Refuses frequencies for which `ω·h` exceeds `most`.
    ///
    /// # Errors
    /// [`PlantError::Stiff`] with the longest step \[s\].
    pub(crate) fn check_stiffness(&self, most: Constant) -> Result<(), PlantError> {
        let most = RealOf::<H::Target>::constant(most);
        let found = bound(&*self.model, &self.state);
        let holds = found * self.h <= most;
        if holds { Ok(()) } else { Err(PlantError::Stiff((most / found).to_f64())) }
    }

    /// Each element's part of the matrix, from the matrix weights.
    pub(crate) fn find_lumped_joints(
        &mut self,
        matrix_weights: MatrixWeights<RealOf<H::Target>>,
        lumped_joints: &mut [LumpedJoint<SpaceOf<H::Target>>],
    ) {
        place_bodies(self.state.bodies.as_ref(), self.frames.as_mut());
        let places = Places { frames: self.frames.as_ref(), signals: self.state.signals.as_ref() };
        solve::find(&self.model.view(), places, matrix_weights, lumped_joints);
    }

    /// What a step borrows, and the step counter.
    #[inline(always)]
    pub(crate) fn workspace<'s, K: Storage>(
        &'s mut self,
        kept: &'s mut Kept<K, H::Target>,
    ) -> (WorkspaceOf<'s, H>, &'s mut u64) {
        let workspace = Workspace {
            model: self.model.view(),
            h: self.h,
            diagonals: self.diagonals.as_ref(),
            rests: self.rests.as_ref(),
            shares: self.shares.as_ref(),
            modes: kept.modes.as_mut(),
            plan: self.model.plan(),
            lumped_joints: kept.lumped_joints.as_ref(),
            half_lumped_joints: kept.half_lumped_joints.as_ref(),
            blocks: kept.bodies.as_mut(),
            pair_blocks: kept.pairs.as_mut(),
            windows: self.windows.as_ref(),
            knots: self.knots.as_ref(),
            sources: self.sources.as_ref(),
            signals: self.state.signals.as_mut(),
            bodies: self.state.bodies.as_mut(),
            turns: self.state.turns.as_mut(),
            law_states: &mut self.state.laws,
            law_shares: &self.law_shares,
            step: self.state.step,
            frames: self.frames.as_mut(),
            wrenches: self.wrenches.as_mut(),
            unpushed: self.unpushed.as_mut(),
            sums: self.sums.as_mut(),
            in_line: self.in_line,
            damped_laws: self.damped_laws,
            cache: &mut self.cache,
        };
        (workspace, &mut self.state.step)
    }

    /// Samples the signals of tables for the coming step.
    #[inline(always)]
    pub(crate) fn sample(&mut self) {
        let start = StageTime { step: self.state.step, part: RealOf::<H::Target>::ZERO, h: self.h };
        let steps = (self.knots.as_ref(), self.sources.as_ref());
        let signals = self.state.signals.as_mut();
        sample_start(&self.model.view(), steps, start, signals, &mut self.cache);
        self.sample_sensors();
        if <H::Target as ModelOwner>::Terms::DRIVEN {
            drive(&self.model.view(), self.state.signals.as_ref(), self.state.bodies.as_mut());
        }
    }

    /// Whether the model has tables over sensors.
    #[inline(always)]
    pub(crate) fn samples_sensors(&self) -> bool {
        let over = |source: &Source<_>| matches!(source.law, SourceLaw::Over { .. });
        <H::Target as ModelOwner>::Terms::SOURCES && self.model.view().sources.iter().any(over)
    }

    /// Samples the signals of tables over sensors for the coming step.
    #[inline(always)]
    pub(crate) fn sample_sensors(&mut self) {
        if self.samples_sensors() && sample_over(&*self.model, &mut self.state, self.knots.as_ref())
        {
            let view = self.model.view();
            self.cache.note_input(&view, view.inputs.iter().any(Input::moves_ground));
        }
    }

    /// The signals of the inputs at `part` of the coming step, 0 to 1, for its stages. At 1 they are those before a
    /// jump there.
    pub(crate) fn signals_at(&self, part: RealOf<H::Target>) -> SignalsOf<H> {
        let view = self.model.view();
        let knots = self.knots.as_ref();
        let at = StageTime { step: self.state.step, part, h: self.h };
        let mut signals = self.state.signals.clone();
        if <H::Target as ModelOwner>::Terms::INPUTS {
            sample(view.inputs, view.knots, knots, at, signals.as_mut());
            let steps = self.sources.as_ref();
            sources::sample(view.sources, view.knots, steps, knots, at, signals.as_mut());
        }
        signals
    }

    /// Latches a failure.
    #[cold]
    pub(crate) fn fail(&mut self, cause: Cause) -> Result<(), Failure> {
        self.cache.fresh = false;
        self.cache.ready = false;
        self.cache.begun = false;
        self.status = Err(Failure { cause, step: self.state.step });
        self.status
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
        place_bodies(self.state.bodies.as_ref(), self.frames.as_mut());
        let signals = self.state.signals.as_ref();
        look(&self.model.view(), Places { frames: self.frames.as_ref(), signals }, &self.state)
    }

    /// Sets an input with its rate.
    ///
    /// # Errors
    /// [`InputError`]; nothing is changed then.
    pub(crate) fn set_signal_real(
        &mut self,
        input: InputIndex,
        value: RealOf<H::Target>,
        rate: RealOf<H::Target>,
    ) -> Result<(), InputError> {
        let row = input.0 as usize;
        let view = self.model.view();
        let signal = self.state.signals.as_mut().get_mut(row);
        let (Some(known), Some(signal)) = (view.inputs.get(row), signal) else {
            return Err(InputError::Unknown(input));
        };
        let follows = <H::Target as ModelOwner>::Terms::SOURCES
            && view.sources.iter().any(|source| source.input == input);
        if known.knots > 0 || follows {
            return Err(InputError::Table(input));
        }
        if !(value.is_finite() && rate.is_finite()) {
            return Err(InputError::NotFinite(input));
        }
        let value = known.bounded(value);
        if known.moves_ground() && !<H::Target as ModelOwner>::Precision::bears_shift(value) {
            return Err(InputError::Extent(input));
        }
        let now = Signal { value, rate };
        if *signal != now {
            *signal = now;
            self.cache.note_input(&view, known.moves_ground());
        }
        Ok(())
    }

    /// Continues from `state`, including its step counter and signals; clears a failure.
    ///
    /// # Errors
    /// [`StateError`] where it is not of this model, not finite, or an orientation is not of unit
    /// length; nothing is changed then.
    pub(crate) fn set_state(&mut self, state: State<H::Target>) -> Result<(), StateError> {
        check(&state, &self.state)?;
        let inputs = self.model.view().inputs;
        let known = inputs.iter().zip(state.signals.as_ref());
        if let Some(row) = known.into_iter().position(|(input, signal)| {
            input.moves_ground() && !<H::Target as ModelOwner>::Precision::bears_shift(signal.value)
        }) {
            return Err(StateError::Signal(InputIndex(row as u16)));
        }
        self.resume(state);
        Ok(())
    }

    /// Continues from a state of this model without a check; clears a failure.
    pub(crate) fn resume(&mut self, state: State<H::Target>) {
        self.state = state;
        self.cache.fresh = false;
        self.cache.ready = false;
        self.cache.moved = false;
        self.cache.begun = false;
        self.status = Ok(());
        self.sample();
    }
}

/// Whether a model has an elimination order that fits it.
pub(crate) fn is_planned<M: ModelOwner>(model: &M) -> bool {
    let view = model.view();
    let groups = view.groups.iter().map(|group| [group.a.0, group.b.0]);
    let ends = groups.chain(view.torsions.iter().map(|spring| [spring.a.0, spring.b.0]));
    let states = view.laws.states();
    let of_laws = (0..view.laws.count()).map(|row| {
        let mut ends = [BodyIndex::WORLD.0; 2];
        view.laws.look(row, &states, &mut |law| ends = law.bodies().map(|end| end.0));
        ends
    });
    model.plan().fits(view.bodies.len(), ends.chain(of_laws))
}

/// Whether a plant in the state `own` can continue from `state`.
fn check<M: ModelOwner>(state: &State<M>, own: &State<M>) -> Result<(), StateError> {
    let counts =
        |s: &State<M>| (s.bodies.as_ref().len(), s.turns.as_ref().len(), s.signals.as_ref().len());
    if counts(state) != counts(own) {
        return Err(StateError::Count);
    }
    for (i, body) in state.bodies.as_ref().iter().enumerate() {
        let index = BodyIndex(i as u16);
        if !is_finite(body) {
            return Err(StateError::NotFinite(index));
        }
        if !M::Precision::is_within(&body.position) {
            return Err(StateError::Extent(index));
        }
        let q = body.orientation.to_f64();
        let norm: f64 = q.iter().map(|c| c * c).sum();
        let unit = (norm - 1.0).abs() < 2e-3;
        if !unit {
            return Err(StateError::Orientation(index));
        }
    }
    let mut finite = Finite(true);
    LawsIn::<M::Precision, M::Terms>::visit(&state.laws, &mut finite);
    if !finite.0 {
        return Err(StateError::Law);
    }
    for (i, signal) in state.signals.as_ref().iter().enumerate() {
        if !(signal.value.is_finite() && signal.rate.is_finite()) {
            return Err(StateError::Signal(InputIndex(i as u16)));
        }
    }
    Ok(())
}
