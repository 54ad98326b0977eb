//! `host-sim trade`: speed against accuracy, every way of stepping a scene.

pub mod advice;
pub mod chart;
pub mod need;
pub mod page;
pub mod point;

pub use point::{Machine, Point, Stepper, front};
