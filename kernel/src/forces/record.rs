//! What the laws' files and the evaluation share: how dampers and memories are taken.

use crate::geometry::Geometry;
use crate::model::{StatesIn, Terms};

pub(crate) use crate::record::apply;
pub use crate::record::{Record, Wrench};

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
#[cfg_attr(all(feature = "defmt", target_os = "none"), derive(defmt::Format))]
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
