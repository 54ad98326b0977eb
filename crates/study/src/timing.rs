//! Time of a step of each method on this host.
//!
//! `(scene, methods, step) => seconds per step: minimum, median, spread`, on one thread while nothing else of this
//! program runs. The methods alternate in rounds, so that other work on the machine affects all of them equally;
//! scattered measurements are repeated. Times are thread times if the system provides them, which exclude other
//! programs. Instruction counts would be free of noise, but do not measure time: single and double precision have equal
//! counts and different times.

use std::hint::black_box;

use crate::reference::Mechanism;
use crate::reference::implicit::Implicit;
use crate::reference::naive::Naive;
use dbd_plant::{AnyPlant, plant};
use dbd_scene::Scene;
use serde::{Deserialize, Serialize};

use crate::measure::implicit_step;
use crate::ways::Way;

/// Time of a step on this host.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Cost {
    /// \[s\] the least of all measurements: other work can only lengthen them.
    pub least: f64,
    /// \[s\] the median of a set of measurements, the calmest.
    pub median: f64,
    /// Of that set half the range of its middle half over the median.
    pub spread: f64,
}

/// Rounds in a set of measurements.
pub const ROUNDS: usize = 15;

/// Sets that are taken at most while times scatter.
const SETS: usize = 4;

/// A spread above this is measured again, and spoken of where it stays.
pub const CALM: f64 = 0.2;

/// \[s\] per measurement.
const BATCH: f64 = 5e-4;

pub use clock::elapsed;

/// Runs the given number of steps of a method.
type Take<'t> = Box<dyn FnMut(u64) + 't>;

/// Measures a step of the size `step` \[s\] of all methods, from t = 0 of the scene on. `progress` receives the rounds
/// done and to do.
#[must_use]
pub fn costs(
    scene: &Scene,
    ways: &[Way],
    step: f64,
    progress: &mut dyn FnMut(u64, u64),
) -> Vec<Cost> {
    let (mechanism, _) = Mechanism::of(scene);
    let mut takes: Vec<Option<(Take<'_>, u64)>> = ways
        .iter()
        .map(|way| {
            let mut take = taker(scene, &mechanism, way, step)?;
            let steps = batch_of(&mut take);
            Some((take, steps))
        })
        .collect();
    rounds(ways.len(), progress, |row| match &mut takes[row] {
        Some((take, steps)) => clock::elapsed(|| take(*steps)) / *steps as f64,
        None => f64::INFINITY,
    })
}

/// Stepping function of a method; `None` if unsupported.
fn taker<'t>(scene: &Scene, mechanism: &'t Mechanism, way: &Way, step: f64) -> Option<Take<'t>> {
    let start = || Mechanism::of(scene).1;
    Some(match way {
        Way::Kernel(method) => {
            let mut plant = plant(scene, method, step).ok()?;
            Box::new(move |steps| take(plant.as_mut(), steps))
        }
        Way::NaiveSemiImplicitEuler | Way::NaiveLeapfrog => {
            let mut naive = Naive::new(mechanism, start(), step);
            let leapfrog = *way == Way::NaiveLeapfrog;
            Box::new(move |steps| {
                for _ in 0..steps {
                    if leapfrog {
                        naive.leapfrog()
                    } else {
                        naive.semi_implicit_euler()
                    }
                    black_box(&naive.state);
                }
            })
        }
        Way::LinearlyImplicitEuler => {
            let mut implicit = Implicit::new(mechanism, start(), step);
            Box::new(move |steps| {
                for _ in 0..steps {
                    black_box(implicit_step(&mut implicit));
                }
            })
        }
    })
}

/// Runs the given number of steps in one call of the plant, which is reset after a failure.
fn take(plant: &mut dyn AnyPlant, mut steps: u64) {
    loop {
        let before = plant.steps();
        if black_box(plant.advance(steps)).is_ok() {
            return;
        }
        steps = steps.saturating_sub(plant.steps() - before);
        plant.reset();
    }
}

/// Warms caches and determines the number of steps per measurement.
fn batch_of(take: &mut Take<'_>) -> u64 {
    let mut steps = 1;
    loop {
        let seconds = clock::elapsed(|| take(steps));
        if seconds >= 0.5 * BATCH {
            return ((BATCH / seconds * steps as f64).ceil() as u64).max(1);
        }
        steps *= 4;
    }
}

