//! A plant: a model, a scheme, a step and the state they drive.
//!
//! `(model, scheme, h) => plant; step: state => state`. Nothing is allocated; all memory lies in
//! the plant, in the shape of its model. A plant holds its model by any pointer: `&M` borrows it,
//! from flash or from a stack; with a heap, `Arc<M>` or `Box<M>` owns it.

use core::ops::Deref;

use crate::attitude::Attitude as _;
use crate::damping::{Damping, Held, Pose, Share, find, share, weigh};
use crate::elements::input::{Input, InputKind};
use crate::extents::first_excess;
use crate::forces::{Unpushed, Wrench, are_in_line, find_rests};
use crate::frequency::bound;
use crate::geometry::Geometry;
use crate::guards::{first_beyond, first_fault};
use crate::index::{BodyIndex, InputIndex};
use crate::keep::{Keep, Kept};
use crate::laws::Laws as _;
use crate::model::{FrameOf, LawShares, LawsIn, ModelOwner, ModelRef, RealOf, SpaceOf, Terms};
use crate::pose::{Places, place_bodies};
use crate::real::Real;
pub use crate::refusal::{InputError, PlantError, StateError};
use crate::schedule::{KnotStep, LoadWindow, Signal, StageTime, sample};
use crate::schemes::Scheme;
use crate::sensors::sample_over;
use crate::solve;
use crate::sources::{self, SourceStep};
use crate::state::State;
use crate::status::{Cause, Failure, MOST_TURN, Status};
use crate::step::{Diagonal, Ledger, Stepper, Workspace};
use crate::words::{Finite, is_finite};

/// A model stepped by a scheme at a fixed step. `H` points to the model: `&M`, or a pointer that
/// owns it.
pub struct Plant<H, S>
where
    H: Deref<Target: ModelOwner + Sized>,
    S: Scheme,
{
    model: H,
    scheme: S,
    step_size: f64,
    h: RealOf<H::Target>,
    diagonals: PerBody<H, Diagonal<SpaceOf<H::Target>>>,
    rests: PerTsda<H>,
    shares: <H::Target as ModelOwner>::PerDamper<Share<RealOf<H::Target>>>,
    law_shares: LawShares<H::Target>,
    kept: Kept<S::Keeps, H::Target>,
    windows: <H::Target as ModelOwner>::PerLoad,
    knots: <H::Target as ModelOwner>::PerKnot,
    sources: <H::Target as ModelOwner>::PerSource,
    state: State<H::Target>,
    frames: PerBody<H, FrameOf<H::Target>>,
    wrenches: PerBody<H, Wrench<SpaceOf<H::Target>>>,
    unpushed: <H::Target as ModelOwner>::PerInput<Unpushed<SpaceOf<H::Target>>>,
    sums: <H::Target as ModelOwner>::PerDampedBody<<PrecisionOf<H> as Geometry>::PassSum>,
    memory: MemoryOf<H, S>,
    in_line: bool,
    ledger: Ledger,
    status: Status,
}

/// What the precision of the model that `H` points to keeps of its TSDAs.
type PerTsda<H> = <<H as Deref>::Target as ModelOwner>::PerTsda<<PrecisionOf<H> as Geometry>::Rest>;
/// The precision of the model that `H` points to.
type PrecisionOf<H> = <<H as Deref>::Target as ModelOwner>::Precision;
/// What a scheme remembers of each body of the model that `H` points to.
pub(crate) type MemoryOf<H, S> =
    PerBody<H, <S as Scheme>::Memory<<<H as Deref>::Target as ModelOwner>::Precision>>;
/// The signals of the inputs of the model that `H` points to.
type SignalsOf<H> =
    <<H as Deref>::Target as ModelOwner>::PerInput<Signal<RealOf<<H as Deref>::Target>>>;
/// One `T` per body of the model that `H` points to.
type PerBody<H, T> = <<H as Deref>::Target as ModelOwner>::PerBody<T>;

