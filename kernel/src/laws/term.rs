//! Terms of a sum of coordinates, each between two bodies.

use crate::geometry::{F64, Geometry};
use crate::index::BodyIndex;
use crate::laws::hinge::Hinge;

/// The largest number of terms of a sum.
pub const MAX_TERMS: usize = 3;

/// A coordinate of two bodies and its factor in a sum.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Term<P: Geometry = F64> {
    /// A, which may be the ground, and B, a body.
    pub bodies: [BodyIndex; 2],
    /// \[unit of the sum per m or rad\]
    pub factor: P::Real,
    /// The coordinate.
    pub way: CoordinateKind<P>,
}

/// The kinds of coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum CoordinateKind<P: Geometry = F64> {
    /// \[rad\] the angle of B in A about an axis since t = 0.
    Turn(Hinge<P::Space>),
    /// \[m\] the displacement of B's point from A's along an axis of A.
    Travel {
        /// A point of A and one of B.
        points: [P::Local; 2],
        /// \[1\] unit vector in the axes of A.
        axis: P::Vector,
    },
}
