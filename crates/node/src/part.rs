//! What a node steps together with its machine: actuators before a step, sensors after it.
//!
//! `(machine, part) => machine, part`. Parts stand in a tuple and are served in its order. A part
//! knows whether a node steps it and why it stands still; a driver's end asks for that first.

use core::cell::RefCell;

use dbd_kernel::Real as _;
use dbd_kernel::index::InputIndex;

use crate::fault::{Fault, Problem, WiringError};
use crate::machine::Machine;
use crate::number::Number;
use crate::probe::Probe;
use crate::share::Shared;
#[cfg(feature = "critical-section")]
use crate::share::Slot;

/// Something between a machine and a driver.
pub trait Part<M: Machine> {
    /// Checks its wires and takes the machine's step; called once, by the node.
    ///
    /// # Errors
    /// [`WiringError`] with the name of what is wired to nothing.
    fn wire(&mut self, wires: &mut Wires<'_, M>) -> Result<(), WiringError>;

    /// Acts on the machine before a step.
    ///
    /// # Errors
    /// [`Fault`]; the node stands still then.
    fn drive(&mut self, machine: &mut M) -> Result<(), Fault>;

    /// Looks at the machine after a step, and once at the start.
    ///
    /// # Errors
    /// [`Fault`]; the node stands still then.
    fn sense(&mut self, machine: &M) -> Result<(), Fault>;

    /// The node stands still, or is gone ([`Fault::NotWired`]): drivers shall hear why.
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

    /// Takes an input, which is 0 from now on until the part drives it.
    ///
    /// # Errors
    /// [`Problem::Input`] where the machine has none or a table drives it, [`Problem::Shared`]
    /// where another part does.
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

    /// Checks where a sensor is fixed.
    ///
    /// # Errors
    /// [`Problem::NoReadout`], [`Problem::Kind`].
    pub fn see(&self, probe: &Probe<M::Precision>) -> Result<(), WiringError> {
        probe.check(&*self.machine)
    }
}

/// Every how many steps a part samples.
#[derive(Clone, Copy, Debug)]
pub struct Every {
    steps: u32,
    left: u32,
}

impl Every {
    /// Every `steps` steps, beginning with the start; at least every step.
    #[must_use]
    pub fn new(steps: u32) -> Self {
        Self { steps: steps.max(1), left: 0 }
    }

    /// Whether this is the time.
    #[inline]
    pub fn is_due(&mut self) -> bool {
        let due = self.left == 0;
        self.left = if due { self.steps - 1 } else { self.left - 1 };
        due
    }
}

/// A quantity in a plant's numbers, from one in double precision; computed when wires are checked.
///
/// # Errors
/// [`Problem::Parameter`] where it is not within the bounds, both included.
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

/// Whether a part is stepped, and if not, why.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Link {
    /// No node steps it.
    #[default]
    Loose,
    /// A node steps it.
    Wired,
    /// The node stands still.
    Stopped(Fault),
}

impl Link {
    /// Takes the wire.
    ///
    /// # Errors
    /// [`Problem::Twice`] where there is one.
    pub fn wire(&mut self, name: &'static str) -> Result<(), WiringError> {
        if *self != Link::Loose {
            return Err(WiringError { name, problem: Problem::Twice });
        }
        *self = Link::Wired;
        Ok(())
    }

    /// The node stands still, or is gone.
    pub fn stop(&mut self, fault: Fault) {
        *self = if fault == Fault::NotWired { Link::Loose } else { Link::Stopped(fault) };
    }

    /// What a driver's call begins with.
    ///
    /// # Errors
    /// [`Fault::NotWired`], or why the node stands still.
    #[inline]
    pub fn check(&self) -> Result<(), Fault> {
        match *self {
            Link::Wired => Ok(()),
            Link::Loose => Err(Fault::NotWired),
            Link::Stopped(fault) => Err(fault),
        }
    }
}

/// A part that has a name and a link, as every end of a driver needs.
pub trait Linked {
    /// The name that the program gave.
    fn name(&self) -> &'static str;
    /// Whether it is stepped.
    fn link(&self) -> Link;
}

/// Checks that a part is stepped, when an end of a driver is fixed to it.
///
/// # Errors
/// [`Problem::NoNode`] with its name; [`Problem::Busy`].
pub fn fix<C: Shared<Part: Linked>>(cell: &C) -> Result<(), WiringError> {
    let seen = cell.with(|part| (part.name(), part.link()));
    match seen {
        Ok((name, Link::Loose)) => Err(WiringError { name, problem: Problem::NoNode }),
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
                // Who is at it now will hear of it at the next call.
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
