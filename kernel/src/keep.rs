//! The storage of a scheme in its plant apart from its memory per body: damping modes, blocks of a matrix.
//!
//! `model => memory`. A scheme has only the memory that it needs.

use crate::damping::Lever;
use crate::freedoms::Freedoms as _;
use crate::model::{ModelOwner, SpaceOf};
use crate::solve::Seat;
use crate::space::{BlockOf, Space};

/// The storage of a scheme in its plant.
pub trait Keep {
    /// Whether there is a matrix, which requires a model with an elimination order.
    const MATRIX: bool = false;
    /// Whether there is another for half a step.
    const HALVES: bool = false;
    /// Memory for a model's damping modes.
    type Levers<M: ModelOwner>: AsRef<[Lever<M::Precision>]> + AsMut<[Lever<M::Precision>]>;
    /// Memory for lumped joints: a point and an axis.
    type Seats<M: ModelOwner>: AsRef<[Seat<SpaceOf<M>>]> + AsMut<[Seat<SpaceOf<M>>]>;
    /// The same for half a step.
    type HalfSeats<M: ModelOwner>: AsRef<[Seat<SpaceOf<M>>]> + AsMut<[Seat<SpaceOf<M>>]>;
    /// Memory for the blocks of bodies.
    type Bodies<M: ModelOwner>: AsMut<[BlockOf<SpaceOf<M>>]>;
    /// Memory for the blocks of pairs of bodies.
    type Pairs<M: ModelOwner>: AsMut<[BlockOf<SpaceOf<M>>]>;

    /// Memory in its initial state.
    fn memory<M: ModelOwner>(model: &M) -> Kept<Self, M>;
}

/// The storage of `K` for a model.
pub struct Kept<K: Keep + ?Sized, M: ModelOwner> {
    pub(crate) levers: K::Levers<M>,
    pub(crate) seats: K::Seats<M>,
    pub(crate) half_seats: K::HalfSeats<M>,
    pub(crate) bodies: K::Bodies<M>,
    pub(crate) pairs: K::Pairs<M>,
}

/// No storage.
#[derive(Clone, Copy, Debug)]
pub struct Nothing;

impl Keep for Nothing {
    type Levers<M: ModelOwner> = [Lever<M::Precision>; 0];
    type Seats<M: ModelOwner> = [Seat<SpaceOf<M>>; 0];
    type HalfSeats<M: ModelOwner> = [Seat<SpaceOf<M>>; 0];
    type Bodies<M: ModelOwner> = [BlockOf<SpaceOf<M>>; 0];
    type Pairs<M: ModelOwner> = [BlockOf<SpaceOf<M>>; 0];

    #[inline]
    fn memory<M: ModelOwner>(_: &M) -> Kept<Self, M> {
        Kept { levers: [], seats: [], half_seats: [], bodies: [], pairs: [] }
    }
}

/// Damping modes: twenty-six words per damper in space, twenty-one in the plane.
#[derive(Clone, Copy, Debug)]
pub struct Levers;

impl Keep for Levers {
    type Levers<M: ModelOwner> = M::PerDamper<Lever<M::Precision>>;
    type Seats<M: ModelOwner> = [Seat<SpaceOf<M>>; 0];
    type HalfSeats<M: ModelOwner> = [Seat<SpaceOf<M>>; 0];
    type Bodies<M: ModelOwner> = [BlockOf<SpaceOf<M>>; 0];
    type Pairs<M: ModelOwner> = [BlockOf<SpaceOf<M>>; 0];

    #[inline]
    fn memory<M: ModelOwner>(model: &M) -> Kept<Self, M> {
        Kept {
            levers: model.per_damper(Lever::default()),
            seats: [],
            half_seats: [],
            bodies: [],
            pairs: [],
        }
    }
}

/// A matrix: thirty-six words per body and per pair of bodies in space, nine in the plane.
#[derive(Clone, Copy, Debug)]
pub struct Matrix;

impl Keep for Matrix {
    const MATRIX: bool = true;
    type Levers<M: ModelOwner> = [Lever<M::Precision>; 0];
    type Seats<M: ModelOwner> = M::PerHome<Seat<SpaceOf<M>>>;
    type HalfSeats<M: ModelOwner> = [Seat<SpaceOf<M>>; 0];
    type Bodies<M: ModelOwner> = M::PerBody<BlockOf<SpaceOf<M>>>;
    type Pairs<M: ModelOwner> = M::PerPair<BlockOf<SpaceOf<M>>>;

    #[inline]
    fn memory<M: ModelOwner>(model: &M) -> Kept<Self, M> {
        let empty = <SpaceOf<M> as Space>::Row::EMPTY;
        let (bodies, pairs) = (model.per_body(empty), model.per_pair(empty));
        let seats = model.per_home(Seat::default());
        Kept { levers: [], seats, half_seats: [], bodies, pairs }
    }
}

/// The matrices of a step and of half a step, in the memory of one.
#[derive(Clone, Copy, Debug)]
pub struct Matrices;

impl Keep for Matrices {
    const MATRIX: bool = true;
    const HALVES: bool = true;
    type Levers<M: ModelOwner> = [Lever<M::Precision>; 0];
    type Seats<M: ModelOwner> = M::PerHome<Seat<SpaceOf<M>>>;
    type HalfSeats<M: ModelOwner> = M::PerHome<Seat<SpaceOf<M>>>;
    type Bodies<M: ModelOwner> = M::PerBody<BlockOf<SpaceOf<M>>>;
    type Pairs<M: ModelOwner> = M::PerPair<BlockOf<SpaceOf<M>>>;

    #[inline]
    fn memory<M: ModelOwner>(model: &M) -> Kept<Self, M> {
        let Kept { seats, bodies, pairs, .. } = Matrix::memory(model);
        let half_seats = model.per_home(Seat::default());
        Kept { levers: [], seats, half_seats, bodies, pairs }
    }
}
