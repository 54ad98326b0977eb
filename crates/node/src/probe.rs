//! Where a sensor is fixed: a read-out by its name, and which number of it the sensor sees.
//!
//! `(machine, read-out, axis) => number`. What it names is looked for when the wires are checked,
//! so that a wrong one ends the start and not a run.

use dbd_kernel::Vec3;
use dbd_kernel::geometry::Geometry;
use dbd_kernel::readouts::{Reading, Readout};
use dbd_kernel::real::Real;

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

    /// A read-out that is a vector, along an axis of the world: a position \[m\], a velocity
    /// \[m/s\] or a force \[N\]. The axis is taken as it is: of unit length it gives the
    /// component, of another one that times its length.
    pub fn along(name: &'static str, readout: Readout<P>, axis: [f64; 3]) -> Self {
        Self { name, readout, axis: Some(Vec3::from_f64(axis)) }
    }

    /// The name that the program gave.
    pub const fn name(&self) -> &'static str {
        self.name
    }

    /// Checks that the machine has it, and that it is of the right kind.
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

    /// What it sees now.
    ///
    /// # Errors
    /// [`Fault::Readout`] where it is undefined.
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

/// A reading's kind in words.
pub(crate) fn kind<R: Real>(reading: &Reading<R>) -> &'static str {
    match reading {
        Reading::Scalar(_) => "a number",
        Reading::Vector(_) => "a vector",
        Reading::Imu { .. } => "specific force and rate",
    }
}
