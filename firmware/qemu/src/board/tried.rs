//! Every driver once, against the emulated hardware.
//!
//! `board => a line per driver, whether all of them did as they should`.

use embedded_hal::delay::DelayNs as _;
use embedded_hal::digital::{OutputPin as _, StatefulOutputPin as _};
use embedded_io::{ReadReady as _, Write as _};

use super::Board;
use super::addresses::CLOCK_HZ;
use crate::say;

/// Tries LEDs, timers, the UART and ticks.
#[must_use]
pub fn run(mut board: Board) -> bool {
    let [first, second] = &mut board.leds;
    let lit = first.set_high().is_ok()
        && second.set_low().is_ok()
        && first.is_set_high() == Ok(true)
        && second.is_set_high() == Ok(false);
    say!("board leds {}", lit);

    let start = board.timer.ticks();
    board.delay.delay_ms(20);
    let ticks = board.timer.ticks() - start;
    let expected = u64::from(CLOCK_HZ) / 50;
    let punctual = (expected..expected + 100).contains(&ticks);
    say!("board delay {} ({} ticks for {})", punctual, ticks, expected);

    let sent = board.uart.write_all(b"board\n").is_ok() && board.uart.flush().is_ok();
    let quiet = board.uart.read_ready() == Ok(false);
    say!("board uart {}", sent && quiet);

    // Three ticks on time; then work of three and a half ticks, which misses three.
    let mut ticks = board.delay.into_ticks(1_000);
    let late = [(); 3].map(|()| ticks.wait(cortex_m::asm::wfi));
    board.timer.delay_us(3_500);
    let missed = [(); 2].map(|()| ticks.wait(cortex_m::asm::wfi));
    let counted = late == [0; 3] && missed == [2, 0];
    say!("board ticks {} (missed {} and {})", counted, missed[0], missed[1]);
    lit && punctual && sent && quiet && counted
}
