//! What an interaction is: all that the kernel asks of a law between two bodies.

use crate::elements::share::Share;
use crate::geometry::{F64, Geometry};
use crate::index::BodyIndex;
use crate::laws::branch::Branch;
use crate::laws::end::Seen;
use crate::laws::kind::{Field, FieldSink, FieldSource};
use crate::real::Real;
use crate::record::Direction;
use crate::record::Record;
use crate::space::Linear as _;
use crate::words::{WordSource, WordVisitor, Words};

/// So many of something, one beside the other: `[(); 2]` has two.
pub trait Several: 'static {
    /// How many.
    const COUNT: usize;
    /// So many `T`.
    type Of<T: Copy + Send + Sync + 'static>: Copy + AsRef<[T]> + AsMut<[T]> + Send + Sync + 'static;
    /// Each of them.
    fn of<T: Copy + Send + Sync + 'static>(value: T) -> Self::Of<T>;
}

impl<const N: usize> Several for [(); N] {
    const COUNT: usize = N;
    type Of<T: Copy + Send + Sync + 'static> = [T; N];
    #[inline(always)]
    fn of<T: Copy + Send + Sync + 'static>(value: T) -> [T; N] {
        [value; N]
    }
}

/// The memory of a law that remembers nothing.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Nothing;

impl Words for Nothing {
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
    /// \[m/s, rad/s\] the rate r₀ at which it does nothing.
    pub rate: P::Real,
    /// \[N, N·m\] the least mean tension over the time it acts, at most 0, and the largest, at least 0.
    bounds: [P::Real; 2],
    /// Whether it takes no more than all of the rate.
    brakes: bool,
    /// \[1\] which part of the rate of the law's own freedom belongs to its rate.
    inner: P::Real,
}

/// Beyond any force, and its product with any step is a number in single precision.
const MOST: f64 = 1e30;

impl<P: Geometry> Damper<P> {
    /// A damper towards rest, without bounds.
    #[inline(always)]
    #[must_use]
    pub fn new(coefficient: P::Real, direction: Direction<P::Space>) -> Self {
        let most = P::Real::from_f64(MOST);
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

    /// With bounds of its tension \[N, N·m\]: `within(least, most)`. Both contain 0: a bound never pushes.
    #[inline(always)]
    #[must_use]
    pub fn within(self, least: P::Real, most: P::Real) -> Self {
        let zero = P::Real::ZERO;
        let least = P::Real::pick(zero.less_than(least), zero, least);
        let most = P::Real::pick(most.less_than(zero), zero, most);
        Self { bounds: [least, most], ..self }
    }

    /// The bounds \[N, N·m\], the least tension and the largest.
    #[inline(always)]
    #[must_use]
    pub fn bounds(&self) -> [P::Real; 2] {
        self.bounds
    }

    /// Towards a rate \[m/s, rad/s\].
    #[inline(always)]
    #[must_use]
    pub fn towards(self, rate: P::Real) -> Self {
        Self { rate, ..self }
    }

    /// Which never turns the rate around, whatever the rate that it goes towards: a tangent of a damper's law.
    #[inline(always)]
    #[must_use]
    pub fn braking(self) -> Self {
        Self { brakes: true, ..self }
    }

    /// Whose rate has this part of the rate of the law's own freedom, [`Interaction::inner`].
    #[inline(always)]
    #[must_use]
    pub fn with_inner(self, inner: P::Real) -> Self {
        Self { inner, ..self }
    }

    /// \[1\] the part of the rate of the law's own freedom that belongs to its rate.
    #[inline(always)]
    #[must_use]
    pub fn inner(&self) -> P::Real {
        self.inner
    }

    /// Whether it never turns the rate around.
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

/// A freedom that a law has of its own, in its memory: a rotor behind a gear.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Inner<R> {
    /// \[m/s, rad/s\] its rate.
    pub rate: R,
    /// \[m/s, rad/s\] what the kick just before gave to it.
    pub kick: R,
    /// \[1/kg, 1/(kg·m²)\]
    pub inverse_inertia: R,
}

/// What a law's memory asks of a scheme, the least first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Need {
    /// No steps back in time: it loses energy as it is settled.
    Forward,
    /// One evaluation per step besides: steps bring it on.
    Steps,
    /// Passes over dampers besides: they bring its own freedom on.
    Passes,
}

