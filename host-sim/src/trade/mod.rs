//! `host-sim trade`: speed against accuracy, every way of stepping a scene at every step.
//!
//! `scene => truth over a window => points (error, energy, cost) => fronts, chart, sentences`.
//!
//! - [`point`]: what a point is, and which of them nothing beats.
//! - [`ways`]: all ways of stepping a scene, and their ladders of steps.
//! - [`grid`], [`truth`], [`metric`]: the times compared, what is true there, and how far off that is.
//! - [`measure`]: how far off a way is at a step, and what a step costs.
//! - [`mod@survey`]: all points, in parallel, kept as they come ([`cache`]).
//! - [`need`], [`advice`], [`command`]: what an accuracy costs, in sentences and tables, and how to
//!   run it.
//! - [`chart`], [`page`]: what people look at; [`files`] writes it and `trade.csv`.

pub mod advice;
pub mod cache;
pub mod chart;
pub mod command;
pub mod files;
pub mod grid;
pub mod measure;
pub mod metric;
pub mod need;
pub mod page;
pub mod point;
pub mod survey;
pub mod truth;
pub mod ways;

pub use point::{Machine, Point, Stepper, front};
pub use survey::{Phase, Trade, TradeOptions, survey};
