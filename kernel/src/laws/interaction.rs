//! The interface of an interaction: a law between two bodies.

use crate::elements::share::Share;
use crate::force_pair::Direction;
use crate::force_pair::ForcePair;
use crate::geometry::{F64, Geometry};
use crate::index::{BodyIndex, GroupIndex};
use crate::laws::branch::Branch;
use crate::laws::end::Seen;
use crate::laws::kind::{Field, FieldSink, FieldSource};
use crate::laws::several::Several;
use crate::real::Real;
use crate::space::Linear as _;
use crate::words::{WordSource, WordVisitor, Words};

/// The memory of a law without memory.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct NoStorage;

impl Words for NoStorage {
    fn visit(&self, _: &mut impl WordVisitor) {}
    fn fill(&mut self, _: &mut impl WordSource) {}
}

/// A damper along a direction: tension `c·(rate − r₀)` within bounds, as an impulse that is stable at any
/// coefficient (compare Shardlow 2003).
#[derive(Clone, Copy, Debug)]
pub struct Damper<P: Geometry> {
    /// \[N·s/m, N·m·s/rad\] coefficient c, ≥ 0.
    pub coefficient: P::Real,
    /// Where it acts.
    pub direction: Direction<P::Space>,
    /// \[m/s, rad/s\] the rate r₀ at which the tension is 0.
    pub rate: P::Real,
    /// \[N, N·m\] the smallest mean tension over its duration, at most 0, and the largest, at least 0.
    bounds: [P::Real; 2],
    /// Whether it is limited to stopping the rate.
    brakes: bool,
    /// \[1\] the fraction of the internal degree of freedom's rate in its rate.
    inner: P::Real,
}

/// Beyond any force; its product with any step is finite in single precision.
const MAX: f64 = 1e30;

impl<P: Geometry> Damper<P> {
    /// A damper towards zero rate, without bounds.
    #[inline(always)]
    #[must_use]
    pub fn new(coefficient: P::Real, direction: Direction<P::Space>) -> Self {
        let most = P::Real::from_f64(MAX);
        let zero = P::Real::ZERO;
        let bounds = [-most, most];
        Self { coefficient, direction, rate: zero, bounds, brakes: false, inner: zero }
    }

    /// A damper that does nothing.
    #[inline(always)]
    #[must_use]
    pub fn idle() -> Self {
        let moments = [P::Moment::ZERO; 2];
        Self::new(P::Real::ZERO, Direction { along: P::Vector::ZERO, moments })
    }

    /// Limits its tension \[N, N·m\]: `within(least, most)`. The range contains 0: a bound never exerts a force.
    #[inline(always)]
    #[must_use]
    pub fn within(self, least: P::Real, most: P::Real) -> Self {
        let zero = P::Real::ZERO;
        let least = P::Real::pick(zero.less_than(least), zero, least);
        let most = P::Real::pick(most.less_than(zero), zero, most);
        Self { bounds: [least, most], ..self }
    }

    /// The bounds \[N, N·m\], the smallest tension and the largest.
    #[inline(always)]
    #[must_use]
    pub fn bounds(&self) -> [P::Real; 2] {
        self.bounds
    }

    /// Sets the target rate \[m/s, rad/s\].
    #[inline(always)]
    #[must_use]
    pub fn towards(self, rate: P::Real) -> Self {
        Self { rate, ..self }
    }

    /// Never reverses the rate, whatever its target rate: a tangent of a damper's law.
    #[inline(always)]
    #[must_use]
    pub fn braking(self) -> Self {
        Self { brakes: true, ..self }
    }

    /// Adds this fraction of the rate of the law's internal degree of freedom, [`Interaction::inner`], to its rate.
    #[inline(always)]
    #[must_use]
    pub fn with_inner(self, inner: P::Real) -> Self {
        Self { inner, ..self }
    }

    /// \[1\] the fraction of the internal degree of freedom's rate in its rate.
    #[inline(always)]
    #[must_use]
    pub fn inner(&self) -> P::Real {
        self.inner
    }

    /// Whether it never reverses the rate.
    #[inline(always)]
    #[must_use]
    pub fn brakes(&self) -> bool {
        self.brakes
    }

