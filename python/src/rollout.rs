//! Runs of many steps, and of many plants on threads.
//!
//! `(plant, inputs held for some steps each) => outputs after each hold`. No interpreter is needed meanwhile; every
//! tenth of a second a run looks whether it was interrupted.

use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, Instant};

use dbd_instance::Instance;
use pyo3::prelude::*;

use crate::error::Refusal;

/// How often a run looks for an interrupt.
const LOOK: Duration = Duration::from_millis(100);

/// Steps between two looks at the clock: some tenths of a millisecond of small scenes.
const STRIDE: u64 = 256;

/// What ended a run.
pub(crate) enum Stop {
    /// What the plant refused, or a step that failed.
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

impl From<dbd_instance::InstanceError> for Stop {
    fn from(error: dbd_instance::InstanceError) -> Self {
        Self::Refused(error.into())
    }
}

/// When a run looked last for an interrupt.
pub(crate) struct Watch(Instant);

impl Watch {
    pub(crate) fn new() -> Self {
        Self(Instant::now())
    }

    /// So many steps; interrupts end them.
    pub(crate) fn advance(&mut self, instance: &mut Instance, steps: u64) -> Result<(), Stop> {
        let mut left = steps;
        while left > 0 {
            let now = left.min(STRIDE);
            instance.advance(now)?;
            left -= now;
            if self.0.elapsed() >= LOOK {
                Python::attach(|py| py.check_signals()).map_err(Stop::Interrupted)?;
                self.0 = Instant::now();
            }
        }
        Ok(())
    }
}

/// What a run is given and shows: the same for each of several plants.
pub(crate) struct Course {
    /// Inputs that are driven, by their places.
    pub(crate) inputs: Vec<usize>,
    /// Outputs that are noted, by their places; `None` is the time.
    pub(crate) columns: Vec<Option<usize>>,
    /// How many holds.
    pub(crate) samples: usize,
    /// Steps of each.
    pub(crate) every: u64,
}

impl Course {
    /// The outputs after each hold, one after another; `held` is samples × inputs.
    pub(crate) fn run(&self, instance: &mut Instance, held: &[f64]) -> Result<Vec<f64>, Stop> {
        let mut rows = Vec::with_capacity(self.samples * self.columns.len());
        let mut watch = Watch::new();
        for sample in 0..self.samples {
            let values = held.iter().skip(sample * self.inputs.len());
            for (input, value) in self.inputs.iter().zip(values) {
                instance.set_input(*input, *value)?;
            }
            watch.advance(instance, self.every)?;
            read(instance, &self.columns, &mut rows);
        }
        Ok(rows)
    }

    /// The same for several plants on threads: all their rows, plant after plant. `held` is theirs in
    /// this order. All run even where one is refused; the first such is told.
    pub(crate) fn run_all(
        &self,
        plants: &[&Mutex<Instance>],
        held: &[f64],
        threads: usize,
    ) -> Result<Vec<f64>, (usize, Stop)> {
        let share = self.samples * self.inputs.len();
        let next = AtomicUsize::new(0);
        let work = || {
            let mut done = Vec::new();
            loop {
                let row = next.fetch_add(1, Ordering::Relaxed);
                let Some(plant) = plants.get(row) else { return done };
                let held = held.get(row * share..(row + 1) * share).unwrap_or_default();
                let rows = match plant.try_lock() {
                    Ok(mut instance) => self.run(&mut instance, held),
                    Err(_) => Err(Stop::Refused(Refusal::busy())),
                };
                done.push((row, rows));
            }
        };
        let mut results: Vec<_> = std::thread::scope(|scope| {
            let others: Vec<_> =
                (1..threads.min(plants.len())).map(|_| scope.spawn(work)).collect();
            let mut results = work();
            for other in others {
                match other.join() {
                    Ok(done) => results.extend(done),
                    Err(panic) => std::panic::resume_unwind(panic),
                }
            }
            results
        });
        results.sort_by_key(|(row, _)| *row);
        let mut all = Vec::with_capacity(plants.len() * self.samples * self.columns.len());
        for (row, rows) in results {
            all.extend(rows.map_err(|stop| (row, stop))?);
        }
        Ok(all)
    }
}

/// Appends outputs as they are now; `None` is the time.
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
