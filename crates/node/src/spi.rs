//! SPI: a part behind chip select, for drivers of a device and of a bus.
//!
//! `bytes of the driver => bytes of the part`. A transaction of `SpiDevice` is one chip select. A driver with `SpiBus`
//! and a pin uses [`SpiWires`] and [`ChipSelect`]; without a selected part the bus reads all ones. Words of 16 bits are
//! sent high byte first. Transfers take no time, and delays within a transaction do not advance time.

use embedded_hal::digital::{ErrorType as PinErrorType, OutputPin};
use embedded_hal::spi::{ErrorType, Operation, SpiBus, SpiDevice};

use crate::fault::{Fault, WiringError};
use crate::part::{Linked, fix};
use crate::share::Shared;

/// A part that speaks SPI, byte by byte.
pub trait SpiPart: Linked {
    /// Chip select goes low.
    fn select(&mut self);
    /// A byte goes in while another comes out.
    fn exchange(&mut self, byte: u8) -> u8;
    /// Chip select goes high.
    fn release(&mut self);
    /// Whether chip select is low.
    fn is_selected(&self) -> bool;
}

/// The byte sent while the driver only reads.
const IDLE: u8 = 0;
/// The byte read if no part answers.
const NOTHING: u8 = 0xff;

/// A part as an `SpiDevice` of words of 8 or 16 bits.
#[derive(Clone, Copy, Debug)]
pub struct SpiEnd<C>(C);

impl<C: Shared<Part: SpiPart>> SpiEnd<C> {
    /// The port of a part.
    ///
    /// # Errors
    /// [`WiringError`] if no node steps it.
    pub fn new(cell: C) -> Result<Self, WiringError> {
        fix(&cell)?;
        Ok(Self(cell))
    }
}

impl<C> ErrorType for SpiEnd<C> {
    type Error = Fault;
}

/// A word as bytes on the wire.
trait WireWord: Copy + Default + 'static {
    /// Sends it and returns the answer.
    fn exchange(self, wire: impl FnMut(u8) -> u8) -> Self;
    /// Nothing to send.
    const IDLE: Self;
}

impl WireWord for u8 {
    const IDLE: u8 = IDLE;
    #[inline]
    fn exchange(self, mut wire: impl FnMut(u8) -> u8) -> u8 {
        wire(self)
    }
}

impl WireWord for u16 {
    const IDLE: u16 = 0;
    #[inline]
    fn exchange(self, mut wire: impl FnMut(u8) -> u8) -> u16 {
        let high = wire((self >> 8) as u8);
        u16::from(high) << 8 | u16::from(wire(self as u8))
    }
}

/// Fills a buffer with read words.
fn read<W: WireWord>(words: &mut [W], mut wire: impl FnMut(u8) -> u8) {
    for word in words {
        *word = W::IDLE.exchange(&mut wire);
    }
}

fn write<W: WireWord>(words: &[W], mut wire: impl FnMut(u8) -> u8) {
    for &word in words {
        word.exchange(&mut wire);
    }
}

/// As long as the longer of the two.
fn transfer<W: WireWord>(read: &mut [W], write: &[W], mut wire: impl FnMut(u8) -> u8) {
    for i in 0..read.len().max(write.len()) {
        let sent = write.get(i).copied().unwrap_or(W::IDLE);
        let seen = sent.exchange(&mut wire);
        if let Some(place) = read.get_mut(i) {
            *place = seen;
        }
    }
}

fn transfer_in_place<W: WireWord>(words: &mut [W], mut wire: impl FnMut(u8) -> u8) {
    for word in words {
        *word = word.exchange(&mut wire);
    }
}

