//! `host-sim trade`: speed against accuracy, every way of stepping a scene at every step.
//!
//! `scene => truth over a window => points (error, energy, cost) => fronts, chart, sentences`.
//!
//! - [`point`]: what a point is, and which of them nothing beats.
//! - [`ways`]: all ways of stepping a scene, and their ladders of steps.
//! - [`measure`]: how far off a way is at a step, and what a step costs.
//! - [`mod@survey`]: all points, in parallel, kept as they come ([`cache`]).
//! - [`need`], [`advice`]: what an accuracy costs, in sentences and tables.
//! - [`chart`], [`page`]: what people look at; [`files`] writes it and `trade.csv`.

pub mod advice;
pub mod cache;
pub mod chart;
pub mod files;
pub mod measure;
pub mod need;
pub mod page;
pub mod point;
pub mod survey;
pub mod ways;

pub use point::{Machine, Point, Stepper, front};
pub use survey::{Trade, TradeOptions, survey};
