//! Clock, console and timer of the board, through the HAL.
//!
//! `peripherals => clocks, console (USART2, PA2) or line (USART2, PA2 and PA3), ticker (TIM2)`. Another board changes this file and `memory.x`.

use stm32f4xx_hal::pac::{GPIOA, RCC, TIM2, USART2};
use stm32f4xx_hal::prelude::*;
use stm32f4xx_hal::rcc::{Config, Rcc};
use stm32f4xx_hal::serial::{Rx, Tx};
use stm32f4xx_hal::timer::{CounterHz, Event};

/// [Hz] the core's clock, here the internal oscillator: no board lacks it, and it is all that QEMU has of this chip's
/// clocks.
#[cfg(not(feature = "pll"))]
pub const CLOCK: u32 = 16_000_000;
/// [Hz] the core's clock, here the most that the chip allows.
#[cfg(feature = "pll")]
pub const CLOCK: u32 = 168_000_000;
/// [Hz] the board's crystal, from which the clock is made.
#[cfg(feature = "pll")]
const CRYSTAL: u32 = 25_000_000;
/// [bit/s] of the console.
const BAUD: u32 = 115_200;

/// [bit/s] of the line to another controller or plant.
const LINE_BAUD: u32 = 921_600;

/// [Hz] ticks per second: below what docs/costs.csv estimates for the dearest plant at 168 MHz, scaled to this clock.
#[cfg(not(feature = "pll"))]
pub const RATE: u32 = 400;
/// [Hz] ticks per second, here those of the cart-pendulum in real time: the scene's step times this is 1.
#[cfg(feature = "pll")]
pub const RATE: u32 = 2_000;

/// [Hz] ticks per second of a plant at a line.
#[cfg(not(feature = "pll"))]
pub const LINE_RATE: u32 = RATE;
/// [Hz] ticks per second of a plant at a line, here those of its controller.
#[cfg(feature = "pll")]
pub const LINE_RATE: u32 = 1_000;

/// Where lines go.
pub type Console = Tx<USART2>;

/// What gives the ticks.
pub type Ticker = CounterHz<TIM2>;

/// Starts the clock.
#[must_use]
pub fn clock(rcc: RCC) -> Rcc {
    #[cfg(feature = "pll")]
    let config = Config::hse(CRYSTAL.Hz()).sysclk(CLOCK.Hz());
    #[cfg(not(feature = "pll"))]
    let config = Config::hsi();
    rcc.freeze(config)
}

/// The console, ready.
#[must_use]
pub fn console(usart: USART2, gpio: GPIOA, rcc: &mut Rcc) -> Console {
    let pin = gpio.split(rcc).pa2;
    usart.tx(pin, BAUD.bps(), rcc).expect("the clock allows this baud rate")
}

/// The line, both ways, in place of the console.
#[must_use]
pub fn line(usart: USART2, gpio: GPIOA, rcc: &mut Rcc) -> (Tx<USART2>, Rx<USART2>) {
    let pins = gpio.split(rcc);
    let serial = usart.serial((pins.pa2, pins.pa3), LINE_BAUD.bps(), rcc);
    serial.expect("the clock allows this baud rate").split()
}

/// The ticker, running at [`RATE`].
#[must_use]
pub fn ticker(timer: TIM2, rcc: &mut Rcc) -> Ticker {
    ticker_at(timer, RATE, rcc)
}

/// The ticker, running at `rate` [Hz].
#[must_use]
pub fn ticker_at(timer: TIM2, rate: u32, rcc: &mut Rcc) -> Ticker {
    let mut ticker = timer.counter_hz(rcc);
    ticker.listen(Event::Update);
    ticker.start(rate.Hz()).expect("the timer can do this rate");
    ticker
}
