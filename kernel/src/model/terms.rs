//! The kinds of element of a model, known at compile time: other kinds generate no code.

use core::marker::PhantomData;

use crate::geometry::Geometry;
use crate::laws::Laws;

/// Carries a type without owning one.
type Named<L> = PhantomData<fn() -> L>;

/// The kinds of element of a model. A kind that is `false` generates no code in a step.
pub trait Terms<P: Geometry>: 'static {
    /// The list of laws.
    type Laws: Laws<P>;

    /// Uniform gravity.
    const GRAVITY: bool;
    /// Loads.
    const LOADS: bool;
    /// TSDAs.
    const TSDAS: bool;
    /// Point bushings.
    const BUSHINGS: bool;
    /// Torsion springs.
    const TORSIONS: bool;
    /// Dampers of any kind.
    const DAMPERS: bool;
    /// Points on lines.
    const LINES: bool;
    /// Inputs.
    const INPUTS: bool;
    /// Clearances.
    const CLEARANCES: bool;
    /// Revolute joints of bushings.
    const REVOLUTES: bool;
    /// Universal joints without a spider.
    const UNIVERSALS: bool;
    /// Sources of inputs other than tables over time.
    const SOURCES: bool;
    /// Driven bodies.
    const DRIVEN: bool;
    /// All of these except sources and driven bodies, which are not part of an evaluation.
    const ALL: bool = Self::GRAVITY
        && Self::LOADS
        && Self::TSDAS
        && Self::BUSHINGS
        && Self::TORSIONS
        && Self::DAMPERS
        && Self::LINES
        && Self::INPUTS
        && Self::CLEARANCES
        && Self::REVOLUTES
        && Self::UNIVERSALS;
}

/// Terms of a model whose sizes are known at run time only: any kind may occur.
#[derive(Debug, PartialEq, Eq)]
pub struct AllTerms<L = ()>(Named<L>);

impl<P: Geometry, L: Laws<P>> Terms<P> for AllTerms<L> {
    type Laws = L;
    const GRAVITY: bool = true;
    const LOADS: bool = true;
    const TSDAS: bool = true;
    const BUSHINGS: bool = true;
    const TORSIONS: bool = true;
    const DAMPERS: bool = true;
    const LINES: bool = true;
    const INPUTS: bool = true;
    const CLEARANCES: bool = true;
    const REVOLUTES: bool = true;
    const UNIVERSALS: bool = true;
    const SOURCES: bool = true;
    const DRIVEN: bool = true;
}

/// Terms of a model whose counts are const generics: a kind occurs where its count is not 0.
#[derive(Debug, PartialEq, Eq)]
pub struct CountedTerms<
    const TSDAS: usize,
    const BUSHINGS: usize,
    const DAMPERS: usize,
    const TORSIONS: usize,
    const GRAVITY: usize,
    const LOADS: usize,
    const LINES: usize,
    const INPUTS: usize,
    const CLEARANCES: usize,
    const REVOLUTES: usize,
    const UNIVERSALS: usize,
    const SOURCES: usize,
    L = (),
    const DRIVEN: usize = 0,
>(Named<L>);

impl<
    P: Geometry,
    const TSDAS: usize,
    const BUSHINGS: usize,
    const DAMPERS: usize,
    const TORSIONS: usize,
    const GRAVITY: usize,
    const LOADS: usize,
    const LINES: usize,
    const INPUTS: usize,
    const CLEARANCES: usize,
    const REVOLUTES: usize,
    const UNIVERSALS: usize,
    const SOURCES: usize,
    L: Laws<P>,
    const DRIVEN: usize,
> Terms<P>
    for CountedTerms<
        TSDAS,
        BUSHINGS,
        DAMPERS,
        TORSIONS,
        GRAVITY,
        LOADS,
        LINES,
        INPUTS,
        CLEARANCES,
        REVOLUTES,
        UNIVERSALS,
        SOURCES,
        L,
        DRIVEN,
    >
{
    type Laws = L;

    const GRAVITY: bool = GRAVITY > 0;
    const LOADS: bool = LOADS > 0;
    const TSDAS: bool = TSDAS > 0;
    const BUSHINGS: bool = BUSHINGS > 0;
    const TORSIONS: bool = TORSIONS > 0;
    const DAMPERS: bool = DAMPERS > 0;
    const LINES: bool = LINES > 0;
    const INPUTS: bool = INPUTS > 0;
    const CLEARANCES: bool = CLEARANCES > 0;
    const REVOLUTES: bool = REVOLUTES > 0;
    const UNIVERSALS: bool = UNIVERSALS > 0;
    const SOURCES: bool = SOURCES > 0;
    const DRIVEN: bool = DRIVEN > 0;
}
