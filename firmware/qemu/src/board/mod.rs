//! The MPS2 board with the AN386 image (Cortex-M4F), as QEMU's `mps2-an386` emulates it.
//!
//! Every hardware number is defined in [`addresses`]. A driver speaks to a [`registers::Registers`],
//! so its logic is tested on a host; only `registers::Mapped`, which exists on the target alone,
//! touches the hardware's memory.

pub mod addresses;
pub mod led;
pub mod registers;
pub mod serial;
pub mod ticks;
pub mod timer;
pub mod uart;

#[cfg(target_os = "none")]
mod fault;
#[cfg(target_os = "none")]
mod interrupt;
#[cfg(target_os = "none")]
pub mod stack;
#[cfg(target_os = "none")]
pub mod systick;
#[cfg(target_os = "none")]
mod take;
#[cfg(target_os = "none")]
pub mod tried;

#[cfg(target_os = "none")]
pub use interrupt::sleep_unless;
#[cfg(target_os = "none")]
pub use take::Board;
