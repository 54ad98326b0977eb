//! Attachment of a sensor: a read-out by name, and which of its numbers the sensor reads.
//!
//! `(machine, read-out, axis) => number`. The read-out is checked at wiring, so that a wrong one fails at the start and
//! not during a run.

use dbd_kernel::readouts::{Reading, Readout};
use dbd_kernel::{Geometry, Real, Vec3};

use crate::fault::{Fault, Problem, WiringError};
use crate::machine::Machine;

/// A number of a machine's read-outs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Probe<P: Geometry> {
    name: &'static str,
    readout: Readout<P>,
    axis: Option<Vec3<P::Real>>,
}

impl<P: Geometry> Probe<P> {
    /// A read-out that is a number: an angle \[rad\], a rate \[rad/s\], a tension \[N\] or an input.
    pub const fn scalar(name: &'static str, readout: Readout<P>) -> Self {
        Self { name, readout, axis: None }
    }

    /// A vector read-out along a world axis: a position \[m\], a velocity \[m/s\] or a force \[N\]. The axis is not
    /// normalised: the component is multiplied by its length.
    pub fn along(name: &'static str, readout: Readout<P>, axis: [f64; 3]) -> Self {
        Self { name, readout, axis: Some(Vec3::from_f64(axis)) }
    }

    /// The name given by the program.
    pub const fn name(&self) -> &'static str {
        self.name
    }

    /// Checks that the machine has it and that its kind is right.
    ///
    /// # Errors
    /// [`Problem::NoReadout`], [`Problem::Kind`], with its name.
    pub fn check<M: Machine<Precision = P, Real = P::Real>>(
        &self,
        machine: &M,
    ) -> Result<(), WiringError> {
        let error = |problem| Err(WiringError { name: self.name, problem });
        let Some(reading) = machine.read(&self.readout) else { return error(Problem::NoReadout) };
        match (reading, self.axis) {
            (Reading::Scalar(_), None) | (Reading::Vector(_), Some(_)) => Ok(()),
            (reading, None) => error(Problem::Kind { wanted: "a number", found: kind(&reading) }),
            (reading, Some(_)) => {
                error(Problem::Kind { wanted: "a vector", found: kind(&reading) })
            }
        }
    }

    /// The present value.
    ///
    /// # Errors
    /// [`Fault::Readout`] if it is undefined.
    #[inline]
    pub fn see<M: Machine<Precision = P, Real = P::Real>>(
        &self,
        machine: &M,
    ) -> Result<P::Real, Fault> {
        match (machine.read(&self.readout), self.axis) {
            (Some(Reading::Scalar(value)), None) => Ok(value),
            (Some(Reading::Vector(value)), Some(axis)) => Ok(value.dot(axis)),
            _ => Err(Fault::Readout(self.name)),
        }
    }
}

/// The name of a reading's kind.
pub(crate) fn kind<R: Real>(reading: &Reading<R>) -> &'static str {
    match reading {
        Reading::Scalar(_) => "a number",
        Reading::Vector(_) => "a vector",
        Reading::Imu { .. } => "specific force and angular rate",
    }
}
