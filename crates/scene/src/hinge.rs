//! Axes about which joints turn.

use dbd_kernel::{BodyIndex, Vec3};

/// An axis about which one body turns in another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hinge {
    /// The first body.
    pub a: BodyIndex,
    /// The second body; its turn about the axis, seen from the first, counts.
    pub b: BodyIndex,
    /// \[1\] unit axis in the first body's axes.
    pub axis: Vec3<f64>,
}
