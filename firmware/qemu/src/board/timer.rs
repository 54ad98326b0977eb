//! The CMSDK timer as a free-running counter of 32 bits, and delays by it.

use embedded_hal::delay::DelayNs;

use super::addresses::CLOCK_HZ;
use super::addresses::timer::{CTRL, CTRL_ENABLE, RELOAD, VALUE};
use super::registers::Registers;
use crate::hash::InstructionCounter;

const NANOSECONDS_PER_TICK: u32 = 1_000_000_000 / CLOCK_HZ;

/// A free-running timer of clock ticks.
#[derive(Debug)]
pub struct Timer<R> {
    registers: R,
    last: u32,
    ticks: u64,
}

impl<R: Registers> Timer<R> {
    /// Starts to count.
    pub fn new(mut registers: R) -> Self {
        registers.write(CTRL, 0);
        registers.write(RELOAD, u32::MAX);
        registers.write(VALUE, u32::MAX);
        registers.write(CTRL, CTRL_ENABLE);
        let last = registers.read(VALUE);
        Self { registers, last, ticks: 0 }
    }

    /// Its registers, for another use.
    pub fn release(self) -> R {
        self.registers
    }

    /// Clock ticks modulo 2³², for short durations.
    pub fn now(&self) -> u32 {
        // It counts downwards.
        self.registers.read(VALUE).wrapping_neg()
    }

    /// Ticks since the start. Must be asked once per 2³² ticks (172 s) or it loses them.
    pub fn ticks(&mut self) -> u64 {
        let value = self.registers.read(VALUE);
        self.ticks += u64::from(self.last.wrapping_sub(value));
        self.last = value;
        self.ticks
    }
}

impl<R: Registers> DelayNs for Timer<R> {
    fn delay_ns(&mut self, ns: u32) {
        // One more than the whole ticks: the present tick has partly passed.
        let end = self.ticks() + u64::from(ns.div_ceil(NANOSECONDS_PER_TICK)) + 1;
        while self.ticks() < end {
            core::hint::spin_loop();
        }
    }
}

/// The emulator's instructions last 64 ns each (`-icount shift=6`), which is 1.6 ticks.
impl<R: Registers> InstructionCounter for Timer<R> {
    fn count(&mut self) -> u64 {
        self.ticks() * 5 / 8
    }
}

#[cfg(test)]
mod tests {
    use std::cell::Cell;

    use super::*;

    /// A timer that passes some ticks with each look at it.
    struct Passing {
        value: Cell<u32>,
        per_look: u32,
        reload: u32,
    }

    impl Registers for Passing {
        fn read(&self, offset: usize) -> u32 {
            assert_eq!(offset, VALUE);
            self.value.set(self.value.get().wrapping_sub(self.per_look));
            self.value.get()
        }

        fn write(&mut self, offset: usize, value: u32) {
            match offset {
                VALUE => self.value.set(value),
                RELOAD => self.reload = value,
                CTRL => assert!(value <= CTRL_ENABLE),
                _ => panic!("register {offset:#x} is not written"),
            }
        }
    }

    fn timer(per_look: u32) -> Timer<Passing> {
        Timer::new(Passing { value: Cell::new(0), per_look, reload: 0 })
    }

    #[test]
    fn ticks_survive_the_wrap() {
        let mut timer = timer(0x6000_0000);
        assert_eq!(timer.registers.reload, u32::MAX);
        let ticks: Vec<u64> = (0..4).map(|_| timer.ticks()).collect();
        assert_eq!(ticks, [0x6000_0000, 0xc000_0000, 0x1_2000_0000, 0x1_8000_0000]);
    }

    #[test]
    fn now_counts_upwards() {
        let timer = timer(9);
        let start = timer.now();
        assert_eq!(timer.now().wrapping_sub(start), 9);
    }

    #[test]
    fn a_delay_is_never_short() {
        let mut timer = timer(1);
        let start = timer.ticks();
        timer.delay_ns(1_000);
        assert!((26..=28).contains(&(timer.ticks() - start)));
    }

    #[test]
    fn an_instruction_is_eight_fifths_of_a_tick() {
        assert_eq!(timer(16).count(), 10);
    }
}
