//! Controllers as for a real board: against embedded-hal, independent of the simulation.
//!
//! `encoders => duties, once per tick`. The same source drives mocks, a plant on a PC, a plant on the chip
//! and, given real pins, a machine. Arithmetic in single precision, by one operation after the
//! other and libm: the same bits on every machine.

pub mod as5047p;
pub mod balance;
pub mod follow;
pub mod servo;

pub use as5047p::{ReadError, Shaft};
pub use balance::Balance;
pub use follow::Follow;
pub use servo::ControlError;
