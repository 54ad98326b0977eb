//! The CMSDK UART by interrupts, with a queue in each direction.
//!
//! `received bytes => queue => Receiver; Sender => queue => sent bytes`. After the start the interrupt's handler
//! alone touches the registers, and it moves bytes only. A byte that finds its queue full is lost and
//! counted, as is one that the UART itself lost.

use core::sync::atomic::{AtomicU32, Ordering};

use heapless::spsc::{Consumer, Producer, Queue};

use super::addresses::uart::{
    CTRL, CTRL_RX_ENABLE, CTRL_RX_INTERRUPT, CTRL_TX_ENABLE, CTRL_TX_INTERRUPT, DATA,
    INTERRUPT_CLEAR, INTERRUPT_RX, INTERRUPT_TX, STATE, STATE_RX_FULL, STATE_RX_OVERRUN,
    STATE_TX_FULL,
};
use super::registers::Registers;

/// \[bytes\] of each queue, one of which stays free.
pub const QUEUE: usize = 4096;

/// A queue of bytes.
pub type Bytes = Queue<u8, QUEUE>;

/// Received bytes that were lost since the start. The interrupt counts them up, nothing else does.
pub static LOST: AtomicU32 = AtomicU32::new(0);

/// The interrupt handler.
pub struct Handler<'q, R> {
    registers: R,
    received: Producer<'q, u8>,
    to_send: Consumer<'q, u8>,
    lost: &'q AtomicU32,
}

/// Takes received bytes.
pub struct Receiver<'q> {
    bytes: Consumer<'q, u8>,
    lost: &'q AtomicU32,
    reported: u32,
}

/// Sends bytes.
pub struct Sender<'q> {
    bytes: Producer<'q, u8>,
    /// Makes the interrupt's handler run.
    start: fn(),
}

/// Switches both directions and their interrupts on. `start` makes the handler run; `lost` is what it counts up.
pub fn split<'q, R: Registers>(
    mut registers: R,
    [received, to_send]: [&'q mut Bytes; 2],
    lost: &'q AtomicU32,
    start: fn(),
) -> (Handler<'q, R>, Receiver<'q>, Sender<'q>) {
    let (received, received_end) = received.split();
    let (to_send_end, to_send) = to_send.split();
    registers.write(CTRL, CTRL_TX_ENABLE | CTRL_RX_ENABLE | CTRL_TX_INTERRUPT | CTRL_RX_INTERRUPT);
    let reported = lost.load(Ordering::Relaxed);
    (
        Handler { registers, received, to_send, lost },
        Receiver { bytes: received_end, lost, reported },
        Sender { bytes: to_send_end, start },
    )
}

impl<R: Registers> Handler<'_, R> {
    /// Moves bytes until neither direction can go on.
    pub fn serve(&mut self) {
        // Before reading the state: later events interrupt again.
        self.registers.write(INTERRUPT_CLEAR, INTERRUPT_TX | INTERRUPT_RX);
        loop {
            let state = self.registers.read(STATE);
            if state & STATE_RX_OVERRUN != 0 {
                self.registers.write(STATE, STATE_RX_OVERRUN);
                self.lose();
            }
            if state & STATE_RX_FULL != 0 {
                let byte = self.registers.read(DATA) as u8;
                if self.received.enqueue(byte).is_err() {
                    self.lose();
                }
            }
            let sent = if state & STATE_TX_FULL == 0 { self.to_send.dequeue() } else { None };
            if let Some(byte) = sent {
                self.registers.write(DATA, u32::from(byte));
            } else if state & STATE_RX_FULL == 0 {
                return;
            }
        }
    }

    fn lose(&self) {
        self.lost.fetch_add(1, Ordering::Relaxed);
    }
}

impl Receiver<'_> {
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
        let lost = self.lost.load(Ordering::Relaxed);
        lost.wrapping_sub(core::mem::replace(&mut self.reported, lost))
    }
}

