//! The quadrature counter LS7366R: an incremental encoder's counts, up to 32 bits, over SPI.
//!
//! `(counts, instruction bytes) => bytes`. According to LSI/CSI, LS7366R 32-Bit Quadrature Counter With Serial
//! Interface, 2009: an instruction specifies an operation (clear, read, write, load) and a register; one to four data
//! bytes, most significant first, as set in MDR1, follow within the same chip select. Quadrature modes, counter width,
//! enable and the transfers between counter, data and output register are implemented; index, compare and modulo modes
//! are stored without effect.

use crate::encoder::Counting;
use crate::fault::{Fault, WiringError};
use crate::machine::Machine;
use crate::part::{Link, Linked, Part, Wires};
use crate::spi::SpiPart;

/// Registers, encoded in bits 5 to 3 of an instruction.
const MDR0: u8 = 1;
const MDR1: u8 = 2;
const DTR: u8 = 3;
const CNTR: u8 = 4;
const OTR: u8 = 5;
const STR: u8 = 6;

/// Operations, encoded in bits 7 and 6.
const CLEAR: u8 = 0;
const READ: u8 = 1;
const WRITE: u8 = 2;

/// Bit of MDR1: counting is disabled.
const DISABLED: u8 = 1 << 2;
/// Bits of STR: powered up and not cleared since; counting is enabled; counting up; negative.
const POWER_LOSS: u8 = 1 << 2;
const ENABLED: u8 = 1 << 3;
const UP: u8 = 1 << 1;
const NEGATIVE: u8 = 1;

/// The counter behind an encoder.
#[derive(Clone, Debug)]
pub struct Ls7366r<E> {
    encoder: E,
    modes: [u8; 2],
    data: u32,
    output: u32,
    /// The present count, and the encoder's count at that time.
    counter: u32,
    seen: Option<i32>,
    up: bool,
    power_loss: bool,
    selected: bool,
    instruction: Option<u8>,
    shifted: u32,
}

impl<E: Counting> Ls7366r<E> {
    /// The chip at an encoder's pins A and B, four counts per period.
    #[must_use]
    pub fn new(encoder: E) -> Self {
        Self {
            encoder,
            modes: [0; 2],
            data: 0,
            output: 0,
            counter: 0,
            seen: None,
            up: true,
            power_loss: true,
            selected: false,
            instruction: None,
            shifted: 0,
        }
    }

    /// Shift of a count in bits: 0 with four counts per period, 2 with one; without quadrature the pulses of A, one per
    /// period, are counted.
    fn coarse(&self) -> u32 {
        match self.modes[0] & 3 {
            3 => 0,
            2 => 1,
            _ => 2,
        }
    }

    /// Bits of the counter and of data.
    fn width(&self) -> u32 {
        32 - 8 * u32::from(self.modes[1] & 3)
    }

    fn mask(&self) -> u32 {
        u32::MAX >> (32 - self.width())
    }

    /// Adds the encoder's counts since the last call.
    fn count(&mut self) {
        let now = self.encoder.counts();
        // Counts from 0 at power-up, at any shaft angle.
        let seen = self.seen.replace(now).unwrap_or(now);
        let steps = (now >> self.coarse()).wrapping_sub(seen >> self.coarse());
        if steps != 0 && self.modes[1] & DISABLED == 0 {
            self.up = steps > 0;
            self.counter = self.counter.wrapping_add(steps as u32) & self.mask();
        }
    }

    fn status(&self) -> u8 {
        let sign = self.counter >> (self.width() - 1) & 1 != 0;
        let bit = |is: bool, bit: u8| if is { bit } else { 0 };
        bit(self.power_loss, POWER_LOSS)
            | bit(self.modes[1] & DISABLED == 0, ENABLED)
            | bit(self.up, UP)
            | bit(sign, NEGATIVE)
    }

    /// Executes the part of an instruction before its data.
    fn begin(&mut self, instruction: u8) {
        let register = instruction >> 3 & 7;
        match (instruction >> 6, register) {
            (CLEAR, MDR0) => self.modes[0] = 0,
            (CLEAR, MDR1) => self.modes[1] = 0,
            (CLEAR, CNTR) => self.counter = 0,
            (CLEAR, STR) => self.power_loss = false,
            (READ, MDR0) => self.shifted = self.shift(self.modes[0]),
            (READ, MDR1) => self.shifted = self.shift(self.modes[1]),
            (READ, STR) => self.shifted = self.shift(self.status()),
            (READ, CNTR) => {
                self.output = self.counter;
                self.shifted = self.output << (32 - self.width());
            }
            (READ, OTR) => self.shifted = self.output << (32 - self.width()),
            (WRITE, DTR) => self.data = 0,
            (3, CNTR) => self.counter = self.data & self.mask(),
            (3, OTR) => self.output = self.counter,
            _ => {}
        }
    }

    /// A byte, most significant first.
    fn shift(&self, byte: u8) -> u32 {
        u32::from(byte) << 24
    }

    /// A byte of an instruction's data.
    fn byte(&mut self, instruction: u8, byte: u8) {
        match (instruction >> 6, instruction >> 3 & 7) {
            (WRITE, MDR0) => self.modes[0] = byte,
            (WRITE, MDR1) => {
                self.modes[1] = byte;
                self.counter &= self.mask();
            }
            (WRITE, DTR) => self.data = (self.data << 8 | u32::from(byte)) & self.mask(),
            _ => {}
        }
    }
}

impl<E: Counting> SpiPart for Ls7366r<E> {
    fn select(&mut self) {
        self.selected = true;
        self.instruction = None;
        self.shifted = 0;
    }

    fn exchange(&mut self, byte: u8) -> u8 {
        match self.instruction {
            None => {
                self.instruction = Some(byte);
                self.count();
                self.begin(byte);
                0
            }
            Some(instruction) => {
                self.byte(instruction, byte);
                let out = (self.shifted >> 24) as u8;
                self.shifted <<= 8;
                out
            }
        }
    }

    fn release(&mut self) {
        self.selected = false;
    }

    fn is_selected(&self) -> bool {
        self.selected
    }
}

impl<E: Counting> Linked for Ls7366r<E> {
    fn name(&self) -> &'static str {
        self.encoder.name()
    }
    fn link(&self) -> Link {
        self.encoder.link()
    }
}

impl<M: Machine, E: Counting + Part<M>> Part<M> for Ls7366r<E> {
    fn wire(&mut self, wires: &mut Wires<'_, M>) -> Result<(), WiringError> {
        self.encoder.wire(wires)
    }

    #[inline]
    fn drive(&mut self, machine: &mut M) -> Result<(), Fault> {
        self.encoder.drive(machine)
    }

    #[inline]
    fn sense(&mut self, machine: &M) -> Result<(), Fault> {
        self.encoder.sense(machine)?;
        // Counting continues while enabled, regardless of reads.
        self.count();
        Ok(())
    }

    fn stop(&mut self, fault: Fault) {
        self.encoder.stop(fault);
    }
}
