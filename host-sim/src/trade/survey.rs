//! The survey: all points of a scene.
//!
//! `(scene, options, cache) => window, points`. Runs for accuracy are shared among the machine's
//! threads, the longest first; their results do not depend on who took them. Times are measured
//! after that, one way after the other.

use std::path::PathBuf;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::channel;
use std::thread;

use dbd_scene::Scene;

use crate::costs::Costs;
use crate::error::Error;
use crate::frequencies::Frequencies;
use crate::reference::trajectory::Trajectory;
use crate::reference::window::{GROWTH, before_chaos};
use crate::trade::cache::{Cache, Entry, Head, key};
use crate::trade::measure::{Comparison, UNSTABLE, cost};
use crate::trade::point::{Point, Stepper};
use crate::trade::ways::{Way, in_space, ways};

/// Samples at which a run is compared with the truth, after t = 0.
const SAMPLES: u32 = 50;

/// \[s\] The longest window where none is given: a mechanism has moved, and a scene of a dozen
/// bodies takes minutes.
const LONGEST: f64 = 0.5;

/// A step's time is measured at this share of the explicit schemes' limit.
const TIMED: f64 = 0.1;

/// A step beyond the limit by more than this counts as unstable, though the motion may not excite
/// the mode that grows: planar motion leaves the modes out of its plane at rest, exactly. The estimate
/// of the frequency is at most 1 % low.
const MARGIN: f64 = 1.01;

/// Force evaluations of the kernel that one of the references takes as long as.
const REFERENCE: u64 = 8;

/// What a survey is asked for.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TradeOptions {
    /// \[s\] the longest window; 0.5 s or the scene's duration where `None`.
    pub window: Option<f64>,
    /// The file that results are kept in; nothing is kept where `None`.
    pub cache: Option<PathBuf>,
    /// Whether the scene is the one that ships under its name, whose steps were counted on the
    /// target.
    pub shipped: bool,
}

/// A survey.
#[derive(Clone, Debug, PartialEq)]
pub struct Trade {
    /// The window and the truth's uncertainty.
    pub head: Head,
    /// All points, way by way, steps descending.
    pub points: Vec<Point>,
}

struct Job {
    way: Way,
    label: String,
    steps: u64,
    weight: u64,
    /// Whether the step is beyond what is stable at t = 0.
    beyond: bool,
}

/// Surveys a scene. `progress` hears of work done and work to do, in force evaluations.
///
/// # Errors
/// Where there is no truth, or results cannot be kept.
pub fn survey(
    scene: &Scene,
    options: &TradeOptions,
    progress: &mut dyn FnMut(u64, u64),
) -> Result<Trade, Error> {
    let longest = options.window.unwrap_or(LONGEST).min(scene.duration);
    let key = key(scene, longest);
    let mut cache = match &options.cache {
        Some(path) => Cache::open(path, key).map_err(Error::Write)?,
        None => Cache::nowhere(),
    };
    let mut truth = None;
    let head = match cache.head {
        Some(head) => head,
        None => {
            let (head, trajectory) = look(scene, key, longest)?;
            cache.add(Entry::Head(head)).map_err(Error::Write)?;
            truth = Some(trajectory);
            head
        }
    };
    let highest = Frequencies::of(scene).estimate;
    let interval = head.window / f64::from(SAMPLES);
    let ways = ways(scene, head.in_space);
    let jobs = jobs(&ways, highest, interval);
    let missing: Vec<&Job> = jobs
        .iter()
        .filter(|job| !cache.accuracies.contains_key(&(job.label.clone(), job.steps)))
        .collect();
    if !missing.is_empty() {
        let truth = match truth {
            Some(truth) => truth,
            None => Trajectory::truth(scene, head.window, SAMPLES)?,
        };
        let comparison = Comparison::new(scene, &truth);
        run(&comparison, missing, &mut cache, progress)?;
    }
    let step = if highest > 0.0 { TIMED * 2.0 / highest } else { interval };
    for way in &ways {
        let label = way.stepper().label();
        if !cache.costs.contains_key(&label) {
            let cost = cost(scene, way, step);
            let (seconds, spread) = (cost.seconds, cost.spread);
            let entry = Entry::Cost { way: label, seconds, spread };
            cache.add(entry).map_err(Error::Write)?;
        }
    }
    let costs = if options.shipped { Costs::shipped() } else { Costs::none() };
    let points =
        jobs.iter().filter_map(|job| point(scene, &costs, job, interval, &cache)).collect();
    Ok(Trade { head, points })
}

