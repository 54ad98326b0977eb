//! A planned run, and what there is to say where it fails.
//!
//! - `rows`: what lanes step, and steps of a large scene in them.
//! - [`run`]: sample by sample.
//! - [`together`]: alike runs in lockstep.
//! - [`watch`]: over its energy.
//! - [`failure`]: where it failed and which step works.

pub mod failure;
mod rows;
pub mod run;
pub mod together;
pub mod watch;

pub use failure::FailedRun;
pub use rows::lanes;
pub use run::{Ending, Observer, Sample, SimulationError, simulate};
pub use together::{Member, simulate_together};
pub use watch::{EnergyLimit, EnergyStop, EnergyWatch};
