//! An end stop: a switch that closes when a read-out passes a threshold.
//!
//! `(read-out, threshold, hysteresis) => closed or open`. It closes at the threshold and opens again only beyond the
//! hysteresis, like a lever switch.

use dbd_kernel::{Geometry, Real as _};

use crate::fault::{Fault, WiringError};
use crate::machine::Machine;
use crate::number::Number;
use crate::part::{Link, Linked, Part, Wires, parameter};
use crate::probe::Probe;

/// The side of the threshold on which a switch is closed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// At and above it.
    Above,
    /// At and below it.
    Below,
}

/// A switch at a read-out.
#[derive(Clone, Debug)]
pub struct EndStop<P: Geometry> {
    probe: Probe<P>,
    side: Side,
    bounds: [f64; 2],
    /// Where it closes and where it opens, in the direction of approach.
    closes: P::Real,
    opens: P::Real,
    link: Link,
    closed: bool,
}

impl<P: Geometry<Real: Number>> EndStop<P> {
    /// A switch that closes at `threshold` and opens `hysteresis` ≥ 0 back from it, both in the unit of the read-out
    /// \[m, rad, …\]; it is named like its probe.
    #[must_use]
    pub fn new(probe: Probe<P>, side: Side, threshold: f64, hysteresis: f64) -> Self {
        let zero = P::Real::from_f64(0.0);
        let bounds = [threshold, hysteresis];
        Self {
            probe,
            side,
            bounds,
            closes: zero,
            opens: zero,
            link: Link::Approximate,
            closed: false,
        }
    }
}

/// A switch.
pub trait Switch: Linked {
    /// Whether it is closed.
    fn is_closed(&self) -> bool;
}

impl<P: Geometry<Real: Number>> Switch for EndStop<P> {
    fn is_closed(&self) -> bool {
        self.closed
    }
}

impl<P: Geometry<Real: Number>> Linked for EndStop<P> {
    fn name(&self) -> &'static str {
        self.probe.name()
    }
    fn link(&self) -> Link {
        self.link
    }
}

impl<P, M> Part<M> for EndStop<P>
where
    P: Geometry<Real: Number>,
    M: Machine<Precision = P, Real = P::Real>,
{
    fn wire(&mut self, wires: &mut Wires<'_, M>) -> Result<(), WiringError> {
        let name = self.probe.name();
        let [threshold, hysteresis] = self.bounds;
        let any = [-f64::MAX, f64::MAX];
        parameter::<P::Real>(name, "the hysteresis", hysteresis, [0.0, f64::MAX])?;
        let sign = if self.side == Side::Above { 1.0 } else { -1.0 };
        self.closes = parameter(name, "the threshold", sign * threshold, any)?;
        self.opens = parameter(name, "the threshold", sign * threshold - hysteresis, any)?;
        wires.see(&self.probe)?;
        self.link.wire(name)
    }

    #[inline]
    fn drive(&mut self, _: &mut M) -> Result<(), Fault> {
        Ok(())
    }

    #[inline]
    fn sense(&mut self, machine: &M) -> Result<(), Fault> {
        let seen = self.probe.see(machine)?;
        let way = if self.side == Side::Above { seen } else { -seen };
        self.closed = way >= self.closes || (self.closed && way >= self.opens);
        Ok(())
    }

    fn stop(&mut self, fault: Fault) {
        self.link.stop(fault);
    }
}
