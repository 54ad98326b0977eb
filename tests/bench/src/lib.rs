//! What a step is made of, and what it is measured with.
//!
//! `model => floating-point operations; number of links => model; model => a plain loop`. The modules in the
//! order in which they stand on each other:
//!
//! - [`counted`]: a number that counts what is done with it.
//! - [`flops`]: the operations of a step.
//! - [`chain`]: chains of any length.
//! - [`vectors`], [`plain`](mod@plain): the same steps, written plainly.
//! - [`kept`]: the energy that a scheme keeps, by which rounding is seen.
//! - [`stepped`]: the constants that a step has, for that energy.
//! - `command`: times of all these on this machine, for `cargo xtask bench`; with the feature `command`.
//!
//! `examples/steps.rs` takes steps for `cargo xtask instructions`, which counts their instructions.

pub mod chain;
#[cfg(feature = "command")]
pub mod command;
pub mod counted;
pub mod flops;
pub mod kept;
pub mod plain;
pub mod stepped;
pub mod vectors;
