//! The linear system of a scheme that includes the joints' stiffness in its step.
//!
//! `(plan, pose, weights) => M-weighted tangent, factor, solution`. The matrix has a block for each body, for each pair
//! of bodies joined by elements, and for the fill-in; the elimination order is determined when the model is built
//! ([`Plan`](crate::model::Plan)) and stored in flash. No pivoting, no iteration: the matrix is positive definite for
//! every step, stiffness and damping.

mod assemble;
mod pencil;
mod seat;
mod system;

pub(crate) use assemble::assemble;
pub use pencil::Pencil;
pub use seat::Seat;
pub(crate) use seat::find;
pub(crate) use system::System;
