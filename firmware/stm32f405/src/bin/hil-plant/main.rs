//! Hardware in the loop: the cart-pendulum at the plant's end of USART2, its controller at the other one.
//!
//! `bytes, ticks => steps => bytes`. The core sleeps until an interrupt; interrupts move bytes and count ticks, and
//! the loop gives both to the plant.
#![no_std]
#![no_main]

mod line;
mod ticks;

use cortex_m::asm::wfi;
use cortex_m_rt::entry;
use dbd_kernel::{Leapfrog, Plant};
use dbd_link::{KernelPlant, PlantEnd};
use stm32f4xx_hal::pac::Peripherals;
use stm32f405::board::{self, LINE_RATE};
use stm32f405::models::cart_pendulum::{
    CART_PENDULUM_F32, CART_PENDULUM_INPUT_DRIVE, CART_PENDULUM_READOUT_ANGLE_F32,
    CART_PENDULUM_READOUT_CART_POINT_F32, CART_PENDULUM_READOUT_CART_VELOCITY_F32,
    CART_PENDULUM_READOUT_RATE_F32, CART_PENDULUM_STEP, CartPendulumF32,
};

/// [µs] from tick to tick.
const PERIOD: u32 = 1_000_000 / LINE_RATE;
/// [bytes] of the buffer for a snapshot.
const SNAPSHOT: usize = 2048;

type End = PlantEnd<KernelPlant<&'static CartPendulumF32, Leapfrog, 1, 4>, SNAPSHOT>;

#[entry]
fn main() -> ! {
    let peripherals = Peripherals::take().expect("nobody took them before");
    let mut core = cortex_m::Peripherals::take().expect("nobody took them before");
    core.DCB.enable_trace();
    core.DWT.enable_cycle_counter();
    let mut rcc = board::clock(peripherals.RCC);
    let (tx, rx) = board::line(peripherals.USART2, peripherals.GPIOA, &mut rcc);
    let mut end = plant().expect("the scene's step is positive, and its state fits");
    let (mut line, mut received) = line::start(tx, rx);
    let mut ticks = ticks::start(board::ticker_at(peripherals.TIM2, LINE_RATE, &mut rcc));
    loop {
        // No more than there are now: a tick must not wait for a line that is never silent.
        for _ in 0..received.waiting() {
            if let Some(byte) = received.byte() {
                end.receive(byte, &mut line);
            }
        }
        end.lost(received.lost());
        if let Some(missed) = ticks.take() {
            end.tick(missed, &mut line);
        }
        // An interrupt between question and sleep is not served before the end of the section, but ends the sleep.
        cortex_m::interrupt::free(|_| {
            if received.waiting() == 0 && !ticks.is_due() {
                wfi();
            }
        });
    }
}

/// The plant, its sensors in the order of the scene.
fn plant() -> Option<End> {
    let plant = Plant::new(&CART_PENDULUM_F32, Leapfrog, CART_PENDULUM_STEP).ok()?;
    let sensors = [
        CART_PENDULUM_READOUT_CART_POINT_F32,
        CART_PENDULUM_READOUT_CART_VELOCITY_F32,
        CART_PENDULUM_READOUT_ANGLE_F32,
        CART_PENDULUM_READOUT_RATE_F32,
    ];
    let plant = KernelPlant::new(plant, "cart-pendulum", [CART_PENDULUM_INPUT_DRIVE], sensors);
    PlantEnd::new(plant, PERIOD)
}
