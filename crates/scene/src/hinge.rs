//! Axes of rotation of joints.

use dbd_kernel::{BodyIndex, Vec3};

/// An axis of rotation between two bodies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hinge {
    /// The first body.
    pub a: BodyIndex,
    /// The second body; angles are its rotation relative to the first.
    pub b: BodyIndex,
    /// \[1\] unit axis in the first body's axes.
    pub axis: Vec3<f64>,
}
