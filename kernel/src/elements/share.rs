//! What a damper bears of a force that several dampers bear together.
//!
//! Weighed by [`crate::damping`], kept beside each damper.

use crate::real::Real;

/// The share of one damper in what it bears together with others.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(all(feature = "defmt", target_os = "none"), derive(defmt::Format))]
pub struct Share<R> {
    /// \[1\] its own, above 0, 1 at most.
    pub own: R,
    /// \[1\] of all dampers that come after it in ascending order.
    pub later: R,
}

impl<R: Real> Share<R> {
    /// Of a damper that no other touches.
    pub const ALONE: Self = Self { own: R::ONE, later: R::ZERO };
}
