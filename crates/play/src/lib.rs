#![doc = include_str!("../README.md")]
//!
//! # Modules
//!
//! Each uses only those before it:
//!
//! - [`refused`]: why a request is refused, in the words of the command line.
//! - [`session`]: a plant that is stepped, changed, grabbed and wound back.
//! - [`ask`]: requests and answers as JSON.
//! - `exported`: the functions that a page calls, on WebAssembly only.
//! - [`page`]: the page around them, on a PC only.

pub mod ask;
#[cfg(target_family = "wasm")]
mod exported;
#[cfg(not(target_family = "wasm"))]
pub mod page;
pub mod refused;
pub mod session;

pub use ask::Desk;
pub use session::Session;
