//! The plants in a loop: it sleeps until the tick, steps, and checks whether the next tick came meanwhile.
#![no_std]
#![no_main]

use core::fmt::Write as _;

use cortex_m::asm::wfi;
use cortex_m::peripheral::NVIC;
use cortex_m_rt::entry;
use stm32f4xx_hal::pac::{Interrupt, Peripherals};
use stm32f405::board::{self, Ticker};
use stm32f405::runs::{Report, Run};

#[entry]
fn main() -> ! {
    let peripherals = Peripherals::take().expect("nobody took them before");
    let mut rcc = board::clock(peripherals.RCC);
    let mut console = board::console(peripherals.USART2, peripherals.GPIOA, &mut rcc);
    let mut ticker = board::ticker(peripherals.TIM2, &mut rcc);
    // The interrupt wakes the core from its sleep but is never taken.
    cortex_m::interrupt::disable();
    // SAFETY: no code depends on its being masked.
    #[allow(unsafe_code)]
    unsafe {
        NVIC::unmask(Interrupt::TIM2);
    }
    for run in (0..).map_while(Run::numbered) {
        let report = paced(run, &mut ticker);
        writeln!(console, "{report}").expect("the console takes every character");
    }
    writeln!(console, "end").expect("the console takes every character");
    loop {
        wfi();
    }
}

/// A whole run.
fn paced(mut run: Run, ticker: &mut Ticker) -> Report {
    // A tick that came between two runs belongs to none.
    ticked(ticker);
    let mut late = false;
    loop {
        while !(late || ticked(ticker)) {
            wfi();
        }
        if let Some(report) = run.tick() {
            return report;
        }
        late = ticked(ticker);
        if late {
            run.overrun();
        }
    }
}

/// Whether a tick came since the last time that it was asked.
fn ticked(ticker: &mut Ticker) -> bool {
    let ticked = ticker.wait().is_ok();
    if ticked {
        NVIC::unpend(Interrupt::TIM2);
    }
    ticked
}
