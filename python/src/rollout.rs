//! Runs of many steps, and of many plants on threads.
//!
//! `(plant, inputs held for some steps each) => outputs after each hold`. The interpreter is released meanwhile; every
//! tenth of a second a run checks for interrupts.

use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::thread;
use std::time::{Duration, Instant};

use dbd_plant::instance::Instance;
use pyo3::exceptions::PyKeyboardInterrupt;
use pyo3::prelude::*;

use crate::error::Refusal;

/// Interval of interrupt checks.
const LOOK: Duration = Duration::from_millis(100);

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

impl From<dbd_plant::instance::InstanceError> for Stop {
    fn from(error: dbd_plant::instance::InstanceError) -> Self {
        Self::Refused(error.into())
    }
}

/// Whether there was an interrupt; only the main thread receives them.
fn interrupted() -> Result<(), Stop> {
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
        let mut left = steps;
        while left > 0 {
            let now = left.min(STRIDE);
            instance.advance(now)?;
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
        mut watch: Watch<'_>,
    ) -> Result<Vec<f64>, Stop> {
        let mut rows = Vec::with_capacity(self.samples * self.columns.len());
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
    /// this order. All run even if one fails; the first error is reported.
    pub(crate) fn run_all(
        &self,
        plants: &[&Mutex<Instance>],
        held: &[f64],
        threads: usize,
    ) -> Result<Vec<f64>, (usize, Stop)> {
        let share = self.samples * self.inputs.len();
        let (next, ended) = (AtomicUsize::new(0), AtomicBool::new(false));
        let work = || {
            let mut done = Vec::new();
            while !ended.load(Ordering::Relaxed) {
                let row = next.fetch_add(1, Ordering::Relaxed);
                let Some(plant) = plants.get(row) else { break };
                let held = held.get(row * share..(row + 1) * share).unwrap_or_default();
                let rows = match plant.try_lock() {
                    Ok(mut instance) => self.run(&mut instance, held, Watch::new(&ended)),
                    Err(_) => Err(Stop::Refused(Refusal::busy())),
                };
                done.push((row, rows));
            }
            done
        };
        let (caller, working) =
            (thread::current(), AtomicUsize::new(threads.min(plants.len()).saturating_sub(1)));
        let mut stopped = None;
        let mut results: Vec<_> = thread::scope(|scope| {
            let others = (1..threads.min(plants.len())).map(|_| {
                scope.spawn(|| {
                    let done = work();
                    working.fetch_sub(1, Ordering::Release);
                    caller.unpark();
                    done
                })
            });
            let others: Vec<_> = others.collect();
            let mut results = work();
            // Only this thread receives interrupts, even while it waits.
            while working.load(Ordering::Acquire) > 0
                && !others.iter().all(thread::ScopedJoinHandle::is_finished)
            {
                thread::park_timeout(LOOK);
                if let Err(stop) = interrupted() {
                    ended.store(true, Ordering::Relaxed);
                    stopped = Some(stop);
                }
            }
            for other in others {
                match other.join() {
                    Ok(done) => results.extend(done),
                    Err(panic) => std::panic::resume_unwind(panic),
                }
            }
            results
        });
        if let Some(stop) = stopped {
            return Err((0, stop));
        }
        // An interrupt takes precedence over other errors.
        let cut = |(_, rows): &(usize, Result<_, Stop>)| matches!(rows, Err(Stop::Interrupted(_)));
        if let Some(place) = results.iter().position(cut)
            && let (row, Err(stop)) = results.swap_remove(place)
        {
            return Err((row, stop));
        }
        results.sort_by_key(|(row, _)| *row);
        let mut all = Vec::with_capacity(plants.len() * self.samples * self.columns.len());
        for (row, rows) in results {
            all.extend(rows.map_err(|stop| (row, stop))?);
        }
        Ok(all)
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
