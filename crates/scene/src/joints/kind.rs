//! Types of joints, and common data of joints.

use dbd_kernel::Vec3;

use crate::assembly::Assembly;
use crate::closure::{Place, Turn};
use crate::error::SceneError;
use crate::hinge::Hinge;
use crate::joints::triad::{self, Triad};
use crate::pair::Pair;
use crate::spring::Spring;
use crate::text::Table;

/// A type of joint.
pub(super) struct JointType {
    /// Its name in a scene.
    pub(super) name: &'static str,
    /// Degrees of freedom that it constrains, see [`JointInfo::holds`](crate::JointInfo::holds).
    pub(super) holds: u32,
    /// The part of these that belongs to a body added by the realisation with TSDAs.
    pub(super) brings: u32,
    /// The keys it has besides those of every joint.
    pub(super) keys: &'static [&'static str],
    /// Constraints on its points and triads.
    pub(super) asks: (Place, Turn),
    /// Adds its elements to the assembly and returns its axes of rotation.
    pub(super) expand: fn(&Table<'_>, &Joint, &mut Assembly) -> Result<Vec<Hinge>, SceneError>,
}

/// Common data of joints.
pub(super) struct Joint {
    pub(super) name: String,
    pub(super) pair: Pair,
    /// \[m\] its position, world.
    pub(super) at_w: Vec3<f64>,
    /// The first body's axis and the second's, world; the same except for a universal joint.
    pub(super) axes: [Vec3<f64>; 2],
    /// World, if given.
    pub(super) reference: Option<Vec3<f64>>,
    pub(super) spring: Spring,
    pub(super) realisation: Realisation,
}

impl Joint {
    /// The triad of its axis and its reference.
    pub(super) fn triad(&self, table: &Table<'_>) -> Result<Triad, SceneError> {
        triad::about(table, self.axes[0], self.reference)
    }
}

/// Realisation of a joint.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Realisation {
    /// TSDAs with free lengths, or points on lines.
    #[default]
    Tsda,
    /// Bushings of zero length with the same stiffness at the assembled pose; a step needs no square root or
    /// division.
    Bushing,
}

impl Realisation {
    /// All of them, the default first.
    pub const ALL: [Self; 2] = [Self::Tsda, Self::Bushing];

    /// `tsda` or `bushing`.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Tsda => "tsda",
            Self::Bushing => "bushing",
        }
    }
}
