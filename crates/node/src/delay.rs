//! Advances the machine while its controller waits.
//!
//! `ns => steps of the node`. For a program without a clock: the controller's loop waits, and the machine takes as many
//! whole steps; the remainder is carried over ([`crate::node`]). If a timer paces the node, the controller uses the
//! board's delay.

use embedded_hal::delay::DelayNs;

use crate::fault::Fault;
use crate::machine::Machine;
use crate::node::Node;
use crate::part::Part;
use crate::share::Shared;

/// Something that can advance time.
pub trait Waiting {
    /// Advances time \[ns\].
    ///
    /// # Errors
    /// [`Fault`] if it is stopped.
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

    /// The first fault of a wait, which the trait cannot report: time did not advance.
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
