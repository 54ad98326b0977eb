//! The board's peripherals, handed out once.

use core::sync::atomic::{AtomicBool, Ordering};

use super::addresses::{FPGAIO, TIMER0, TIMER1, UART0, fpgaio};
use super::led::Led;
use super::registers::Mapped;
use super::systick::SysTick;
use super::timer::Timer;
use super::uart::Uart;

/// \[1/s\] the UART's bit rate.
const BIT_RATE: u32 = 115_200;

/// All peripherals that programs use.
pub struct Board {
    /// UART 0.
    pub uart: Uart<Mapped>,
    /// Timer 0, free-running since start.
    pub timer: Timer<Mapped>,
    /// Timer 1, for delays.
    pub delay: Timer<Mapped>,
    /// The two user LEDs.
    pub leds: [Led<Mapped>; 2],
    /// The core's SysTick.
    pub systick: SysTick,
}

impl Board {
    /// The board.
    ///
    /// # Panics
    /// The second time: a peripheral has one owner.
    #[must_use]
    pub fn take() -> Self {
        static TAKEN: AtomicBool = AtomicBool::new(false);
        let core = cortex_m::Peripherals::take();
        let (Some(core), false) = (core, TAKEN.swap(true, Ordering::Relaxed)) else {
            panic!("the board has already been taken");
        };
        Self {
            uart: Uart::new(Mapped::at(UART0), BIT_RATE),
            timer: Timer::new(Mapped::at(TIMER0)),
            delay: Timer::new(Mapped::at(TIMER1)),
            leds: fpgaio::USER_LEDS.map(|bit| Led::new(Mapped::at(FPGAIO), bit)),
            systick: SysTick::new(core.SYST),
        }
    }
}
