//! The pace of ticks: a board's timer, or none.

/// Waits for ticks.
pub trait Pace {
    /// Begins: the first tick is due a period from now.
    fn start(&mut self);
    /// Waits for the next tick; how many ticks were missed since the last wait.
    fn wait(&mut self) -> u32;
    /// \[µs\] since the tick was due.
    fn passed(&self) -> u32;
    /// Ticks that came since the last wait.
    fn ahead(&self) -> u32;
    /// \[µs\] from tick to tick; 0 where nothing paces.
    fn period(&self) -> u32;
}

/// One tick after the other, as fast as they go.
#[derive(Clone, Copy, Debug, Default)]
pub struct Unpaced;

impl Pace for Unpaced {
    fn start(&mut self) {}

    fn wait(&mut self) -> u32 {
        0
    }

    fn passed(&self) -> u32 {
        0
    }

    fn ahead(&self) -> u32 {
        0
    }

    fn period(&self) -> u32 {
        0
    }
}

#[cfg(target_os = "none")]
impl<R: crate::board::registers::Registers> Pace for crate::board::ticks::Ticks<'_, R> {
    fn start(&mut self) {
        self.restart();
    }

    fn wait(&mut self) -> u32 {
        self.wait(cortex_m::asm::wfi)
    }

    fn passed(&self) -> u32 {
        self.passed()
    }

    fn ahead(&self) -> u32 {
        self.ahead()
    }

    fn period(&self) -> u32 {
        self.period()
    }
}