/// A number that a law shows beside what it does: a depth, a slip.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Quantity {
    /// Its name, as `depth`.
    pub name: &'static str,
    /// Its unit, as `m`; `1` where it has none.
    pub unit: &'static str,
}

/// What is wrong with a law's constants.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Wrong {
    /// The field.
    pub field: &'static str,
    /// What is wrong, to follow its name: `is negative`.
    pub problem: &'static str,
    /// What it must be: `a stiffness ≥ 0`.
    pub expected: &'static str,
}

impl Wrong {
    /// Refuses a field unless it `holds`.
    ///
    /// # Errors
    /// Itself.
    pub fn unless(
        holds: bool,
        field: &'static str,
        problem: &'static str,
        expected: &'static str,
    ) -> Result<(), Self> {
        if holds { Ok(()) } else { Err(Self { field, problem, expected }) }
    }
}

/// The constants of a law in one precision; [`law!`](crate::law) writes this.
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

/// A law between two bodies. Its terms: a coordinate with a [`Direction`], a spring force along it, dampers.
///
/// The sign of a record: [`Seen::pull`]. All that a law says must be a function of what it sees and of its memory,
/// in arithmetic of [`Real`]: then its bits are the same on every target.
pub trait Interaction<P: Geometry>: Constants<P> {
    /// What it remembers from step to step; [`Nothing`].
    type State: Copy + Default + Words + Send + Sync + 'static;
    /// How many dampers it has at most: `[(); 1]`.
    type Dampers: Several;
    /// Whether it brings its memory on by [`Self::advance`], once per step.
    const ADVANCES: bool = false;
    /// Whether its energy falls as its memory is settled, as that of friction does: schemes with steps back in time
    /// refuse it then. A memory that only counts turns loses nothing.
    const SLIPS: bool = Self::ADVANCES;
    /// Whether it has a freedom of its own, which passes over dampers bring on; it [`Self::ADVANCES`] then.
    const INNER: bool = false;
    /// Whether its dampers are those of a drive: their work counts as that of inputs.
    const DRIVES: bool = false;
    /// Whether [`Self::record`] depends on inputs: an input that is set costs an evaluation then. Dampers and drives may
    /// depend on them without that.
    const DRIVEN: bool = false;
    /// On how many further pairs of bodies it acts at most, up to [`MOST_BRANCHES`](crate::laws::MOST_BRANCHES): with one
    /// tension along the sum of its own direction and of theirs. Such a law has one damper at most.
    const BRANCHES: usize = 0;
    /// What [`Self::read`] shows.
    const QUANTITIES: &'static [Quantity] = &[];

