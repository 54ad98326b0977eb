//! The plants in an embassy task; a task of lower priority prints. Each has an executor of its own, at an interrupt.
//!
//! Clock, console and pins are the HAL's; embassy's time is SysTick.
#![no_std]
#![no_main]

mod systick;

use core::fmt::Write as _;

use embassy_executor::InterruptExecutor;
use embassy_sync::blocking_mutex::raw::CriticalSectionRawMutex;
use embassy_sync::channel::Channel;
use embassy_time::{Duration, Instant, TICK_HZ, Timer};
use stm32f4xx_hal::pac::{Interrupt, NVIC, Peripherals, interrupt};
use stm32f405::board::{self, Console, RATE};
use stm32f405::runs::{Report, Run};

/// Between two ticks of the plant.
const PERIOD: Duration = Duration::from_hz(RATE as u64);
const _: () =
    assert!(TICK_HZ.is_multiple_of(RATE as u64), "the period is a whole number of embassy's ticks");

/// Where the plants are stepped: at the interrupt USART6, whose peripheral nobody uses.
static ABOVE: InterruptExecutor = InterruptExecutor::new();
/// Where lines are printed: at the interrupt UART5, likewise.
static BELOW: InterruptExecutor = InterruptExecutor::new();
/// Reports on their way to the console; `None` after the last one.
static OUTBOX: Channel<CriticalSectionRawMutex, Option<Report>, 1> = Channel::new();

#[interrupt]
fn USART6() {
    // SAFETY: `main` starts this executor at this interrupt, which is enabled by that.
    #[allow(unsafe_code)]
    unsafe {
        ABOVE.on_interrupt();
    }
}

#[interrupt]
fn UART5() {
    // SAFETY: as above.
    #[allow(unsafe_code)]
    unsafe {
        BELOW.on_interrupt();
    }
}

#[cortex_m_rt::entry]
fn main() -> ! {
    let peripherals = Peripherals::take().expect("nobody took them before");
    let mut core = cortex_m::Peripherals::take().expect("nobody took them before");
    let mut rcc = board::clock(peripherals.RCC);
    let console = board::console(peripherals.USART2, peripherals.GPIOA, &mut rcc);
    systick::start(core.SYST, board::CLOCK);
    prioritise(&mut core.NVIC);
    let print = print(console).expect("it is spawned once");
    BELOW.start(Interrupt::UART5).spawn(print);
    ABOVE.start(Interrupt::USART6).spawn(plants().expect("it is spawned once"));
    // Not the executor of thread mode: it waits for events, which QEMU does without rest.
    loop {
        cortex_m::asm::wfi();
    }
}

/// SysTick stays above all, so that time goes on while the plant steps.
fn prioritise(nvic: &mut NVIC) {
    // SAFETY: critical sections mask all interrupts, whatever their priorities.
    #[allow(unsafe_code)]
    unsafe {
        nvic.set_priority(Interrupt::USART6, 0x40);
        nvic.set_priority(Interrupt::UART5, 0x80);
    }
}

/// All runs, one after the other.
#[embassy_executor::task]
async fn plants() {
    for run in (0..).map_while(Run::numbered) {
        let report = paced(run).await;
        OUTBOX.send(Some(report)).await;
    }
    OUTBOX.send(None).await;
}

/// A whole run.
async fn paced(mut run: Run) -> Report {
    let mut due = Instant::now();
    loop {
        Timer::at(due).await;
        if let Some(report) = run.tick() {
            return report;
        }
        due += PERIOD;
        let now = Instant::now();
        if now >= due {
            run.overrun();
            // Late steps follow at once, but lost ticks are not made up for.
            due = now;
        }
    }
}

#[embassy_executor::task]
async fn print(mut console: Console) {
    while let Some(report) = OUTBOX.receive().await {
        writeln!(console, "{report}").expect("the console takes every character");
    }
    writeln!(console, "end").expect("the console takes every character");
}
