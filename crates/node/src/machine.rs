//! The simulated machine: a plant behind the few calls that parts need.
//!
//! `(input, value) => machine; machine => reading; steps => machine`. The kernel's plant implements it; a recorded or
//! remote plant or another solver can too.

use core::ops::Deref;

use dbd_kernel::model::ModelOwner;
use dbd_kernel::plant::InputError;
use dbd_kernel::readouts::{Reading, Readout};
use dbd_kernel::{Failure, Geometry, InputIndex, Plant, Scheme};

use crate::number::Number;

/// A machine that is stepped, driven by inputs and observed through read-outs.
pub trait Machine {
    /// The numbers of its inputs and read-outs.
    type Real: Number;
    /// The precision of its positions.
    type Precision: Geometry<Real = Self::Real>;

    /// Sets an input \[N, N·m or m\], which keeps its value until set again.
    ///
    /// # Errors
    /// [`InputError`]; nothing is changed.
    fn set_input(&mut self, input: InputIndex, value: Self::Real) -> Result<(), InputError>;

    /// Reads a sensor; `None` if the machine has no such sensor or its value is undefined.
    fn read(&self, readout: &Readout<Self::Precision>) -> Option<Reading<Self::Real>>;

    /// `steps` steps.
    ///
    /// # Errors
    /// The latched failure; the steps before it are done.
    fn advance(&mut self, steps: u64) -> Result<(), Failure>;

    /// The result of the last step.
    ///
    /// # Errors
    /// The latched failure.
    fn status(&self) -> Result<(), Failure>;

    /// Steps since t = 0.
    fn steps(&self) -> u64;

    /// \[s\] the time of a step.
    fn step_size(&self) -> f64;

    /// \[s\] the present time.
    fn time(&self) -> f64 {
        self.steps() as f64 * self.step_size()
    }
}

impl<H, S> Machine for Plant<H, S>
where
    H: Deref<Target: ModelOwner<Precision: Geometry<Real: Number>> + Sized>,
    S: Scheme,
{
    type Real = <<H::Target as ModelOwner>::Precision as Geometry>::Real;
    type Precision = <H::Target as ModelOwner>::Precision;

    #[inline]
    fn set_input(&mut self, input: InputIndex, value: Self::Real) -> Result<(), InputError> {
        self.set_input_real(input, value)
    }

    #[inline]
    fn read(&self, readout: &Readout<Self::Precision>) -> Option<Reading<Self::Real>> {
        Plant::read(self, readout)
    }

    #[inline]
    fn advance(&mut self, steps: u64) -> Result<(), Failure> {
        Plant::advance(self, steps)
    }

    fn status(&self) -> Result<(), Failure> {
        Plant::status(self)
    }

    fn steps(&self) -> u64 {
        self.state().step
    }

    fn step_size(&self) -> f64 {
        Plant::step_size(self)
    }

    fn time(&self) -> f64 {
        Plant::time(self)
    }
}
