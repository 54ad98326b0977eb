//! The trade-off study: all points of a scene.
//!
//! `(scene, options, cache) => window, points`. Runs for accuracy are shared among the machine's
//! threads, the longest first; their results do not depend on the thread. Times are measured after that, alternating
//! between the methods.

use std::collections::BTreeMap;
use std::io;
use std::path::PathBuf;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::channel;
use std::thread;

use crate::reference::fine::states;
use crate::reference::metric::Metric;
use crate::reference::reference_solution::{Integrator, NoReferenceSolution};
use crate::reference::window::{GROWTH, before_chaos};
use crate::reference::{Mechanism, State};
use dbd_plant::Method;
use dbd_scene::Scene;

use crate::cache::{Cache, Entry, Head, key};
use crate::costs::Costs;
use crate::estimate;
use crate::frame::{Frame, TradeOptions, WindowError, frame};
use crate::grid::{Grid, SAMPLES};
use crate::limits::{Limit, Limits};
use crate::measure::{Comparison, UNSTABLE};
use crate::order::{Influences, describe};
use crate::point::{Fall, Point, Stepper};
use crate::timing::{Cost, costs};
use crate::variants::{Compared, compare, counted_as};
use crate::ways::{Way, in_space, ways};

/// A step's time is measured at this fraction of the explicit schemes' limit.
const TIMED: f64 = 0.1;

/// Cost of a reference's force evaluation, in evaluations of the kernel.
const REFERENCE: u64 = 8;

/// A survey.
#[derive(Clone, Debug, PartialEq)]
pub struct Trade {
    /// The window and the uncertainty of the reference solution.
    pub head: Head,
    /// \[s\] the requested period that every step divides.
    pub period: Option<f64>,
    /// All points by method, steps descending.
    pub points: Vec<Point>,
    /// The scene and its variants, if any.
    pub variants: Vec<Compared>,
    /// Whether instructions on the target are estimates.
    pub estimated: bool,
}

/// Phase of a study.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Phase {
    /// Determining the window.
    Window,
    /// Computing the reference solution.
    ReferenceSolution,
    /// The solution of a second integrator.
    SecondSolution,
    /// The largest stable steps.
    Limits,
    /// Runs for accuracy: work done and all work, in force evaluations.
    Runs(u64, u64),
    /// Measuring times: rounds done and all that are foreseen.
    Times(u64, u64),
    /// Other models of the same mechanism.
    Variants,
}

