//! Drawings of a figure over one axis or two, as SVG.
//!
//! - `scale`: positions of values, and round ticks.
//! - [`frame`]: grid, numbers and axis titles.
//! - [`lines`]: curves and points over a scale.
//! - [`heat`]: one coloured cell per pair of values.

pub mod frame;
pub mod heat;
pub mod lines;
mod scale;

pub use scale::Scale;

/// Text.
pub const INK: &str = "#333a45";
const FRAME: &str = "#8f949b";
const GRID: &str = "#e3e7ec";
/// In place of a unit: that of the quantity.
pub const SI: &str = "SI";
/// Cases that did not come to their end.
const FAILED: &str = "#c0392b";

/// Distinct for people who see few colours, too (Okabe & Ito 2008).
pub const COLOURS: [&str; 8] =
    ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000", "#8a7f00"];
