//! The plants in an RTIC task at the timer's interrupt; a task below it prints.
#![no_std]
#![no_main]

// For its panic handler; and the interrupts' names are those of the chip.
use stm32f405 as _;

#[rtic::app(device = stm32f4xx_hal::pac, dispatchers = [USART6])]
mod app {
    use core::fmt::Write as _;

    use rtic_monotonics::systick::prelude::*;
    use stm32f405::board::{self, Console, Ticker};
    use stm32f405::runs::{Report, Run};

    systick_monotonic!(Mono, 1_000);

    #[shared]
    struct Shared {
        outbox: Outbox,
    }

    /// What is to be printed.
    #[derive(Default)]
    pub struct Outbox {
        report: Option<Report>,
        end: bool,
    }

    type Runs = core::iter::MapWhile<core::ops::RangeFrom<usize>, fn(usize) -> Option<Run>>;

    #[local]
    struct Local {
        console: Console,
        ticker: Ticker,
        /// The runs to come; the one at hand.
        runs: Runs,
        run: Option<Run>,
    }

    #[init]
    fn init(context: init::Context) -> (Shared, Local) {
        let device = context.device;
        let mut rcc = board::clock(device.RCC);
        let console = board::console(device.USART2, device.GPIOA, &mut rcc);
        let ticker = board::ticker(device.TIM2, &mut rcc);
        Mono::start(context.core.SYST, board::CLOCK);
        print::spawn().expect("it is not yet running");
        let runs: Runs = (0..).map_while(Run::numbered);
        (Shared { outbox: Outbox::default() }, Local { console, ticker, runs, run: None })
    }

    /// The plant's tick: above everything that may take its time.
    #[task(binds = TIM2, priority = 2, local = [ticker, runs, run], shared = [outbox])]
    fn tick(mut context: tick::Context) {
        let tick::LocalResources { ticker, runs, run: at_hand, .. } = context.local;
        // Late or not, the tick is taken.
        _ = ticker.wait();
        if let Some(run) = at_hand {
            if let Some(report) = run.tick() {
                *at_hand = None;
                context.shared.outbox.lock(|outbox| outbox.report = Some(report));
            } else if ticker.wait().is_ok() {
                run.overrun();
            }
        } else if context.shared.outbox.lock(|outbox| outbox.report.is_none()) {
            *at_hand = runs.next();
            if at_hand.is_none() {
                ticker.cancel().expect("it runs");
                context.shared.outbox.lock(|outbox| outbox.end = true);
            }
        }
    }

    /// Prints what there is, a hundred times per second.
    #[task(priority = 1, local = [console], shared = [outbox])]
    async fn print(mut context: print::Context) {
        let console = context.local.console;
        loop {
            let Outbox { report, end } = context.shared.outbox.lock(core::mem::take);
            if let Some(report) = report {
                writeln!(console, "{report}").expect("the console takes every character");
            }
            if end {
                writeln!(console, "end").expect("the console takes every character");
            }
            Mono::delay(10.millis()).await;
        }
    }
}
