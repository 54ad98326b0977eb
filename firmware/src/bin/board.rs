//! Program `board`: every driver once, against the emulated hardware.
#![cfg_attr(target_os = "none", no_std, no_main)]

use firmware::console::exit;
use firmware::say;

#[cfg(target_os = "none")]
#[cortex_m_rt::entry]
fn main() -> ! {
    use embedded_hal::delay::DelayNs;
    use embedded_hal::digital::{OutputPin, StatefulOutputPin};
    use embedded_io::{ReadReady, Write};
    use firmware::board::Board;
    use firmware::board::addresses::CLOCK_HZ;

    let mut board = Board::take();
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
    exit(lit && punctual && sent && quiet)
}

#[cfg(not(target_os = "none"))]
fn main() -> ! {
    say!("the drivers are tried on the target: cargo xtask fw board");
    exit(false)
}
