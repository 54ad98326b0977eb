//! `trace.csv`: a header, then one row per sample.
//!
//! `samples => rows`, streamed. Columns: time, per body position, quaternion, velocity and angular
//! velocity, then the energies, then the read-outs ([`Scene::columns`]). Every number is the
//! shortest text that reads back to its bits. [`crate::recorded::trace`] reads it.

use std::io::{self, Write};

use dbd_plant::number_format::Digits;
use dbd_scene::Scene;

use crate::simulate::Sample;

/// The format version of a trace; incremented by every incompatible
/// change.
pub const FORMAT: u32 = 1;

/// FNV-1a 64 over bytes (offset 0xcbf29ce484222325, prime 0x100000001b3), incrementally.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TextHash(u64);

impl Default for TextHash {
    fn default() -> Self {
        Self(0xcbf2_9ce4_8422_2325)
    }
}

impl TextHash {
    /// Takes the next bytes.
    pub fn add(&mut self, bytes: &[u8]) {
        for byte in bytes {
            self.0 = (self.0 ^ u64::from(*byte)).wrapping_mul(0x0000_0100_0000_01b3);
        }
    }

    /// 16 hexadecimal digits.
    #[must_use]
    pub fn text(self) -> String {
        format!("{:016x}", self.0)
    }
}

/// A writer that hashes its output.
struct Hashed<W> {
    to: W,
    hash: TextHash,
}

impl<W: Write> Write for Hashed<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let written = self.to.write(bytes)?;
        self.hash.add(&bytes[..written]);
        Ok(written)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.to.flush()
    }
}

/// Writes a trace.
pub struct TraceWriter<W: Write> {
    rows: csv::Writer<Hashed<W>>,
    text: Vec<u8>,
}

impl<W: Write> TraceWriter<W> {
    /// A trace with the scene's header.
    ///
    /// # Errors
    /// If the writer fails.
    pub fn new(to: W, scene: &Scene) -> io::Result<Self> {
        let to = Hashed { to, hash: TextHash::default() };
        let mut rows = csv::Writer::from_writer(to);
        for column in scene.columns() {
            rows.write_field(column)?;
        }
        rows.write_record(None::<&[u8]>)?;
        Ok(Self { rows, text: Vec::new() })
    }

    /// Appends the row of a sample.
    ///
    /// # Errors
    /// If the writer fails.
    pub fn row(&mut self, sample: &Sample<'_>) -> io::Result<()> {
        self.numbers(Digits::Double, &[sample.time])?;
        let number_format = sample.number_format;
        for body in &sample.state.bodies {
            self.numbers(number_format.position, &body.position.to_f64())?;
            self.numbers(number_format.orientation, &body.orientation.to_f64())?;
            self.numbers(number_format.velocity, &body.velocity.to_f64())?;
            self.numbers(number_format.velocity, &body.angular_velocity.to_f64())?;
        }
        let energy = &sample.energy;
        self.numbers(Digits::Double, &[energy.kinetic, energy.potential(), energy.total()])?;
        self.numbers(number_format.reading, sample.readings)?;
        self.rows.write_record(None::<&[u8]>)?;
        Ok(())
    }

    fn numbers(&mut self, digits: Digits, values: &[f64]) -> io::Result<()> {
        for value in values {
            self.text.clear();
            digits.write(*value, &mut self.text)?;
            self.rows.write_field(&self.text)?;
        }
        Ok(())
    }

    /// Flushes the buffer and returns the writer, with the hash of all output.
    ///
    /// # Errors
    /// If the writer fails.
    pub fn finish(self) -> io::Result<(W, TextHash)> {
        let Hashed { to, hash } =
            self.rows.into_inner().map_err(|error| io::Error::other(error.to_string()))?;
        Ok((to, hash))
    }
}
