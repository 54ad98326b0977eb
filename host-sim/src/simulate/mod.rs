//! A planned run.
//!
//! - [`run`]: sample by sample.
//! - [`together`]: alike runs in lockstep, with the feature `lanes`.
//! - [`watch`]: over its energy.
//! - [`balance`]: where its energy came from.
//! - [`engaged`]: what its stops, ropes and contacts did.

pub mod balance;
pub mod engaged;
pub mod run;
pub mod together;
pub mod watch;

pub use balance::{Balance, EnergyBalance};
pub use engaged::Engagement;
pub use run::{Ending, Observer, Sample, SimulationError, simulate};
pub use together::{Member, lanes, simulate_together};
pub use watch::{EnergyLimit, EnergyStop, EnergyWatch};
