//! Balances a pendulum on a cart: state feedback on two encoders, one motor.
//!
//! `(cart's and pendulum's counts) => duty and direction, once per millisecond`. The gains are the linear
//! regulator of the ideal cart and pendulum for weights 20, 50, 1, 1 on position, angle and their
//! rates and 0.05 on the force; the rates are filtered differences. The motor's back-EMF is added to
//! the voltage. Where the pendulum leans further than [`Constants::most_axis_error`] the motor is off.

use embedded_hal::delay::DelayNs;
use embedded_hal::digital::OutputPin;
use embedded_hal::pwm::SetDutyCycle;
use embedded_hal::spi::SpiDevice;

use super::as5047p::{COUNTS, Shaft};
use super::servo::{ControlError, Drive, Rate};

/// \[ns\] from tick to tick.
pub const TICK: u32 = 1_000_000;

/// Parameters, measured and chosen at the machine.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Constants {
    /// \[m\] the cart's way per turn of its encoder.
    pub cart_turn: f32,
    /// Counts of the pendulum's encoder, 0 to 16383, with the pendulum upright.
    pub upright: i32,
    /// \[N/m, N/rad, N·s/m, N·s/rad\] of the cart's position, the angle and their rates.
    pub gains: [f32; 4],
    /// \[N\] the force at full duty and standstill.
    pub full_force: f32,
    /// \[N·s/m\] reduction of the force by the back-EMF.
    pub back_emf: f32,
    /// \[rad\] beyond it the motor is off.
    pub most_axis_error: f32,
}

impl Constants {
    /// Of the cart with the Quanser IP02's motor at 12 V and encoder pinion.
    pub const IP02: Self = Self {
        cart_turn: 0.093_18,
        upright: 16_156,
        gains: [-20.0, 88.97, -18.33, 17.54],
        full_force: 20.68,
        back_emf: 7.725,
        most_axis_error: 0.5,
    };
}

/// Measurements and outputs of a tick.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Seen {
    /// \[m\] the cart from where it started.
    pub cart: f32,
    /// \[rad\] the pendulum from upright.
    pub axis_error: f32,
    /// \[N\] the force that was asked for.
    pub force: f32,
}

/// The controller.
#[derive(Debug)]
pub struct Balance<C, A, P, D> {
    cart: Shaft<C>,
    pendulum: Shaft<A>,
    motor: Drive<P, D>,
    constants: Constants,
    start: Option<i32>,
    rates: [Rate; 2],
}

impl<C: SpiDevice, A: SpiDevice, P: SetDutyCycle, D: OutputPin> Balance<C, A, P, D> {
    /// The controller of a cart's encoder, a pendulum's encoder and a motor.
    pub const fn new(cart: C, pendulum: A, duty: P, direction: D, constants: Constants) -> Self {
        let rate = Rate::new(1e9 / TICK as f32, 0.2);
        Self {
            cart: Shaft::new(cart),
            pendulum: Shaft::new(pendulum),
            motor: Drive::new(0, duty, direction),
            constants,
            start: None,
            rates: [rate; 2],
        }
    }

    /// One tick.
    ///
    /// # Errors
    /// [`ControlError`]: axis 0 is the cart, 1 the pendulum.
    pub fn tick(&mut self) -> Result<Seen, ControlError> {
        let counts = self.cart.counts().map_err(|error| ControlError::Encoder(0, error))?;
        let angle = self.pendulum.counts().map_err(|error| ControlError::Encoder(1, error))?;
        let start = *self.start.get_or_insert(counts);
        let constants = &self.constants;
        let cart = counts.wrapping_sub(start) as f32 * (constants.cart_turn / COUNTS as f32);
        // Within half a turn of upright.
        let off = (angle.wrapping_sub(constants.upright) << 18) >> 18;
        let axis_error = off as f32 * (core::f32::consts::TAU / COUNTS as f32);
        let [cart_rate, axis_error_rate] = &mut self.rates;
        let [speed, spin] = [cart_rate.next(cart), axis_error_rate.next(axis_error)];
        let [on_cart, on_axis_error, on_speed, on_spin] = constants.gains;
        let force =
            -(on_cart * cart + on_axis_error * axis_error + on_speed * speed + on_spin * spin);
        let up = axis_error < constants.most_axis_error && axis_error > -constants.most_axis_error;
        let force = if up { force } else { 0.0 };
        let drive = if up { force + constants.back_emf * speed } else { 0.0 };
        self.motor.set(drive / constants.full_force)?;
        Ok(Seen { cart, axis_error, force })
    }

    /// Ticks, at the pace of a delay; what `look` sees of each.
    ///
    /// # Errors
    /// [`ControlError`] of the first tick that fails.
    pub fn run(
        &mut self,
        delay: &mut impl DelayNs,
        ticks: u32,
        mut look: impl FnMut(Seen),
    ) -> Result<(), ControlError> {
        for _ in 0..ticks {
            look(self.tick()?);
            delay.delay_ns(TICK);
        }
        Ok(())
    }
}
