//! The element laws, one per file: the law, its sign, its energy.
//!
//! A law sees displacements, velocities and arms, never a body or an index; grouping and summing
//! is [`crate::forces`]' work.

pub mod clearance;
pub mod gravity;
pub mod input;
pub mod load;
pub mod point_bushing;
pub mod point_on_line;
pub mod torsion_spring;
pub mod tsda;
