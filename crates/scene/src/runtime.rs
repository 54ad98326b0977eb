//! A model whose sizes are known at run time: vectors for the kernel's slices.
//!
//! `assembly => model in any precision`. Steps run the same code, with the same bits, as for a const model.

use dbd_kernel::elements::input::{Input, Knot};
use dbd_kernel::elements::source::{Source, SourceLaw};
use dbd_kernel::laws::Laws;
use dbd_kernel::model::Plan;
use dbd_kernel::model::{AllTerms, Group, LawsIn, ModelOwner, ModelRef};
use dbd_kernel::schedule::LoadWindow;
use dbd_kernel::schedule::{KnotStep, Signal};
use dbd_kernel::sources::SourceStep;
use dbd_kernel::space::Linear as _;
use dbd_kernel::words::Word;
use dbd_kernel::{
    Body, BodyState, F64, Geometry, InputIndex, Load, PointBushing, PointOnLine, Real, Revolute,
    State, TorsionSpring, Tsda, Universal,
};

use crate::elimination::Elimination;
use crate::laws::{LawList, Listed, convert_words};

/// A model on the heap, see [`dbd_kernel::Model`] for the fields.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SceneModel<P: Geometry> {
    /// Bodies in scene order, spiders after them.
    pub bodies: Vec<Body<P::Space>>,
    /// The bodies' states at t = 0.
    pub initial: Vec<BodyState<P>>,
    /// \[m/s²\] gravity, or empty.
    pub gravity: Vec<P::Vector>,
    /// Groups in the order in which their forces are summed.
    pub groups: Vec<Group>,
    /// \[m\] points of the groups, in the axes of their bodies.
    pub points: Vec<P::Local>,
    /// TSDAs of the groups.
    pub tsdas: Vec<Tsda<P::Real>>,
    /// Point bushings of the groups.
    pub bushings: Vec<PointBushing<P::Real>>,
    /// \[N·s/m, N·m·s/rad\] damping coefficients of groups and torsion springs.
    pub dampers: Vec<P::Real>,
    /// Torsion springs.
    pub torsions: Vec<TorsionSpring<P::Space>>,
    /// Loads.
    pub loads: Vec<Load<P::Space>>,
    /// Points on lines of the groups.
    pub lines: Vec<PointOnLine<P::Space>>,
    /// Inputs.
    pub inputs: Vec<Input<P>>,
    /// Knots of the inputs' tables.
    pub knots: Vec<Knot<P::Real>>,
    /// \[m\] clearances of groups.
    pub clearances: Vec<P::Real>,
    /// Revolute joints of bushings of the groups.
    pub revolutes: Vec<Revolute<P::Space>>,
    /// Universal joints of the groups.
    pub universals: Vec<Universal<P::Space>>,
    /// Sources that inputs follow.
    pub sources: Vec<Source<P>>,
    /// The list of laws, summed after all torsion springs.
    pub laws: LawList<P>,
    /// The elimination order; empty except for schemes with a matrix; see [`Self::planned`].
    pub plan: Elimination,
}

impl<P: Geometry> SceneModel<P> {
    /// The same model in another precision: stored constants are rounded once, derived ones recomputed.
    #[must_use]
    pub fn convert<Q: Geometry>(&self) -> SceneModel<Q> {
        SceneModel {
            bodies: self.bodies.iter().map(Body::convert).collect(),
            initial: self.initial.iter().map(BodyState::convert).collect(),
            gravity: self.gravity.iter().map(|g| Q::Vector::from_f64(g.to_f64())).collect(),
            groups: self.groups.clone(),
            points: self.points.iter().map(|p| Q::local_from_f64(P::local_to_f64(p))).collect(),
            tsdas: self.tsdas.iter().map(Tsda::convert).collect(),
            bushings: self.bushings.iter().map(PointBushing::convert).collect(),
            dampers: self.dampers.iter().map(|c| Q::Real::from_f64(c.to_f64())).collect(),
            torsions: self.torsions.iter().map(TorsionSpring::convert).collect(),
            loads: self.loads.iter().map(Load::convert).collect(),
            lines: self.lines.iter().map(PointOnLine::convert).collect(),
            inputs: self.inputs.iter().map(Input::convert).collect(),
            knots: self.knots.iter().map(Knot::convert).collect(),
            clearances: self.clearances.iter().map(|c| Q::Real::from_f64(c.to_f64())).collect(),
            revolutes: self.revolutes.iter().map(Revolute::convert).collect(),
            universals: self.universals.iter().map(Universal::convert).collect(),
            sources: self.sources.iter().map(Source::convert).collect(),
            laws: self.laws.convert(),
            plan: self.plan.clone(),
        }
    }

    /// The same model with an elimination order for an implicit scheme; unchanged where the plan is too large.
    #[must_use]
    pub fn planned(self) -> Self {
        let plan = Elimination::of(&self.view()).unwrap_or_default();
        Self { plan, ..self }
    }

    /// The first input whose value or table the precision cannot represent.
    #[must_use]
    pub fn unfit_input(&self) -> Option<InputIndex> {
        let of_source = |row: usize| self.sources.iter().find(|s| usize::from(s.input.0) == row);
        let is_fit = |(row, input): (usize, &Input<P>)| {
            input.is_finite(&self.knots)
                && of_source(row).is_none_or(|source| source.is_finite(&self.knots))
        };
        let row = self.inputs.iter().enumerate().position(|one| !is_fit(one))?;
        Some(InputIndex(row as u16))
    }

