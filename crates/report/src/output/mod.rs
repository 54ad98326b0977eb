//! Output of a run or a study: files, drawings, pages.
//!
//! - `lock`: one program at a time.
//! - [`file`](mod@file): files that appear complete or not at all.
//! - [`set`]: files that belong together.
//! - [`markup`]: escaped text, the common style of pages.
//! - [`page`]: an HTML page.
//! - [`svg`]: elements of drawings.
//! - [`dark`]: colours on a dark screen.
//! - [`label_positions`]: placement of names in a drawing.

pub mod dark;
pub mod file;
pub mod label_positions;
mod lock;
pub mod markup;
pub mod page;
pub mod set;
pub mod svg;
