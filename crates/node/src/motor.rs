//! A motor behind a bridge: duty to voltage or current, lag, saturation, torque, gear.
//!
//! `(duty, direction, speed) => input of the machine`. A direct-current motor as in Krishnan, Electric Motor Drives,
//! 2001, ch. 2: i* = (u·V − kₑ·ω)/R within ±i_most, τ·di/dt = i* − i, M = k·i − friction. Over a step i* is constant
//! and the lag is solved exactly: i becomes i + a·(i* − i) with a = 1 − e^(−h/τ), and the machine gets the mean over
//! the step, so that the impulse is exact too. The coefficients are computed at wiring, by libm in double precision on
//! every machine.

use dbd_kernel::chain::limited;
use dbd_kernel::{Geometry, InputIndex, Real as _};

use crate::fault::{Fault, WiringError};
use crate::machine::Machine;
use crate::number::Number;
use crate::part::{Link, Linked, Part, Wires, parameter};
use crate::probe::Probe;

/// The supply of the motor by its bridge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Supply {
    /// A voltage on the winding.
    Voltage {
        /// \[V\] at full duty, > 0.
        full: f64,
        /// \[Ω\] of winding and bridge, > 0.
        resistance: f64,
        /// \[V·s/rad\] back-EMF constant, ≥ 0; above 0 the motor needs a speed.
        back_emf: f64,
    },
    /// A current controller.
    Current {
        /// \[A\] at full duty, > 0.
        full: f64,
    },
}

/// A motor's constants.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MotorParameters {
    /// The supply of the motor by its bridge.
    pub supply: Supply,
    /// \[N·m/A\] torque constant, > 0; \[N/A\] of a linear motor.
    pub torque_constant: f64,
    /// \[A\] maximum current in either direction, > 0; infinite without a limit.
    pub most_current: f64,
    /// \[s\] time constant of the current, ≥ 0; 0 without lag.
    pub lag: f64,
    /// \[N·m\] Coulomb friction on the motor's shaft, ≥ 0; above 0 the motor needs a speed.
    pub friction: f64,
    /// \[rad/s\] motor speed at which friction is full, > 0; proportional below.
    pub friction_speed: f64,
    /// Motor revolutions per joint revolution, not 0; \[1/m\] motor angle per travel if the input is a force: one over
    /// the pinion's radius. Negative reverses the direction.
    pub ratio: f64,
    /// Duty of 100 %, > 0: counts of the timer.
    pub most_duty: u16,
}

impl MotorParameters {
    /// A motor without lag, limit or friction whose full duty is `full` \[N·m or N\] at the input.
    #[must_use]
    pub const fn ideal(full: f64, most_duty: u16) -> Self {
        Self {
            supply: Supply::Current { full: 1.0 },
            torque_constant: full,
            most_current: f64::INFINITY,
            lag: 0.0,
            friction: 0.0,
            friction_speed: 1.0,
            ratio: 1.0,
            most_duty,
        }
    }
}

/// A motor that drives an input of the machine.
#[derive(Clone, Debug)]
pub struct Motor<P: Geometry> {
    name: &'static str,
    input: InputIndex,
    parameters: MotorParameters,
    speed: Option<Probe<P>>,
    constants: Option<Constants<P::Real>>,
    link: Link,
    current: P::Real,
    output: P::Real,
    duties: [u16; 2],
    reversed: bool,
    enabled: bool,
}

/// Constants in the machine's precision.
#[derive(Clone, Copy, Debug)]
struct Constants<R> {
    /// \[A\] current per duty.
    per_duty: R,
    /// \[A·s/rad\] current reduction by back-EMF per speed.
    per_speed: R,
    /// \[A\] maximum in either direction; `None` without a limit.
    most: Option<R>,
    /// Fraction of the way to its final value that the current covers in a step, and that of its mean.
    way: R,
    mean: R,
    torque_constant: R,
    friction: R,
    per_friction_speed: R,
    ratio: R,
}

