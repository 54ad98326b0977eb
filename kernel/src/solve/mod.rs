//! The linear system of a scheme that includes the joints' stiffness in its step.
//!
//! `(plan, pose, weights) => M-weighted tangent, factor, solution`. The matrix has a block for each body, for each pair
//! of bodies joined by elements, and for the fill-in; the elimination order is determined when the model is built
//! ([`Plan`](crate::model::Plan)) and stored in flash. No pivoting, no iteration: the matrix is positive definite for
//! every step, stiffness and damping.

mod assemble;
mod lumped_joint;
mod matrix_weights;
mod system;

pub(crate) use assemble::assemble;
pub use lumped_joint::LumpedJoint;
pub(crate) use lumped_joint::find;
pub use matrix_weights::MatrixWeights;
pub(crate) use system::System;
