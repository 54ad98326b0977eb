//! What is left of a run or a study: files, drawings, pages.
//!
//! - `lock`: one program at a time.
//! - [`file`](mod@file): files that appear complete or not at all.
//! - [`set`]: files that belong together.
//! - [`markup`]: text as HTML and SVG take it, the style that pages share.
//! - [`page`]: an HTML page.
//! - [`svg`]: what drawings are made of.
//! - [`dark`]: what their colours become on a dark screen.
//! - [`label_spots`]: where names go in a drawing.

pub mod dark;
pub mod file;
pub mod label_spots;
mod lock;
pub mod markup;
pub mod page;
pub mod set;
pub mod svg;
