//! The controller's end: the closed loop of the cart-pendulum with its plant at the far end of the line.
//!
//! `(line, session) => loop`. Motor, encoders and controller are those of
//! [`closed_loop`](crate::closed_loop), so the lines that it prints are the same, bit for bit.

use core::cell::{Cell, RefCell};

use dbd_link::controller_end::Wait;
use dbd_link::message::Statistics;
use dbd_node::fault::{Problem, WiringError};

use crate::closed_loop::{CartPendulum, Loop, LoopError, Sample, balanced};
use crate::hil::plants::{self, CART_PENDULUM_INPUTS, CART_PENDULUM_SENSORS};
use crate::hil::remote::Remote;

/// The loop; `line` leads to the plant.
pub struct RemoteCartPendulum<L> {
    line: RefCell<L>,
    session: u16,
    seen: Cell<Statistics>,
}

impl<L> RemoteCartPendulum<L> {
    /// A loop whose session has this number.
    #[must_use]
    pub fn new(line: L, session: u16) -> Self {
        Self { line: RefCell::new(line), session, seen: Cell::default() }
    }

    /// The line, and the counts of the controller's end at the last tick.
    pub fn into_parts(self) -> (L, Statistics) {
        (self.line.into_inner(), self.seen.get())
    }
}

impl<L: Wait> Loop for RemoteCartPendulum<L> {
    const NAME: &'static str = CartPendulum::NAME;
    const TICK: u32 = CartPendulum::TICK;
    const PERIOD: u32 = CartPendulum::PERIOD;

    fn with(
        &self,
        ticks: impl FnOnce(
            &mut dyn FnMut() -> Result<(Sample, u64), LoopError>,
        ) -> Result<(), LoopError>,
    ) -> Result<(), LoopError> {
        let wrong = |problem| LoopError::Wiring(WiringError { name: "remote plant", problem });
        // Only the plant's identity is needed.
        let own = plants::cart_pendulum(0).ok_or(wrong(Problem::Parameter("the step")))?;
        let mut line = self.line.try_borrow_mut().map_err(|_| wrong(Problem::Busy))?;
        let (inputs, sensors) = (&CART_PENDULUM_INPUTS, &CART_PENDULUM_SENSORS);
        let opened =
            Remote::open(&mut *line, self.session, own.identity().clone(), inputs, sensors);
        let remote = opened.ok_or(wrong(Problem::Busy))?;
        let hash = |remote: &Remote<'_, L>| {
            self.seen.set(*remote.statistics());
            remote.hash()
        };
        balanced(remote, hash, ticks)
    }
}

#[cfg(test)]
mod tests {
    use std::collections::VecDeque;

    use dbd_link::Line;

    use super::*;
    use crate::hil::plants::End;
    use crate::models::cart_pendulum::CartPendulumF32;

    /// A line to a plant in this program, which periodically loses a frame.
    struct Lossy {
        plant: End<CartPendulumF32, 1, 4>,
        answers: VecDeque<u8>,
        every: u32,
        frames: u32,
    }

    impl Lossy {
        fn new(every: u32) -> Self {
            let plant = plants::cart_pendulum(0).expect("the scene's step");
            Self { plant, answers: VecDeque::new(), every, frames: 0 }
        }

        fn is_lost(&mut self) -> bool {
            self.frames += 1;
            self.frames.is_multiple_of(self.every)
        }
    }

    impl Line for Lossy {
        fn send(&mut self, frame: &[u8]) {
            if self.is_lost() {
                return;
            }
            let mut answer = Vec::new();
            for byte in frame {
                self.plant.receive(*byte, &mut |frame: &[u8]| answer.extend_from_slice(frame));
            }
            if !self.is_lost() {
                self.answers.extend(answer);
            }
        }
    }

    impl Wait for Lossy {
        fn byte(&mut self) -> Option<u8> {
            self.answers.pop_front()
        }
    }

    /// Samples and hashes of 20 ticks.
    fn ticked(the_loop: &impl Loop) -> Vec<(Sample, u64)> {
        let mut all = Vec::new();
        let ended = the_loop.with(|tick| {
            for _ in 0..20 {
                all.push(tick()?);
            }
            Ok(())
        });
        assert_eq!(ended, Ok(()));
        all
    }

    #[test]
    fn a_remote_plant_has_the_bits_of_a_local_one() {
        let local = ticked(&CartPendulum);
        for every in [u32::MAX, 5] {
            let remote = RemoteCartPendulum::new(Lossy::new(every), 3);
            assert_eq!(ticked(&remote), local, "every {every}th frame is lost");
            let (line, seen) = remote.into_parts();
            assert_eq!(seen.repeated > 0, every == 5);
            assert_eq!((line.plant.is_open(), line.plant.device().plant().hash()), {
                (false, local.last().expect("20 ticks").1)
            });
        }
    }
}
