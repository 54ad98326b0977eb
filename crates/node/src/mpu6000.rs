//! The inertial measurement units MPU-6000 and MPU-6050: registers over SPI and I2C.
//!
//! `(specific force, angular rate) => registers`. According to InvenSense, MPU-6000 and MPU-6050 Register Map and
//! Descriptions, RM-MPU-6000A-00 r4.2, and Product Specification PS-MPU-6000A-00 r3.4, §7.5 and §9: full scales, sample
//! rate, sleep, reset, standby, data ready; addresses increment in a burst. Filter and interrupt settings are stored;
//! of the filter only its sample rate has an effect. FIFO, auxiliary bus and self-test are not implemented: their
//! registers store written values, the FIFO is empty.

use dbd_kernel::readouts::{Reading, Readout};
use dbd_kernel::{Geometry, Real as _};

use crate::fault::{Fault, Problem, WiringError};
use crate::i2c::I2cPart;
use crate::machine::Machine;
use crate::number::Number;
use crate::part::{Link, Linked, Part, Wires, parameter};
use crate::probe::kind;
use crate::sensor::{Errors, Sensor};
use crate::spi::SpiPart;

/// \[m/s²\] 1 g, the unit of the full scales.
pub const STANDARD_GRAVITY: f64 = 9.80665;

const SMPLRT_DIV: u8 = 0x19;
const CONFIG: u8 = 0x1a;
const GYRO_CONFIG: u8 = 0x1b;
const ACCEL_CONFIG: u8 = 0x1c;
const INT_PIN_CFG: u8 = 0x37;
const INT_STATUS: u8 = 0x3a;
/// First of 14: specific force, temperature, angular rate, two bytes each, high byte first.
const ACCEL_XOUT_H: u8 = 0x3b;
const TEMP_OUT_H: u8 = 0x41;
const GYRO_XOUT_H: u8 = 0x43;
const USER_CTRL: u8 = 0x6a;
const PWR_MGMT_1: u8 = 0x6b;
const PWR_MGMT_2: u8 = 0x6c;
const FIFO_R_W: u8 = 0x74;
const WHO_AM_I: u8 = 0x75;

/// Bits of PWR_MGMT_1.
const DEVICE_RESET: u8 = 1 << 7;
const SLEEP: u8 = 1 << 6;
/// Bit of USER_CTRL: I2C is disabled in favour of SPI.
const I2C_IF_DIS: u8 = 1 << 4;
/// Bit of INT_PIN_CFG: any read clears INT_STATUS.
const INT_RD_CLEAR: u8 = 1 << 4;
/// Bit of INT_STATUS.
const DATA_RDY: u8 = 1;
/// The identity, the same at either address.
const IDENTITY: u8 = 0x68;

/// An inertial measurement unit's constants.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ImuParameters {
    /// I2C address: 0x68, or 0x69 with the pin AD0 high.
    pub address: u8,
    /// \[m/s²\] errors of each axis's specific force; each axis has separate random numbers.
    pub accelerometer: Errors,
    /// \[rad/s\] errors of each axis's rate, likewise.
    pub gyroscope: Errors,
    /// \[°C\] temperature reading, −40 to 85.
    pub temperature: f64,
}

impl Default for ImuParameters {
    fn default() -> Self {
        Self {
            address: 0x68,
            accelerometer: Errors::NONE,
            gyroscope: Errors::NONE,
            temperature: 25.0,
        }
    }
}

/// The chip at an inertial read-out, in body axes; `DELAY` samples late.
#[derive(Clone, Debug)]
pub struct Mpu6000<P: Geometry, const DELAY: usize = 0> {
    name: &'static str,
    readout: Readout<P>,
    parameters: ImuParameters,
    sensors: Option<[Sensor<P::Real, DELAY>; 6]>,
    /// \[s\] the step, and the number of steps per 125 µs.
    step: P::Real,
    per_tick: P::Real,
    /// Counts per unit at the smallest full scale.
    sensitive: [P::Real; 2],
    temperature: i16,
    link: Link,
    registers: [u8; 128],
    pointer: u8,
    phase: Phase,
    selected: bool,
    /// Steps since the last sample.
    waited: i32,
    /// Steps from sample to sample.
    every: i32,
}

/// The state of a transfer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Phase {
    /// The next byte is a register's address.
    Address,
    Reading,
    Writing,
}

