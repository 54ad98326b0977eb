//! The board's interrupts: timer 1 counts ticks that are due, UART 0 moves bytes.

use core::cell::RefCell;
use core::sync::atomic::Ordering;

use cortex_m::interrupt::{InterruptNumber, Mutex, free};
use cortex_m::peripheral::NVIC;
use cortex_m::{asm, singleton};
use cortex_m_rt::exception;

use super::addresses::timer::INTERRUPT_CLEAR;
use super::addresses::{TIMER1, TIMER1_INTERRUPT, UART0_RX_INTERRUPT, UART0_TX_INTERRUPT};
use super::registers::{Mapped, Registers as _};
use super::serial::{self, Bytes, Handler, LOST, Receiver, Sender};
use super::ticks::{DUE, Ticks};
use super::timer::Timer;
use super::uart::Uart;
use crate::console::exit;

/// The interrupts by their numbers in the controller.
#[derive(Clone, Copy)]
#[repr(u16)]
enum Interrupt {
    UartReceived = UART0_RX_INTERRUPT,
    UartSent = UART0_TX_INTERRUPT,
    Timer1 = TIMER1_INTERRUPT,
}

// The numbers are those of the board, fixed and unique, as the trait requires.
#[allow(unsafe_code)]
// SAFETY: as said.
unsafe impl InterruptNumber for Interrupt {
    fn number(self) -> u16 {
        self as u16
    }
}

/// The handler of the UART, once it is used by interrupts.
static SERIAL: Mutex<RefCell<Option<Handler<'static, Mapped>>>> = Mutex::new(RefCell::new(None));

impl Timer<Mapped> {
    /// Ticks every `period` microseconds from now on; the timer is timer 1.
    // Unmasking could break a critical section by masks; nothing here uses one.
    #[allow(unsafe_code)]
    #[must_use]
    pub fn into_ticks(self, period: u32) -> Ticks<'static, Mapped> {
        let ticks = Ticks::start(self.release(), period, &DUE);
        // SAFETY: what the interrupt shares is atomic.
        unsafe { NVIC::unmask(Interrupt::Timer1) };
        ticks
    }
}

impl Uart<Mapped> {
    /// The same UART by interrupts, with queues; its bit rate \[1/s\] the nearest below the clock over 16.
    ///
    /// # Panics
    /// The second time, which cannot be: the board has one of them.
    // Unmasking could break a critical section by masks; nothing here uses one.
    #[allow(unsafe_code)]
    #[must_use]
    pub fn into_serial(mut self, bit_rate: u32) -> (Receiver<'static>, Sender<'static>) {
        self.set_bit_rate(bit_rate);
        let received = singleton!(: Bytes = Bytes::new()).expect("the first time");
        let to_send = singleton!(: Bytes = Bytes::new()).expect("the first time");
        let start = || NVIC::pend(Interrupt::UartSent);
        let (handler, receiver, sender) =
            serial::split(self.release(), [received, to_send], &LOST, start);
        free(|section| SERIAL.borrow(section).replace(Some(handler)));
        // SAFETY: what the interrupts share are queues with one end each, behind a critical section, and an atomic.
        unsafe {
            NVIC::unmask(Interrupt::UartReceived);
            NVIC::unmask(Interrupt::UartSent);
        }
        // A byte that was received before interrupted nobody, and no further one comes while it waits.
        start();
        (receiver, sender)
    }
}

/// Sleeps until an interrupt, unless there is work: an interrupt between the question and the sleep ends the
/// sleep at once.
pub fn sleep_unless(is_work: impl FnOnce() -> bool) {
    // A masked interrupt is not served before the end of the section, but wakes the core.
    free(|_| {
        if !is_work() {
            asm::wfi();
        }
    });
}

// The runtime calls it from an exception, which its attribute makes unsafe to declare.
#[allow(unsafe_code)]
#[exception]
unsafe fn DefaultHandler(number: i16) {
    match u16::try_from(number) {
        Ok(TIMER1_INTERRUPT) => {
            Mapped::at(TIMER1).write(INTERRUPT_CLEAR, 1);
            // Nothing else counts, so it may be two operations.
            DUE.store(DUE.load(Ordering::Relaxed).wrapping_add(1), Ordering::Relaxed);
        }
        Ok(UART0_RX_INTERRUPT | UART0_TX_INTERRUPT) => free(|section| {
            if let Some(serial) = SERIAL.borrow(section).borrow_mut().as_mut() {
                serial.serve();
            }
        }),
        _ => {
            defmt::error!("unexpected interrupt {=i16}", number);
            exit(false);
        }
    }
}
