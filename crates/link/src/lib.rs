//! Hardware in the loop: a plant and its controller at the two ends of a serial line.
//!
//! One end steps the plant ([`PlantEnd`]), the other one drives it ([`ControllerEnd`]); each may be a microcontroller
//! or a PC. Frames carry a version, a session, a sequence number, a step number and a CRC-32, so that no disturbance of
//! the line steps the plant wrongly. The crate is `no_std` and does not allocate. The protocol is described in the
//! book's page on hardware in the loop.
//!
//! The modules, each of which uses only those before it:
//!
//! - [`message`]: messages between the two ends.
//! - [`frame`]: messages as bytes.
//! - [`device`]: the interface of a plant for its end; the kernel's plant.
//! - [`plant_end`], [`controller_end`]: the two ends.
//! - [`host`]: the PC side (feature `host`).
#![cfg_attr(not(feature = "host"), no_std)]
#![forbid(unsafe_code)]

#[cfg(all(test, not(feature = "host")))]
extern crate std;

pub mod controller_end;
pub mod device;
pub mod frame;
#[cfg(feature = "host")]
pub mod host;
pub mod message;
pub mod plant_end;

pub use controller_end::ControllerEnd;
pub use device::{Device, KernelPlant};
pub use plant_end::{Line, PlantEnd};
