//! What people look at of a run: one page that needs no other file.
//!
//! `(scene, samples) => data => page`. The modules in the order in which they stand on each other:
//!
//! - [`packed`]: numbers as text.
//! - [`data`]: what the page draws from.
//! - [`page`]: the page.

pub mod data;
pub mod packed;
pub mod page;