impl Sender<'_> {
    /// Puts all bytes into the queue, or none if there is no room for all; returns whether there was.
    pub fn send(&mut self, bytes: &[u8]) -> bool {
        let room = self.bytes.capacity() - self.bytes.len();
        if bytes.len() > room {
            return false;
        }
        // There is room, and nobody else fills the queue.
        bytes.iter().for_each(|byte| _ = self.bytes.enqueue(*byte));
        (self.start)();
        true
    }

    /// Whether the UART has taken all bytes.
    pub fn is_done(&self) -> bool {
        self.bytes.is_empty()
    }
}

#[cfg(test)]
mod tests {
    use std::cell::RefCell;
    use std::collections::VecDeque;

    use super::*;

    /// A UART that sends as many bytes as `room`, and receives those of `line`.
    #[derive(Default)]
    struct Wire {
        line: RefCell<VecDeque<u8>>,
        sent: Vec<u8>,
        room: usize,
        control: u32,
        cleared: u32,
        overrun: bool,
    }

    impl Registers for Wire {
        fn read(&self, offset: usize) -> u32 {
            match offset {
                DATA => u32::from(self.line.borrow_mut().pop_front().expect("a byte is there")),
                STATE => {
                    let waiting = !self.line.borrow().is_empty();
                    u32::from(waiting) * STATE_RX_FULL
                        + u32::from(self.room == 0) * STATE_TX_FULL
                        + u32::from(self.overrun) * STATE_RX_OVERRUN
                }
                _ => panic!("register {offset:#x} is not read"),
            }
        }

        fn write(&mut self, offset: usize, value: u32) {
            match offset {
                DATA => {
                    self.room = self.room.checked_sub(1).expect("the buffer is free");
                    self.sent.push(value as u8);
                }
                STATE => self.overrun &= value & STATE_RX_OVERRUN == 0,
                CTRL => self.control = value,
                INTERRUPT_CLEAR => self.cleared |= value,
                _ => panic!("register {offset:#x} is not written"),
            }
        }
    }

    #[test]
    fn bytes_pass_both_ways_in_order() {
        let (mut received, mut to_send) = (Bytes::new(), Bytes::new());
        let lost = AtomicU32::new(0);
        let (mut handler, mut receiver, mut sender) =
            split(Wire::default(), [&mut received, &mut to_send], &lost, || ());
        assert_eq!(handler.registers.control, 0b1111);
        handler.registers.line.borrow_mut().extend(b"plant");
        assert!(sender.send(b"controller"));
        handler.registers.room = 3;
        handler.serve();
        assert_eq!((handler.registers.cleared, &handler.registers.sent[..]), (3, &b"con"[..]));
        assert!(!sender.is_done());
        handler.registers.room = 100;
        handler.serve();
        assert_eq!((sender.is_done(), &handler.registers.sent[..]), (true, &b"controller"[..]));
        assert_eq!(receiver.waiting(), 5);
        let bytes: Vec<u8> = std::iter::from_fn(|| receiver.byte()).collect();
        assert_eq!((&bytes[..], receiver.lost()), (&b"plant"[..], 0));
    }

    #[test]
    fn lost_bytes_are_counted_once() {
        let (mut received, mut to_send) = (Bytes::new(), Bytes::new());
        let lost = AtomicU32::new(u32::MAX);
        let wire = Wire { overrun: true, ..Wire::default() };
        let (mut handler, mut receiver, _) =
            split(wire, [&mut received, &mut to_send], &lost, || ());
        handler.registers.line.borrow_mut().extend([7; QUEUE + 1]);
        handler.serve();
        // One in the UART, two at the full queue.
        assert_eq!((receiver.lost(), receiver.lost()), (3, 0));
        assert_eq!(receiver.waiting(), QUEUE - 1);
    }

    #[test]
    fn a_frame_without_room_is_dropped_whole() {
        let (mut received, mut to_send) = (Bytes::new(), Bytes::new());
        let lost = AtomicU32::new(0);
        let (mut handler, _, mut sender) =
            split(Wire::default(), [&mut received, &mut to_send], &lost, || ());
        assert!(sender.send(&[1; QUEUE - 2]));
        assert!(!sender.send(&[2; 2]));
        assert!(sender.send(&[3]));
        handler.registers.room = 2 * QUEUE;
        handler.serve();
        assert_eq!(handler.registers.sent, [&[1; QUEUE - 2][..], &[3]].concat());
    }
}
