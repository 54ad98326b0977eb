//! The results of a run.
//!
//! - [`trace`]: every sample, as rows.
//! - [`golden`]: the result of a golden comparison.
//! - [`statistics`], [`summary`]: figures over all samples.
//! - [`mod@text`]: the texts of its page.
//! - [`mod@show`]: the files for people.

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