/// Measures all methods in rounds; repeats scattered ones in the same way.
fn rounds(
    count: usize,
    progress: &mut dyn FnMut(u64, u64),
    mut measure: impl FnMut(usize) -> f64,
) -> Vec<Cost> {
    let mut costs: Vec<Option<Cost>> = vec![None; count];
    let mut done = 0;
    for set in 1..=SETS {
        let scattered = |cost: &Option<Cost>| cost.is_none_or(|cost| cost.spread > CALM);
        let rows: Vec<usize> = (0..count).filter(|row| scattered(&costs[*row])).collect();
        if rows.is_empty() {
            break;
        }
        let mut times = vec![Vec::with_capacity(ROUNDS); count];
        for _ in 0..ROUNDS {
            progress(done, (set * ROUNDS) as u64);
            rows.iter().for_each(|row| times[*row].push(measure(*row)));
            done += 1;
        }
        for row in rows {
            let new = cost_of(&mut times[row]);
            costs[row] = Some(match costs[row] {
                Some(old) => {
                    let calmer = if new.spread < old.spread { new } else { old };
                    Cost { least: old.least.min(new.least), ..calmer }
                }
                None => new,
            });
        }
    }
    costs.into_iter().flatten().collect()
}

/// The cost of a set of measurements.
fn cost_of(times: &mut [f64]) -> Cost {
    times.sort_by(f64::total_cmp);
    let count = times.len();
    let median = times[count / 2];
    let spread = 0.5 * (times[3 * count / 4] - times[count / 4]) / median;
    // Unsupported methods do not scatter.
    Cost { least: times[0], median, spread: if spread.is_finite() { spread } else { 0.0 } }
}

/// The thread's own time.
#[cfg(unix)]
mod clock {
    use rustix::time::{ClockId, clock_gettime};

    /// \[s\] that this thread has run.
    fn now() -> f64 {
        let now = clock_gettime(ClockId::ThreadCPUTime);
        now.tv_sec as f64 + 1e-9 * now.tv_nsec as f64
    }

    /// \[s\] thread time of a function.
    pub fn elapsed(work: impl FnOnce()) -> f64 {
        let start = now();
        work();
        now() - start
    }
}

/// A clock on the wall, where the system does not count a thread's time finely.
#[cfg(not(unix))]
mod clock {
    use std::time::Instant;

    /// \[s\] elapsed time of a function.
    pub fn elapsed(work: impl FnOnce()) -> f64 {
        let start = Instant::now();
        work();
        start.elapsed().as_secs_f64()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_take_turns_and_what_scatters_is_measured_again() {
        let mut calls = Vec::new();
        let costs = rounds(3, &mut |_, _| (), |row| {
            calls.push(row);
            let call = calls.len();
            match row {
                // Other work meets the first half of its first set.
                1 if call < 3 * ROUNDS / 2 => 35.0,
                // Scatters for good.
                2 => 2.0 + (call % 5) as f64,
                _ => 1.0 + 0.001 * (call % 7) as f64,
            }
        });
        assert_eq!(calls[..3 * ROUNDS], [0, 1, 2].repeat(ROUNDS));
        assert_eq!(calls[3 * ROUNDS..5 * ROUNDS], [1, 2].repeat(ROUNDS));
        assert_eq!(calls[5 * ROUNDS..], [2].repeat(2 * ROUNDS));
        for cost in &costs[..2] {
            assert!((cost.median - 1.0).abs() < 0.01 && cost.spread < CALM, "{cost:?}");
            assert!(cost.least <= cost.median);
        }
        assert!(costs[2].spread > CALM && costs[2].least == 2.0, "{:?}", costs[2]);
    }

    #[test]
    fn what_cannot_be_stepped_takes_for_ever_and_once() {
        let mut calls = 0;
        let costs = rounds(1, &mut |_, _| (), |_| {
            calls += 1;
            f64::INFINITY
        });
        assert!(costs[0].least.is_infinite() && costs[0].spread == 0.0 && calls == ROUNDS);
    }

    #[test]
    #[cfg(unix)]
    fn what_runs_meanwhile_is_not_in_a_time() {
        let idle = clock::elapsed(|| std::thread::sleep(std::time::Duration::from_millis(20)));
        assert!(idle < 5e-3, "{idle}");
        let busy = clock::elapsed(|| {
            black_box((0..100_000).fold(1.0_f64, |x, _| black_box(x * 1.000_1)));
        });
        assert!(busy > 0.0 && busy.is_finite());
    }
}
