//! A planned run.
//!
//! - [`run`]: sample by sample.
//! - [`together`]: similar runs in lockstep, with the feature `lanes`.
//! - [`watch`]: the energy watch.
//! - [`balance`]: the energy balance.
//! - [`engaged`]: engagements of its stops, ropes and contacts.

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