impl<P: Geometry<Real: Number>> Motor<P> {
    /// A motor at an input, with a name for errors.
    #[must_use]
    pub fn new(name: &'static str, input: InputIndex, parameters: MotorParameters) -> Self {
        Self {
            name,
            input,
            parameters,
            speed: None,
            constants: None,
            link: Link::Approximate,
            current: P::Real::ZERO,
            output: P::Real::ZERO,
            duties: [0; 2],
            reversed: false,
            enabled: true,
        }
    }

    /// The motor with the speed of its joint \[rad/s; m/s for a force\], for back-EMF and friction.
    #[must_use]
    pub fn with_speed(mut self, speed: Probe<P>) -> Self {
        self.speed = Some(speed);
        self
    }

    /// \[A\] the current at the end of the last step.
    pub fn current(&self) -> P::Real {
        self.current
    }

    /// \[N·m or N\] the machine's input over the last step.
    pub fn output(&self) -> P::Real {
        self.output
    }

    /// Its constants.
    pub fn parameters(&self) -> &MotorParameters {
        &self.parameters
    }

    /// The signed duty, −1 to 1; 0 if the bridge is disabled.
    #[inline]
    fn duty(&self) -> Option<P::Real> {
        if !self.enabled {
            return None;
        }
        let [a, b] = self.duties.map(i32::from);
        let whole = P::Real::from_i32(i32::from(self.parameters.most_duty));
        let duty = P::Real::from_i32(a - b) / whole;
        Some(if self.reversed { -duty } else { duty })
    }

    fn constants(&self, step: f64) -> Result<Constants<P::Real>, WiringError> {
        const POSITIVE: [f64; 2] = [f64::MIN_POSITIVE, f64::MAX];
        const NOT_NEGATIVE: [f64; 2] = [0.0, f64::MAX];
        let name = self.name;
        let p = &self.parameters;
        let fine = |which, value, bounds| parameter::<P::Real>(name, which, value, bounds);
        let needs = |which| -> Result<(), WiringError> {
            match self.speed {
                Some(_) => Ok(()),
                None => fine(which, f64::NAN, NOT_NEGATIVE).map(|_| ()),
            }
        };
        let (per_duty, per_speed) = match p.supply {
            Supply::Voltage { full, resistance, back_emf } => {
                fine("the voltage", full, POSITIVE)?;
                fine("the resistance", resistance, POSITIVE)?;
                fine("the back-EMF constant", back_emf, NOT_NEGATIVE)?;
                if back_emf > 0.0 {
                    needs("the speed (required for back-EMF)")?;
                }
                (full / resistance, back_emf / resistance)
            }
            Supply::Current { full } => (full, 0.0),
        };
        if p.friction > 0.0 {
            needs("the speed (required for friction)")?;
        }
        fine("the friction speed", p.friction_speed, POSITIVE)?;
        fine("the lag", p.lag, NOT_NEGATIVE)?;
        fine("the maximum duty", f64::from(p.most_duty), POSITIVE)?;
        let most = if p.most_current == f64::INFINITY {
            None
        } else {
            Some(fine("the maximum current", p.most_current, POSITIVE)?)
        };
        let [way, mean] = lag(p.lag, step);
        fine("the ratio", p.ratio.abs(), POSITIVE)?;
        Ok(Constants {
            per_duty: fine("the current at full duty", per_duty, POSITIVE)?,
            per_speed: P::Real::from_f64(per_speed),
            most,
            way: P::Real::from_f64(way),
            mean: P::Real::from_f64(mean),
            torque_constant: fine("the torque constant", p.torque_constant, POSITIVE)?,
            friction: fine("the friction", p.friction, NOT_NEGATIVE)?,
            per_friction_speed: P::Real::from_f64(1.0 / p.friction_speed),
            ratio: P::Real::from_f64(p.ratio),
        })
    }

