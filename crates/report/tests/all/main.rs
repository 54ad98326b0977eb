//! Pictures of the scenes that ship.

mod geometry;
mod pictures;
