//! Reports of a run: one self-contained page.
//!
//! `(scene, samples) => data => page`. The modules in dependency order:
//!
//! - [`output`]: files that appear complete or not at all, parts of drawings and pages.
//! - [`picture`](mod@picture): a mechanism's geometry, and a picture of it.
//! - [`packed`]: numbers as text.
//! - [`data`]: data of the page.
//! - [`measure`]: sizes of a mechanism and its joints.
//! - [`turn`]: rotation of a body, without jumps.
//! - [`loading`]: forces at a state.
//! - [`film`]: frames at evenly spread samples.
//! - [`curves`]: curves on one grid of times, thinned.
//! - [`charts`]: curves of a run, and their selection.
//! - [`recording`]: recording of a run.
//! - [`page`]: the page.
//! - [`gltf`]: the animation as a file for programs that show models.
//! - `mcap` (feature): the run as a file for programs that show robots' logs.

pub mod charts;
pub mod curves;
pub mod data;
pub mod film;
pub mod gltf;
pub mod loading;
#[cfg(feature = "mcap")]
pub mod mcap;
pub mod measure;
pub mod output;
pub mod packed;
pub mod page;
pub mod picture;
pub mod recording;
pub mod turn;

pub use data::Data;
pub use recording::{Recorded, Recording, Sample};
