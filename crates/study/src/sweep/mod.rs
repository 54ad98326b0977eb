//! Sweeps: one scene, many values, one row per case.
//!
//! `SPEC.toml => axes => cases; rows of cases, kept as they finish => table, page`. What runs a case is
//! not here: it gets changes of the scene's values and a method, and gives a row. The modules in the order
//! in which they stand on each other:
//!
//! - [`refusal`]: why a sweep is refused, with the place in its file.
//! - `text`: TOML whose values know their place.
//! - [`value`]: what an axis may hold, as the scene takes it and as the table shows it.
//! - `range`: values from one end to the other.
//! - [`key`]: what makes two cases the same.
//! - [`random`]: seeded samples and Latin hypercubes.
//! - [`axis`]: what varies, and over which values.
//! - `read`: tables of the file as axes.
//! - [`statistic`]: figures of a column over a run.
//! - [`spec`]: the whole file.
//! - [`cases`]: the cases of a sweep, in their order.
//! - [`check`](mod@check): every axis, before any case runs.
//! - [`columns`](mod@columns): what of a trace the table has.
//! - [`shard`]: a share of the cases.
//! - [`row`]: what a case came to.
//! - [`store`]: rows of finished cases, kept in a folder.
//! - [`table`]: rows in the order of the cases, as CSV.
//! - `parquet`: the same as a Parquet file.
//! - `coordinates`: values of an axis as places in a drawing.
//! - [`page`]: what people look at.
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
