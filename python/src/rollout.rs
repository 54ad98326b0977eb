//! Runs of many steps.
//!
//! `(plant, inputs held for some steps each) => outputs after each hold`. The interpreter is released meanwhile; every
//! tenth of a second a run checks for interrupts.

use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use dbd_plant::instance::{Instance, InstanceError};
use pyo3::exceptions::PyKeyboardInterrupt;
use pyo3::prelude::*;

use crate::error::Refusal;

/// Interval of interrupt checks.
pub(crate) const LOOK: Duration = Duration::from_millis(100);

/// Steps between two reads of the clock: some tenths of a millisecond for small scenes.
const STRIDE: u64 = 256;

/// The reason for the end of a run.
pub(crate) enum Stop {
    /// An error of the plant, or a failed step.
    Refused(Refusal),
    /// An interrupt.
    Interrupted(PyErr),
}

impl Stop {
    /// Python's exception.
    pub(crate) fn raised(self, py: Python<'_>) -> PyErr {
        match self {
            Self::Refused(refusal) => refusal.raised(py),
            Self::Interrupted(error) => error,
        }
    }
}

impl From<InstanceError> for Stop {
    fn from(error: InstanceError) -> Self {
        Self::Refused(error.into())
    }
}

/// Whether there was an interrupt; only the main thread receives them.
pub(crate) fn interrupted() -> Result<(), Stop> {
    Python::attach(|py| py.check_signals()).map_err(Stop::Interrupted)
}

/// Time of the last interrupt check, and whether another thread has received one.
pub(crate) struct Watch<'s> {
    looked: Instant,
    ended: &'s AtomicBool,
}

impl<'s> Watch<'s> {
    /// A run that ends when `ended` is set.
    pub(crate) fn new(ended: &'s AtomicBool) -> Self {
        Self { looked: Instant::now(), ended }
    }

    /// Advances by the given number of steps, or until an interrupt.
    pub(crate) fn advance(&mut self, instance: &mut Instance, steps: u64) -> Result<(), Stop> {
        self.repeat(steps, STRIDE, |now| Ok(instance.advance(now)?))
    }

    /// The given number of steps, at most `stride` at a time, or fewer on an interrupt.
    pub(crate) fn repeat(
        &mut self,
        steps: u64,
        stride: u64,
        mut advance: impl FnMut(u64) -> Result<(), Stop>,
    ) -> Result<(), Stop> {
        let mut left = steps;
        while left > 0 {
            let now = left.min(stride);
            advance(now)?;
            left -= now;
            if self.looked.elapsed() >= LOOK {
                if self.ended.load(Ordering::Relaxed) {
                    return Err(Stop::Interrupted(PyKeyboardInterrupt::new_err(())));
                }
                interrupted().inspect_err(|_| self.ended.store(true, Ordering::Relaxed))?;
                self.looked = Instant::now();
            }
        }
        Ok(())
    }
}

/// Inputs and outputs of a run, the same for each of several plants.
pub(crate) struct Course {
    /// Indices of the driven inputs.
    pub(crate) inputs: Vec<usize>,
    /// Indices of the recorded outputs; `None` is the time.
    pub(crate) columns: Vec<Option<usize>>,
    /// Number of holds.
    pub(crate) samples: usize,
    /// Steps of each.
    pub(crate) every: u64,
}

impl Course {
    /// The outputs after each hold, one after another; `held` is samples × inputs.
    pub(crate) fn run(
        &self,
        instance: &mut Instance,
        held: &[f64],
        watch: Watch<'_>,
    ) -> Result<Vec<f64>, Stop> {
        self.run_from(instance, held, 0, self.rows(), watch)
    }

    /// No rows yet.
    pub(crate) fn rows(&self) -> Vec<f64> {
        Vec::with_capacity(self.samples * self.columns.len())
    }

    /// The same after `rows` of the samples before `from`.
    pub(crate) fn run_from(
        &self,
        instance: &mut Instance,
        held: &[f64],
        from: usize,
        mut rows: Vec<f64>,
        mut watch: Watch<'_>,
    ) -> Result<Vec<f64>, Stop> {
        for sample in from..self.samples {
            self.hold(instance, held, sample)?;
            watch.advance(instance, self.every)?;
            read(instance, &self.columns, &mut rows);
        }
        Ok(rows)
    }

    /// Sets the inputs of a sample.
    pub(crate) fn hold(
        &self,
        instance: &mut Instance,
        held: &[f64],
        sample: usize,
    ) -> Result<(), InstanceError> {
        let values = held.iter().skip(sample * self.inputs.len());
        let mut all = self.inputs.iter().zip(values);
        all.try_for_each(|(input, value)| instance.set_input(*input, *value))
    }

    /// The rows of each plant of Python's, one plant after the other.
    pub(crate) fn run_each(
        &self,
        plants: &[&Mutex<Instance>],
        held: &[&[f64]],
        ended: &AtomicBool,
    ) -> Vec<Result<Vec<f64>, Stop>> {
        let each = plants.iter().zip(held);
        each.map(|(plant, held)| match plant.try_lock() {
            Ok(mut instance) => self.run(&mut instance, held, Watch::new(ended)),
            Err(_) => Err(Stop::Refused(Refusal::busy())),
        })
        .collect()
    }
}

/// Appends the present outputs; `None` is the time.
pub(crate) fn read(instance: &Instance, columns: &[Option<usize>], values: &mut Vec<f64>) {
    let first = values.len();
    let places: Vec<usize> = columns.iter().map(|column| column.unwrap_or(usize::MAX)).collect();
    instance.values_of(&places, values);
    for (column, value) in columns.iter().zip(&mut values[first..]) {
        if column.is_none() {
            *value = instance.time();
        }
    }
}
