//! Embassy's time from SysTick: an interrupt per tick of `embassy_time::TICK_HZ`, on any Cortex-M.
//!
//! `core's clock => ticks since the start, wakers that are due`.

use core::cell::{Cell, RefCell};
use core::task::Waker;

use cortex_m::peripheral::SYST;
use cortex_m::peripheral::syst::SystClkSource;
use cortex_m_rt::exception;
use critical_section::{CriticalSection, Mutex};
use embassy_time::TICK_HZ;
use embassy_time_driver::Driver;
use embassy_time_queue_utils::Queue;

struct SysTicks(Mutex<Inner>);

struct Inner {
    ticks: Cell<u64>,
    /// When the first waker is due.
    next: Cell<u64>,
    queue: RefCell<Queue>,
}

embassy_time_driver::time_driver_impl!(static DRIVER: SysTicks = SysTicks(Mutex::new(Inner {
    ticks: Cell::new(0),
    next: Cell::new(u64::MAX),
    queue: RefCell::new(Queue::new()),
})));

/// Starts the time. `clock` \[Hz\] is the core's.
pub fn start(mut systick: SYST, clock: u32) {
    systick.set_clock_source(SystClkSource::Core);
    systick.set_reload(clock / TICK_HZ as u32 - 1);
    systick.clear_current();
    systick.enable_interrupt();
    systick.enable_counter();
}

impl Driver for SysTicks {
    fn now(&self) -> u64 {
        critical_section::with(|section| self.0.borrow(section).ticks.get())
    }

    fn schedule_wake(&self, at: u64, waker: &Waker) {
        critical_section::with(|section| {
            let inner = self.0.borrow(section);
            if inner.queue.borrow_mut().schedule_wake(at, waker) {
                inner.wake(section);
            }
        });
    }
}

impl Inner {
    /// Wakes what is due; within a critical section, so that nothing comes between.
    fn wake(&self, _: CriticalSection<'_>) {
        self.next.set(self.queue.borrow_mut().next_expiration(self.ticks.get()));
    }
}

#[exception]
fn SysTick() {
    critical_section::with(|section| {
        let inner = DRIVER.0.borrow(section);
        inner.ticks.set(inner.ticks.get() + 1);
        if inner.next.get() <= inner.ticks.get() {
            inner.wake(section);
        }
    });
}
