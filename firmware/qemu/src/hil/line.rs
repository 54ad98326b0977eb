//! The board's end of the line: UART 0, timer 1 for ticks, timer 0 for cycles.

use dbd_link::Line;
use dbd_link::controller_end::Wait;

use crate::board::registers::Mapped;
use crate::board::serial::{Receiver, Sender};
use crate::board::ticks::Ticks;
use crate::board::timer::Timer;
use crate::board::{Board, sleep_unless};

/// \[1/s\] bit rate of the line.
pub const BIT_RATE: u32 = 921_600;
/// \[ticks\] that the answer to a frame may take.
const PATIENCE: u32 = 50;

/// The line, and the events that wake the core.
pub struct BoardLine {
    receiver: Receiver<'static>,
    sender: Sender<'static>,
    clock: Timer<Mapped>,
    ticks: Ticks<'static, Mapped>,
    /// \[ticks\] since the last frame was sent.
    waited: u32,
}

impl BoardLine {
    /// The line of a board, with a tick every `period` \[µs\].
    #[must_use]
    pub fn new(board: Board, period: u32) -> Self {
        let (receiver, sender) = board.uart.into_serial(BIT_RATE);
        let ticks = board.delay.into_ticks(period);
        Self { receiver, sender, clock: board.timer, ticks, waited: 0 }
    }

    /// \[µs\] from tick to tick.
    pub fn period(&self) -> u32 {
        self.ticks.period()
    }

    /// Bytes that wait.
    pub fn waiting(&self) -> usize {
        self.receiver.waiting()
    }

    /// The next byte, if it is there.
    pub fn received(&mut self) -> Option<u8> {
        self.receiver.byte()
    }

    /// Bytes that were lost since this was asked last.
    pub fn lost(&mut self) -> u32 {
        self.receiver.lost()
    }

    /// Takes the tick that is due: how many before it were missed.
    pub fn tick(&mut self) -> Option<u32> {
        self.ticks.take()
    }

    /// The next tick is due a period from now, none was missed.
    pub fn restart_ticks(&mut self) {
        self.ticks.restart();
    }

    /// Sleeps until a byte or a tick is there.
    pub fn sleep(&self) {
        sleep_unless(|| self.receiver.waiting() > 0 || self.ticks.ahead() > 0);
    }

    /// Waits until all bytes are sent, or as long as for an answer.
    pub fn finish(&mut self) {
        self.waited = 0;
        while !self.sender.is_done() && self.waited < PATIENCE {
            self.count();
            sleep_unless(|| self.sender.is_done() || self.ticks.ahead() > 0);
        }
    }

    /// Counts the ticks of a wait.
    fn count(&mut self) {
        if let Some(missed) = self.ticks.take() {
            self.waited = self.waited.saturating_add(missed).saturating_add(1);
        }
    }
}

impl Line for BoardLine {
    fn send(&mut self, frame: &[u8]) {
        // A frame without room is lost, as it may be on the line.
        _ = self.sender.send(frame);
        self.waited = 0;
    }

    fn cycles(&self) -> u32 {
        // Core and timer have one clock.
        self.clock.now()
    }
}

impl Wait for BoardLine {
    fn byte(&mut self) -> Option<u8> {
        loop {
            self.count();
            // Before the bytes: a line that never is silent must not keep a question from being asked again.
            if self.waited >= PATIENCE {
                return None;
            }
            if let Some(byte) = self.receiver.byte() {
                return Some(byte);
            }
            self.sleep();
        }
    }
}