macro_rules! device {
    ($word:ty) => {
        impl<C: Shared<Part: SpiPart>> SpiDevice<$word> for SpiEnd<C> {
            fn transaction(
                &mut self,
                operations: &mut [Operation<'_, $word>],
            ) -> Result<(), Fault> {
                self.0.with(|part| {
                    part.link().check()?;
                    part.select();
                    for operation in operations {
                        let wire = |byte| part.exchange(byte);
                        match operation {
                            Operation::Read(words) => read(words, wire),
                            Operation::Write(words) => write(words, wire),
                            Operation::Transfer(seen, sent) => transfer(seen, sent, wire),
                            Operation::TransferInPlace(words) => transfer_in_place(words, wire),
                            Operation::DelayNs(_) => {}
                        }
                    }
                    part.release();
                    Ok(())
                })?
            }
        }
    };
}

device!(u8);
device!(u16);

/// Devices on a bus: a part in its cell, or several in a tuple.
pub trait OnSpi {
    /// Exchanges a byte with the selected part, if any.
    ///
    /// # Errors
    /// [`Fault`] if a part is in use elsewhere or stopped.
    fn exchange(&self, byte: u8) -> Result<Option<u8>, Fault>;
}

impl<C: Shared<Part: SpiPart>> OnSpi for C {
    #[inline]
    fn exchange(&self, byte: u8) -> Result<Option<u8>, Fault> {
        self.with(|part| {
            if part.is_selected() {
                part.link().check()?;
                Ok(Some(part.exchange(byte)))
            } else {
                Ok(None)
            }
        })?
    }
}

/// Two or more devices on the same bus; nest tuples for more than four.
macro_rules! on_spi {
    ($($thing:ident)*) => {
        #[allow(non_snake_case)]
        impl<$($thing: OnSpi),*> OnSpi for ($($thing,)*) {
            fn exchange(&self, byte: u8) -> Result<Option<u8>, Fault> {
                let ($($thing,)*) = self;
                let mut answer = None;
                $(answer = answer.or($thing.exchange(byte)?);)*
                Ok(answer)
            }
        }
    };
}

on_spi!(A B);
on_spi!(A B C);
on_spi!(A B C D);

/// The bus as an `SpiBus` of bytes.
#[derive(Clone, Copy, Debug)]
pub struct SpiWires<T>(T);

impl<T: OnSpi> SpiWires<T> {
    /// The bus of a part in its cell, or of a tuple of them.
    pub const fn new(parts: T) -> Self {
        Self(parts)
    }

    fn begin(&self) -> Exchange<'_, T> {
        Exchange { parts: &self.0, fault: None }
    }
}

/// Exchanges bytes until a part refuses.
struct Exchange<'w, T> {
    parts: &'w T,
    fault: Option<Fault>,
}

impl<T: OnSpi> Exchange<'_, T> {
    fn byte(&mut self, byte: u8) -> u8 {
        match self.parts.exchange(byte) {
            Ok(answer) => answer.unwrap_or(NOTHING),
            Err(fault) => {
                self.fault = Some(fault);
                NOTHING
            }
        }
    }

    fn end(self) -> Result<(), Fault> {
        self.fault.map_or(Ok(()), Err)
    }
}

impl<T> ErrorType for SpiWires<T> {
    type Error = Fault;
}

impl<T: OnSpi> SpiBus for SpiWires<T> {
    fn read(&mut self, words: &mut [u8]) -> Result<(), Fault> {
        let mut wires = self.begin();
        read(words, |byte| wires.byte(byte));
        wires.end()
    }
    fn write(&mut self, words: &[u8]) -> Result<(), Fault> {
        let mut wires = self.begin();
        write(words, |byte| wires.byte(byte));
        wires.end()
    }
    fn transfer(&mut self, seen: &mut [u8], sent: &[u8]) -> Result<(), Fault> {
        let mut wires = self.begin();
        transfer(seen, sent, |byte| wires.byte(byte));
        wires.end()
    }
    fn transfer_in_place(&mut self, words: &mut [u8]) -> Result<(), Fault> {
        let mut wires = self.begin();
        transfer_in_place(words, |byte| wires.byte(byte));
        wires.end()
    }
    fn flush(&mut self) -> Result<(), Fault> {
        Ok(())
    }
}

/// The chip select of a part, active low.
#[derive(Clone, Copy, Debug)]
pub struct ChipSelect<C>(C);

impl<C: Shared<Part: SpiPart>> ChipSelect<C> {
    /// The pin of a part.
    ///
    /// # Errors
    /// [`WiringError`] if no node steps it.
    pub fn new(cell: C) -> Result<Self, WiringError> {
        fix(&cell)?;
        Ok(Self(cell))
    }
}

impl<C> PinErrorType for ChipSelect<C> {
    type Error = Fault;
}

impl<C: Shared<Part: SpiPart>> OutputPin for ChipSelect<C> {
    fn set_low(&mut self) -> Result<(), Fault> {
        self.0.with(|part| part.select())
    }
    fn set_high(&mut self) -> Result<(), Fault> {
        self.0.with(|part| part.release())
    }
}
