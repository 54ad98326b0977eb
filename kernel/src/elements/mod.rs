//! The element laws, one per file: the law, its sign, its energy, its part of the frequency bound.
//!
//! A law between two points uses displacements, velocities and lever arms. Loads, inputs and torsion springs refer to
//! bodies. [`crate::forces`] computes points, groups them and sums the forces.

pub mod clearance;
pub mod element;
pub mod gravity;
pub mod input;
pub mod load;
pub mod point_bushing;
pub mod point_law;
pub mod point_on_line;
pub mod revolute;
pub mod share;
pub mod source;
pub mod torsion_spring;
pub mod tsda;
pub mod universal;
