//! The accuracy-against-speed chart as an SVG.
//!
//! `(points, machine) => SVG`: cost to the right, error upwards, both logarithmic; a line for each
//! stepper through its steps, the front as a band, to the right of each power of ten what to choose
//! for it, what is unstable in a strip at the top.
//!
//! - `axis`, `style`, `layout`: where a value lies, what a stepper looks like, how large it all is.
//! - `drawing`: measures, lines and marks.
//! - `choices`, `frame`, `labels`: what lies beside, around and beneath them, and their names.

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
