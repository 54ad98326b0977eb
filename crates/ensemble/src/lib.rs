#![doc = include_str!("../README.md")]
//!
//! # Modules
//!
//! Each uses only those before it:
//!
//! - `register`, `lanes`: one register of an instruction set, and the number that the kernel takes.
//! - `alike`, `gather`: models of one structure become the model of lanes, states likewise and back.
//! - `in_lanes`, `batch`: which schemes lanes step; as many instances as a register has lanes, stepped as one.
//! - `instructions`, `number`: what a machine has, and which batches a number has there.
//! - `ensemble`, `pace`, `leapfrog`: many instances, how fast they are, and leapfrog's compiled once.
#![cfg_attr(docsrs, feature(doc_cfg))]

mod alike;
mod batch;
mod ensemble;
mod gather;
mod in_lanes;
mod instructions;
mod lanes;
mod leapfrog;
mod number;
mod pace;
mod register;

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