impl<P: Geometry<Real: Number>, const DELAY: usize> Mpu6000<P, DELAY> {
    /// The chip, with a name for errors.
    #[must_use]
    pub fn new(name: &'static str, imu: Readout<P>, parameters: ImuParameters) -> Self {
        let zero = P::Real::ZERO;
        let mut chip = Self {
            name,
            readout: imu,
            parameters,
            sensors: None,
            step: zero,
            per_tick: zero,
            sensitive: [zero; 2],
            temperature: 0,
            link: Link::Approximate,
            registers: [0; 128],
            pointer: 0,
            phase: Phase::Address,
            selected: false,
            waited: 0,
            every: 1,
        };
        chip.reset();
        chip
    }

    fn reset(&mut self) {
        self.registers = [0; 128];
        self.set(PWR_MGMT_1, SLEEP);
        self.set(WHO_AM_I, IDENTITY);
        self.pace();
    }

    #[inline]
    fn get(&self, register: u8) -> u8 {
        self.registers.get(usize::from(register)).copied().unwrap_or(0)
    }

    #[inline]
    fn set(&mut self, register: u8, value: u8) {
        if let Some(place) = self.registers.get_mut(usize::from(register)) {
            *place = value;
        }
    }

    fn set_pair(&mut self, register: u8, value: i16) {
        let [high, low] = value.to_be_bytes();
        self.set(register, high);
        self.set(register.wrapping_add(1), low);
    }

    /// Steps from sample to sample according to the registers: 8 kHz without the filter, 1 kHz with it, divided; at
    /// least one.
    fn pace(&mut self) {
        let filter = self.get(CONFIG) & 7;
        let base = if filter == 0 || filter == 7 { 1 } else { 8 };
        let ticks = (i32::from(self.get(SMPLRT_DIV)) + 1) * base;
        self.every = (P::Real::from_i32(ticks) * self.per_tick).nearest().max(1);
        let period = P::Real::from_i32(self.every) * self.step;
        if let Some(sensors) = &mut self.sensors {
            sensors.iter_mut().for_each(|sensor| sensor.set_period(period));
        }
    }

    fn write(&mut self, register: u8, value: u8) {
        match register {
            PWR_MGMT_1 if value & DEVICE_RESET != 0 => self.reset(),
            // Read-only.
            WHO_AM_I | INT_STATUS | FIFO_R_W | ACCEL_XOUT_H..=0x60 | 0x72 | 0x73 => {}
            _ => {
                self.set(register, value);
                if matches!(register, SMPLRT_DIV | CONFIG) {
                    self.pace();
                }
            }
        }
    }

    fn read(&mut self, register: u8) -> u8 {
        let value = self.get(register);
        if register == INT_STATUS || self.get(INT_PIN_CFG) & INT_RD_CLEAR != 0 {
            self.set(INT_STATUS, 0);
        }
        value
    }

    /// The next address of a burst; the FIFO register repeats.
    fn advance(&mut self) {
        if self.pointer != FIFO_R_W {
            self.pointer = (self.pointer + 1) & 0x7f;
        }
    }

    fn byte_in(&mut self, byte: u8) {
        self.write(self.pointer, byte);
        self.advance();
    }

    fn byte_out(&mut self) -> u8 {
        let byte = self.read(self.pointer);
        self.advance();
        byte
    }

    /// Stores a sample in the registers.
    fn sample(&mut self, actual: [P::Real; 6]) {
        let Some(sensors) = &mut self.sensors else { return };
        let mut shown = actual;
        for (value, sensor) in shown.iter_mut().zip(sensors) {
            *value = sensor.sample(*value);
        }
        let [per_force, per_rate] = self.sensitive;
        let [force_scale, rate_scale] =
            [ACCEL_CONFIG, GYRO_CONFIG].map(|register| self.get(register) >> 3 & 3);
        let halves = |scale: u8| P::Real::ONE / P::Real::from_i32(1 << scale);
        let per_unit = [per_force * halves(force_scale), per_rate * halves(rate_scale)];
        let standby = self.get(PWR_MGMT_2);
        let mut register = ACCEL_XOUT_H;
        for (axis, value) in (0_u8..).zip(shown) {
            if register == TEMP_OUT_H {
                self.set_pair(register, self.temperature);
                register = GYRO_XOUT_H;
            }
            let per_unit = if axis < 3 { per_unit[0] } else { per_unit[1] };
            // An axis in standby keeps its last sample.
            if standby >> (5 - axis.min(5)) & 1 == 0 {
                let counts = (value * per_unit).nearest();
                let counts = counts.clamp(i32::from(i16::MIN), i32::from(i16::MAX));
                self.set_pair(register, counts as i16);
            }
            register += 2;
        }
        self.set(INT_STATUS, self.get(INT_STATUS) | DATA_RDY);
    }
}

