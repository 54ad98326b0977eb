//! Ticks at a fixed rate by the CMSDK timer: its interrupt counts those that are due, so that none is
//! lost while work runs.
//!
//! `period => due ticks; wait => ticks that were missed`. The interrupt does nothing else: what is
//! done in a tick runs in the thread that waits, and shares nothing with an interrupt.

use core::sync::atomic::{AtomicU32, Ordering};

use super::addresses::CLOCK_HZ;
use super::addresses::timer::{
    CTRL, CTRL_ENABLE, CTRL_INTERRUPT, INTERRUPT_CLEAR, MAX_PERIOD, RELOAD, VALUE,
};
use super::registers::Registers;

/// Clock ticks in a microsecond.
const PER_MICROSECOND: u32 = CLOCK_HZ / 1_000_000;

/// Ticks since the timer of [`Ticks`] was started. The interrupt counts them up, nothing else does.
pub static DUE: AtomicU32 = AtomicU32::new(0);

/// A timer that ticks.
#[derive(Debug)]
pub struct Ticks<'d, R> {
    registers: R,
    due: &'d AtomicU32,
    done: u32,
    period: u32,
}

impl<'d, R: Registers> Ticks<'d, R> {
    /// Starts to tick every `period` microseconds, at least 1 and at most 171 s. `due` is what the
    /// timer's interrupt counts up.
    pub fn start(mut registers: R, period: u32, due: &'d AtomicU32) -> Self {
        let period = period.clamp(1, MAX_PERIOD / PER_MICROSECOND) * PER_MICROSECOND;
        registers.write(CTRL, 0);
        registers.write(INTERRUPT_CLEAR, 1);
        // The counter passes 0, too.
        registers.write(RELOAD, period - 1);
        registers.write(VALUE, period - 1);
        let done = due.load(Ordering::Relaxed);
        registers.write(CTRL, CTRL_ENABLE | CTRL_INTERRUPT);
        Self { registers, due, done, period }
    }

    /// Begins anew: the next tick is due a period from now, none was missed.
    pub fn restart(&mut self) {
        self.registers.write(CTRL, 0);
        self.registers.write(INTERRUPT_CLEAR, 1);
        self.registers.write(VALUE, self.period - 1);
        self.done = self.due.load(Ordering::Relaxed);
        self.registers.write(CTRL, CTRL_ENABLE | CTRL_INTERRUPT);
    }

    /// Waits for the next tick, with `sleep` in between; how many ticks came while the last one was
    /// still at work, and are left out. `sleep` returns after an interrupt at the latest.
    pub fn wait(&mut self, mut sleep: impl FnMut()) -> u32 {
        loop {
            if let Some(missed) = self.take() {
                return missed;
            }
            sleep();
        }
    }

    /// Takes the tick that is due: how many before it came while the last one was still at work, and are left
    /// out. `None` where no tick is due.
    pub fn take(&mut self) -> Option<u32> {
        let ahead = self.ahead();
        self.done = self.done.wrapping_add(ahead);
        ahead.checked_sub(1)
    }

    /// Microseconds since the last tick that was due, rounded up: what was done in it takes so long,
    /// where none was missed.
    pub fn passed(&self) -> u32 {
        let counted = (self.period - 1).saturating_sub(self.registers.read(VALUE));
        counted.div_ceil(PER_MICROSECOND)
    }

    /// Ticks that came since the last wait.
    pub fn ahead(&self) -> u32 {
        self.due.load(Ordering::Relaxed).wrapping_sub(self.done)
    }

    /// \[µs\] from tick to tick.
    pub fn period(&self) -> u32 {
        self.period / PER_MICROSECOND
    }

    /// Stops; the timer can be started again.
    pub fn stop(mut self) -> R {
        self.registers.write(CTRL, 0);
        self.registers.write(INTERRUPT_CLEAR, 1);
        self.registers
    }
}

#[cfg(test)]
mod tests {
    use std::cell::Cell;

    use super::*;

    #[derive(Default)]
    struct Written {
        control: u32,
        reload: u32,
        value: Cell<u32>,
    }

    impl Registers for Written {
        fn read(&self, offset: usize) -> u32 {
            assert_eq!(offset, VALUE);
            self.value.get()
        }

        fn write(&mut self, offset: usize, value: u32) {
            match offset {
                CTRL => self.control = value,
                RELOAD => self.reload = value,
                VALUE => self.value.set(value),
                INTERRUPT_CLEAR => assert_eq!(value, 1),
                _ => panic!("register {offset:#x} is not written"),
            }
        }
    }

    #[test]
    fn a_period_is_whole_clock_ticks() {
        let due = AtomicU32::new(7);
        let ticks = Ticks::start(Written::default(), 1_000, &due);
        assert_eq!((ticks.registers.reload, ticks.registers.control), (24_999, 9));
        assert_eq!(ticks.passed(), 0);
        ticks.registers.value.set(24_999 - 26);
        assert_eq!(ticks.passed(), 2);
        assert_eq!(ticks.stop().control, 0);
        assert_eq!(Ticks::start(Written::default(), 0, &due).registers.reload, 24);
        assert_eq!(Ticks::start(Written::default(), u32::MAX, &due).period, 4_294_967_275);
    }

    #[test]
    fn missed_ticks_are_counted_once() {
        // The counter may wrap.
        let due = AtomicU32::new(u32::MAX);
        let mut ticks = Ticks::start(Written::default(), 100, &due);
        let tick = || _ = due.fetch_add(1, Ordering::Relaxed);
        let mut slept = 0;
        let mut wait = |ticks: &mut Ticks<'_, Written>| {
            ticks.wait(|| {
                slept += 1;
                tick();
            })
        };
        assert_eq!(wait(&mut ticks), 0);
        (0..3).for_each(|_| tick());
        assert_eq!(ticks.ahead(), 3);
        assert_eq!(wait(&mut ticks), 2);
        assert_eq!(wait(&mut ticks), 0);
        (0..3).for_each(|_| tick());
        ticks.restart();
        assert_eq!((ticks.ahead(), ticks.registers.value.get()), (0, 2_499));
        assert_eq!(slept, 2);
        assert_eq!(ticks.take(), None);
        tick();
        assert_eq!((ticks.take(), ticks.take()), (Some(0), None));
    }
}
