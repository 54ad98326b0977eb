//! What a number of several lanes is made of: one register of an instruction set.
//!
//! `(register, register) => register`, each operation IEEE 754's in every lane. Nothing is fused, so a
//! lane has the bits of the scalar operation.

mod array;
mod interface;
#[cfg(target_arch = "x86_64")]
mod x86;

pub(crate) use array::{Doubles, Singles};
pub(crate) use interface::{Register, Work};
#[cfg(target_arch = "x86_64")]
pub(crate) use x86::{Doubles256, Doubles512, Singles256, Singles512};
