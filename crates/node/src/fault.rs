//! Errors: wiring errors at the start, and faults at run time.

use core::fmt;

use dbd_kernel::plant::InputError;
use dbd_kernel::{Failure, InputIndex};

/// A sensor or an actuator is not wired, or wired wrongly.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(all(feature = "defmt", target_os = "none"), derive(defmt::Format))]
pub struct WiringError {
    /// The name given by the program.
    pub name: &'static str,
    /// The problem.
    pub problem: Problem,
}

/// A wiring problem.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(all(feature = "defmt", target_os = "none"), derive(defmt::Format))]
pub enum Problem {
    /// The input cannot be set: the model has none, or a table of the scene drives it.
    Input(InputError),
    /// The model has no such read-out, or its value is undefined at the start.
    NoReadout,
    /// The read-out is of another kind.
    Kind {
        /// The required kind.
        wanted: &'static str,
        /// The kind of the read-out.
        found: &'static str,
    },
    /// A parameter is out of range: its name.
    Parameter(&'static str),
    /// Two parts drive the same input.
    Shared(InputIndex),
    /// The part has a driver but no node steps it.
    NoNode,
    /// The part is stepped by two nodes, or twice by one.
    Twice,
    /// The part is in use elsewhere, or its slot is empty.
    Busy,
}

impl fmt::Display for WiringError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "`{}`: ", self.name)?;
        match self.problem {
            Problem::Input(error) => write!(f, "{error}"),
            Problem::NoReadout => write!(f, "the model has no such read-out"),
            Problem::Kind { wanted, found } => {
                write!(f, "the read-out is {found}, expected {wanted}")
            }
            Problem::Parameter(which) => write!(f, "{which} is out of range"),
            Problem::Shared(input) => write!(f, "another part drives input {}", input.0),
            Problem::NoNode => write!(f, "no node steps this part"),
            Problem::Twice => write!(f, "the part is stepped twice"),
            Problem::Busy => write!(f, "the part is in use elsewhere or its slot is empty"),
        }
    }
}

impl core::error::Error for WiringError {}

/// Why a driver's call failed, or a node is stopped.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(all(feature = "defmt", target_os = "none"), derive(defmt::Format))]
pub enum Fault {
    /// The plant failed: it diverged, or its step counter is exhausted.
    Plant(Failure),
    /// An input refused its value: it is not finite.
    Input(InputError),
    /// A read-out, by its name, is currently undefined.
    Readout(&'static str),
    /// A part or a node is in use elsewhere at the same time.
    Busy,
    /// No node steps the part, any more or yet.
    NotWired,
    /// A duty above its maximum.
    Duty,
    /// I2C: no device answers at this address.
    Address(u8),
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Fault::Plant(failure) => write!(f, "the plant failed: {failure}"),
            Fault::Input(error) => write!(f, "{error}"),
            Fault::Readout(name) => write!(f, "`{name}` is currently undefined"),
            Fault::Busy => write!(f, "in use elsewhere"),
            Fault::NotWired => write!(f, "no node steps this part"),
            Fault::Duty => write!(f, "the duty exceeds its maximum"),
            Fault::Address(address) => write!(f, "no device answers at {address:#04x}"),
        }
    }
}

impl core::error::Error for Fault {}

impl embedded_hal::pwm::Error for Fault {
    fn kind(&self) -> embedded_hal::pwm::ErrorKind {
        embedded_hal::pwm::ErrorKind::Other
    }
}

impl embedded_hal::digital::Error for Fault {
    fn kind(&self) -> embedded_hal::digital::ErrorKind {
        embedded_hal::digital::ErrorKind::Other
    }
}

impl embedded_hal::spi::Error for Fault {
    fn kind(&self) -> embedded_hal::spi::ErrorKind {
        embedded_hal::spi::ErrorKind::Other
    }
}

impl embedded_hal::i2c::Error for Fault {
    fn kind(&self) -> embedded_hal::i2c::ErrorKind {
        use embedded_hal::i2c::{ErrorKind, NoAcknowledgeSource};
        match self {
            Fault::Address(_) => ErrorKind::NoAcknowledge(NoAcknowledgeSource::Address),
            _ => ErrorKind::Other,
        }
    }
}
