//! SysTick as a counter of instructions, on an emulator whose instructions last 64 ns each.
//!
//! A tick is 40 ns of virtual time, an instruction 1.6 ticks; the counter of 24 bits wraps after
//! 10.4 million instructions. Without `-icount shift=6` the counts mean nothing.

use cortex_m::peripheral::SYST;
use cortex_m::peripheral::syst::SystClkSource;

/// Largest count of 24 bits.
const WRAP: u32 = 0x00ff_ffff;

/// The running counter.
pub struct SysTick {
    _peripheral: SYST,
}

impl SysTick {
    /// Starts the counter at the core's clock, without an interrupt.
    pub(super) fn new(mut peripheral: SYST) -> Self {
        peripheral.set_clock_source(SystClkSource::Core);
        peripheral.set_reload(WRAP);
        peripheral.clear_current();
        peripheral.enable_counter();
        Self { _peripheral: peripheral }
    }

    /// The present count, downwards.
    #[inline(always)]
    pub fn read(&mut self) -> u32 {
        SYST::get_current()
    }

    /// Ticks between two readings less than a wrap apart.
    #[must_use]
    pub fn between(start: u32, end: u32) -> u64 {
        u64::from(start.wrapping_sub(end) & WRAP)
    }

    /// Instructions per call from the ticks of `calls` calls, rounded.
    #[must_use]
    pub fn instructions(ticks: u64, calls: u32) -> u64 {
        let calls = u64::from(calls);
        (ticks * 5 + 4 * calls) / (8 * calls)
    }
}
