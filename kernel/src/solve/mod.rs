//! The linear system of a scheme that takes the joints' stiffness into its step.
//!
//! `(plan, pose, weights) => M-weighted tangent, factor, solution`. The matrix has a block for each body
//! and for each pair of bodies that elements lie between, and what elimination fills; the order of
//! elimination is found when the model is built ([`Plan`](crate::model::Plan)) and kept in flash. No pivoting, no iteration:
//! the matrix is positive definite for every step, stiffness and damping.

mod assemble;
mod pencil;
mod seat;
mod system;

pub(crate) use assemble::assemble;
pub use pencil::Pencil;
pub use seat::Seat;
pub(crate) use seat::find;
pub(crate) use system::System;
