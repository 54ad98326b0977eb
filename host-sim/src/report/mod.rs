//! What is left of a run.
//!
//! - [`trace`]: every sample, as rows.
//! - [`golden`]: what a comparison came to.
//! - [`statistics`], [`summary`]: what they amount to.
//! - [`mod@text`]: what its page says in words.
//! - [`mod@show`]: the files that people look at.

pub mod golden;
pub mod show;
pub mod statistics;
pub mod summary;
pub mod text;
pub mod trace;

pub use golden::{GoldenOutcome, NotGolden};
pub use show::{Shown, show};
pub use statistics::{Figures, ReadoutFigures, Statistics};
pub use summary::{JointOpening, SetValue, Summary};
pub use text::text;
pub use trace::TraceWriter;
