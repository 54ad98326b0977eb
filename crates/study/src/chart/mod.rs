//! The accuracy-against-speed chart as an SVG.
//!
//! `(points, machine) => SVG`: cost to the right, error upwards, both logarithmic; a line for each
//! stepper through its steps, the Pareto front as a band, to the right of each power of ten its choice, unstable points
//! in a strip at the top.
//!
//! - `axis`, `style`, `layout`: positions of values, appearance of steppers, dimensions.
//! - `drawing`: dimensions, lines and marks.
//! - `choices`, `frame`, `labels`: elements beside, around and below them, and their names.

mod axis;
mod choices;
mod drawing;
mod frame;
mod labels;
mod layout;
mod style;

pub use drawing::{Chart, hover, narrow_svg, steppers, svg};

#[cfg(test)]
pub(crate) mod tests;
