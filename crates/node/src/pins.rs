//! Pins: a quadrature encoder's A, B and index, and switches.
//!
//! `part => level`. A and B encode the lowest two bits of the count: 00, 10, 11, 01 as it rises. A driver that polls
//! them must do so more often than the count changes, or it misses counts, as on a board.

use embedded_hal::digital::{ErrorType, InputPin};

use crate::encoder::Counting;
use crate::end_stop::Switch;
use crate::fault::{Fault, WiringError};
use crate::part::{Linked as _, fix};
use crate::share::Shared;

/// The signal of an encoder on a pin.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Signal {
    /// Leads B where the count rises.
    A,
    /// A quarter of a period behind.
    B,
    /// High for one count per revolution, at 0.
    Index,
}

/// A pin of an encoder.
#[derive(Clone, Copy, Debug)]
pub struct EncoderPin<C> {
    cell: C,
    signal: Signal,
}

impl<C: Shared<Part: Counting>> EncoderPin<C> {
    /// A pin of an encoder.
    ///
    /// # Errors
    /// [`WiringError`] if no node steps it.
    pub fn new(cell: C, signal: Signal) -> Result<Self, WiringError> {
        fix(&cell)?;
        Ok(Self { cell, signal })
    }
}

impl<C> ErrorType for EncoderPin<C> {
    type Error = Fault;
}

impl<C: Shared<Part: Counting>> InputPin for EncoderPin<C> {
    fn is_high(&mut self) -> Result<bool, Fault> {
        let signal = self.signal;
        self.cell.with(|part| {
            part.link().check()?;
            let quarter = part.counts() & 3;
            Ok(match signal {
                Signal::A => quarter == 1 || quarter == 2,
                Signal::B => quarter >= 2,
                Signal::Index => match i32::try_from(part.counts_per_turn()) {
                    Ok(turn) => part.counts().checked_rem(turn) == Some(0),
                    Err(_) => part.counts() == 0,
                },
            })
        })?
    }

    fn is_low(&mut self) -> Result<bool, Fault> {
        self.is_high().map(|high| !high)
    }
}

/// The level of a closed switch.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Active {
    /// Closed is low: a switch to ground and a resistor to the supply.
    Low,
    /// Closed is high.
    High,
}

/// A pin of a switch.
#[derive(Clone, Copy, Debug)]
pub struct SwitchPin<C> {
    cell: C,
    active: Active,
}

impl<C: Shared<Part: Switch>> SwitchPin<C> {
    /// A pin of a switch.
    ///
    /// # Errors
    /// [`WiringError`] if no node steps it.
    pub fn new(cell: C, active: Active) -> Result<Self, WiringError> {
        fix(&cell)?;
        Ok(Self { cell, active })
    }
}

impl<C> ErrorType for SwitchPin<C> {
    type Error = Fault;
}

impl<C: Shared<Part: Switch>> InputPin for SwitchPin<C> {
    fn is_high(&mut self) -> Result<bool, Fault> {
        let active = self.active;
        self.cell.with(|part| {
            part.link().check()?;
            Ok(part.is_closed() == (active == Active::High))
        })?
    }

    fn is_low(&mut self) -> Result<bool, Fault> {
        self.is_high().map(|high| !high)
    }
}
