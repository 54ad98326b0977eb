//! Prints the panic message and location to the console, then halts.

use core::fmt::{self, Write as _};
use core::panic::PanicInfo;

use stm32f4xx_hal::pac::USART2;

/// The console's registers, whoever holds the console.
struct Last(USART2);

impl fmt::Write for Last {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        for byte in text.bytes() {
            while self.0.sr().read().txe().bit_is_clear() {}
            self.0.dr().write(|w| w.dr().set(byte.into()));
        }
        Ok(())
    }
}

#[panic_handler]
fn panicked(info: &PanicInfo<'_>) -> ! {
    cortex_m::interrupt::disable();
    // SAFETY: interrupts are off and this function never returns, so nobody else uses it any more.
    #[allow(unsafe_code)]
    let usart = unsafe { USART2::steal() };
    _ = writeln!(Last(usart), "error: {info}");
    loop {
        cortex_m::asm::wfi();
    }
}
