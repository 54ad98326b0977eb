//! A planned run, and what there is to say where it fails.
//!
//! - [`run`]: sample by sample.
//! - [`failure`]: where it failed and which step works.

pub mod failure;
pub mod run;

pub use failure::FailedRun;
pub use run::{Ending, Observer, Sample, SimulationError, simulate};
