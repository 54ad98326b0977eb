//! The storage of a scheme in its plant apart from its memory per body: damping modes, blocks of a matrix.
//!
//! `model => memory`. A scheme has only the memory that it needs.

use crate::damping::DampingMode;
use crate::freedoms::Freedoms as _;
use crate::model::{ModelOwner, SpaceOf};
use crate::solve::LumpedJoint;
use crate::space::{BlockOf, Space};

/// The storage of a scheme in its plant.
pub trait Storage {
    /// Whether there is a matrix, which requires a model with an elimination order.
    const MATRIX: bool = false;
    /// Whether there is another for half a step.
    const HALVES: bool = false;
    /// Memory for a model's damping modes.
    type DampingModes<M: ModelOwner>: AsRef<[DampingMode<M::Precision>]>
        + AsMut<[DampingMode<M::Precision>]>;
    /// Memory for lumped joints: a point and an axis.
    type LumpedJoints<M: ModelOwner>: AsRef<[LumpedJoint<SpaceOf<M>>]>
        + AsMut<[LumpedJoint<SpaceOf<M>>]>;
    /// The same for half a step.
    type HalfLumpedJoints<M: ModelOwner>: AsRef<[LumpedJoint<SpaceOf<M>>]>
        + AsMut<[LumpedJoint<SpaceOf<M>>]>;
    /// Memory for the blocks of bodies.
    type Bodies<M: ModelOwner>: AsMut<[BlockOf<SpaceOf<M>>]>;
    /// Memory for the blocks of pairs of bodies.
    type Pairs<M: ModelOwner>: AsMut<[BlockOf<SpaceOf<M>>]>;

    /// Memory in its initial state.
    fn memory<M: ModelOwner>(model: &M) -> Kept<Self, M>;
}

/// The storage of `K` for a model.
pub struct Kept<K: Storage + ?Sized, M: ModelOwner> {
    pub(crate) modes: K::DampingModes<M>,
    pub(crate) lumped_joints: K::LumpedJoints<M>,
    pub(crate) half_lumped_joints: K::HalfLumpedJoints<M>,
    pub(crate) bodies: K::Bodies<M>,
    pub(crate) pairs: K::Pairs<M>,
}

/// No storage.
#[derive(Clone, Copy, Debug)]
pub struct NoStorage;

impl Storage for NoStorage {
    type DampingModes<M: ModelOwner> = [DampingMode<M::Precision>; 0];
    type LumpedJoints<M: ModelOwner> = [LumpedJoint<SpaceOf<M>>; 0];
    type HalfLumpedJoints<M: ModelOwner> = [LumpedJoint<SpaceOf<M>>; 0];
    type Bodies<M: ModelOwner> = [BlockOf<SpaceOf<M>>; 0];
    type Pairs<M: ModelOwner> = [BlockOf<SpaceOf<M>>; 0];

    #[inline]
    fn memory<M: ModelOwner>(_: &M) -> Kept<Self, M> {
        Kept { modes: [], lumped_joints: [], half_lumped_joints: [], bodies: [], pairs: [] }
    }
}

/// Damping modes: twenty-six words per damper in space, twenty-one in the plane.
#[derive(Clone, Copy, Debug)]
pub struct DampingModes;

impl Storage for DampingModes {
    type DampingModes<M: ModelOwner> = M::PerDamper<DampingMode<M::Precision>>;
    type LumpedJoints<M: ModelOwner> = [LumpedJoint<SpaceOf<M>>; 0];
    type HalfLumpedJoints<M: ModelOwner> = [LumpedJoint<SpaceOf<M>>; 0];
    type Bodies<M: ModelOwner> = [BlockOf<SpaceOf<M>>; 0];
    type Pairs<M: ModelOwner> = [BlockOf<SpaceOf<M>>; 0];

    #[inline]
    fn memory<M: ModelOwner>(model: &M) -> Kept<Self, M> {
        Kept {
            modes: model.per_damper(DampingMode::default()),
            lumped_joints: [],
            half_lumped_joints: [],
            bodies: [],
            pairs: [],
        }
    }
}

/// A matrix: thirty-six words per body and per pair of bodies in space, nine in the plane.
#[derive(Clone, Copy, Debug)]
pub struct Matrix;

impl Storage for Matrix {
    const MATRIX: bool = true;
    type DampingModes<M: ModelOwner> = [DampingMode<M::Precision>; 0];
    type LumpedJoints<M: ModelOwner> = M::PerSlot<LumpedJoint<SpaceOf<M>>>;
    type HalfLumpedJoints<M: ModelOwner> = [LumpedJoint<SpaceOf<M>>; 0];
    type Bodies<M: ModelOwner> = M::PerBody<BlockOf<SpaceOf<M>>>;
    type Pairs<M: ModelOwner> = M::PerPair<BlockOf<SpaceOf<M>>>;

    #[inline]
    fn memory<M: ModelOwner>(model: &M) -> Kept<Self, M> {
        let empty = <SpaceOf<M> as Space>::Row::EMPTY;
        let (bodies, pairs) = (model.per_body(empty), model.per_pair(empty));
        let lumped_joints = model.per_slot(LumpedJoint::default());
        Kept { modes: [], lumped_joints, half_lumped_joints: [], bodies, pairs }
    }
}

/// The matrices of a step and of half a step, in the memory of one.
#[derive(Clone, Copy, Debug)]
pub struct Matrices;

impl Storage for Matrices {
    const MATRIX: bool = true;
    const HALVES: bool = true;
    type DampingModes<M: ModelOwner> = [DampingMode<M::Precision>; 0];
    type LumpedJoints<M: ModelOwner> = M::PerSlot<LumpedJoint<SpaceOf<M>>>;
    type HalfLumpedJoints<M: ModelOwner> = M::PerSlot<LumpedJoint<SpaceOf<M>>>;
    type Bodies<M: ModelOwner> = M::PerBody<BlockOf<SpaceOf<M>>>;
    type Pairs<M: ModelOwner> = M::PerPair<BlockOf<SpaceOf<M>>>;

    #[inline]
    fn memory<M: ModelOwner>(model: &M) -> Kept<Self, M> {
        let Kept { lumped_joints, bodies, pairs, .. } = Matrix::memory(model);
        let half_lumped_joints = model.per_slot(LumpedJoint::default());
        Kept { modes: [], lumped_joints, half_lumped_joints, bodies, pairs }
    }
}
