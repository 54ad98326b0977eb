//! An encoder: an angle or a travel in whole counts.
//!
//! `(read-out, counts per revolution, errors) => counts`. The count is `⌊value/turn·counts⌋`. Noise, bias, delay and
//! resolution are applied to the exact value first.

use dbd_kernel::{Geometry, Real as _};

use crate::fault::{Fault, WiringError};
use crate::machine::Machine;
use crate::number::Number;
use crate::part::{Every, Link, Linked, Part, Wires, parameter};
use crate::probe::Probe;
use crate::sensor::{Errors, Sensor};

/// An encoder's constants.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EncoderParameters {
    /// Counts per revolution, > 0; four per line of a quadrature encoder.
    pub counts: u32,
    /// \[rad or m\] read-out per revolution, not 0: 2π at the joint, less behind a gear, the circumference of a pinion;
    /// negative reverses the count.
    pub turn: f64,
    /// Steps from sample to sample, at least 1.
    pub every: u32,
    /// \[rad or m\] errors of the shaft's angle.
    pub errors: Errors,
}

impl EncoderParameters {
    /// An encoder at a joint \[rad\] that samples every step, without errors except its resolution.
    #[must_use]
    pub const fn at_joint(counts: u32) -> Self {
        Self { counts, turn: core::f64::consts::TAU, every: 1, errors: Errors::NONE }
    }
}

/// An encoder at a read-out; `DELAY` samples late.
#[derive(Clone, Debug)]
pub struct Encoder<P: Geometry, const DELAY: usize = 0> {
    probe: Probe<P>,
    parameters: EncoderParameters,
    every: Every,
    sensor: Option<Sensor<P::Real, DELAY>>,
    per_unit: P::Real,
    link: Link,
    counted: i32,
}

impl<P: Geometry<Real: Number>, const DELAY: usize> Encoder<P, DELAY> {
    /// An encoder, named like its probe.
    #[must_use]
    pub fn new(probe: Probe<P>, parameters: EncoderParameters) -> Self {
        Self {
            probe,
            parameters,
            every: Every::new(parameters.every),
            sensor: None,
            per_unit: P::Real::from_f64(0.0),
            link: Link::Approximate,
            counted: 0,
        }
    }

    pub(crate) fn set_link(&mut self, fault: Fault) {
        self.link.stop(fault);
    }
}

/// A counter: the shaft's angle as a driver sees it.
pub trait Counting: Linked {
    /// Counts since the read-out was 0, over all revolutions; saturates at the ends of the range.
    fn counts(&self) -> i32;
    /// Counts per revolution.
    fn counts_per_turn(&self) -> u32;
}

impl<P: Geometry<Real: Number>, const DELAY: usize> Counting for Encoder<P, DELAY> {
    fn counts(&self) -> i32 {
        self.counted
    }
    fn counts_per_turn(&self) -> u32 {
        self.parameters.counts
    }
}

impl<P: Geometry<Real: Number>, const DELAY: usize> Linked for Encoder<P, DELAY> {
    fn name(&self) -> &'static str {
        self.probe.name()
    }
    fn link(&self) -> Link {
        self.link
    }
}

impl<P, M, const DELAY: usize> Part<M> for Encoder<P, DELAY>
where
    P: Geometry<Real: Number>,
    M: Machine<Precision = P, Real = P::Real>,
{
    fn wire(&mut self, wires: &mut Wires<'_, M>) -> Result<(), WiringError> {
        let EncoderParameters { counts, turn, every, errors } = self.parameters;
        let name = self.probe.name();
        let counts = f64::from(counts);
        parameter::<P::Real>(name, "the number of counts", counts, [1.0, f64::MAX])?;
        self.per_unit = parameter(name, "the turn", counts / turn, [-1e30, 1e30])?;
        let period = f64::from(every.max(1)) * wires.step_size();
        self.sensor = Some(Sensor::new(name, 0, errors, period)?);
        wires.see(&self.probe)?;
        self.link.wire(name)
    }

    #[inline]
    fn drive(&mut self, _: &mut M) -> Result<(), Fault> {
        Ok(())
    }

    #[inline]
    fn sense(&mut self, machine: &M) -> Result<(), Fault> {
        if self.every.is_due() {
            let Some(sensor) = &mut self.sensor else { return Err(Fault::NotWired) };
            let shown = sensor.sample(self.probe.see(machine)?);
            self.counted = (shown * self.per_unit).whole_below();
        }
        Ok(())
    }

    fn stop(&mut self, fault: Fault) {
        self.set_link(fault);
    }
}