/// Finds window and truth.
fn look(scene: &Scene, key: u64, longest: f64) -> Result<(Head, Trajectory), Error> {
    let window = before_chaos(scene, longest, SAMPLES, GROWTH)?;
    // At least one interval, so that there is something to compare.
    let last = window.times.iter().rposition(|time| *time <= window.end).unwrap_or(0).max(1);
    let (end, growth) = (window.times[last], window.growth[last]);
    let truth = Trajectory::truth(scene, end, SAMPLES)?;
    let uncertainty = truth.largest_uncertainty();
    let in_space = in_space(&truth.states);
    Ok((Head { key, window: end, growth, uncertainty, in_space }, truth))
}

fn jobs(ways: &[Way], highest: f64, interval: f64) -> Vec<Job> {
    let of_way = |way: &Way| {
        let (way, label) = (*way, way.stepper().label());
        let price = match way {
            Way::Kernel(method) => u64::from(method.evaluations()),
            _ => REFERENCE,
        };
        way.ladder(highest, interval).into_iter().map(move |steps| Job {
            way,
            label: label.clone(),
            steps,
            weight: steps * u64::from(SAMPLES) * price,
            beyond: highest * interval / steps as f64 > MARGIN * way.stability_limit(),
        })
    };
    ways.iter().flat_map(of_way).collect()
}

/// Runs all jobs and keeps their results as they come.
fn run(
    comparison: &Comparison<'_>,
    mut jobs: Vec<&Job>,
    cache: &mut Cache,
    progress: &mut dyn FnMut(u64, u64),
) -> Result<(), Error> {
    jobs.sort_by_key(|job| std::cmp::Reverse(job.weight));
    let all = jobs.iter().map(|job| job.weight).sum();
    let mut done = 0;
    progress(done, all);
    let next = AtomicUsize::new(0);
    let threads = thread::available_parallelism().map_or(1, usize::from);
    thread::scope(|scope| {
        let (sender, results) = channel();
        for _ in 0..threads {
            let (sender, next, jobs) = (sender.clone(), &next, &jobs);
            scope.spawn(move || {
                while let Some(job) = jobs.get(next.fetch_add(1, Ordering::Relaxed)) {
                    let accuracy = match job.beyond {
                        true => UNSTABLE,
                        false => comparison.accuracy(&job.way, job.steps),
                    };
                    if sender.send((*job, accuracy)).is_err() {
                        break;
                    }
                }
            });
        }
        drop(sender);
        for (job, accuracy) in results {
            let entry = Entry::Accuracy {
                way: job.label.clone(),
                steps: job.steps,
                stable: accuracy.stable,
                error: accuracy.error,
                energy_rms: accuracy.energy_rms,
                energy_peak: accuracy.energy_peak,
            };
            cache.add(entry).map_err(Error::Write)?;
            done += job.weight;
            progress(done, all);
        }
        Ok(())
    })
}

fn point(scene: &Scene, costs: &Costs, job: &Job, interval: f64, cache: &Cache) -> Option<Point> {
    let entry = cache.accuracies.get(&(job.label.clone(), job.steps))?;
    let Entry::Accuracy { stable, error, energy_rms, energy_peak, .. } = entry else { return None };
    let (seconds, spread) = cache.costs.get(&job.label)?;
    let step = interval / job.steps as f64;
    let stepper = job.way.stepper();
    Some(Point {
        step,
        steps: job.steps * u64::from(SAMPLES),
        stable: *stable,
        error: *error,
        energy_rms: *energy_rms,
        energy_peak: *energy_peak,
        evaluations: f64::from(job.way.evaluations()) / step,
        host_seconds: seconds / step,
        host_spread: *spread,
        target_instructions: instructions(scene, costs, &job.way).map(|count| count / step),
        stepper,
    })
}

/// Instructions per step on Cortex-M4F, where they were counted: of the scenes that ship.
fn instructions(scene: &Scene, costs: &Costs, way: &Way) -> Option<f64> {
    let Stepper { scheme, newton, damping, precision, orientation, kernel } = &way.stepper();
    if !kernel {
        return None;
    }
    let explicit = damping.is_some();
    costs.instructions_per_step(&scene.name, scheme, *newton, explicit, precision, orientation)
}
