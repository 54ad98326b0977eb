#![doc = include_str!("../README.md")]
//!
//! # Modules
//!
//! Each uses only those before it:
//!
//! - `alike`, `gather`: structural check; conversion of models and states between instances and lanes.
//! - `in_lanes`, `batch`: schemes that support lanes; as many instances as a register has lanes, stepped together.
//! - `instructions`, `number`: instruction sets of a machine, and the batches of each precision.
//! - `ensemble`, `pace`, `leapfrog`: many instances, their speed, and precompiled ensembles for leapfrog.
#![cfg_attr(docsrs, feature(doc_cfg))]

mod alike;
mod batch;
mod ensemble;
mod gather;
mod in_lanes;
mod instructions;
mod leapfrog;
mod number;
mod pace;

pub use alike::Difference;
pub use batch::PlantOf;
pub use ensemble::{Ensemble, EnsembleError};
pub use in_lanes::InLanes;
pub use instructions::InstructionSet;
pub use leapfrog::{
    AnyEnsemble, ensemble_in_f32, ensemble_in_f64, lanes_in_f64, pace_in_f32, pace_in_f64,
};
pub use number::Number;
pub use pace::{Course, Pace, pace};
