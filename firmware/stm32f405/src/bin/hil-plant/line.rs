//! USART2 by its interrupt, with a queue in each direction.

use core::cell::RefCell;
use core::sync::atomic::{AtomicU32, Ordering};

use cortex_m::interrupt::{Mutex, free};
use cortex_m::peripheral::{DWT, NVIC};
use cortex_m::singleton;
use heapless::spsc::{Consumer, Producer, Queue};
use stm32f4xx_hal::nb;
use stm32f4xx_hal::pac::{Interrupt, USART2, interrupt};
use stm32f4xx_hal::prelude::*;
use stm32f4xx_hal::serial::{Rx, Tx};

/// [bytes] of each queue, one of which stays free.
const QUEUE: usize = 2048;

/// What the interrupt uses.
static HANDLER: Mutex<RefCell<Option<Handler>>> = Mutex::new(RefCell::new(None));
/// Received bytes that were lost since the start: errors of the line, and those that found the queue full.
static LOST: AtomicU32 = AtomicU32::new(0);

struct Handler {
    tx: Tx<USART2>,
    rx: Rx<USART2>,
    received: Producer<'static, u8>,
    to_send: Consumer<'static, u8>,
}

/// Takes received bytes.
pub struct Received {
    bytes: Consumer<'static, u8>,
    reported: u32,
}

/// Sends frames.
pub struct Line {
    bytes: Producer<'static, u8>,
}

/// Starts to receive.
pub fn start(tx: Tx<USART2>, mut rx: Rx<USART2>) -> (Line, Received) {
    let received = singleton!(: Queue<u8, QUEUE> = Queue::new()).expect("it is started once");
    let to_send = singleton!(: Queue<u8, QUEUE> = Queue::new()).expect("it is started once");
    let (received, bytes) = received.split();
    let (send, to_send) = to_send.split();
    rx.listen();
    free(|section| HANDLER.borrow(section).replace(Some(Handler { tx, rx, received, to_send })));
    // SAFETY: no code depends on its being masked.
    #[allow(unsafe_code)]
    unsafe {
        NVIC::unmask(Interrupt::USART2);
    }
    (Line { bytes: send }, Received { bytes, reported: 0 })
}

impl Received {
    /// The next byte, if there is one.
    pub fn byte(&mut self) -> Option<u8> {
        self.bytes.dequeue()
    }

    /// Bytes that wait.
    pub fn waiting(&self) -> usize {
        self.bytes.len()
    }

    /// Bytes that were lost since this was asked last.
    pub fn lost(&mut self) -> u32 {
        let lost = LOST.load(Ordering::Relaxed);
        lost.wrapping_sub(core::mem::replace(&mut self.reported, lost))
    }
}

impl dbd_link::Line for Line {
    fn send(&mut self, frame: &[u8]) {
        // A frame without room is lost whole, as it may be on the line.
        if frame.len() > self.bytes.capacity() - self.bytes.len() {
            return;
        }
        frame.iter().for_each(|byte| _ = self.bytes.enqueue(*byte));
        // The handler begins; QEMU's USART has no interrupt of an empty transmitter.
        NVIC::pend(Interrupt::USART2);
    }

    fn cycles(&self) -> u32 {
        DWT::cycle_count()
    }
}

impl Handler {
    /// Moves bytes until neither direction can go on.
    fn serve(&mut self) {
        loop {
            match self.rx.read() {
                Ok(byte) if self.received.enqueue(byte).is_ok() => {}
                Err(nb::Error::WouldBlock) => break,
                // The queue is full, or the line had an error.
                _ => _ = LOST.fetch_add(1, Ordering::Relaxed),
            }
        }
        while self.tx.is_tx_empty() {
            match self.to_send.dequeue() {
                Some(byte) => _ = self.tx.write(byte),
                // The interrupt would recur indefinitely.
                None => return self.tx.unlisten(),
            }
        }
        self.tx.listen();
    }
}

#[interrupt]
fn USART2() {
    free(|section| {
        if let Some(handler) = HANDLER.borrow(section).borrow_mut().as_mut() {
            handler.serve();
        }
    });
}
