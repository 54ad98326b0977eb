//! What people look at of a run: one page that needs no other file.
//!
//! `(scene, samples) => data => page`. The modules in the order in which they stand on each other:
//!
//! - [`output`]: files that appear complete or not at all, parts of drawings and pages.
//! - [`picture`](mod@picture): a mechanism's geometry, and a picture of it.
//! - [`packed`]: numbers as text.
//! - [`data`]: what the page draws from.
//! - [`measure`]: how large a mechanism and its joints are.
//! - [`turn`]: how far a body has turned, without jumps.
//! - [`loading`]: what pulls and pushes at a state.
//! - [`film`]: frames at evenly spread samples.
//! - [`curves`]: curves on one grid of times, thinned.
//! - [`charts`]: which curves there are, and which of them are shown.
//! - [`recording`]: a run as it goes on.
//! - [`page`]: the page.
//! - [`gltf`]: the animation as a file for programs that show models.

pub mod charts;
pub mod curves;
pub mod data;
pub mod film;
pub mod gltf;
pub mod loading;
pub mod measure;
pub mod output;
pub mod packed;
pub mod page;
pub mod picture;
pub mod recording;
pub mod turn;

pub use data::Data;
pub use recording::{Recorded, Recording, Sample};
