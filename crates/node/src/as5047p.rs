//! The magnetic encoder AS5047P: an absolute angle of 14 bits over SPI.
//!
//! `(counts, frames) => frames`. According to the datasheet of ams, AS5047P v1-09, "SPI Interface" and "Volatile
//! Registers": frames of 16 bits, each delimited by chip select; even parity in bit 15; a command is answered in the
//! next frame; bit 14 of an answer indicates an error of the previous frame, which ERRFL stores until it is read.
//! Direction and zero position are implemented; one-time programming, field strength and the settings of the PWM and
//! ABI outputs are stored without effect.

use crate::encoder::Counting;
use crate::fault::{Fault, Problem, WiringError};
use crate::machine::Machine;
use crate::part::{Link, Linked, Part, Wires};
use crate::spi::SpiPart;

/// Counts per revolution.
pub const COUNTS: u32 = 16_384;

const NOP: u16 = 0x0000;
const ERRFL: u16 = 0x0001;
const PROG: u16 = 0x0003;
/// The first settings register: ZPOSM, ZPOSL, SETTINGS1, SETTINGS2.
const ZPOSM: u16 = 0x0016;
const DIAAGC: u16 = 0x3ffc;
const MAG: u16 = 0x3ffd;
const ANGLEUNC: u16 = 0x3ffe;
const ANGLECOM: u16 = 0x3fff;

const DATA: u16 = 0x3fff;
const READ: u16 = 1 << 14;
const ERROR: u16 = 1 << 14;
/// Bits of ERRFL: frame not of 16 bits, unknown register, odd parity.
const FRERR: u16 = 1;
const INVCOMM: u16 = 1 << 1;
const PARERR: u16 = 1 << 2;
/// Bit of SETTINGS1.
const DIR: u16 = 1 << 2;

/// An encoder of 16384 counts per turn behind the chip's registers.
#[derive(Clone, Debug)]
pub struct As5047p<E> {
    encoder: E,
    /// ZPOSM, ZPOSL, SETTINGS1, SETTINGS2.
    settings: [u16; 4],
    prog: u16,
    errors: u16,
    selected: bool,
    bytes: u8,
    incoming: u16,
    outgoing: u16,
    /// The register that the next frame writes.
    writing: Option<u16>,
}

impl<E: Counting> As5047p<E> {
    /// The chip on an encoder's shaft.
    #[must_use]
    pub fn new(encoder: E) -> Self {
        Self {
            encoder,
            settings: [0, 0, 1, 0],
            prog: 0,
            errors: 0,
            selected: false,
            bytes: 0,
            incoming: 0,
            outgoing: 0,
            writing: None,
        }
    }

    /// The displayed angle: 14 bits.
    pub fn angle(&self) -> u16 {
        let [zero_high, zero_low, settings, _] = self.settings;
        let zero = (zero_high & 0xff) << 6 | (zero_low & 0x3f);
        let angle = (self.encoder.counts() as u16).wrapping_sub(zero);
        (if settings & DIR == 0 { angle } else { angle.wrapping_neg() }) & DATA
    }

    fn read(&mut self, address: u16) -> Option<u16> {
        Some(match address {
            NOP => 0,
            ERRFL => core::mem::take(&mut self.errors),
            PROG => self.prog,
            // Offset compensation done, gain in the middle.
            DIAAGC => 0x0180,
            MAG => 0x1000,
            ANGLEUNC | ANGLECOM => self.angle(),
            _ => *self.settings.get(usize::from(address.wrapping_sub(ZPOSM)))?,
        })
    }

    fn write(&mut self, address: u16, data: u16) -> Option<()> {
        match address {
            PROG => self.prog = data,
            _ => *self.settings.get_mut(usize::from(address.wrapping_sub(ZPOSM)))? = data,
        }
        Some(())
    }

    /// Executes a complete frame; returns the answer of the next one.
    fn frame(&mut self, frame: u16) -> u16 {
        let data = frame & DATA;
        if !frame.count_ones().is_multiple_of(2) {
            self.errors |= PARERR;
            self.writing = None;
            return ERROR;
        }
        let answer = if let Some(address) = self.writing.take() {
            self.write(address, data).and_then(|()| self.read(address))
        } else if frame & READ == 0 {
            // A write is answered with the previous contents.
            let old = self.read_setting(data);
            self.writing = old.map(|_| data);
            old
        } else {
            self.read(data)
        };
        match answer {
            Some(data) => data & DATA,
            None => {
                self.errors |= INVCOMM;
                ERROR
            }
        }
    }

    /// A writable register; writing NOP has no effect.
    fn read_setting(&mut self, address: u16) -> Option<u16> {
        match address {
            ERRFL | DIAAGC | MAG | ANGLEUNC | ANGLECOM => None,
            _ => self.read(address),
        }
    }
}

/// The word with even parity in its highest bit.
const fn even(word: u16) -> u16 {
    word | (word.count_ones() as u16 & 1) << 15
}

impl<E: Counting> SpiPart for As5047p<E> {
    fn select(&mut self) {
        self.selected = true;
        self.bytes = 0;
        self.incoming = 0;
    }

    fn exchange(&mut self, byte: u8) -> u8 {
        let shown = match self.bytes {
            0 => self.outgoing >> 8,
            1 => self.outgoing & 0xff,
            _ => 0,
        };
        self.incoming = self.incoming << 8 | u16::from(byte);
        self.bytes = self.bytes.saturating_add(1);
        shown as u8
    }

    fn release(&mut self) {
        if !core::mem::take(&mut self.selected) || self.bytes == 0 {
            return;
        }
        let answer = if self.bytes == 2 {
            self.frame(self.incoming)
        } else {
            self.errors |= FRERR;
            self.writing = None;
            ERROR
        };
        self.outgoing = even(answer);
    }

    fn is_selected(&self) -> bool {
        self.selected
    }
}

impl<E: Counting> Linked for As5047p<E> {
    fn name(&self) -> &'static str {
        self.encoder.name()
    }
    fn link(&self) -> Link {
        self.encoder.link()
    }
}

/// The pins A, B and I of the same chip.
impl<E: Counting> Counting for As5047p<E> {
    fn counts(&self) -> i32 {
        self.encoder.counts()
    }
    fn counts_per_turn(&self) -> u32 {
        self.encoder.counts_per_turn()
    }
}

impl<M: Machine, E: Counting + Part<M>> Part<M> for As5047p<E> {
    fn wire(&mut self, wires: &mut Wires<'_, M>) -> Result<(), WiringError> {
        if self.encoder.counts_per_turn() != COUNTS {
            let problem = Problem::Parameter("the number of counts (fixed at 16384)");
            return Err(WiringError { name: self.encoder.name(), problem });
        }
        self.encoder.wire(wires)
    }

    #[inline]
    fn drive(&mut self, machine: &mut M) -> Result<(), Fault> {
        self.encoder.drive(machine)
    }

    #[inline]
    fn sense(&mut self, machine: &M) -> Result<(), Fault> {
        self.encoder.sense(machine)
    }

    fn stop(&mut self, fault: Fault) {
        self.encoder.stop(fault);
    }
}
