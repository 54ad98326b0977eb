//! Colours and widths, light and dark, as a style sheet within the SVG.
//!
//! Bodies in colours of Okabe & Ito (2008), distinct for colour-blind readers; forces and inputs in their vermilion.
//! Every rule is bound to the picture's class, so that it does not affect a surrounding page.

/// The class of the picture's root.
pub(crate) const ROOT: &str = "mechanism";

/// Colours of bodies.
pub(crate) const COLOURS: usize = 5;

/// \[pixels\] of letters: they can be read where the sheet is scaled down to a narrow screen.
pub(crate) const LETTERS: f64 = 17.0;

/// Shapes, in light colours.
const SHEET: &str = include_str!("picture.css");

/// Changes for a dark screen.
const DARK: &str = include_str!("dark.css");

/// The style sheet, which follows the reader's screen.
pub(crate) fn sheet() -> String {
    format!("{SHEET}@media (prefers-color-scheme: dark) {{\n{DARK}}}\n")
}