/// Why a survey could not be made.
#[derive(Debug, thiserror::Error, miette::Diagnostic)]
pub enum SurveyError {
    /// The window cannot be looked at.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Window(#[from] WindowError),
    /// There is no reference solution to compare with.
    #[error(transparent)]
    #[diagnostic(transparent)]
    NoReferenceSolution(#[from] NoReferenceSolution),
    /// Another survey of the same keeps its results in the folder.
    #[error("another trade-off study of this scene is writing to {}", folder.display())]
    #[diagnostic(help("wait until it completes, or give another folder with --out DIR"))]
    Busy {
        /// The folder.
        folder: PathBuf,
    },
    /// Results cannot be kept.
    #[error("cannot write the results: {0}")]
    Write(io::Error),
}

struct Job {
    way: Way,
    label: String,
    steps: u64,
    weight: u64,
    limit: Limit,
    /// \[s\] of a planar scene the largest step that is stable in space, too.
    in_space: Option<f64>,
}

/// Runs the study of a scene. `progress` receives the current phase.
///
/// # Errors
/// [`SurveyError`].
pub fn survey(
    scene: &Scene,
    options: &TradeOptions,
    progress: &mut dyn FnMut(Phase),
) -> Result<Trade, SurveyError> {
    let frame = frame(scene, options)?;
    let key = key(scene, frame.longest, frame.unit);
    let mut cache = match &options.cache {
        Some(folder) => Cache::open(folder, key).map_err(|error| match error.kind() {
            io::ErrorKind::WouldBlock => SurveyError::Busy { folder: folder.clone() },
            _ => SurveyError::Write(error),
        })?,
        None => Cache::nowhere(),
    };
    let mut reference_solution = None;
    let head = match cache.head {
        Some(head) => head,
        None => {
            let (head, found) = look(scene, key, frame, progress)?;
            cache.add(Entry::Head(head)).map_err(SurveyError::Write)?;
            reference_solution = Some(found);
            head
        }
    };
    let grid = head.grid;
    let ways = ways(scene, head.in_space);
    let limits = Limits::of(scene);
    // In space a planar mechanism may leave its plane.
    let spatial = scene.planar.is_some().then(|| Limits::in_space(scene));
    let both = [(OWN, Some(&limits)), (IN_SPACE, spatial.as_ref())];
    find(&both, &ways, &mut cache, progress)?;
    let highest = limits.highest();
    let jobs = jobs(&ways, &both, &cache, &grid, scene.body_names.len());
    let missing: Vec<&Job> = jobs
        .iter()
        .filter(|job| !cache.accuracies.contains_key(&(job.label.clone(), job.steps)))
        .collect();
    if !missing.is_empty() {
        let reference_solution = match reference_solution {
            Some(reference_solution) => reference_solution,
            None => {
                progress(Phase::ReferenceSolution);
                states(Integrator::Dop853, scene, false, &grid.times())?
            }
        };
        let comparison = Comparison::new(scene, grid, &reference_solution);
        run(&comparison, missing, &mut cache, progress)?;
    }
    let step = if highest > 0.0 { TIMED * 2.0 / highest } else { grid.interval };
    let untimed = |way: &&Way| !cache.costs.contains_key(&way.stepper().label());
    let untimed: Vec<Way> = ways.iter().filter(untimed).copied().collect();
    if !untimed.is_empty() {
        let costs = costs(scene, &untimed, step, &mut |done, all| {
            progress(Phase::Times(done, all));
        });
        for (way, cost) in untimed.iter().zip(costs) {
            let entry = Entry::Cost { way: way.stepper().label(), cost };
            cache.add(entry).map_err(SurveyError::Write)?;
        }
    }
    let costs = Costs::shipped();
    let called = |scene: &Scene| counted_as(options.shipped.as_ref()?, scene);
    let counted = called(scene);
    let of_way = |way: &Way| {
        let count = match &counted {
            Some(called) => counted_instructions(called, &costs, way),
            None => way.method().and_then(|method| estimate::instructions(scene, &method, &costs)),
        };
        Some((way.stepper().label(), count?))
    };
    let instructions: BTreeMap<String, f64> = ways.iter().filter_map(of_way).collect();
    let with_point =
        |job: &Job| Some((point(&instructions, job, &grid, &cache)?, job.way.method()));
    let (mut points, methods): (Vec<Point>, Vec<_>) = jobs.iter().filter_map(with_point).unzip();
    let influences = Influences::of(scene, grid.window());
    describe(&mut points, &methods, influences, head.uncertainty);
    let variants = match cache.variants.take() {
        Some(variants) => variants,
        None => {
            progress(Phase::Variants);
            let variants = compare(scene, &grid, &costs, &called);
            cache.add(Entry::Variants(variants.clone())).map_err(SurveyError::Write)?;
            variants
        }
    };
    let estimated = counted.is_none();
    Ok(Trade { head, period: options.period, points, variants, estimated })
}

/// Finds window and reference solution.
///
/// # Errors
/// If the integrator fails.
pub(crate) fn look(
    scene: &Scene,
    key: u64,
    frame: Frame,
    progress: &mut dyn FnMut(Phase),
) -> Result<(Head, Vec<State>), NoReferenceSolution> {
    progress(Phase::Window);
    let window = before_chaos(scene, frame.longest, SAMPLES, GROWTH)?;
    // At least one interval, so that there is something to compare.
    let last = window.times.iter().rposition(|time| *time <= window.end).unwrap_or(0).max(1);
    let grid = Grid::new(frame.unit, window.times[last]);
    progress(Phase::ReferenceSolution);
    let reference_solution = states(Integrator::Dop853, scene, false, &grid.times())?;
    progress(Phase::SecondSolution);
    let second = states(Integrator::Verner98, scene, false, &grid.times())?;
    let metric = Metric::of(&Mechanism::of(scene).0);
    let pairs = reference_solution.iter().zip(&second);
    let uncertainty = pairs.map(|(a, b)| metric.distance(a, b)).fold(0.0, f64::max);
    let in_space = in_space(&reference_solution);
    Ok((Head { key, grid, growth: window.growth[last], uncertainty, in_space }, reference_solution))
}

/// Finds the largest stable steps that are not known yet, on all the machine's threads.
fn find(
    limits: &[Whose<'_>],
    ways: &[Way],
    cache: &mut Cache,
    progress: &mut dyn FnMut(Phase),
) -> Result<(), SurveyError> {
    let mut missing: BTreeMap<String, (&Limits, Method)> = BTreeMap::new();
    for (whose, limits) in limits {
        let Some(limits) = limits else { continue };
        for method in ways.iter().filter_map(|way| limits.decisive(way)) {
            let label = label(whose, &method);
            if !cache.limits.contains_key(&label) {
                missing.insert(label, (limits, method));
            }
        }
    }
    if missing.is_empty() {
        return Ok(());
    }
    progress(Phase::Limits);
    let missing: Vec<_> = missing.into_iter().collect();
    in_parallel(
        &missing,
        |(_, (limits, method))| limits.found(method),
        |(label, _), step| {
            let entry = Entry::Limit { way: label.clone(), step };
            cache.add(entry).map_err(SurveyError::Write)
        },
    )
}

/// Limits of a model of the scene, and the prefix of their labels.
type Whose<'l> = (&'static str, Option<&'l Limits>);

/// Of the model that steps.
const OWN: &str = "";

/// Of a planar scene in space.
const IN_SPACE: &str = "in space, ";

/// Label of a method's limit.
fn label(whose: &str, method: &Method) -> String {
    format!("{whose}{}", Way::Kernel(*method).stepper().label())
}

/// Step limits of a method from the found ones.
fn limit((whose, limits): Whose<'_>, way: &Way, cache: &Cache) -> Option<Limit> {
    let limits = limits?;
    let decisive = limits.decisive(way);
    let found = decisive.and_then(|method| cache.limits.get(&label(whose, &method)).copied());
    Some(limits.limit(way, found))
}

fn jobs(
    ways: &[Way],
    [own, spatial]: &[Whose<'_>; 2],
    cache: &Cache,
    grid: &Grid,
    bodies: usize,
) -> Vec<Job> {
    let of_way = |way: &Way| {
        let (way, own_label) = (*way, way.stepper().label());
        let price = match way {
            Way::Kernel(method) => u64::from(method.evaluations()),
            _ => REFERENCE,
        };
        let limit = limit(*own, &way, cache)?;
        let in_space = self::limit(*spatial, &way, cache).map(|limit| limit.stable);
        let highest = own.1.map_or(0.0, Limits::highest);
        let ladder = way.ladder(highest, limit.ladder_top(), grid, bodies);
        Some(ladder.into_iter().map(move |steps| Job {
            way,
            label: own_label.clone(),
            steps,
            weight: steps * u64::from(grid.samples) * price,
            limit,
            in_space,
        }))
    };
    ways.iter().filter_map(of_way).flatten().collect()
}

/// Does jobs on all the machine's threads, in their order; `done` hears of each as it is done.
fn in_parallel<J: Sync, R: Send>(
    jobs: &[J],
    work: impl Fn(&J) -> R + Sync,
    mut done: impl FnMut(&J, R) -> Result<(), SurveyError>,
) -> Result<(), SurveyError> {
    let next = AtomicUsize::new(0);
    let threads = thread::available_parallelism().map_or(1, usize::from);
    thread::scope(|scope| {
        let (sender, results) = channel();
        for _ in 0..threads {
            let (sender, next, work) = (sender.clone(), &next, &work);
            scope.spawn(move || {
                while let Some(job) = jobs.get(next.fetch_add(1, Ordering::Relaxed)) {
                    if sender.send((job, work(job))).is_err() {
                        break;
                    }
                }
            });
        }
        drop(sender);
        results.into_iter().try_for_each(|(job, result)| done(job, result))
    })
}

/// Runs all jobs and keeps their results as they come.
fn run(
    comparison: &Comparison<'_>,
    mut jobs: Vec<&Job>,
    cache: &mut Cache,
    progress: &mut dyn FnMut(Phase),
) -> Result<(), SurveyError> {
    jobs.sort_by_key(|job| std::cmp::Reverse(job.weight));
    let all = jobs.iter().map(|job| job.weight).sum();
    let mut done = 0;
    progress(Phase::Runs(done, all));
    let accuracy = |job: &&Job| match job.limit.is_beyond(comparison.grid.step(job.steps)) {
        true => UNSTABLE,
        false => comparison.accuracy(&job.way, job.steps),
    };
    in_parallel(&jobs, accuracy, |job, accuracy| {
        let entry = Entry::Accuracy {
            way: job.label.clone(),
            steps: job.steps,
            stable: accuracy.stable,
            lost: accuracy.lost,
            error: accuracy.error,
            energy_rms: accuracy.energy_rms,
            energy_peak: accuracy.energy_peak,
        };
        cache.add(entry).map_err(SurveyError::Write)?;
        done += job.weight;
        progress(Phase::Runs(done, all));
        Ok(())
    })
}

fn point(
    instructions: &BTreeMap<String, f64>,
    job: &Job,
    grid: &Grid,
    cache: &Cache,
) -> Option<Point> {
    let entry = cache.accuracies.get(&(job.label.clone(), job.steps))?;
    let Entry::Accuracy { stable, lost, error, energy_rms, energy_peak, .. } = entry else {
        return None;
    };
    let Cost { least, median, spread } = *cache.costs.get(&job.label)?;
    let step = grid.step(job.steps);
    let stepper = job.way.stepper();
    Some(Point {
        step,
        steps: job.steps * u64::from(grid.samples),
        stable: *stable,
        lost: *lost,
        advisable: job.limit.advises(step),
        error: *error,
        energy_rms: *energy_rms,
        energy_peak: *energy_peak,
        evaluations: f64::from(job.way.evaluations()) / step,
        host_seconds_least: least / step,
        host_seconds: median / step,
        host_spread: spread,
        target_instructions: instructions.get(&job.label).map(|count| count / step),
        step_in_space: job.in_space,
        fall: Fall::default(),
        stepper,
    })
}

/// Instructions per step on Cortex-M4F, where they were counted: of the scenes that ship and some variants.
fn counted_instructions(called: &str, costs: &Costs, way: &Way) -> Option<f64> {
    let Stepper { scheme, newton, damping, precision, orientation, kernel } = &way.stepper();
    if !kernel {
        return None;
    }
    let damping = damping.as_deref();
    costs.instructions_per_step(called, scheme, *newton, damping, precision, orientation)
}
