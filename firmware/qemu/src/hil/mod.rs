//! Hardware in the loop: this board as one end of a serial line, UART 0, with the plant or its controller.
//!
//! `bytes, ticks => plant's steps => bytes`, or `plant's outputs => controller => inputs`. The protocol is that of
//! [`dbd_link`]; the other end is a PC or another board. The modules:
//!
//! - [`plants`]: the plants that can be served.
//! - [`remote`]: a plant at the far end of the line, to which parts are wired as to one in this image.
//! - [`controller`]: the controller's end.
//! - `line`, `plant`: UART and timers of the board; the plant's end. They exist on the target alone.

pub mod controller;
pub mod plants;
pub mod remote;

#[cfg(target_os = "none")]
mod line;
#[cfg(target_os = "none")]
mod plant;
#[cfg(target_os = "none")]
mod target;

#[cfg(target_os = "none")]
pub use target::run;
