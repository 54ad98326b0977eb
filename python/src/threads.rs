//! Runs of many plants on threads.
//!
//! `(plants, held inputs, threads) => outputs of each`. The result does not depend on the number of threads.

use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::thread;

use dbd_plant::instance::Instance;

use crate::rollout::{Course, LOOK, Stop, interrupted};

impl Course {
    /// The outputs of several plants on threads, and in SIMD lanes where they are alike: all their rows, plant after
    /// plant. `held` is theirs in this order. All run even if one fails; the first error is reported.
    pub(crate) fn run_all(
        &self,
        plants: &[&Mutex<Instance>],
        held: &[f64],
        threads: usize,
    ) -> Result<Vec<f64>, (usize, Stop)> {
        let share = self.samples * self.inputs.len();
        let (next, ended) = (AtomicUsize::new(0), AtomicBool::new(false));
        let group = self.group(plants, threads);
        let parts: Vec<_> = plants.chunks(group).collect();
        let groups = parts.len();
        let work = || {
            let mut done = Vec::new();
            while !ended.load(Ordering::Relaxed) {
                let part = next.fetch_add(1, Ordering::Relaxed);
                let Some(plants) = parts.get(part) else { break };
                let first = part * group;
                let held = |row: usize| held.get(row * share..(row + 1) * share);
                let held: Vec<_> = (first..first + plants.len())
                    .map(|row| held(row).unwrap_or_default())
                    .collect();
                let rows = self.run_group(plants, &held, &ended);
                done.extend(rows.into_iter().enumerate().map(|(row, rows)| (first + row, rows)));
            }
            done
        };
        let (caller, working) =
            (thread::current(), AtomicUsize::new(threads.min(groups).saturating_sub(1)));
        let mut stopped = None;
        let mut results: Vec<_> = thread::scope(|scope| {
            let others = (1..threads.min(groups)).map(|_| {
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
