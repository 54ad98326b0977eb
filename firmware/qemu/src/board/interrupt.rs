//! The board's one interrupt: timer 1 counts ticks that are due.

use core::sync::atomic::Ordering;

use cortex_m::interrupt::InterruptNumber;
use cortex_m::peripheral::NVIC;
use cortex_m_rt::exception;

use super::addresses::timer::INTERRUPT_CLEAR;
use super::addresses::{TIMER1, TIMER1_INTERRUPT};
use super::registers::{Mapped, Registers as _};
use super::ticks::{DUE, Ticks};
use super::timer::Timer;
use crate::console::exit;

/// Timer 1 as the interrupt controller knows it.
#[derive(Clone, Copy)]
struct Timer1;

// The number is the board's, for the life of the program, and no other's: what the trait asks.
#[allow(unsafe_code)]
// SAFETY: as said.
unsafe impl InterruptNumber for Timer1 {
    fn number(self) -> u16 {
        TIMER1_INTERRUPT
    }
}

impl Timer<Mapped> {
    /// Ticks every `period` microseconds from now on; the timer is timer 1.
    // Unmasking could break a critical section by masks; nothing here uses one.
    #[allow(unsafe_code)]
    #[must_use]
    pub fn into_ticks(self, period: u32) -> Ticks<'static, Mapped> {
        let ticks = Ticks::start(self.release(), period, &DUE);
        // SAFETY: what the interrupt shares is atomic.
        unsafe { NVIC::unmask(Timer1) };
        ticks
    }
}

// The runtime calls it from an exception, which its attribute makes unsafe to declare.
#[allow(unsafe_code)]
#[exception]
unsafe fn DefaultHandler(number: i16) {
    if number != TIMER1_INTERRUPT as i16 {
        defmt::error!("interrupt {=i16} is nobody's", number);
        exit(false);
    }
    Mapped::at(TIMER1).write(INTERRUPT_CLEAR, 1);
    // Nothing else counts, so it may be two operations.
    DUE.store(DUE.load(Ordering::Relaxed).wrapping_add(1), Ordering::Relaxed);
}
