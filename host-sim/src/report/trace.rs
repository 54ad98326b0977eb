//! `trace.csv`: the values of the scene that were changed, a header, then one row per sample.
//!
//! `samples => rows`, streamed. A changed value is a line of its own that begins with `#`; without changes
//! the header is the first line. Columns: time, per body position, quaternion, velocity and angular
//! velocity, then the energies, then the read-outs ([`Scene::columns`]). Every number is the
//! shortest text that reads back to its bits.

use std::io::{self, Write};

use dbd_plant::numerals::Digits;
use dbd_scene::Scene;

use crate::report::summary::SetValue;
use crate::simulate::Sample;

/// The format of a trace: what its lines and columns mean. A change that readers would misread counts
/// it up.
pub const FORMAT: u32 = 1;

/// Writes a trace.
pub struct TraceWriter<W: Write> {
    rows: csv::Writer<W>,
    text: Vec<u8>,
}

impl<W: Write> TraceWriter<W> {
    /// A trace with the scene's header.
    ///
    /// # Errors
    /// Where the writer cannot take it.
    pub fn new(mut to: W, scene: &Scene) -> io::Result<Self> {
        for value in SetValue::of(scene) {
            writeln!(to, "# set {}", value.text())?;
        }
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
    /// Where the writer cannot take it.
    pub fn row(&mut self, sample: &Sample<'_>) -> io::Result<()> {
        self.numbers(Digits::Double, &[sample.time])?;
        let numerals = sample.numerals;
        for body in &sample.state.bodies {
            self.numbers(numerals.position, &body.position.to_f64())?;
            self.numbers(numerals.orientation, &body.orientation.to_f64())?;
            self.numbers(numerals.velocity, &body.velocity.to_f64())?;
            self.numbers(numerals.velocity, &body.angular_velocity.to_f64())?;
        }
        let energy = &sample.energy;
        self.numbers(Digits::Double, &[energy.kinetic, energy.potential(), energy.total()])?;
        self.numbers(numerals.reading, sample.readings)?;
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

    /// Writes what is buffered and returns the writer.
    ///
    /// # Errors
    /// Where the writer cannot take it.
    pub fn finish(self) -> io::Result<W> {
        self.rows.into_inner().map_err(|error| io::Error::other(error.to_string()))
    }
}
