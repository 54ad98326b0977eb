//! Golden trajectories: a run recorded once, against which later runs are compared.
//!
//! `plant => samples as text; text, plant => equal, within bands, or the first difference`. The modules in dependency
//! order:
//!
//! - `number`, `component`, [`head`], `chain`: parts of a line.
//! - [`subject`]: recorded plants.
//! - `distance`: distance of two bodies.
//! - [`record`]: writes a run as lines.
//! - [`mismatch`]: errors and differences, with both values.
//! - [`mod@text`]: reads a file, or names its damage.
//! - [`bands`]: allowed distances.
//! - [`compare`]: compares a run with a file.
//! - [`plants`], [`recording`]: plants by name; runs in memory (these and the following: feature `std`).
//! - [`blessing`], [`band_list`], [`file`](mod@file): permission to write a file, bands as text, files.
//!
//! Tests, blessing and guarantees on bits: `docs/golden.md` in the repository. Without `std`, as in firmware:
//!
//! ```
//! use dbd_golden::{Comparison, Golden, Head, Recorder, Subject as _, Tolerance};
//! use dbd_kernel::model_spec::{ModelSpec, Start};
//! use dbd_kernel::{Leapfrog, Plant, model};
//!
//! const MODEL_SPEC: ModelSpec = ModelSpec::new().gravity([0.0, -9.81, 0.0]).body(1.0, [0.1; 3], Start::at([0.0; 3]));
//! model!(static BALL: F32 = MODEL_SPEC);
//!
//! let mut plant = Plant::new(&BALL, Leapfrog, 1e-3)?;
//! let identity = plant.identity();
//! let head = Head { scene: "ball", identity, every: 100, bodies: &["ball"], values: &[] };
//! let mut printed = Recorder::begin(String::new(), &head)?; // or a console
//! for _ in 0..=300 {
//!     printed.look(&plant, &[])?; // every hundredth step
//!     plant.step()?;
//! }
//! let text = printed.finish()?;
//!
//! plant.reset();
//! let mut comparison = Comparison::new(Golden::read(&text).unwrap(), head, Tolerance::Bits).unwrap();
//! while let Some(due) = comparison.due() {
//!     plant.advance(due - plant.state().step)?;
//!     comparison.sample(&plant, &[]).unwrap();
//! }
//! assert_eq!(comparison.finish().unwrap().samples, 4);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
#![no_std]
#![allow(
    clippy::result_large_err,
    reason = "a finding is made once, and nothing may be allocated for it on a target"
)]

#[cfg(any(test, feature = "std"))]
extern crate std;

#[cfg(feature = "std")]
pub mod band_list;
pub mod bands;
#[cfg(feature = "std")]
pub mod blessing;
mod chain;
pub mod compare;
mod component;
mod distance;
#[cfg(feature = "std")]
pub mod file;
pub mod head;
pub mod mismatch;
mod number;
#[cfg(feature = "std")]
pub mod plants;
pub mod record;
#[cfg(feature = "std")]
pub mod recording;
pub mod subject;
pub mod text;

#[cfg(feature = "std")]
pub use band_list::BandList;
pub use bands::{Bands, Tolerance};
#[cfg(feature = "std")]
pub use blessing::Blessing;
pub use compare::{Comparison, Summary};
pub use component::{Component, Quantity};
#[cfg(feature = "std")]
pub use file::{GoldenError, GoldenFile, Verdict};
pub use head::{Head, Identity};
pub use mismatch::{Damage, Difference, Mismatch};
pub use number::{Digits, same};
#[cfg(feature = "std")]
pub use plants::Readable;
pub use record::{RecordError, Recorder};
#[cfg(feature = "std")]
pub use recording::Recording;
pub use subject::{Moment, Subject};
pub use text::{Golden, Row, Rows};
