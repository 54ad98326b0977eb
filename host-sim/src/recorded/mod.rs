//! Runs that were recorded, read back: what they are, and their samples in order.
//!
//! `path => head, rows; or file, line and column of what is wrong`.
//!
//! - [`unreadable`]: what can be wrong.
//! - [`lines`]: a text of any size, line by line.
//! - [`head`]: what a run was.
//! - [`row`], [`row_text`]: a sample, and its line.
//! - [`summary`]: what is needed of a `summary.json`.
//! - [`trace`]: the rows of a `trace.csv`, held against its summary.
//! - [`golden`]: a golden file, by itself or within what a console showed.
//! - [`run`]: either, by the path that a user gives.

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
