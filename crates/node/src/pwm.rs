//! Pulse-width modulation and the pins of a bridge.
//!
//! `(duty, pins) => motor`. Two modes, as on real bridges: a duty and a direction, or one duty for each direction,
//! whose difference applies. Settings take effect from the machine's next step.

use embedded_hal::digital::{ErrorType as PinErrorType, OutputPin, StatefulOutputPin};
use embedded_hal::pwm::{ErrorType, SetDutyCycle};

use crate::fault::{Fault, Problem, WiringError};
use crate::motor::{Bridge, Channel};
use crate::part::{Linked as _, fix};
use crate::share::Shared;

/// A channel's duty.
#[derive(Clone, Copy, Debug)]
pub struct DutyEnd<C> {
    cell: C,
    channel: Channel,
    most: u16,
}

impl<C: Shared<Part: Bridge>> DutyEnd<C> {
    /// A channel of a motor; with a direction pin, the forward one.
    ///
    /// # Errors
    /// [`WiringError`] if no node steps it.
    pub fn new(cell: C, channel: Channel) -> Result<Self, WiringError> {
        fix(&cell)?;
        let busy = WiringError { name: "a motor", problem: Problem::Busy };
        let most = cell.with(|part| part.most_duty()).map_err(|_| busy)?;
        Ok(Self { cell, channel, most })
    }
}

impl<C> ErrorType for DutyEnd<C> {
    type Error = Fault;
}

impl<C: Shared<Part: Bridge>> SetDutyCycle for DutyEnd<C> {
    fn max_duty_cycle(&self) -> u16 {
        self.most
    }

    fn set_duty_cycle(&mut self, duty: u16) -> Result<(), Fault> {
        if duty > self.most {
            return Err(Fault::Duty);
        }
        let channel = self.channel;
        self.cell.with(|part| {
            part.link().check()?;
            part.set_duty(channel, duty);
            Ok(())
        })?
    }
}

/// The setting of a pin of a bridge.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Line {
    Direction,
    Enable,
}

/// A pin of a bridge.
#[derive(Clone, Copy, Debug)]
pub struct BridgePin<C> {
    cell: C,
    line: Line,
}

impl<C: Shared<Part: Bridge>> BridgePin<C> {
    /// The direction of a motor: low forwards, high backwards; low at the start.
    ///
    /// # Errors
    /// [`WiringError`] if no node steps it.
    pub fn direction(cell: C) -> Result<Self, WiringError> {
        fix(&cell)?;
        Ok(Self { cell, line: Line::Direction })
    }

    /// The enable pin of a bridge: low blocks the current; high at the start, as without one.
    ///
    /// # Errors
    /// [`WiringError`] if no node steps its motor.
    pub fn enable(cell: C) -> Result<Self, WiringError> {
        fix(&cell)?;
        Ok(Self { cell, line: Line::Enable })
    }

    fn set(&self, high: bool) -> Result<(), Fault> {
        let line = self.line;
        self.cell.with(|part| {
            part.link().check()?;
            match line {
                Line::Direction => part.set_reversed(high),
                Line::Enable => part.set_enabled(high),
            }
            Ok(())
        })?
    }
}

impl<C> PinErrorType for BridgePin<C> {
    type Error = Fault;
}

impl<C: Shared<Part: Bridge>> OutputPin for BridgePin<C> {
    fn set_low(&mut self) -> Result<(), Fault> {
        self.set(false)
    }
    fn set_high(&mut self) -> Result<(), Fault> {
        self.set(true)
    }
}

impl<C: Shared<Part: Bridge>> StatefulOutputPin for BridgePin<C> {
    fn is_set_high(&mut self) -> Result<bool, Fault> {
        let line = self.line;
        self.cell.with(|part| match line {
            Line::Direction => part.is_reversed(),
            Line::Enable => part.is_enabled(),
        })
    }
    fn is_set_low(&mut self) -> Result<bool, Fault> {
        self.is_set_high().map(|high| !high)
    }
}