    /// \[N, N·m\] its tension at a rate \[m/s, rad/s\] along its direction.
    #[inline(always)]
    #[must_use]
    pub fn tension(&self, rate: P::Real) -> P::Real {
        let tension = self.coefficient * (rate - self.rate);
        let [least, most] = self.bounds;
        let tension = P::Real::pick(most.less_than(tension), most, tension);
        P::Real::pick(tension.less_than(least), least, tension)
    }
}

/// An internal degree of freedom of a law, part of its memory: a rotor behind a gear.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Inner<R> {
    /// \[m/s, rad/s\] its rate.
    pub rate: R,
    /// \[m/s, rad/s\] its change by the preceding kick.
    pub kick: R,
    /// \[1/kg, 1/(kg·m²)\]
    pub inverse_inertia: R,
}

/// The requirement of a law's memory on a scheme, weakest first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Need {
    /// No steps back in time: it loses energy when it is updated.
    Forward,
    /// Also one evaluation per step: steps advance it.
    Steps,
    /// Also damper passes: they advance its internal degree of freedom.
    Passes,
}

/// An additional output of a law: a depth, a slip.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Quantity {
    /// Its name, for example `depth`.
    pub name: &'static str,
    /// Its unit, for example `m`; `1` where it has none.
    pub unit: &'static str,
}

/// What is wrong with a law's constants.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Wrong {
    /// The field.
    pub field: &'static str,
    /// What is wrong, as a predicate after its name: `is negative`.
    pub problem: &'static str,
    /// What it must be, for example `a stiffness ≥ 0`.
    pub expected: &'static str,
}

impl Wrong {
    /// Refuses a field unless it `holds`.
    ///
    /// # Errors
    /// The error itself.
    pub fn unless(
        holds: bool,
        field: &'static str,
        problem: &'static str,
        expected: &'static str,
    ) -> Result<(), Self> {
        if holds { Ok(()) } else { Err(Self { field, problem, expected }) }
    }
}

/// The constants of a law in one precision; implemented by [`law!`](crate::law).
pub trait Constants<P: Geometry>: Copy + Send + Sync + 'static {
    /// The law's name, in lower case with hyphens.
    const NAME: &'static str;

    /// Its bodies A and B: A may be the ground, B is a body.
    fn bodies(&self) -> [BodyIndex; 2];

    /// Visits every constant in the order of the fields: for fingerprints.
    fn visit(&self, visitor: &mut dyn WordVisitor);
}

/// A visitor of springs: stiffness \[N/m, N·m/rad\], direction.
pub type Springs<'v, P> =
    &'v mut dyn FnMut(<P as Geometry>::Real, &Direction<<P as Geometry>::Space>);

/// A law between two bodies: a spring force along a [`Direction`], and dampers.
///
/// The sign of a record is that of [`Seen::pull`]. A law must be a function of its arguments and its memory only, in
/// arithmetic of [`Real`]: then its bits are the same on every target.
pub trait Interaction<P: Geometry>: Constants<P> {
    /// Its memory from step to step; [`NoStorage`] without one.
    type State: Copy + Default + Words + Send + Sync + 'static;
    /// The largest number of its dampers: `[(); 1]`.
    type Dampers: Several;
    /// Whether it advances its memory by [`Self::advance`], once per step.
    const ADVANCES: bool = false;
    /// Whether [`Self::advance`] also does what [`Self::settle`] does, which then is not called after it.
    const ADVANCE_SETTLES: bool = false;
    /// Whether an update of its memory reduces its energy, as for friction: schemes with steps back in time refuse it
    /// then. A memory that only counts revolutions loses no energy.
    const SLIPS: bool = Self::ADVANCES;
    /// Whether it has an internal degree of freedom, which damper passes advance; it [`Self::ADVANCES`] then.
    const INNER: bool = false;
    /// Whether [`Self::bear`] gives it the force of a group: costs an evaluation of that group.
    const BEARS: bool = false;
    /// Whether all its dampers act on rotations only: [`Direction::along`] of each is 0. Their passes are then cheaper.
    const TURNS: bool = false;
    /// Whether its dampers are those of a drive: their work counts as that of inputs.
    const DRIVES: bool = false;
    /// Whether [`Self::force_pair`] depends on inputs: setting an input then costs an evaluation. Dampers and drives may
    /// depend on inputs without it.
    const DRIVEN: bool = false;
    /// Whether [`Self::keep_pose`] keeps something.
    const KEEPS: bool = false;
    /// The largest number of further pairs of bodies on which it acts, up to
    /// [`MAX_BRANCHES`](crate::laws::MAX_BRANCHES): with one tension along the sum of its own direction and of
    /// theirs. Such a law has at most one damper.
    const BRANCHES: usize = 0;
    /// The outputs of [`Self::read`].
    const QUANTITIES: &'static [Quantity] = &[];

