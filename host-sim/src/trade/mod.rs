//! `host-sim trade`: speed against accuracy, every way of stepping a scene.

pub mod point;

pub use point::{Machine, Point, Stepper, front};
