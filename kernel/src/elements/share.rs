//! The weight of a damper among dampers that act on a common force.
//!
//! Computed by [`crate::damping`], stored with each damper.

use crate::real::Real;

/// The weight of one damper among those that act on a common force.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(all(feature = "defmt", target_os = "none"), derive(defmt::Format))]
pub struct Share<R> {
    /// \[1\] its own, above 0, at most 1.
    pub own: R,
    /// \[1\] of all dampers that come after it in ascending order.
    pub later: R,
}

impl<R: Real> Share<R> {
    /// A damper that shares its force with no other.
    pub const ALONE: Self = Self { own: R::ONE, later: R::ZERO };
}
