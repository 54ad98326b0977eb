//! The sum of a damper pass per body, added to the velocity at its end.
//!
//! `impulses of a pass => one change of velocity`. A velocity in single precision cannot resolve the impulse of one
//! joint's dampers and rounds it in the same direction step after step.

use core::fmt::Debug;

use crate::space::Space;

/// The sum of a damper pass for a body, apart from the velocity before the pass; `()` in precisions that add impulses
/// to velocities directly.
pub trait PassSum<S: Space>: Copy + Debug + Default + Send + 'static {
    /// Whether there is a sum.
    const APART: bool;
    /// The sum.
    fn sum(&self) -> Option<&Sum<S>>;
    /// The sum, mutable.
    fn sum_mut(&mut self) -> Option<&mut Sum<S>>;
}

/// A sum of changes of a body's velocity and angular velocity.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sum<S: Space> {
    /// \[m/s\] world axes.
    pub linear: S::Vector,
    /// \[rad/s\] body axes.
    pub angular: S::Moment,
}

impl<S: Space> PassSum<S> for () {
    const APART: bool = false;

    #[inline(always)]
    fn sum(&self) -> Option<&Sum<S>> {
        None
    }
    #[inline(always)]
    fn sum_mut(&mut self) -> Option<&mut Sum<S>> {
        None
    }
}

impl<S: Space> PassSum<S> for Sum<S> {
    const APART: bool = true;

    #[inline(always)]
    fn sum(&self) -> Option<&Sum<S>> {
        Some(self)
    }
    #[inline(always)]
    fn sum_mut(&mut self) -> Option<&mut Sum<S>> {
        Some(self)
    }
}
