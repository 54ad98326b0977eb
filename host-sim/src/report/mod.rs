//! What is left of a run.
//!
//! - [`trace`]: every sample, as rows.
//! - [`golden`]: what a comparison came to.
//! - [`statistics`], [`summary`]: what they amount to.
//! - [`curves`], [`page`]: what people look at.

pub mod curves;
pub mod golden;
pub mod page;
pub mod statistics;
pub mod summary;
pub mod trace;

pub use curves::Curves;
pub use golden::{GoldenOutcome, NotGolden};
pub use page::{Report, html};
pub use statistics::{Figures, ReadoutFigures, Statistics};
pub use summary::{JointOpening, SetValue, Summary};
pub use trace::TraceWriter;
