//! Rollouts of similar plants in SIMD lanes.
//!
//! `(plants, held inputs) => outputs after each hold`, with the bits that each plant has alone.

use std::iter;
use std::sync::Mutex;
use std::sync::atomic::AtomicBool;

use dbd_plant::instance::Instance;
use dbd_plant::instance::lockstep::Lockstep;
use pyo3::exceptions::PyKeyboardInterrupt;

use crate::rollout::{Course, Stop, Watch, read};

/// Body-steps between two interrupt checks: some tens of milliseconds.
const STRIDE: u64 = 1 << 16;

/// Steps of a hold from which lanes are faster: states are copied into the lanes and back for each.
const SHORTEST: u64 = 5;

impl Course {
    /// Number of neighbouring plants that run together.
    pub(crate) fn group(&self, plants: &[&Mutex<Instance>], threads: usize) -> usize {
        let first = plants.first().and_then(|plant| plant.try_lock().ok());
        match first {
            Some(first) if self.every >= SHORTEST => {
                Lockstep::lanes(&first, plants.len().div_ceil(threads.max(1)))
            }
            _ => 1,
        }
    }

    /// The rows of each plant of a group.
    pub(crate) fn run_group(
        &self,
        plants: &[&Mutex<Instance>],
        held: &[&[f64]],
        ended: &AtomicBool,
    ) -> Vec<Result<Vec<f64>, Stop>> {
        let locked: Result<Vec<_>, _> = plants.iter().map(|plant| plant.try_lock()).collect();
        if let Ok(mut locked) = locked {
            let mut instances: Vec<&mut Instance> =
                locked.iter_mut().map(|plant| &mut **plant).collect();
            if let Some(lanes) = Lockstep::new(&instances) {
                return self.run_together(lanes, &mut instances, held, ended);
            }
        }
        self.run_each(plants, held, ended)
    }

    /// The rows of each plant; once one fails, the others continue one by one.
    fn run_together(
        &self,
        mut lanes: Lockstep,
        instances: &mut [&mut Instance],
        held: &[&[f64]],
        ended: &AtomicBool,
    ) -> Vec<Result<Vec<f64>, Stop>> {
        let bodies = instances.first().map_or(1, |first| first.scene().body_names.len().max(1));
        let stride = (STRIDE / bodies as u64).max(1);
        let mut watch = Watch::new(ended);
        let mut rows: Vec<_> = instances.iter().map(|_| Ok(self.rows())).collect();
        for sample in 0..self.samples {
            let mut all = instances.iter_mut().zip(held);
            if all.any(|(instance, held)| self.hold(instance, held, sample).is_err()) {
                return self.run_rest(instances, held, sample, rows, ended);
            }
            let mut advanced: Vec<Result<(), Stop>> = instances.iter().map(|_| Ok(())).collect();
            let watched = watch.repeat(self.every, stride, |steps| {
                for (advanced, now) in advanced.iter_mut().zip(lanes.advance(instances, steps)) {
                    if let (Ok(()), Err(error)) = (&advanced, now) {
                        *advanced = Err(error.into());
                    }
                }
                Ok(())
            });
            if let Err(stop) = watched {
                let others =
                    iter::repeat_with(|| Stop::Interrupted(PyKeyboardInterrupt::new_err(())));
                return iter::once(stop).chain(others).take(rows.len()).map(Err).collect();
            }
            let failed = advanced.iter().any(Result::is_err);
            for ((rows, advanced), instance) in rows.iter_mut().zip(advanced).zip(&*instances) {
                match (&mut *rows, advanced) {
                    (Ok(rows), Ok(())) => read(instance, &self.columns, rows),
                    (_, Err(stop)) => *rows = Err(stop),
                    (Err(_), _) => {}
                }
            }
            if failed {
                return self.run_rest(instances, held, sample + 1, rows, ended);
            }
        }
        rows
    }

    /// The remaining rows of each plant that has not failed, one by one.
    fn run_rest(
        &self,
        instances: &mut [&mut Instance],
        held: &[&[f64]],
        from: usize,
        rows: Vec<Result<Vec<f64>, Stop>>,
        ended: &AtomicBool,
    ) -> Vec<Result<Vec<f64>, Stop>> {
        let all = instances.iter_mut().zip(held).zip(rows);
        all.map(|((instance, held), rows)| {
            self.run_from(instance, held, from, rows?, Watch::new(ended))
        })
        .collect()
    }
}
