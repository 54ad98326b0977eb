//! Recorded runs, read back: their heads and their samples in order.
//!
//! `path => head, rows; or file, line and column of the error`.
//!
//! - [`unreadable`]: the errors.
//! - [`lines`]: a text of any size, line by line.
//! - [`head`]: the properties of a run.
//! - [`row`], [`row_text`]: a sample, and its line.
//! - [`summary`]: the needed keys of a `summary.json`.
//! - [`trace`]: the rows of a `trace.csv`, checked against its summary.
//! - [`golden`]: a golden file, by itself or within a console log.
//! - [`run`]: either of them, by its path.

pub mod golden;
pub mod head;
pub mod lines;
pub mod row;
pub mod row_text;
pub mod run;
pub mod summary;
pub mod trace;
pub mod unreadable;

pub use head::{Head, Kind, Value};
pub use row::Row;
pub use run::Recorded;
pub use unreadable::Unreadable;
