//! A driver of the magnetic encoder AS5047P, and its angle over all turns.
//!
//! `frames => angle of 14 bits => counts`. ams, AS5047P datasheet v1-09, "SPI Interface": a command is
//! answered in the next frame, so the angle of one tick is asked for in two.

use embedded_hal::spi::{Error as _, ErrorKind, SpiDevice};

/// Reads ANGLECOM: bit 14 says read, bit 15 makes the parity even.
const READ_ANGLE: [u8; 2] = [0xff, 0xff];
/// Reads NOP, to get the answer.
const NOP: [u8; 2] = [0xc0, 0x00];
/// Reads ERRFL, which clears it.
const READ_ERRORS: [u8; 2] = [0x40, 0x01];
/// Counts of a turn.
pub const COUNTS: i32 = 16_384;

/// Why there is no angle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ReadError {
    /// The bus failed.
    Bus(ErrorKind),
    /// The answer's parity is odd.
    Parity,
    /// The chip refused the frame before.
    Frame,
}

/// A shaft with an encoder on its end.
#[derive(Debug)]
pub struct Shaft<S> {
    spi: S,
    last: Option<u16>,
    counts: i32,
}

impl<S: SpiDevice> Shaft<S> {
    /// The driver of a device.
    pub const fn new(spi: S) -> Self {
        Self { spi, last: None, counts: 0 }
    }

    /// The angle within the turn.
    ///
    /// # Errors
    /// [`ReadError`]; what the chip refused is cleared then.
    pub fn angle(&mut self) -> Result<u16, ReadError> {
        let mut frame = READ_ANGLE;
        self.exchange(&mut frame)?;
        frame = NOP;
        self.exchange(&mut frame)?;
        let word = u16::from_be_bytes(frame);
        if !word.count_ones().is_multiple_of(2) {
            return Err(ReadError::Parity);
        }
        if word & 1 << 14 != 0 {
            self.exchange(&mut { READ_ERRORS })?;
            self.exchange(&mut { NOP })?;
            return Err(ReadError::Frame);
        }
        Ok(word & 0x3fff)
    }

    /// Counts over all turns, the first angle within its turn; between two calls the shaft turns
    /// less than half a turn.
    ///
    /// # Errors
    /// [`ReadError`].
    pub fn counts(&mut self) -> Result<i32, ReadError> {
        let angle = self.angle()?;
        self.counts = match self.last {
            None => i32::from(angle),
            Some(last) => {
                // The difference modulo a turn, as a signed number of 14 bits.
                let turned = (angle.wrapping_sub(last) << 2) as i16 >> 2;
                self.counts.wrapping_add(i32::from(turned))
            }
        };
        self.last = Some(angle);
        Ok(self.counts)
    }

    /// The device, when the driver is done with.
    pub fn release(self) -> S {
        self.spi
    }

    fn exchange(&mut self, frame: &mut [u8; 2]) -> Result<(), ReadError> {
        self.spi.transfer_in_place(frame).map_err(|error| ReadError::Bus(error.kind()))
    }
}
