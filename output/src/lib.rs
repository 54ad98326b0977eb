//! What is left of a run or a study: files, drawings, pages.
//!
//! - [`file`](mod@file): files that appear complete or not at all.
//! - [`markup`]: text as HTML and SVG take it, the style that pages share.
//! - [`svg`]: what drawings are made of.
//! - [`panel`]: curves over time as an SVG.

pub mod file;
pub mod markup;
pub mod panel;
pub mod svg;
