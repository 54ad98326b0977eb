//! The CMSDK UART: one byte of buffer each way, no interrupts.
//!
//! Implements embedded-io's `Read`, `Write`, `ReadReady` and `WriteReady`. A byte that arrives
//! before the last one was read is lost and reported once as an error.

use embedded_io::{Error, ErrorKind, ErrorType, Read, ReadReady, Write, WriteReady};

use super::addresses::CLOCK_HZ;
use super::addresses::uart::{
    BAUD_DIVISOR, BAUD_DIVISOR_MIN, CTRL, CTRL_RX_ENABLE, CTRL_TX_ENABLE, DATA, STATE,
    STATE_RX_FULL, STATE_RX_OVERRUN, STATE_TX_FULL,
};
use super::registers::Registers;

/// A UART.
#[derive(Debug)]
pub struct Uart<R> {
    registers: R,
}

/// A received byte was lost: it was not read in time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Overrun;

impl core::fmt::Display for Overrun {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str("a received byte was lost")
    }
}

impl core::error::Error for Overrun {}

impl Error for Overrun {
    fn kind(&self) -> ErrorKind {
        ErrorKind::Other
    }
}

/// Clock over bit rate \[1/s\].
fn divisor(bit_rate: u32) -> u32 {
    (CLOCK_HZ / bit_rate.max(1)).max(BAUD_DIVISOR_MIN)
}

impl<R: Registers> Uart<R> {
    /// Switches both directions on at a bit rate \[1/s\], the nearest below the clock over 16.
    pub fn new(mut registers: R, bit_rate: u32) -> Self {
        registers.write(BAUD_DIVISOR, divisor(bit_rate));
        registers.write(CTRL, CTRL_TX_ENABLE | CTRL_RX_ENABLE);
        Self { registers }
    }

    /// Changes the bit rate \[1/s\].
    pub fn set_bit_rate(&mut self, bit_rate: u32) {
        self.registers.write(BAUD_DIVISOR, divisor(bit_rate));
    }

    /// Its registers, for another use.
    pub fn release(self) -> R {
        self.registers
    }

    fn state(&self, bit: u32) -> bool {
        self.registers.read(STATE) & bit != 0
    }
}

impl<R: Registers> ErrorType for Uart<R> {
    type Error = Overrun;
}

impl<R: Registers> Read for Uart<R> {
    fn read(&mut self, buf: &mut [u8]) -> Result<usize, Overrun> {
        if buf.is_empty() {
            return Ok(0);
        }
        while !self.state(STATE_RX_FULL) {
            core::hint::spin_loop();
        }
        if self.state(STATE_RX_OVERRUN) {
            self.registers.write(STATE, STATE_RX_OVERRUN);
            return Err(Overrun);
        }
        let mut count = 0;
        for byte in buf {
            if count > 0 && !self.state(STATE_RX_FULL) {
                break;
            }
            *byte = self.registers.read(DATA) as u8;
            count += 1;
        }
        Ok(count)
    }
}

impl<R: Registers> ReadReady for Uart<R> {
    fn read_ready(&mut self) -> Result<bool, Overrun> {
        Ok(self.state(STATE_RX_FULL))
    }
}

impl<R: Registers> Write for Uart<R> {
    fn write(&mut self, buf: &[u8]) -> Result<usize, Overrun> {
        let Some(&byte) = buf.first() else {
            return Ok(0);
        };
        while self.state(STATE_TX_FULL) {
            core::hint::spin_loop();
        }
        self.registers.write(DATA, u32::from(byte));
        Ok(1)
    }

    fn flush(&mut self) -> Result<(), Overrun> {
        while self.state(STATE_TX_FULL) {
            core::hint::spin_loop();
        }
        Ok(())
    }
}

impl<R: Registers> WriteReady for Uart<R> {
    fn write_ready(&mut self) -> Result<bool, Overrun> {
        Ok(!self.state(STATE_TX_FULL))
    }
}

#[cfg(test)]
mod tests {
    use std::cell::RefCell;
    use std::collections::VecDeque;

    use super::*;

    /// A UART whose line returns what was sent.
    #[derive(Default)]
    struct Loopback {
        line: RefCell<VecDeque<u8>>,
        divisor: u32,
        control: u32,
        overrun: bool,
    }

    impl Registers for Loopback {
        fn read(&self, offset: usize) -> u32 {
            match offset {
                DATA => u32::from(self.line.borrow_mut().pop_front().unwrap_or(0)),
                STATE => {
                    let waiting = !self.line.borrow().is_empty();
                    u32::from(waiting) * STATE_RX_FULL + u32::from(self.overrun) * STATE_RX_OVERRUN
                }
                _ => panic!("register {offset:#x} is not read"),
            }
        }

        fn write(&mut self, offset: usize, value: u32) {
            match offset {
                DATA => self.line.borrow_mut().push_back(value as u8),
                STATE => self.overrun &= value & STATE_RX_OVERRUN == 0,
                CTRL => self.control = value,
                BAUD_DIVISOR => self.divisor = value,
                _ => panic!("register {offset:#x} is not written"),
            }
        }
    }

    #[test]
    fn set_up_follows_the_manual() {
        let uart = Uart::new(Loopback::default(), 115_200);
        assert_eq!((uart.registers.divisor, uart.registers.control), (217, 3));
        let mut uart = Uart::new(Loopback::default(), u32::MAX);
        assert_eq!(uart.registers.divisor, 16);
        uart.set_bit_rate(921_600);
        assert_eq!(uart.release().divisor, 27);
    }

    #[test]
    fn bytes_return_in_order() {
        let mut uart = Uart::new(Loopback::default(), 115_200);
        assert_eq!(uart.read_ready(), Ok(false));
        uart.write_all(b"plant").unwrap();
        uart.flush().unwrap();
        assert_eq!((uart.read_ready(), uart.write_ready()), (Ok(true), Ok(true)));
        let mut buf = [0; 8];
        assert_eq!(uart.read(&mut buf), Ok(5));
        assert_eq!(&buf[..5], b"plant");
    }

    #[test]
    fn a_lost_byte_is_reported_once() {
        let mut uart = Uart::new(Loopback { overrun: true, ..Loopback::default() }, 115_200);
        uart.write_all(b"x").unwrap();
        let mut buf = [0];
        assert_eq!(uart.read(&mut buf), Err(Overrun));
        assert_eq!((uart.read(&mut buf), buf), (Ok(1), *b"x"));
    }
}
