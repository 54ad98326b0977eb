#![doc = include_str!("../README.md")]
#![cfg_attr(docsrs, feature(doc_cfg))]

mod register;
mod lanes;
mod alike;
mod gather;
mod batch;
mod instructions;
mod number;
mod ensemble;

pub use alike::Difference;
pub use batch::PlantOf;
pub use ensemble::{Ensemble, EnsembleError};
pub use instructions::InstructionSet;
pub use number::Number;
