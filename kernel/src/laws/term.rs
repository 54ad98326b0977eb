//! Terms of a sum of coordinates, each of two bodies of its own.

use crate::geometry::{F64, Geometry};
use crate::index::BodyIndex;
use crate::laws::hinge::Hinge;

/// The most terms of a sum.
pub const MOST_TERMS: usize = 3;

/// A coordinate of two bodies and the factor by which it enters a sum.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Term<P: Geometry = F64> {
    /// A, which may be the ground, and B, a body.
    pub bodies: [BodyIndex; 2],
    /// \[unit of the sum per m or rad\]
    pub factor: P::Real,
    /// What the coordinate is.
    pub way: Way<P>,
}

/// What a coordinate is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Way<P: Geometry = F64> {
    /// \[rad\] how far B has turned in A about an axis since t = 0.
    Turn(Hinge<P::Space>),
    /// \[m\] how far B's point is from A's along an axis of A.
    Travel {
        /// A point of A and one of B.
        points: [P::Local; 2],
        /// \[1\] unit vector in the axes of A.
        axis: P::Vector,
    },
}
