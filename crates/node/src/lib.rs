//! A plant behind `embedded-hal`: virtual devices for a controller's drivers, on a PC and on a chip.
//!
//! A [`Node`] steps a machine, any plant of the kernel, together with its parts: motors that drive its inputs, sensors
//! that read its read-outs. Drivers use ports that implement the traits of embedded-hal 1.0; a controller written
//! against those runs unchanged. The crate is `no_std`, does not allocate or panic, and the same seeds give the same
//! bits on every machine.
//!
//! The modules, each of which uses only those before it:
//!
//! - [`number`], [`fault`]: conversion to integers; errors.
//! - [`machine`], [`probe`]: the simulated machine; attachment of a sensor to it.
//! - [`sensor`]: one number of a sensor, with the kernel's seeded noise and error model.
//! - [`share`], [`part`], [`node`]: shared cells; the parts that a node steps; the node.
//! - [`motor`], [`encoder`], [`end_stop`]: parts without registers.
//! - [`spi`], [`i2c`]: buses.
//! - [`as5047p`], [`ls7366r`], [`mpu6000`]: parts behind registers.
//! - [`pins`], [`pwm`], [`delay`]: the other driver ports.
#![no_std]
#![forbid(unsafe_code)]

#[cfg(test)]
extern crate std;

pub mod as5047p;
pub mod delay;
pub mod encoder;
pub mod end_stop;
pub mod fault;
pub mod i2c;
pub mod ls7366r;
pub mod machine;
pub mod motor;
pub mod mpu6000;
pub mod node;
pub mod number;
pub mod part;
pub mod pins;
pub mod probe;
pub mod pwm;
pub mod sensor;
pub mod share;
pub mod spi;

pub use as5047p::As5047p;
pub use delay::NodeDelay;
pub use encoder::{Encoder, EncoderParameters};
pub use end_stop::{EndStop, Side};
pub use fault::{Fault, Problem, WiringError};
pub use i2c::I2cEnd;
pub use ls7366r::Ls7366r;
pub use machine::Machine;
pub use motor::{Channel, Motor, MotorParameters, Supply};
pub use mpu6000::{ImuParameters, Mpu6000};
pub use node::Node;
pub use number::Number;
pub use part::{Part, Wires};
pub use pins::{Active, EncoderPin, Signal, SwitchPin};
pub use probe::Probe;
pub use pwm::{BridgePin, DutyEnd};
pub use sensor::{Errors, Sensor};
pub use share::Shared;
#[cfg(feature = "critical-section")]
pub use share::Slot;
pub use spi::{ChipSelect, SpiEnd, SpiWires};