    /// Brings its memory to the boundary of a step, before [`Self::record`]: a projection, twice is once. An
    /// evaluation may be repeated without time passing.
    #[inline(always)]
    fn settle(&self, _seen: &Seen<'_, P>, _state: &mut Self::State) {}

    /// Brings its memory on by a step of `h` \[s\], at the pose at its end, once per step: for what a law
    /// integrates. Schemes of one evaluation per step alone do this.
    #[inline(always)]
    fn advance(&self, _seen: &Seen<'_, P>, _h: P::Real, _state: &mut Self::State) {}

    /// What its springs do to its bodies, without its dampers; `None` where that is undefined, which fails the step.
    fn record(&self, seen: &Seen<'_, P>, state: &Self::State) -> Option<Record<P::Space>>;

    /// \[J\] the energy that [`Self::record`] is minus the gradient of, as far as it has one.
    fn energy(&self, seen: &Seen<'_, P>, state: &Self::State) -> P::Real;

    /// Visits the stiffness of [`Self::record`] as springs along directions \[N/m, N·m/rad\], each at its largest
    /// wherever it may get to within a step; returns \[N·m\] what its force does to a turn of A and of B, in any
    /// direction at most. The frequency bound and the matrix of implicit schemes are made of it. With [`Self::BRANCHES`]
    /// the first spring is one along all directions; the others are of its own pair alone.
    fn tangent(
        &self,
        seen: &Seen<'_, P>,
        state: &Self::State,
        visit: Springs<'_, P>,
    ) -> [P::Real; 2];

    /// Visits the bodies of its branches, A and B, in the order of [`Self::branches`].
    fn branch_bodies(&self, _visit: &mut dyn FnMut([BodyIndex; 2])) {}

    /// Visits its branches with the tension of its spring, each time as many and in the same order.
    #[inline(always)]
    fn branches(
        &self,
        _seen: &Seen<'_, P>,
        _state: &Self::State,
        _visit: &mut impl FnMut(Branch<P>),
    ) {
    }

    /// [`Self::tangent`] of a branch by its place, without the spring along all directions.
    fn branch_tangent(
        &self,
        _branch: usize,
        _seen: &Seen<'_, P>,
        _state: &Self::State,
        _visit: Springs<'_, P>,
    ) -> [P::Real; 2] {
        [P::Real::ZERO; 2]
    }

    /// Visits its dampers, each time as many and in the same order, idle ones with the coefficient 0.
    #[inline(always)]
    fn dampers(
        &self,
        _seen: &Seen<'_, P>,
        _state: &Self::State,
        _visit: &mut impl FnMut(Damper<P>),
    ) {
    }

    /// Gives to its own freedom what its springs give in the time `h` \[s\], before a pass; returns \[m/s, rad/s\] what
    /// that is.
    #[inline(always)]
    fn kick(&self, _seen: &Seen<'_, P>, _h: P::Real, _state: &mut Self::State) -> P::Real {
        P::Real::ZERO
    }

    /// Drives and damps its own freedom by itself, `[time, kick]`: for a time \[s\], after a kick that gave it so much
    /// \[m/s, rad/s\]. It comes first in a pass, last in one of descending order.
    #[inline(always)]
    fn drive(&self, _seen: &Seen<'_, P>, _time_and_kick: [P::Real; 2], _state: &mut Self::State) {}

    /// Its own freedom, with the kick that it was given.
    #[inline(always)]
    fn inner(&self, _state: &Self::State, kick: P::Real) -> Inner<P::Real> {
        Inner { rate: P::Real::ZERO, kick, inverse_inertia: P::Real::ZERO }
    }

    /// Sets the rate \[m/s, rad/s\] of its own freedom.
    #[inline(always)]
    fn set_inner(&self, _rate: P::Real, _state: &mut Self::State) {}

    /// \[rad²/s²\] the square of the highest frequency of its own freedom where its bodies are held.
    fn inner_square(&self) -> P::Real {
        P::Real::ZERO
    }

    /// \[W\] what drives its own freedom gives.
    fn supply(&self, _seen: &Seen<'_, P>, _state: &Self::State) -> P::Real {
        P::Real::ZERO
    }

    /// Replaces the vectors of its memory: `turn(0, v)` those in the axes of A, `turn(1, v)` those in the axes of B.
    /// A plane's memory comes into space by it, and back.
    fn turn(_state: &mut Self::State, _turn: &mut dyn FnMut(usize, [f64; 3]) -> [f64; 3]) {}

    /// Whether its constants go together, as a scene gives them.
    ///
    /// # Errors
    /// The field that is wrong, why, and what would be right.
    fn check(&self) -> Result<(), Wrong> {
        Ok(())
    }

    /// What it shows, by its place among [`Self::QUANTITIES`].
    #[inline]
    fn read(&self, _quantity: usize, _seen: &Seen<'_, P>, _state: &Self::State) -> P::Real {
        P::Real::ZERO
    }
}

/// A law in all precisions: what scenes, exports and programs that read scenes know of it. Written by
/// [`law!`](crate::law) for its constants in double precision.
pub trait Law: Interaction<F64> {
    /// It in another precision.
    type In<P: Geometry>: Interaction<P>;
    /// Its constants beside its bodies, in their order.
    const FIELDS: &'static [Field];
    /// What it is, in a line.
    const ABOUT: &'static str;
    /// The path of its type in Rust, as the module has it that declares it.
    const PATH: &'static str;
    /// The name and the folder of the package that declares it.
    const PACKAGE: [&'static str; 2];

    /// Its constants rounded once.
    fn rounded<P: Geometry>(&self) -> Self::In<P>;

    /// Its constants from a source that knows them by name; `None` where the source has refused one.
    fn read_from(bodies: [BodyIndex; 2], source: &mut dyn FieldSource) -> Option<Self>;

    /// Its constants to a sink, in their order.
    fn write_to(&self, sink: &mut dyn FieldSink);
}

/// The shares of a law's dampers.
pub(crate) type SharesOf<P, T> =
    <<T as Interaction<P>>::Dampers as Several>::Of<Share<<P as Geometry>::Real>>;
