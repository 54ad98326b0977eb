//! One register of an instruction set, the basis of a number of several lanes.
//!
//! `(register, register) => register`, with IEEE 754 operations in every lane. Nothing is fused, so a lane has the bits
//! of the scalar operation.

mod array;
mod interface;
#[cfg(target_arch = "x86_64")]
mod x86;

pub(crate) use array::{Doubles, Singles};
pub(crate) use interface::{Register, Work};
#[cfg(target_arch = "x86_64")]
pub(crate) use x86::{Doubles256, Doubles512, Singles256, Singles512};
