//! A planned run, and what there is to say where it fails.
//!
//! - [`run`]: sample by sample.
//! - [`watch`]: over its energy.
//! - [`failure`]: where it failed and which step works.

pub mod failure;
pub mod run;
pub mod watch;

pub use failure::FailedRun;
pub use run::{Ending, Observer, Sample, SimulationError, simulate};
pub use watch::{EnergyLimit, EnergyStop, EnergyWatch};