impl<H, S> Plant<H, S>
where
    H: Deref<Target: ModelOwner + Sized>,
    S: Scheme,
{
    /// A plant at its model's initial state, with the step `step_size` \[s\], which is rounded
    /// once to the precision. The diagonals of the inverse Jacobian are computed here.
    ///
    /// # Errors
    /// [`PlantError::Step`] where the rounded step is not positive and finite, [`PlantError::Extent`] where
    /// a part of the model is beyond what the precision holds.
    pub fn new(model: H, scheme: S, step_size: f64) -> Result<Self, PlantError> {
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
        let mut shares = owner.per_damper(Share::ALONE);
        let mut law_shares = view.laws.shares();
        match view.laws.memory() {
            Some((law, need)) if !S::bears(need) => return Err(PlantError::Memory(law)),
            _ => {}
        }
        if S::Keeps::MATRIX && !is_planned(owner) {
            return Err(PlantError::Plan);
        }
        let mut kept = S::Keeps::memory(owner);
        let levers = &mut kept.levers;
        let mut ledger = Ledger::default();
        let damped = <H::Target as ModelOwner>::Terms::DAMPERS || view.laws.is_damped();
        if damped && !matches!(S::DAMPING, Damping::Explicit | Damping::Implicit) {
            let (bodies, signals) = (state.bodies.as_ref(), state.signals.as_ref());
            place_bodies(bodies, frames.as_mut());
            let places = Places { frames: frames.as_ref(), signals };
            let half = RealOf::<H::Target>::HALF * h;
            if S::DAMPING == Damping::JointWise {
                ledger.stops = find(&view, places, half, levers.as_mut());
            }
            let (mut held, shares) = (owner.per_body(Held::default()), shares.as_mut());
            let memories = (state.turns.as_ref(), &state.laws);
            let pose = Pose { model: &view, places, bodies, memories, levers: levers.as_ref() };
            share(&pose, held.as_mut(), (shares, &mut law_shares));
            weigh(&view, shares, half, levers.as_mut());
        }
        if S::Keeps::MATRIX {
            place_bodies(state.bodies.as_ref(), frames.as_mut());
            let places = Places { frames: frames.as_ref(), signals: state.signals.as_ref() };
            if let Some(most) = S::MOST_VIBRATION {
                let (most, found) = (RealOf::<H::Target>::constant(most), bound(owner, &state));
                let holds = found * h <= most;
                if !holds {
                    return Err(PlantError::Stiff((most / found).to_f64()));
                }
            }
            solve::find(&view, places, scheme.pencil(h), kept.seats.as_mut());
            if S::Keeps::HALVES {
                let pencil = scheme.pencil(RealOf::<H::Target>::HALF * h);
                solve::find(&view, places, pencil, kept.half_seats.as_mut());
            }
        }
        let wrenches = owner.per_body(Wrench::default());
        let unpushed = owner.per_input([Wrench::default(); 2]);
        let sums = owner.per_damped_body(Default::default());
        let memory = owner.per_body(S::Memory::default());
        let in_line = are_in_line(&view);
        let mut plant = Self {
            model,
            scheme,
            step_size,
            h,
            diagonals,
            rests,
            shares,
            law_shares,
            kept,
            windows,
            knots,
            sources,
            state,
            frames,
            wrenches,
            unpushed,
            sums,
            memory,
            in_line,
            ledger,
            status: Status::Running,
        };
        plant.sample();
        Ok(plant)
    }

    /// Brings the signals of tables to the present step: the one that comes next.
    #[inline(always)]
    fn sample(&mut self) {
        if <H::Target as ModelOwner>::Terms::INPUTS {
            let view = self.model.view();
            let knots = self.knots.as_ref();
            let start =
                StageTime { step: self.state.step, part: RealOf::<H::Target>::ZERO, h: self.h };
            let signals = self.state.signals.as_mut();
            let mut changed = sample(view.inputs, view.knots, knots, start, signals);
            if <H::Target as ModelOwner>::Terms::SOURCES && !view.sources.is_empty() {
                changed |= sources::sample(
                    view.sources,
                    view.knots,
                    self.sources.as_ref(),
                    knots,
                    start,
                    signals,
                );
                changed |= sample_over(&*self.model, &mut self.state, knots);
            }
            if changed {
                let moves = view.inputs.iter().any(moves_ground);
                self.change(moves);
            }
        }
    }

    /// Takes note of an input's new signal.
    #[inline(always)]
    fn change(&mut self, moves_ground: bool) {
        self.ledger.pushed = false;
        self.ledger.fresh &= !(moves_ground || self.model.view().laws.is_driven());
    }

    /// The signals of the inputs at `part` of the coming step, 0 to 1: what its stages see. At 1 they are
    /// those before what jumps there.
    pub fn signals_at(&self, part: RealOf<H::Target>) -> SignalsOf<H> {
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

    /// One step. A failure latches: the state stays as the failed step left it, and later calls
    /// change nothing and return the same failure.
    #[inline]
    pub fn step(&mut self) -> Status {
        if !self.status.is_running() {
            return self.status;
        }
        // Counted before it is done: nothing of the counter is then kept through it.
        let step = self.state.step;
        let Some(next) = step.checked_add(1) else { return self.fail(Cause::Steps) };
        self.state.step = next;
        let cause = match self.attempt(step) {
            Ok(()) => self.fault(),
            Err(cause) => Some(cause),
        };
        if let Some(cause) = cause {
            return self.fail(cause);
        }
        self.sample();
        Status::Running
    }

    /// One step without the guards and whatever the status, which it leaves: for those who guard
    /// otherwise, as who steps lanes must. A step counter at its end begins anew.
    ///
    /// # Errors
    /// What the scheme could not do.
    #[inline(always)]
    pub fn step_unguarded(&mut self) -> Result<(), Cause> {
        let step = self.state.step;
        self.state.step = step.wrapping_add(1);
        let done = self.attempt(step);
        self.sample();
        done
    }

    /// What the scheme does in the step of this number.
    #[inline(always)]
    fn attempt(&mut self, step: u64) -> Result<(), Cause> {
        let model = self.model.view();
        let workspace = Workspace {
            model,
            h: self.h,
            diagonals: self.diagonals.as_ref(),
            rests: self.rests.as_ref(),
            shares: self.shares.as_ref(),
            levers: self.kept.levers.as_mut(),
            plan: self.model.plan(),
            seats: self.kept.seats.as_ref(),
            half_seats: self.kept.half_seats.as_ref(),
            blocks: self.kept.bodies.as_mut(),
            pair_blocks: self.kept.pairs.as_mut(),
            windows: self.windows.as_ref(),
            knots: self.knots.as_ref(),
            sources: self.sources.as_ref(),
            signals: self.state.signals.as_mut(),
            bodies: self.state.bodies.as_mut(),
            turns: self.state.turns.as_mut(),
            law_states: &mut self.state.laws,
            law_shares: &self.law_shares,
            step,
            frames: self.frames.as_mut(),
            wrenches: self.wrenches.as_mut(),
            unpushed: self.unpushed.as_mut(),
            sums: self.sums.as_mut(),
            in_line: self.in_line,
            ledger: &mut self.ledger,
        };
        self.scheme.step(&mut Stepper { workspace, memory: self.memory.as_mut() })
    }

    /// Latches a failure.
    #[cold]
    pub(crate) fn fail(&mut self, cause: Cause) -> Status {
        self.ledger.fresh = false;
        self.ledger.ready = false;
        self.ledger.begun = false;
        self.status = Status::Failed(Failure { cause, step: self.state.step });
        self.status
    }

    /// Looks at the state with the bodies' frames brought to it.
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

    /// What the guards of a step find wrong with the present state: a body that is not finite or turns
    /// too far in a step, or a turn count at its end. After a failure it may be the one that failed;
    /// before [`Self::clear`] it tells whether the next step can go well.
    #[inline]
    #[must_use]
    pub fn fault(&self) -> Option<Cause> {
        let (bodies, turns) = (self.state.bodies.as_ref(), self.state.turns.as_ref());
        let limits = (self.h, S::MOST_TURN);
        match first_fault::<_, <H::Target as ModelOwner>::Terms>(bodies, turns, limits) {
            Some(Cause::Spin { body }) if S::MOST_TURN.single < MOST_TURN as f32 => {
                Some(Cause::Turn { body })
            }
            None => first_beyond(bodies),
            some => some,
        }
    }

    /// Forgets a failure and leaves the state as it failed. What is not finite, spins too fast or is
    /// at its end fails again.
    pub fn clear(&mut self) {
        self.status = Status::Running;
    }

    /// `n` steps with held inputs, or as many as succeed.
    pub fn advance(&mut self, n: u64) -> Status {
        for _ in 0..n {
            if !self.step().is_running() {
                break;
            }
        }
        self.status
    }

    /// Sets an input \[N, N·m, or m for an anchor, then at rest\], within its range; it is held until set again.
    ///
    /// # Errors
    /// [`InputError`]; nothing is changed then.
    pub fn set_input(&mut self, input: InputIndex, value: f64) -> Result<(), InputError> {
        self.set_signal(input, value, 0.0)
    }

    /// [`Self::set_input`] with a value in the plant's own number: what a controller in single
    /// precision has at hand, without a way through double precision.
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

    /// Sets an input with its rate: for an anchor the displacement \[m\] and its velocity \[m/s\],
    /// which its dampers feel; the other kinds do not use the rate. Each number is rounded once to
    /// the precision.
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
        if moves_ground(known) && !<H::Target as ModelOwner>::Precision::bears_shift(value) {
            return Err(InputError::Extent(input));
        }
        let now = Signal { value, rate };
        if *signal != now {
            *signal = now;
            let moves = moves_ground(known);
            self.change(moves);
        }
        Ok(())
    }

    /// Goes back to t = 0, as after [`Self::new`]: the model's initial state, a failure forgotten.
    pub fn reset(&mut self) {
        self.ledger.evaluations = 0;
        self.resume(State::initial(&*self.model));
    }

    /// Goes on from `state`, its step counter and signals included; a failure is forgotten.
    ///
    /// # Errors
    /// [`StateError`] where it is not of this model, not finite, or an orientation is not of unit
    /// length; nothing is changed then.
    pub fn set_state(&mut self, state: State<H::Target>) -> Result<(), StateError> {
        check(&state, &self.state)?;
        let inputs = self.model.view().inputs;
        let known = inputs.iter().zip(state.signals.as_ref());
        if let Some(row) = known.into_iter().position(|(input, signal)| {
            moves_ground(input) && !<H::Target as ModelOwner>::Precision::bears_shift(signal.value)
        }) {
            return Err(StateError::Signal(InputIndex(row as u16)));
        }
        self.resume(state);
        Ok(())
    }

    /// The scheme.
    pub fn scheme(&self) -> &S {
        &self.scheme
    }

    /// The status of the last step.
    pub fn status(&self) -> Status {
        self.status
    }

    /// The model.
    pub fn model(&self) -> &H::Target {
        &self.model
    }

    /// The state.
    pub fn state(&self) -> &State<H::Target> {
        &self.state
    }

    /// The step \[s\] as given.
    pub fn step_size(&self) -> f64 {
        self.step_size
    }

    /// The present time \[s\]: the number of steps times the step, never accumulated.
    pub fn time(&self) -> f64 {
        self.state.step as f64 * self.step_size
    }

    /// Force evaluations performed since t = 0.
    pub fn evaluations(&self) -> u64 {
        self.ledger.evaluations
    }

    /// Goes on from a state of this model as it is, a failure forgotten: [`Self::set_state`] for a
    /// state that a plant of it was in, which needs no look.
    pub fn resume(&mut self, state: State<H::Target>) {
        self.state = state;
        self.ledger.fresh = false;
        self.ledger.ready = false;
        self.ledger.moved = false;
        self.ledger.begun = false;
        self.status = Status::Running;
        self.sample();
    }

    /// What the scheme remembers of the bodies, where that is of the present state.
    pub(crate) fn remembered(&self) -> Option<&MemoryOf<H, S>> {
        (S::REMEMBERS && self.ledger.begun).then_some(&self.memory)
    }

    /// Goes on from a state with what the scheme remembers of it.
    pub(crate) fn resume_with(&mut self, state: State<H::Target>, memory: Option<MemoryOf<H, S>>) {
        self.resume(state);
        if let Some(memory) = memory {
            self.memory = memory;
            self.ledger.begun = true;
        }
    }

    /// Memory for what the scheme remembers.
    pub(crate) fn memory(&self) -> MemoryOf<H, S> {
        self.memory.clone()
    }

    /// FNV-1a 64 over the state's words.
    pub fn hash(&self) -> u64 {
        self.state.hash()
    }
}

/// Whether a model has a plan, and its own.
fn is_planned<M: ModelOwner>(model: &M) -> bool {
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

fn moves_ground<P: Geometry>(input: &Input<P>) -> bool {
    matches!(input.kind, InputKind::Anchor { .. })
}

/// Whether a plant in the state `own` can go on from `state`.
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