impl<P: Geometry<Real: Number>, const DELAY: usize> Linked for Mpu6000<P, DELAY> {
    fn name(&self) -> &'static str {
        self.name
    }
    fn link(&self) -> Link {
        self.link
    }
}

impl<P: Geometry<Real: Number>, const DELAY: usize> I2cPart for Mpu6000<P, DELAY> {
    fn address(&self) -> u8 {
        // No part has the general call address.
        if self.get(USER_CTRL) & I2C_IF_DIS == 0 { self.parameters.address } else { 0xff }
    }

    fn start(&mut self, reading: bool) {
        self.phase = if reading { Phase::Reading } else { Phase::Address };
    }

    fn take(&mut self, byte: u8) {
        if self.phase == Phase::Address {
            self.pointer = byte & 0x7f;
            self.phase = Phase::Writing;
        } else {
            self.byte_in(byte);
        }
    }

    fn give(&mut self) -> u8 {
        self.byte_out()
    }

    fn finish(&mut self) {
        self.phase = Phase::Address;
    }
}

impl<P: Geometry<Real: Number>, const DELAY: usize> SpiPart for Mpu6000<P, DELAY> {
    fn select(&mut self) {
        self.selected = true;
        self.phase = Phase::Address;
    }

    fn exchange(&mut self, byte: u8) -> u8 {
        match self.phase {
            Phase::Address => {
                self.pointer = byte & 0x7f;
                self.phase = if byte & 0x80 == 0 { Phase::Writing } else { Phase::Reading };
                0
            }
            Phase::Reading => self.byte_out(),
            Phase::Writing => {
                self.byte_in(byte);
                0
            }
        }
    }

    fn release(&mut self) {
        self.selected = false;
        self.phase = Phase::Address;
    }

    fn is_selected(&self) -> bool {
        self.selected
    }
}

impl<P, M, const DELAY: usize> Part<M> for Mpu6000<P, DELAY>
where
    P: Geometry<Real: Number>,
    M: Machine<Precision = P, Real = P::Real>,
{
    fn wire(&mut self, wires: &mut Wires<'_, M>) -> Result<(), WiringError> {
        let name = self.name;
        let error = |problem| Err(WiringError { name, problem });
        let step = wires.step_size();
        let ImuParameters { address, accelerometer, gyroscope, temperature } = self.parameters;
        if !(0x08..=0x77).contains(&address) {
            return error(Problem::Parameter("the address"));
        }
        parameter::<P::Real>(name, "the temperature", temperature, [-40.0, 85.0])?;
        // 340 counts per degree, 0 at 36.53 °C.
        self.temperature = ((temperature - 36.53) * 340.0).nearest() as i16;
        self.step = P::Real::from_f64(step);
        self.per_tick = P::Real::from_f64(125e-6 / step);
        // 16384 per g; 131 per degree/second, which is 32768/250 rounded, as in the data sheet.
        self.sensitive = [16_384.0 / STANDARD_GRAVITY, 131.0 * 180.0 / core::f64::consts::PI]
            .map(P::Real::from_f64);
        let sensor = |lane, errors| Sensor::new(name, lane, errors, step);
        let [force, rate] = [accelerometer, gyroscope];
        self.sensors = Some([
            sensor(0, force)?,
            sensor(1, force)?,
            sensor(2, force)?,
            sensor(3, rate)?,
            sensor(4, rate)?,
            sensor(5, rate)?,
        ]);
        match wires.machine().read(&self.readout) {
            None => return error(Problem::NoReadout),
            Some(Reading::Imu { .. }) => {}
            Some(other) => {
                let wanted = "specific force and angular rate";
                return error(Problem::Kind { wanted, found: kind(&other) });
            }
        }
        self.pace();
        self.link.wire(name)
    }

    #[inline]
    fn drive(&mut self, _: &mut M) -> Result<(), Fault> {
        Ok(())
    }

    #[inline]
    fn sense(&mut self, machine: &M) -> Result<(), Fault> {
        self.waited = self.waited.saturating_add(1);
        // Asleep there is no sample, and no force evaluation.
        if self.waited < self.every || self.get(PWR_MGMT_1) & SLEEP != 0 {
            return Ok(());
        }
        self.waited = 0;
        let Some(Reading::Imu { specific_force: f, rate: w }) = machine.read(&self.readout) else {
            return Err(Fault::Readout(self.name));
        };
        self.sample([f.x, f.y, f.z, w.x, w.y, w.z]);
        Ok(())
    }

    fn stop(&mut self, fault: Fault) {
        self.link.stop(fault);
    }
}
