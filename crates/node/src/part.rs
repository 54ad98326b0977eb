//! Parts that a node steps with its machine: actuators before a step, sensors after it.
//!
//! `(machine, part) => machine, part`. Parts are in a tuple and served in its order. A part knows whether a node steps
//! it and why it is stopped; a driver port checks that first.

use core::cell::RefCell;

use dbd_kernel::{InputIndex, Real as _};

use crate::fault::{Fault, Problem, WiringError};
use crate::machine::Machine;
use crate::number::Number;
use crate::probe::Probe;
use crate::share::Shared;
#[cfg(feature = "critical-section")]
use crate::share::Slot;

/// A device between a machine and a driver.
pub trait Part<M: Machine> {
    /// Checks its wiring and gets the machine's step; called once by the node.
    ///
    /// # Errors
    /// [`WiringError`] with the name of the part that is wired wrongly.
    fn wire(&mut self, wires: &mut Wires<'_, M>) -> Result<(), WiringError>;

    /// Acts on the machine before a step.
    ///
    /// # Errors
    /// [`Fault`]; the node stops then.
    fn drive(&mut self, machine: &mut M) -> Result<(), Fault>;

    /// Samples the machine after a step, and once at the start.
    ///
    /// # Errors
    /// [`Fault`]; the node stops then.
    fn sense(&mut self, machine: &M) -> Result<(), Fault>;

    /// The node is stopped, or dropped ([`Fault::NotWired`]): drivers get the reason.
    fn stop(&mut self, fault: Fault);
}

/// A machine while parts are wired to it.
#[derive(Debug)]
pub struct Wires<'m, M> {
    machine: &'m mut M,
    /// One bit per input that a part drives.
    driven: [u64; 4],
}

impl<'m, M: Machine> Wires<'m, M> {
    /// No part is wired yet.
    pub fn new(machine: &'m mut M) -> Self {
        Self { machine, driven: [0; 4] }
    }

    /// \[s\] the time of a step.
    pub fn step_size(&self) -> f64 {
        self.machine.step_size()
    }

    /// The machine as it is now.
    pub fn machine(&self) -> &M {
        self.machine
    }

    /// Claims an input, which is 0 until the part drives it.
    ///
    /// # Errors
    /// [`Problem::Input`] if the machine has no such input or a table drives it, [`Problem::Shared`] if another part
    /// does.
    pub fn drive(&mut self, name: &'static str, input: InputIndex) -> Result<(), WiringError> {
        let error = |problem| WiringError { name, problem };
        let set = self.machine.set_input(input, M::Real::ZERO);
        set.map_err(|refused| error(Problem::Input(refused)))?;
        if let Some(word) = self.driven.get_mut(usize::from(input.0 / 64)) {
            let bit = 1 << (input.0 % 64);
            if *word & bit != 0 {
                return Err(error(Problem::Shared(input)));
            }
            *word |= bit;
        }
        Ok(())
    }

    /// Checks the read-out of a sensor.
    ///
    /// # Errors
    /// [`Problem::NoReadout`], [`Problem::Kind`].
    pub fn see(&self, probe: &Probe<M::Precision>) -> Result<(), WiringError> {
        probe.check(&*self.machine)
    }
}

/// Sampling interval of a part in steps.
#[derive(Clone, Copy, Debug)]
pub struct Every {
    steps: u32,
    left: u32,
}

impl Every {
    /// Every `steps` steps, starting at once; at least 1.
    #[must_use]
    pub fn new(steps: u32) -> Self {
        Self { steps: steps.max(1), left: 0 }
    }

    /// Whether a sample is due.
    #[inline]
    pub fn is_due(&mut self) -> bool {
        let due = self.left == 0;
        self.left = if due { self.steps - 1 } else { self.left - 1 };
        due
    }
}

/// Converts a parameter from double precision to the plant's; called when wiring is checked.
///
/// # Errors
/// [`Problem::Parameter`] unless it is within the inclusive bounds.
pub fn parameter<R: Number>(
    name: &'static str,
    which: &'static str,
    value: f64,
    [least, most]: [f64; 2],
) -> Result<R, WiringError> {
    let rounded = R::from_f64(value);
    if value >= least && value <= most && rounded.is_finite() {
        Ok(rounded)
    } else {
        Err(WiringError { name, problem: Problem::Parameter(which) })
    }
}

/// Whether a part is stepped, else the reason.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Link {
    /// No node steps it.
    #[default]
    Approximate,
    /// A node steps it.
    Wired,
    /// The node is stopped.
    Stopped(Fault),
}

