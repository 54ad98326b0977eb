//! Parameters common to the laws' files and the evaluation: the treatment of dampers and memories.

use crate::geometry::Geometry;
use crate::model::{StatesIn, Terms};

pub(crate) use crate::force_pair::apply;
pub use crate::force_pair::{ForcePair, Wrench};

/// Whether the dampers' forces are part of an evaluation.
pub trait Dampers {
    /// The relevant part for an evaluation: damper types with equal forces map to one type.
    type Forces: Dampers;
    /// Whether they act.
    const ACT: bool;
    /// Whether the remaining dampers act joint by joint.
    const JOINT_WISE: bool = false;
}

/// Dampers act as forces at the velocities of the evaluation.
#[derive(Clone, Copy, Debug)]
pub struct ExplicitDampers;

impl Dampers for ExplicitDampers {
    type Forces = Self;
    const ACT: bool = true;
}

/// Dampers are left to the damper passes of [`crate::damping`].
#[derive(Clone, Copy, Debug)]
pub struct DampersLeft;

impl Dampers for DampersLeft {
    type Forces = Self;
    const ACT: bool = false;
}

/// Dampers are left to the joints' damping modes of [`crate::damping`].
#[derive(Clone, Copy, Debug)]
pub struct DampersOfJoints;

impl Dampers for DampersOfJoints {
    type Forces = DampersLeft;
    const ACT: bool = false;
    const JOINT_WISE: bool = true;
}

/// The position of an evaluation in a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(all(feature = "defmt", target_os = "none"), derive(defmt::Format))]
pub enum At {
    /// Near a step's boundary, at least once per step: revolution counts are updated.
    Boundary,
    /// Anywhere else: revolution counts are only read.
    Stage,
}

/// The memories of elements during an evaluation.
pub(crate) struct Memories<'s, P: Geometry, T: Terms<P>> {
    /// The revolution counts, one per torsion spring.
    pub(crate) turns: &'s mut [i32],
    /// The memories of the laws.
    pub(crate) laws: &'s mut StatesIn<P, T>,
    /// Whether they are updated.
    pub(crate) at: At,
    /// \[s\] the step by which the laws' memories advance before that.
    pub(crate) advance: Option<P::Real>,
}
