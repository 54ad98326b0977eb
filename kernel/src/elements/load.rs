//! A force and a torque on one body, constant over a window of time \[from, until).
//!
//! `(load, frame) => (force, torque)` in world axes. The load is sampled at the start of a step
//! and held for all its stages; the window therefore becomes a window of whole steps once per
//! (model, step). A force in world axes has the potential `−F·x` while it acts; a force in body
//! axes and a torque have none.

use crate::model::BodyIndex;
use crate::real::Real;
use crate::vector::Vec3;

/// The axes in which a load is given.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum LoadFrame {
    /// World axes.
    #[default]
    World,
    /// Body axes: the load turns with its body.
    Body,
}

/// A constant load.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Load<R> {
    /// The body it acts on.
    pub body: BodyIndex,
    /// The axes of `force` and `torque`.
    pub frame: LoadFrame,
    /// \[N\] force at the centre of mass.
    pub force: Vec3<R>,
    /// \[N·m\] torque.
    pub torque: Vec3<R>,
    /// \[s\] start of the window.
    pub from: f64,
    /// \[s\] end of the window, exclusive; infinite where it never ends.
    pub until: f64,
}

impl<R: Real> Load<R> {
    /// The same load in another precision.
    pub fn convert<Q: Real>(&self) -> Load<Q> {
        Load {
            body: self.body,
            frame: self.frame,
            force: Vec3::from_f64(self.force.to_f64()),
            torque: Vec3::from_f64(self.torque.to_f64()),
            from: self.from,
            until: self.until,
        }
    }

    /// Potential energy \[J\] of an active load on a body at `position` \[m\].
    #[inline]
    pub fn energy(&self, position: Vec3<R>) -> R {
        match self.frame {
            LoadFrame::World => -self.force.dot(position),
            LoadFrame::Body => R::ZERO,
        }
    }
}

/// The steps during which a load acts: `first ≤ n < end`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct LoadWindow {
    /// First step.
    pub first: u64,
    /// First step after the window.
    pub end: u64,
}

impl LoadWindow {
    /// The steps of size `step` \[s\] that start within \[from, until).
    #[must_use]
    pub fn new(from: f64, until: f64, step: f64) -> Self {
        Self { first: first_step(from, step), end: first_step(until, step) }
    }

    /// Whether the load acts during step `n`.
    #[inline(always)]
    #[must_use]
    pub fn contains(self, n: u64) -> bool {
        self.first <= n && n < self.end
    }

    /// Whether the load starts or ends at step `n`.
    #[inline(always)]
    #[must_use]
    pub fn changes_at(self, n: u64) -> bool {
        n == self.first || n == self.end
    }
}

/// The first step that starts at or after `time`; a multiple of the step within 1e-9 counts as
/// exact.
pub(crate) fn first_step(time: f64, step: f64) -> u64 {
    if time <= 0.0 {
        return 0;
    }
    let steps = time / step;
    // The conversion saturates: an infinite end becomes the last step that can be counted.
    let below = steps as u64;
    let excess = steps - below as f64;
    if excess <= 1e-9 * steps {
        below
    } else {
        // `excess` close to 1 rounds up to the same step as any other fraction.
        below.saturating_add(1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn windows_are_half_open_and_forgive_rounding() {
        let window = LoadWindow::new(0.0, 2.0, 2e-5);
        assert_eq!((window.first, window.end), (0, 100_000));
        assert!(window.contains(0) && window.contains(99_999) && !window.contains(100_000));
        assert_eq!(
            LoadWindow::new(0.3, f64::INFINITY, 0.1),
            LoadWindow { first: 3, end: u64::MAX }
        );
        assert_eq!(LoadWindow::new(0.25, 0.35, 0.1), LoadWindow { first: 3, end: 4 });
    }
}