impl Link {
    /// Connects the part.
    ///
    /// # Errors
    /// [`Problem::Twice`] if it is already connected.
    pub fn wire(&mut self, name: &'static str) -> Result<(), WiringError> {
        if *self != Link::Approximate {
            return Err(WiringError { name, problem: Problem::Twice });
        }
        *self = Link::Wired;
        Ok(())
    }

    /// The node is stopped or dropped.
    pub fn stop(&mut self, fault: Fault) {
        *self = if fault == Fault::NotWired { Link::Approximate } else { Link::Stopped(fault) };
    }

    /// The check at the start of a driver's call.
    ///
    /// # Errors
    /// [`Fault::NotWired`], or why the node is stopped.
    #[inline]
    pub fn check(&self) -> Result<(), Fault> {
        match *self {
            Link::Wired => Ok(()),
            Link::Approximate => Err(Fault::NotWired),
            Link::Stopped(fault) => Err(fault),
        }
    }
}

/// A part with a name and a link, as every driver port requires.
pub trait Linked {
    /// The name given by the program.
    fn name(&self) -> &'static str;
    /// Whether it is stepped.
    fn link(&self) -> Link;
}

/// Checks that a part is stepped when a driver port is attached.
///
/// # Errors
/// [`Problem::NoNode`] with its name; [`Problem::Busy`].
pub fn fix<C: Shared<Part: Linked>>(cell: &C) -> Result<(), WiringError> {
    let seen = cell.with(|part| (part.name(), part.link()));
    match seen {
        Ok((name, Link::Approximate)) => Err(WiringError { name, problem: Problem::NoNode }),
        Ok(_) => Ok(()),
        Err(_) => Err(WiringError { name: "a part", problem: Problem::Busy }),
    }
}

/// A part in a cell.
macro_rules! in_a_cell {
    ($(#[$feature:meta])* $cell:ty) => {
        $(#[$feature])*
        impl<M: Machine, T: Part<M>> Part<M> for &$cell {
            fn wire(&mut self, wires: &mut Wires<'_, M>) -> Result<(), WiringError> {
                let busy = WiringError { name: "a part", problem: Problem::Busy };
                self.with(|part| part.wire(wires)).map_err(|_| busy)?
            }
            #[inline]
            fn drive(&mut self, machine: &mut M) -> Result<(), Fault> {
                self.with(|part| part.drive(machine))?
            }
            #[inline]
            fn sense(&mut self, machine: &M) -> Result<(), Fault> {
                self.with(|part| part.sense(machine))?
            }
            fn stop(&mut self, fault: Fault) {
                // The present user is notified at the next call.
                let _ = self.with(|part| part.stop(fault));
            }
        }
    };
}

in_a_cell!(RefCell<T>);
in_a_cell!(#[cfg(feature = "critical-section")] critical_section::Mutex<RefCell<T>>);
in_a_cell!(#[cfg(feature = "critical-section")] Slot<T>);

impl<M: Machine, T: Part<M>, const N: usize> Part<M> for [T; N] {
    fn wire(&mut self, wires: &mut Wires<'_, M>) -> Result<(), WiringError> {
        self.iter_mut().try_for_each(|part| part.wire(wires))
    }
    #[inline]
    fn drive(&mut self, machine: &mut M) -> Result<(), Fault> {
        self.iter_mut().try_for_each(|part| part.drive(machine))
    }
    #[inline]
    fn sense(&mut self, machine: &M) -> Result<(), Fault> {
        self.iter_mut().try_for_each(|part| part.sense(machine))
    }
    fn stop(&mut self, fault: Fault) {
        self.iter_mut().for_each(|part| part.stop(fault));
    }
}

/// Parts in a tuple, served from left to right.
macro_rules! tuple {
    ($($part:ident)*) => {
        #[allow(non_snake_case, unused_variables)]
        impl<M: Machine, $($part: Part<M>),*> Part<M> for ($($part,)*) {
            fn wire(&mut self, wires: &mut Wires<'_, M>) -> Result<(), WiringError> {
                let ($($part,)*) = self;
                $($part.wire(wires)?;)*
                Ok(())
            }
            #[inline]
            fn drive(&mut self, machine: &mut M) -> Result<(), Fault> {
                let ($($part,)*) = self;
                $($part.drive(machine)?;)*
                Ok(())
            }
            #[inline]
            fn sense(&mut self, machine: &M) -> Result<(), Fault> {
                let ($($part,)*) = self;
                $($part.sense(machine)?;)*
                Ok(())
            }
            fn stop(&mut self, fault: Fault) {
                let ($($part,)*) = self;
                $($part.stop(fault);)*
            }
        }
    };
}

tuple!();
tuple!(A);
tuple!(A B);
tuple!(A B C);
tuple!(A B C D);
tuple!(A B C D E);
tuple!(A B C D E F);
tuple!(A B C D E F G);
tuple!(A B C D E F G H);
