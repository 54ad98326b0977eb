//! A force and a torque on one body, constant over a window of time \[from, until).
//!
//! `(load, frame) => (force, torque)` in world axes. [`crate::schedule`] rounds the window to whole steps. A force in
//! world axes has the potential `−F·x` while it acts, which [`crate::energy`] reports separately; a force in body axes
//! and a torque have none.

use crate::index::BodyIndex;
use crate::real::Real as _;
use crate::space::{Linear as _, Space};

/// The axes in which a load is given.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(all(feature = "defmt", target_os = "none"), derive(defmt::Format))]
pub enum LoadFrame {
    /// World axes.
    #[default]
    World,
    /// Body axes: the load rotates with its body.
    Body,
}

/// A constant load.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Load<S: Space> {
    /// The body it acts on.
    pub body: BodyIndex,
    /// The axes of `force` and `torque`.
    pub frame: LoadFrame,
    /// \[N\] force at the centre of mass.
    pub force: S::Vector,
    /// \[N·m\] torque.
    pub torque: S::Moment,
    /// \[s\] start of the window.
    pub from: f64,
    /// \[s\] end of the window, exclusive; infinite for a permanent load.
    pub until: f64,
}

impl<S: Space> Load<S> {
    /// The same load in another precision.
    pub fn convert<Q: Space>(&self) -> Load<Q> {
        Load {
            body: self.body,
            frame: self.frame,
            force: Q::Vector::from_f64(self.force.to_f64()),
            torque: Q::Moment::from_f64(self.torque.to_f64()),
            from: self.from,
            until: self.until,
        }
    }

    /// Potential energy \[J\] of an active load on a body at `position` \[m\].
    #[inline]
    pub fn energy(&self, position: S::Vector) -> S::Real {
        match self.frame {
            LoadFrame::World => -self.force.dot(position),
            LoadFrame::Body => S::Real::ZERO,
        }
    }
}
