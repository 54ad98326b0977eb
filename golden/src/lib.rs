//! Golden trajectories: a run recorded once, with which every later one is compared.
//!
//! `plant => samples as text; text, plant => equal, within bands, or the first difference`. The modules
//! in the order in which they stand on each other:
//!
//! - `number`, `component`, [`head`], `chain`: what lines are made of.
//! - [`subject`]: what is recorded.
//! - [`record`]: a run becomes lines.
//! - [`mismatch`]: what can be wrong, with both values.
//! - [`mod@text`]: a file's lines become numbers, or damage is named.
//! - [`bands`]: how far a run may be off.
//! - [`compare`]: a run beside a file.
//! - [`plants`], [`recording`], [`blessing`], [`band_list`], [`file`](mod@file): plants by name, runs in memory, consent
//!   to a new file, bands as text, files (feature `std`).
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
pub use number::Digits;
#[cfg(feature = "std")]
pub use plants::Readable;
pub use record::{RecordError, Recorder};
#[cfg(feature = "std")]
pub use recording::Recording;
pub use subject::{Moment, Subject};
pub use text::Golden;
