//! The bodies of a plain loop, and the loads on them.

use crate::vectors::{Matrix, Quaternion, Vector};

/// A body and how it moves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Body {
    /// \[kg\].
    pub mass: f64,
    /// \[kg·m²\] body axes.
    pub inertia: Vector,
    /// \[m\] centre of mass, world.
    pub position: Vector,
    /// Body → world.
    pub orientation: Quaternion,
    /// \[m/s\] world.
    pub velocity: Vector,
    /// \[rad/s\] body axes.
    pub rate: Vector,
    /// Body → world, of this pose.
    pub(super) rotation: Matrix,
    /// \[rad/s\] world axes, at this pose.
    pub(super) spin: Vector,
    /// \[N\] world axes.
    pub(super) force: Vector,
    /// \[N·m\] about the centre of mass: world axes while elements add to it, then body axes, with what tumbling
    /// does.
    pub(super) torque: Vector,
}

/// A force and a torque on a body over a window of time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Load {
    pub(super) body: usize,
    pub(super) in_body_axes: bool,
    pub(super) force: Vector,
    pub(super) torque: Vector,
    pub(super) from: f64,
    pub(super) until: f64,
}
