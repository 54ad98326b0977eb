//! Further pairs of bodies on which a law acts with the same tension.

use crate::force_pair::Direction;
use crate::geometry::Geometry;
use crate::index::BodyIndex;

/// The largest number of branches of a law.
pub const MAX_BRANCHES: usize = 2;

/// A further pair of bodies on which a law acts: its tension acts there along another direction.
#[derive(Clone, Copy, Debug)]
pub struct Branch<P: Geometry> {
    /// A, which may be the ground, and B.
    pub bodies: [BodyIndex; 2],
    /// The rate of the law is the sum of the rates along its own direction and along those of its branches.
    pub direction: Direction<P::Space>,
    /// \[N, N·m\] the tension of the law's spring.
    pub tension: P::Real,
}
