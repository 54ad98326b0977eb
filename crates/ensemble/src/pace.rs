//! Speed of an ensemble compared with its instances one after the other.
//!
//! `(model, scheme, h, instruction set, threads) => steps per second of each`. All in one process, alternating, from
//! the same state.

use std::num::NonZeroUsize;
use std::thread;
use std::time::Instant;

use dbd_kernel::Plant;
use dbd_kernel::geometry::Float;
use dbd_scene::SceneModel;

use crate::batch::PlantOf;
use crate::ensemble::{Ensemble, EnsembleError};
use crate::in_lanes::InLanes;
use crate::instructions::InstructionSet;
use crate::number::Number;

/// Measurement settings.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Course {
    /// The instruction set.
    pub set: InstructionSet,
    /// Number of threads that step the ensemble. Threads are started in each round, so a round should take much longer
    /// than that.
    pub threads: NonZeroUsize,
    /// Steps of each instance in a round.
    pub steps: u64,
    /// Rounds, each of which times all variants.
    pub rounds: NonZeroUsize,
}

/// Steps per second, of all instances together.
#[derive(Clone, Debug, PartialEq)]
pub struct Pace {
    /// Instances, a full batch for each thread.
    pub instances: usize,
    /// The ensemble, per round.
    pub together: Vec<f64>,
    /// The same ensemble on one thread, per round; empty if it has only one.
    pub on_one_thread: Vec<f64>,
    /// Its instances one after the other on one thread, per round.
    pub alone: Vec<f64>,
    /// Its separate instances on as many threads, per round; empty if it has only one.
    pub alone_on_threads: Vec<f64>,
}

impl Pace {
    /// Speed-up of the ensemble: the median of the rounds' ratios.
    #[must_use]
    pub fn ratio(&self) -> f64 {
        median(&ratios(&self.together, &self.alone)).unwrap_or(f64::NAN)
    }

    /// Speed-up of its threads over one: the median of the rounds' ratios; `None` with one thread.
    #[must_use]
    pub fn over_one_thread(&self) -> Option<f64> {
        median(&ratios(&self.together, &self.on_one_thread))
    }

    /// The same for separate instances, which share nothing: the limit of the machine's cores.
    #[must_use]
    pub fn alone_over_one_thread(&self) -> Option<f64> {
        median(&ratios(&self.alone_on_threads, &self.alone))
    }

    /// Half the interquartile range of the rounds' ratios over their median.
    #[must_use]
    pub fn spread(&self) -> f64 {
        let ratios = ratios(&self.together, &self.alone);
        let at = |quarters: usize| ratios.get(quarters * ratios.len() / 4).copied();
        at(1).zip(at(3)).map_or(f64::NAN, |(low, high)| 0.5 * (high - low) / self.ratio())
    }

    /// The ratio of the fastest rounds of each, which other programs disturbed least.
    #[must_use]
    pub fn best_ratio(&self) -> f64 {
        let most = |rates: &[f64]| rates.iter().copied().fold(f64::NAN, f64::max);
        most(&self.together) / most(&self.alone)
    }

    /// Without rounds.
    fn of(instances: usize) -> Self {
        let [together, on_one_thread, alone, alone_on_threads] = [const { Vec::new() }; 4];
        Self { instances, together, on_one_thread, alone, alone_on_threads }
    }

    /// Adds a round of `done` steps.
    fn push(&mut self, done: f64, times: &Times) {
        self.together.push(done / times.together);
        self.on_one_thread.extend(times.on_one_thread.map(|time| done / time));
        self.alone.push(done / times.alone);
        self.alone_on_threads.extend(times.alone_on_threads.map(|time| done / time));
    }
}

/// \[s\] duration of a round.
struct Times {
    together: f64,
    on_one_thread: Option<f64>,
    alone: f64,
    alone_on_threads: Option<f64>,
}

/// \[s\] duration of some work.
fn seconds(work: impl FnOnce()) -> f64 {
    let start = Instant::now();
    work();
    start.elapsed().as_secs_f64()
}

/// Steps of plants one after the other.
fn each<R: Number, S: InLanes>(plants: &mut [PlantOf<R, S>], steps: u64) {
    for plant in plants {
        let _ = plant.advance(steps);
    }
}

/// The same on several threads, including this one.
fn each_on<R: Number, S: InLanes + Send>(
    plants: &mut [PlantOf<R, S>],
    threads: NonZeroUsize,
    steps: u64,
) {
    let share = plants.len().div_ceil(threads.get()).max(1);
    let (own, others) = plants.split_at_mut(share.min(plants.len()));
    thread::scope(|scope| {
        others.chunks_mut(share).for_each(|plants| _ = scope.spawn(move || each(plants, steps)));
        each(own, steps);
    });
}

/// The rounds' ratios in ascending order.
fn ratios(rates: &[f64], of: &[f64]) -> Vec<f64> {
    let mut ratios: Vec<f64> = rates.iter().zip(of).map(|(rate, of)| rate / of).collect();
    ratios.sort_by(f64::total_cmp);
    ratios
}

fn median(sorted: &[f64]) -> Option<f64> {
    sorted.get(sorted.len() / 2).copied()
}

/// Times an ensemble of identical instances of `model` against separate plants.
///
/// # Errors
/// [`EnsembleError`] if the machine lacks the instruction set, or the step is not representable.
pub fn pace<R: Number, S: InLanes + Send + 'static>(
    model: &SceneModel<Float<R>>,
    scheme: S,
    step_size: f64,
    course: Course,
) -> Result<Pace, EnsembleError> {
    let Course { set, threads, steps, rounds } = course;
    let instances = R::lanes(set) * threads.get();
    let plants: Result<Vec<PlantOf<R, S>>, _> =
        (0..instances).map(|_| Plant::new(Box::new(model.clone()), scheme, step_size)).collect();
    let mut plants = plants.map_err(|_| EnsembleError::Step { step: step_size })?;
    let ensemble =
        || Ensemble::with_instructions(vec![model.clone(); instances], scheme, step_size, set);
    let mut on_threads = ensemble()?;
    let mut on_one = if threads.get() > 1 { Some(ensemble()?) } else { None };
    let mut pace = Pace::of(instances);
    // The first round warms the caches.
    for round in 0..=rounds.get() {
        for ensemble in on_one.iter_mut().chain([&mut on_threads]) {
            (0..instances).for_each(|instance| ensemble.plant_mut(instance).reset());
            // Lanes are filled before the first step.
            ensemble.advance(1);
        }
        for plant in &mut plants {
            plant.reset();
            let _ = plant.step();
        }
        let times = Times {
            together: seconds(|| on_threads.advance_on(threads, steps)),
            on_one_thread: on_one.as_mut().map(|one| seconds(|| one.advance(steps))),
            alone: seconds(|| each(&mut plants, steps)),
            alone_on_threads: (threads.get() > 1)
                .then(|| seconds(|| each_on(&mut plants, threads, steps))),
        };
        if round > 0 {
            pace.push(steps as f64 * instances as f64, &times);
        }
    }
    Ok(pace)
}
