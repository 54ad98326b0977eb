//! A machine and its parts, stepped together; waiting controllers advance its time.
//!
//! `(machine, parts, time) => machine, parts`. In a step, actuators drive, the machine steps, sensors sample. Waiting
//! time is converted to whole steps and a carried remainder, both in whole attoseconds (10⁻¹⁸ s): a decimal step is
//! exact; any other has an error of at most half an attosecond, which is a nanosecond after 2·10⁹ steps.

use core::num::NonZeroU64;

use crate::fault::{Fault, Problem, WiringError};
use crate::machine::Machine;
use crate::part::{Part, Wires};

/// A machine with the parts between it and the drivers of a controller.
#[derive(Debug)]
pub struct Node<M, D> {
    machine: M,
    parts: D,
    clock: Clock,
    fault: Option<Fault>,
}

impl<M: Machine, D: Part<M>> Node<M, D> {
    /// Wires parts to a machine; each sensor samples its present state.
    ///
    /// # Errors
    /// [`WiringError`] with the name of the first part that is wired wrongly; all parts are disconnected then.
    pub fn new(mut machine: M, mut parts: D) -> Result<Self, WiringError> {
        let refused = WiringError { name: "node", problem: Problem::Parameter("the step") };
        let clock = Clock::new(machine.step_size()).ok_or(refused)?;
        let wired = parts.wire(&mut Wires::new(&mut machine)).and_then(|()| {
            parts.sense(&machine).map_err(|fault| match fault {
                Fault::Readout(name) => WiringError { name, problem: Problem::NoReadout },
                _ => WiringError { name: "a part", problem: Problem::Busy },
            })
        });
        match wired {
            Ok(()) => Ok(Self { machine, parts, clock, fault: None }),
            Err(error) => {
                parts.stop(Fault::NotWired);
                Err(error)
            }
        }
    }

    /// One step: actuators drive, the machine steps, sensors sample.
    ///
    /// # Errors
    /// [`Fault`]; it latches: later calls, including those of drivers, change nothing and return the same fault.
    #[inline]
    pub fn step(&mut self) -> Result<(), Fault> {
        if let Some(fault) = self.fault {
            return Err(fault);
        }
        match self.try_step() {
            Ok(()) => Ok(()),
            Err(fault) => {
                self.stop(fault);
                Err(fault)
            }
        }
    }

    #[inline]
    fn try_step(&mut self) -> Result<(), Fault> {
        self.parts.drive(&mut self.machine)?;
        self.machine.advance(1).map_err(Fault::Plant)?;
        self.parts.sense(&self.machine)
    }

    #[cold]
    fn stop(&mut self, fault: Fault) {
        self.fault = Some(fault);
        self.parts.stop(fault);
    }

    /// `steps` steps, or as many as succeed; called by a timer interrupt.
    ///
    /// # Errors
    /// [`Fault`], as [`Self::step`].
    #[inline]
    pub fn advance(&mut self, steps: u64) -> Result<(), Fault> {
        for _ in 0..steps {
            self.step()?;
        }
        Ok(())
    }

    /// Advances time \[ns\] by as many whole steps as fit; the remainder is carried over to the next wait. The
    /// machine's time lags the waited time by less than a step.
    ///
    /// # Errors
    /// [`Fault`], as [`Self::step`].
    #[inline]
    pub fn wait(&mut self, nanoseconds: u32) -> Result<(), Fault> {
        let steps = self.clock.pass(nanoseconds);
        self.advance(steps)
    }

    /// Why it is stopped, if it is.
    pub fn fault(&self) -> Option<Fault> {
        self.fault
    }

    /// The machine.
    pub fn machine(&self) -> &M {
        &self.machine
    }

    /// The machine, to disturb it: inputs that no part drives, states.
    pub fn machine_mut(&mut self) -> &mut M {
        &mut self.machine
    }

    /// The parts.
    pub fn parts(&self) -> &D {
        &self.parts
    }

    /// \[s\] the machine's time.
    pub fn time(&self) -> f64 {
        self.machine.time()
    }

    /// Separates machine and parts; the parts may be wired again.
    pub fn release(mut self) -> (M, D) {
        self.parts.stop(Fault::NotWired);
        (self.machine, self.parts)
    }
}

/// Waited time in steps.
#[derive(Clone, Copy, Debug)]
struct Clock {
    /// \[as\] the step.
    step: NonZeroU64,
    /// \[as\] the remainder; less than a step.
    carried: u64,
}

impl Clock {
    /// `None` unless the step is from one attosecond to 10 s.
    fn new(step_size: f64) -> Option<Self> {
        let step = step_size * 1e18;
        if step <= 1e19 {
            // The conversion saturates: negative numbers and NaN become 0.
            Some(Self { step: NonZeroU64::new((step + 0.5) as u64)?, carried: 0 })
        } else {
            None
        }
    }

    /// The whole steps in the remainder plus `nanoseconds`.
    #[inline]
    fn pass(&mut self, nanoseconds: u32) -> u64 {
        // At most 10¹⁹ and 4.3·10¹⁸.
        let waited = self.carried.saturating_add(u64::from(nanoseconds) * 1_000_000_000);
        let steps = waited / self.step;
        self.carried = waited % self.step;
        steps
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_million_waits_do_not_drift() {
        // Steps of 50 µs and 1/3 ms, waits of 7 µs: whole, and not.
        for (step, steps, carried) in
            [(5e-5, 140_000, 0), (1e-3 / 3.0, 21_000, 7_000), (1e-9, 7_000_000_000, 0)]
        {
            let mut clock = Clock::new(step).unwrap();
            let mut sum = 0;
            for _ in 0..1_000_000 {
                sum += clock.pass(7_000);
            }
            assert_eq!((sum, clock.carried), (steps, carried), "{step}");
        }
        // Each wait is shorter than a step.
        let mut clock = Clock::new(1e-3).unwrap();
        let sum: u64 = (0..1_000_000).map(|_| clock.pass(999_999)).sum();
        assert_eq!((sum, clock.carried), (999_999, 0));
    }

    #[test]
    fn the_longest_waits_fit() {
        let mut clock = Clock::new(10.0).unwrap();
        let sum: u64 = (0..10).map(|_| clock.pass(u32::MAX)).sum();
        assert_eq!(sum, 4);
        assert_eq!(clock.carried, 2_949_672_950_000_000_000);
        for step in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e-19, 11.0] {
            assert!(Clock::new(step).is_none(), "{step}");
        }
    }
}
