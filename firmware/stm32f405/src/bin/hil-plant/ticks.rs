//! Ticks of TIM2: its interrupt counts those that are due.

use core::cell::RefCell;
use core::sync::atomic::{AtomicU32, Ordering};

use cortex_m::interrupt::{Mutex, free};
use cortex_m::peripheral::NVIC;
use stm32f4xx_hal::pac::{Interrupt, interrupt};
use stm32f405::board::Ticker;

/// What the interrupt uses.
static TICKER: Mutex<RefCell<Option<Ticker>>> = Mutex::new(RefCell::new(None));
/// Ticks since the start. The interrupt counts them up, nothing else does.
static DUE: AtomicU32 = AtomicU32::new(0);

/// Takes ticks.
pub struct Ticks {
    done: u32,
}

/// Starts to count the ticks of a ticker.
pub fn start(ticker: Ticker) -> Ticks {
    free(|section| TICKER.borrow(section).replace(Some(ticker)));
    // SAFETY: no code depends on its being masked.
    #[allow(unsafe_code)]
    unsafe {
        NVIC::unmask(Interrupt::TIM2);
    }
    Ticks { done: DUE.load(Ordering::Relaxed) }
}

impl Ticks {
    /// Whether a tick is due.
    pub fn is_due(&self) -> bool {
        DUE.load(Ordering::Relaxed) != self.done
    }

    /// Takes the tick that is due: how many before it were missed.
    pub fn take(&mut self) -> Option<u32> {
        let ahead = DUE.load(Ordering::Relaxed).wrapping_sub(self.done);
        self.done = self.done.wrapping_add(ahead);
        ahead.checked_sub(1)
    }
}

#[interrupt]
fn TIM2() {
    free(|section| {
        if let Some(ticker) = TICKER.borrow(section).borrow_mut().as_mut() {
            // It clears the interrupt.
            _ = ticker.wait();
        }
    });
    // Nothing else counts, so it may be two operations.
    DUE.store(DUE.load(Ordering::Relaxed).wrapping_add(1), Ordering::Relaxed);
}