    /// Detaches an input from its table or source, so that the caller sets it; it starts at the table's first value, or
    /// at the offset of a sine.
    pub fn release(&mut self, input: InputIndex) {
        let row = self.sources.iter().position(|source| source.input == input);
        let source = row.map(|row| self.sources.remove(row));
        let Some(input) = self.inputs.get_mut(usize::from(input.0)) else { return };
        if let Some(source) = source {
            input.value = match source.law {
                SourceLaw::Sine { offset, .. } => offset,
                _ => source.knots_of(&self.knots).first().map_or(input.value, |knot| knot.value),
            };
        }
        if input.knots > 0 {
            input.value = self.knots[usize::from(input.knot)].value;
            input.knots = 0;
        }
    }

    /// Calls [`Self::release`] on every input; the model then contains no tables.
    pub fn release_all(&mut self) {
        (0..self.inputs.len()).for_each(|row| self.release(InputIndex(row as u16)));
        self.inputs.iter_mut().for_each(|input| input.knot = 0);
        self.knots.clear();
    }

    /// The number of elements that count as a TSDA (Franco & Degani 2026, Table 7b).
    #[must_use]
    pub fn tsda_count(&self) -> usize {
        let bushings = self.bushings.len() + self.revolutes.len() + self.universals.len();
        self.tsdas.len() + bushings + self.lines.len()
    }
}

/// A state of any owner and precision, as the state of the double-precision model of the scene.
#[must_use]
pub fn widen<M: ModelOwner>(state: &State<M>) -> State<SceneModel<F64>> {
    State {
        bodies: state.bodies.as_ref().iter().map(BodyState::convert).collect(),
        turns: state.turns.as_ref().to_vec(),
        laws: convert_words(&words_of(state), Word::F64),
        step: state.step,
        signals: state.signals.as_ref().iter().map(Signal::convert).collect(),
    }
}

/// A state in another precision, each number rounded once.
#[must_use]
pub fn rounded<P: Geometry>(state: &State<SceneModel<F64>>) -> State<SceneModel<P>> {
    State {
        bodies: state.bodies.iter().map(BodyState::convert).collect(),
        turns: state.turns.clone(),
        laws: convert_words(&state.laws, |x| P::Real::from_f64(x).word()),
        step: state.step,
        signals: state.signals.iter().map(Signal::convert).collect(),
    }
}

/// The words of the laws' memories in a state.
fn words_of<M: ModelOwner>(state: &State<M>) -> Vec<Word> {
    let mut list = Listed::default();
    LawsIn::<M::Precision, M::Terms>::visit(&state.laws, &mut list);
    list.0
}

impl<P: Geometry> ModelOwner for SceneModel<P> {
    type Precision = P;
    type Terms = AllTerms<LawList<P>>;
    type PerBody<T: Copy> = Vec<T>;
    type PerDampedBody<T: Copy> = Vec<T>;
    type PerTorsion = Vec<i32>;
    type PerLoad = Vec<LoadWindow>;
    type PerInput<T: Copy> = Vec<T>;
    type PerDamper<T: Copy> = Vec<T>;
    type PerTsda<T: Copy> = Vec<T>;
    type PerPair<T: Copy> = Vec<T>;
    type PerSlot<T: Copy> = Vec<T>;
    type PerKnot = Vec<KnotStep<P::Real>>;
    type PerSource = Vec<SourceStep>;

    fn view(&self) -> ModelRef<'_, P, AllTerms<LawList<P>>> {
        ModelRef {
            bodies: &self.bodies,
            gravity: &self.gravity,
            groups: &self.groups,
            points: &self.points,
            tsdas: &self.tsdas,
            bushings: &self.bushings,
            dampers: &self.dampers,
            torsions: &self.torsions,
            loads: &self.loads,
            lines: &self.lines,
            inputs: &self.inputs,
            knots: &self.knots,
            clearances: &self.clearances,
            revolutes: &self.revolutes,
            universals: &self.universals,
            sources: &self.sources,
            laws: &self.laws,
        }
    }

    fn initial(&self) -> &[BodyState<P>] {
        &self.initial
    }

    fn per_body<T: Copy>(&self, value: T) -> Vec<T> {
        vec![value; self.bodies.len()]
    }

    fn per_damped_body<T: Copy>(&self, value: T) -> Vec<T> {
        let none = self.dampers.is_empty() && !self.laws.is_damped();
        if none { Vec::new() } else { self.per_body(value) }
    }

    fn per_torsion(&self) -> Vec<i32> {
        vec![0; self.torsions.len() * P::Real::LANES]
    }

    fn per_load(&self) -> Vec<LoadWindow> {
        vec![LoadWindow::default(); self.loads.len()]
    }

    fn per_input<T: Copy>(&self, value: T) -> Vec<T> {
        vec![value; self.inputs.len()]
    }

    fn per_damper<T: Copy>(&self, value: T) -> Vec<T> {
        vec![value; self.dampers.len()]
    }

    fn per_pair<T: Copy>(&self, value: T) -> Vec<T> {
        vec![value; self.plan.pairs.len()]
    }

    fn per_slot<T: Copy>(&self, value: T) -> Vec<T> {
        vec![value; self.plan.slots.len()]
    }

    fn plan(&self) -> Plan<'_> {
        self.plan.plan()
    }

    fn per_tsda<T: Copy>(&self, value: T) -> Vec<T> {
        vec![value; self.tsdas.len()]
    }

    fn per_knot(&self) -> Self::PerKnot {
        vec![KnotStep::default(); self.knots.len()]
    }

    fn per_source(&self) -> Self::PerSource {
        vec![SourceStep::default(); self.sources.len()]
    }
}
