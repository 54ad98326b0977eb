//! The common parts of the controllers: a motor with a direction pin, and a rate from counts.
//!
//! `part of full drive => duty and direction; counts => counts per second`.

use embedded_hal::digital::{Error as _, ErrorKind as PinError, OutputPin};
use embedded_hal::pwm::{Error as _, ErrorKind as DutyError, SetDutyCycle};

use super::as5047p::ReadError;

/// Why a tick of a controller failed. The last outputs then stay set.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ControlError {
    /// The encoder of this axis.
    Encoder(u8, ReadError),
    /// The duty of this axis.
    Duty(u8, DutyError),
    /// The direction of this axis.
    Direction(u8, PinError),
}

/// A motor behind a bridge with a duty and a direction.
#[derive(Debug)]
pub struct Drive<P, D> {
    duty: P,
    direction: D,
    axis: u8,
}

impl<P: SetDutyCycle, D: OutputPin> Drive<P, D> {
    /// The motor of an axis; a high direction drives backwards.
    pub const fn new(axis: u8, duty: P, direction: D) -> Self {
        Self { duty, direction, axis }
    }

    /// Sets a part of the full drive, −1 to 1 and no more; NaN counts as 0.
    ///
    /// # Errors
    /// [`ControlError::Duty`], [`ControlError::Direction`].
    pub fn set(&mut self, part: f32) -> Result<(), ControlError> {
        let axis = self.axis;
        let direction =
            if part < 0.0 { self.direction.set_high() } else { self.direction.set_low() };
        direction.map_err(|error| ControlError::Direction(axis, error.kind()))?;
        let most = self.duty.max_duty_cycle();
        // The conversion saturates; half is rounded up.
        let part = if part < 0.0 { -part } else { part };
        let duty = (part * f32::from(most) + 0.5) as u16;
        let set = self.duty.set_duty_cycle(duty.min(most));
        set.map_err(|error| ControlError::Duty(axis, error.kind()))
    }
}

/// The rate of a number that is read once per tick: its difference through a low-pass filter of
/// first order.
#[derive(Clone, Copy, Debug)]
pub struct Rate {
    last: Option<f32>,
    rate: f32,
    /// \[1/s\] ticks per second.
    frequency: f32,
    /// How much of a new difference is taken at once, 0 to 1.
    share: f32,
}

impl Rate {
    /// The rate at `frequency` \[1/s\] of ticks, with a filter that takes `share` of each difference.
    #[must_use]
    pub const fn new(frequency: f32, share: f32) -> Self {
        Self { last: None, rate: 0.0, frequency, share }
    }

    /// The rate \[1/s\] at the next value; 0 at the first.
    pub fn next(&mut self, value: f32) -> f32 {
        if let Some(last) = self.last {
            let difference = (value - last) * self.frequency;
            self.rate += self.share * (difference - self.rate);
        }
        self.last = Some(value);
        self.rate
    }
}
