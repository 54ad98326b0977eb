//! Numbers of 32 digits, so that what is computed from points is rounded once: the number in the
//! model is the double nearest to the exact one, whatever way led to it.
//!
//! `sums of two doubles => sums, products, quotients, roots; sine, cosine, arctangent; vectors`.
//! Source: Dekker, Numer. Math. 18 (1971) 224; Hida, Li & Bailey, ARITH-15 (2001) 155. Only sums,
//! products and libm's functions of doubles, so the bits are the same on every host.

mod number;
mod trigonometry;
mod vector;

pub(crate) use number::Precise;
pub(crate) use trigonometry::{arctangent, sine_and_cosine};
pub(crate) use vector::PreciseVector;
