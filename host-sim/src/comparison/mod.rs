//! Comparison of two recorded runs at their common times.
//!
//! `(head, rows) of A and of B, bands => equal, within bands, or where they first differ and how far apart they go`.
//!
//! - [`pairing`]: pairs of bodies and values with the same name.
//! - [`quantity`]: the distance of a quantity over all samples.
//! - [`first`]: where two samples first differ.
//! - [`walk`]: sample by sample.
//! - [`run`]: two whole runs.

pub mod first;
pub mod pairing;
pub mod quantity;
pub mod run;
pub mod walk;

pub use first::{Beyond, First};
pub use pairing::Pairing;
pub use quantity::Quantity;
pub use run::{CompareError, Comparison, Verdict, compare};
