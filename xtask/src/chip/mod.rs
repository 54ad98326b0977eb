//! The target: its compiler and tools, the firmware's images, the emulator that runs them.

pub mod c_project;
pub mod cores;
pub mod debian;
pub mod emulator;
pub mod firmware;
pub mod project;
pub mod serial;
pub mod setup;
mod toolchain;
pub mod trajectory;

pub use toolchain::Toolchain;