    /// Updates its memory at the boundary of a step, before [`Self::force_pair`], and does what [`Self::keep_pose`] does;
    /// must be idempotent. An evaluation may be repeated without time passing.
    #[inline(always)]
    fn settle(&self, seen: &Seen<'_, P>, state: &mut Self::State) {
        self.keep_pose(seen, state);
    }

    /// Keeps in its memory what several calls at the same pose need, for example an angle. It or [`Self::settle`] is
    /// called at every pose before all others but [`Self::bear`] and [`Self::advance`]; what it keeps is no part of the
    /// memory's words.
    #[inline(always)]
    fn keep_pose(&self, _seen: &Seen<'_, P>, _state: &mut Self::State) {}

    /// Whether its dampers do nothing at the pose of [`Self::keep_pose`], whatever the rates: damper passes skip it.
    #[inline(always)]
    fn is_idle(&self, _state: &Self::State) -> bool {
        false
    }

    /// The group of the model whose force [`Self::bear`] gives it.
    #[inline(always)]
    fn group(&self) -> GroupIndex {
        GroupIndex(u16::MAX)
    }

    /// Updates its memory by the force \[N\] of the springs of [`Self::group`] between its bodies, world axes, at the
    /// boundary of a step, before [`Self::advance`] and [`Self::settle`]; a function of the pose only.
    #[inline(always)]
    fn bear(&self, _seen: &Seen<'_, P>, _force: P::Vector, _state: &mut Self::State) {}

    /// Advances its memory by a step of `h` \[s\], at the pose at its end, once per step: for integrated quantities.
    /// Only schemes of one evaluation per step do this.
    #[inline(always)]
    fn advance(&self, _seen: &Seen<'_, P>, _h: P::Real, _state: &mut Self::State) {}

    /// The record of its springs, without its dampers; `None` where it is undefined, which fails the step.
    fn force_pair(&self, seen: &Seen<'_, P>, state: &Self::State) -> Option<ForcePair<P::Space>>;

    /// \[J\] the energy whose negative gradient is [`Self::force_pair`], if it has one.
    fn energy(&self, seen: &Seen<'_, P>, state: &Self::State) -> P::Real;

    /// Visits the stiffness of [`Self::force_pair`] as springs along directions \[N/m, N·m/rad\], each at its largest value
    /// within a step; returns \[N·m\] an upper bound of the effect of its force on a rotation of A and of B, in any
    /// direction. Used by the frequency bound and the matrix of implicit schemes. With [`Self::BRANCHES`] the first
    /// spring is along all directions; the others belong to its own pair.
    fn tangent(
        &self,
        seen: &Seen<'_, P>,
        state: &Self::State,
        visit: Springs<'_, P>,
    ) -> [P::Real; 2];

    /// Visits the bodies of its branches, A and B, in the order of [`Self::branches`].
    fn branch_bodies(&self, _visit: &mut dyn FnMut([BodyIndex; 2])) {}

    /// Visits its branches with the tension of its spring, always the same number in the same order.
    #[inline(always)]
    fn branches(
        &self,
        _seen: &Seen<'_, P>,
        _state: &Self::State,
        _visit: &mut impl FnMut(Branch<P>),
    ) {
    }

    /// [`Self::tangent`] of a branch by its index, without the spring along all directions.
    fn branch_tangent(
        &self,
        _branch: usize,
        _seen: &Seen<'_, P>,
        _state: &Self::State,
        _visit: Springs<'_, P>,
    ) -> [P::Real; 2] {
        [P::Real::ZERO; 2]
    }

    /// Whether its dampers may act, by its constants alone: damper passes skip it otherwise.
    #[inline(always)]
    fn is_damped(&self) -> bool {
        true
    }

    /// Visits its dampers, always the same number in the same order, idle ones with the coefficient 0.
    #[inline(always)]
    fn dampers(
        &self,
        _seen: &Seen<'_, P>,
        _state: &Self::State,
        _visit: &mut impl FnMut(Damper<P>),
    ) {
    }

    /// Applies its springs to its internal degree of freedom for the time `h` \[s\], before a damper pass; returns the
    /// change \[m/s, rad/s\].
    #[inline(always)]
    fn kick(&self, _seen: &Seen<'_, P>, _h: P::Real, _state: &mut Self::State) -> P::Real {
        P::Real::ZERO
    }

    /// Drives and damps its internal degree of freedom, `[time, kick]`: for a time \[s\], after a kick \[m/s, rad/s\].
    /// It comes first in a pass, last in a descending one.
    #[inline(always)]
    fn drive(&self, _seen: &Seen<'_, P>, _time_and_kick: [P::Real; 2], _state: &mut Self::State) {}

    /// Its internal degree of freedom, with the change by the kick.
    #[inline(always)]
    fn inner(&self, _state: &Self::State, kick: P::Real) -> Inner<P::Real> {
        Inner { rate: P::Real::ZERO, kick, inverse_inertia: P::Real::ZERO }
    }

    /// Sets the rate \[m/s, rad/s\] of its internal degree of freedom.
    #[inline(always)]
    fn set_inner(&self, _rate: P::Real, _state: &mut Self::State) {}

    /// \[rad²/s²\] the square of the highest frequency of its internal degree of freedom with fixed bodies.
    fn inner_square(&self) -> P::Real {
        P::Real::ZERO
    }

    /// \[W\] the power of the drive of its internal degree of freedom, or of an input that moves its springs.
    fn supply(&self, _seen: &Seen<'_, P>, _state: &Self::State) -> P::Real {
        P::Real::ZERO
    }

    /// \[W\] the loss of its internal degree of freedom by friction, apart from its dampers.
    fn loss(&self, _state: &Self::State) -> P::Real {
        P::Real::ZERO
    }

    /// \[m/s, rad/s\] the part of its dampers' target rate that an input gives: its power is that of the input. Not for
    /// [`Self::DRIVES`].
    fn driven_rate(&self, _seen: &Seen<'_, P>) -> P::Real {
        P::Real::ZERO
    }

    /// Replaces the vectors of its memory: `turn(0, v)` those in the axes of A, `turn(1, v)` those in the axes of B.
    /// Used to convert a planar memory to space and back.
    fn turn(_state: &mut Self::State, _turn: &mut dyn FnMut(usize, [f64; 3]) -> [f64; 3]) {}

    /// Checks its constants, as given in a scene.
    ///
    /// # Errors
    /// The invalid field, the problem, and the expected value.
    fn check(&self) -> Result<(), Wrong> {
        Ok(())
    }

    /// An output, by its index in [`Self::QUANTITIES`].
    #[inline]
    fn read(&self, _quantity: usize, _seen: &Seen<'_, P>, _state: &Self::State) -> P::Real {
        P::Real::ZERO
    }
}

/// A law in all precisions, for scenes, exports and programs that read scenes. Implemented by [`law!`](crate::law) for
/// its constants in double precision.
pub trait Law: Interaction<F64> {
    /// The law in another precision.
    type In<P: Geometry>: Interaction<P>;
    /// Its constants except its bodies, in their order.
    const FIELDS: &'static [Field];
    /// A description in one line.
    const ABOUT: &'static str;
    /// The path of its type in Rust, in the declaring module.
    const PATH: &'static str;
    /// The name and the folder of the declaring package.
    const PACKAGE: [&'static str; 2];

    /// Its constants rounded once.
    fn rounded<P: Geometry>(&self) -> Self::In<P>;

    /// Reads its constants from a source by name; `None` where the source has refused one.
    fn read_from(bodies: [BodyIndex; 2], source: &mut dyn FieldSource) -> Option<Self>;

    /// Writes its constants to a sink, in their order.
    fn write_to(&self, sink: &mut dyn FieldSink);
}

/// The weights of a law's dampers.
pub(crate) type SharesOf<P, T> =
    <<T as Interaction<P>>::Dampers as Several>::Of<Share<<P as Geometry>::Real>>;
