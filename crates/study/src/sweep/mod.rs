//! Sweeps: one scene, many values, one row per case.
//!
//! `SPEC.toml => axes => cases; rows of finished cases => table, page`. Cases are run elsewhere, from changes of the
//! scene's values and a method to a row. The modules in dependency order:
//!
//! - [`refusal`]: errors of a sweep, with the position in its file.
//! - `text`: TOML values with positions.
//! - [`value`]: values of an axis, for the scene and for the table.
//! - `range`: values from one end to the other.
//! - [`key`]: identity of a case.
//! - [`random`]: seeded samples and Latin hypercubes.
//! - [`axis`]: varied quantities and their values.
//! - `read`: tables of the file as axes.
//! - [`statistic`]: figures of a column over a run.
//! - [`spec`]: the whole file.
//! - [`cases`]: the cases of a sweep, in their order.
//! - [`check`](mod@check): checks of every axis before any case runs.
//! - [`columns`](mod@columns): selected columns of a trace.
//! - [`shard`]: a fraction of the cases.
//! - [`row`]: result of a case.
//! - [`store`]: rows of finished cases, kept in a folder.
//! - [`table`]: rows in the order of the cases, as CSV.
//! - `parquet`: the same as a Parquet file.
//! - `coordinates`: values of an axis as positions in a drawing.
//! - [`page`]: page for people.
//!
//! # Features
//!
//! | feature | brings |
//! |---|---|
//! | `parquet` | the table as a Parquet file, too |

pub mod axis;
pub mod cases;
pub mod check;
pub mod columns;
mod coordinates;
pub mod key;
pub mod page;
#[cfg(feature = "parquet")]
pub mod parquet;
pub mod random;
mod range;
mod read;
pub mod refusal;
pub mod row;
pub mod shard;
pub mod spec;
pub mod statistic;
pub mod store;
pub mod table;
mod text;
pub mod value;

pub use spec::Spec;