    /// One step at a motor speed; returns the mean input.
    #[inline]
    fn follow(&mut self, constants: &Constants<P::Real>, speed: P::Real) -> P::Real {
        let target = match self.duty() {
            Some(duty) => constants.per_duty * duty - constants.per_speed * speed,
            None => P::Real::ZERO,
        };
        let target = match constants.most {
            Some(most) => limited(target, [-most, most]),
            None => target,
        };
        let off = target - self.current;
        let mean = self.current + constants.mean * off;
        self.current = self.current + constants.way * off;
        let one = P::Real::ONE;
        let slowed = limited(speed * constants.per_friction_speed, [-one, one]);
        let torque = constants.torque_constant * mean - constants.friction * slowed;
        torque * constants.ratio
    }
}

/// The settings of a bridge by a driver.
pub trait Bridge: Linked {
    /// Duty of 100 %.
    fn most_duty(&self) -> u16;
    /// Sets the duty of a channel: the first drives forwards, the second backwards; their difference applies.
    fn set_duty(&mut self, channel: Channel, duty: u16);
    /// Sets the sign of the duties.
    fn set_reversed(&mut self, reversed: bool);
    /// Whether the sign is reversed.
    fn is_reversed(&self) -> bool;
    /// Enables or disables the bridge; disabled it conducts no current.
    fn set_enabled(&mut self, enabled: bool);
    /// Whether it is enabled, as it is initially.
    fn is_enabled(&self) -> bool;
}

/// A channel of a bridge.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Channel {
    /// Its duty drives forwards.
    Forwards,
    /// Its duty drives backwards.
    Backwards,
}

impl<P: Geometry<Real: Number>> Bridge for Motor<P> {
    fn most_duty(&self) -> u16 {
        self.parameters.most_duty
    }
    #[inline]
    fn set_duty(&mut self, channel: Channel, duty: u16) {
        let [forwards, backwards] = &mut self.duties;
        match channel {
            Channel::Forwards => *forwards = duty,
            Channel::Backwards => *backwards = duty,
        }
    }
    fn set_reversed(&mut self, reversed: bool) {
        self.reversed = reversed;
    }
    fn is_reversed(&self) -> bool {
        self.reversed
    }
    fn set_enabled(&mut self, enabled: bool) {
        self.enabled = enabled;
    }
    fn is_enabled(&self) -> bool {
        self.enabled
    }
}

/// Fraction of the way that a first-order lag covers in a step, and that of its mean over the step.
fn lag(time_constant: f64, step: f64) -> [f64; 2] {
    if time_constant == 0.0 {
        return [1.0, 1.0];
    }
    let steps = step / time_constant;
    let way = -libm::expm1(-steps);
    // 1 − way/steps suffers from cancellation for short steps, where its series is used.
    let mean = if steps < 1e-3 {
        steps * (0.5 - steps * (1.0 / 6.0 - steps / 24.0))
    } else {
        1.0 - way / steps
    };
    [way, mean]
}

impl<P: Geometry<Real: Number>> Linked for Motor<P> {
    fn name(&self) -> &'static str {
        self.name
    }
    fn link(&self) -> Link {
        self.link
    }
}

impl<P, M> Part<M> for Motor<P>
where
    P: Geometry<Real: Number>,
    M: Machine<Precision = P, Real = P::Real>,
{
    fn wire(&mut self, wires: &mut Wires<'_, M>) -> Result<(), WiringError> {
        self.constants = Some(self.constants(wires.step_size())?);
        if let Some(speed) = &self.speed {
            wires.see(speed)?;
        }
        wires.drive(self.name, self.input)?;
        self.link.wire(self.name)
    }

    #[inline]
    fn drive(&mut self, machine: &mut M) -> Result<(), Fault> {
        let Some(constants) = self.constants else { return Err(Fault::NotWired) };
        let speed = match &self.speed {
            Some(probe) => probe.see(machine)? * constants.ratio,
            None => P::Real::ZERO,
        };
        self.output = self.follow(&constants, speed);
        machine.set_input(self.input, self.output).map_err(Fault::Input)
    }

    #[inline]
    fn sense(&mut self, _: &M) -> Result<(), Fault> {
        Ok(())
    }

    fn stop(&mut self, fault: Fault) {
        self.link.stop(fault);
    }
}
