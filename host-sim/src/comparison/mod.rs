//! Two recorded runs beside each other, at the times that both have.
//!
//! `(head, rows) of A and of B, bands => equal, within bands, or where they first differ and how far apart they go`.
//!
//! - [`pairing`]: which bodies and values go together, by their names.
//! - [`quantity`]: how far apart a quantity is, over all samples.
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
