//! Time passes for the machine while its controller waits.
//!
//! `ns => steps of the node`. For a program without a clock of its own: the controller's loop waits, and
//! the machine takes the steps that fit; the remainder is carried ([`crate::node`]). Where a timer
//! paces the node, the controller waits by the board's own delay.

use embedded_hal::delay::DelayNs;

use crate::fault::Fault;
use crate::machine::Machine;
use crate::node::Node;
use crate::part::Part;
use crate::share::Shared;

/// What lets time pass.
pub trait Waiting {
    /// Lets time pass \[ns\].
    ///
    /// # Errors
    /// [`Fault`] where it stands still.
    fn wait(&mut self, nanoseconds: u32) -> Result<(), Fault>;
}

impl<M: Machine, D: Part<M>> Waiting for Node<M, D> {
    #[inline]
    fn wait(&mut self, nanoseconds: u32) -> Result<(), Fault> {
        Node::wait(self, nanoseconds)
    }
}

/// A node as a `DelayNs`.
#[derive(Clone, Copy, Debug)]
pub struct NodeDelay<C> {
    cell: C,
    fault: Option<Fault>,
}

impl<C: Shared<Part: Waiting>> NodeDelay<C> {
    /// The delay of a node in its cell.
    pub const fn new(cell: C) -> Self {
        Self { cell, fault: None }
    }

    /// The first fault of a wait, which the trait cannot tell: the time did not pass then.
    pub const fn fault(&self) -> Option<Fault> {
        self.fault
    }
}

impl<C: Shared<Part: Waiting>> DelayNs for NodeDelay<C> {
    #[inline]
    fn delay_ns(&mut self, nanoseconds: u32) {
        let waited = self.cell.with(|node| node.wait(nanoseconds));
        if let (None, Err(fault) | Ok(Err(fault))) = (self.fault, waited) {
            self.fault = Some(fault);
        }
    }
}
