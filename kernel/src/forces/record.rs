//! What the laws' files and the evaluation share: records, wrenches, and how dampers and turn counts
//! are taken.
//!
//! `record => wrenches of its two bodies`.

use crate::geometry::Geometry;
use crate::model::{StatesIn, Terms};
use crate::space::{Linear as _, Space};

/// The force on a body and its torque.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Wrench<S: Space> {
    /// \[N\] force, world axes.
    pub force: S::Vector,
    /// \[N·m\] torque about the centre of mass, body axes once the evaluation is complete.
    pub torque: S::Moment,
    filler: S::Filler,
}

impl<S: Space> Wrench<S> {
    /// A force \[N\], world axes, and a torque \[N·m\].
    #[inline(always)]
    pub fn new(force: S::Vector, torque: S::Moment) -> Self {
        Self { force, torque, filler: Default::default() }
    }
}

/// What a group does to its two bodies, world axes: force and torque of A, and of B the opposite of its
/// own torque; its force is the opposite of A's.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Record<S: Space> {
    /// \[N\] force on A.
    pub force: S::Vector,
    /// \[N·m\] torque on A about its centre of mass.
    pub torque_a: S::Moment,
    /// \[N·m\] the opposite of the torque on B about its centre of mass.
    pub torque_b: S::Moment,
}

impl<S: Space> Record<S> {
    pub(crate) const ZERO: Self =
        Self { force: S::Vector::ZERO, torque_a: S::Moment::ZERO, torque_b: S::Moment::ZERO };

    /// This and another.
    #[inline(always)]
    pub(crate) fn with(&self, other: &Self) -> Self {
        Self {
            force: self.force + other.force,
            torque_a: self.torque_a + other.torque_a,
            torque_b: self.torque_b + other.torque_b,
        }
    }
}

/// Whether the dampers' forces are part of an evaluation.
pub trait Dampers {
    /// What of them matters to an evaluation: those that do the same there are one type.
    type Forces: Dampers;
    /// Whether they act.
    const ACT: bool;
    /// Whether what is left of them acts joint by joint.
    const JOINT_WISE: bool = false;
}

/// Dampers act as forces at the velocities of the evaluation.
#[derive(Clone, Copy, Debug)]
pub struct ExplicitDampers;

impl Dampers for ExplicitDampers {
    type Forces = Self;
    const ACT: bool = true;
}

/// Dampers are left to the sweeps of [`crate::damping`].
#[derive(Clone, Copy, Debug)]
pub struct DampersLeft;

impl Dampers for DampersLeft {
    type Forces = Self;
    const ACT: bool = false;
}

/// Dampers are left to the joints' levers of [`crate::damping`].
#[derive(Clone, Copy, Debug)]
pub struct DampersOfJoints;

impl Dampers for DampersOfJoints {
    type Forces = DampersLeft;
    const ACT: bool = false;
    const JOINT_WISE: bool = true;
}

/// Where in a step an evaluation stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum At {
    /// Near a step's boundary, at least once per step: turn counts are settled.
    Boundary,
    /// Anywhere else: turn counts are only read.
    Stage,
}

/// What elements remember, in an evaluation.
pub(crate) struct Memories<'s, P: Geometry, T: Terms<P>> {
    /// The turn counts, one per torsion spring.
    pub(crate) turns: &'s mut [i32],
    /// Those of the laws.
    pub(crate) laws: &'s mut StatesIn<P, T>,
    /// Whether to settle them.
    pub(crate) at: At,
    /// \[s\] the step to bring the laws' on by before that.
    pub(crate) advance: Option<P::Real>,
}

/// Adds a record to its two bodies; the world takes none.
#[inline(always)]
pub(crate) fn apply<S: Space>(wrenches: &mut [Wrench<S>], a: usize, b: usize, record: &Record<S>) {
    if let Some(wrench) = wrenches.get_mut(a) {
        wrench.force = wrench.force + record.force;
        wrench.torque = wrench.torque + record.torque_a;
    }
    if let Some(wrench) = wrenches.get_mut(b) {
        wrench.force = wrench.force - record.force;
        wrench.torque = wrench.torque - record.torque_b;
    }
}
