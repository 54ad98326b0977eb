//! How fast lanes are beside plants by themselves: an ensemble beside its instances one after the other, a large model
//! in lanes beside its plant.
//!
//! `(model, scheme, h, instruction set, threads) => steps per second of both`. Both in one process, in
//! turn, from the same state.

use std::num::NonZeroUsize;
use std::time::Instant;

use dbd_kernel::geometry::Float;
use dbd_kernel::{Leapfrog, Plant};
use dbd_scene::SceneModel;

use crate::batch::PlantOf;
use crate::ensemble::{Ensemble, EnsembleError};
use crate::in_lanes::InLanes;
use crate::instructions::InstructionSet;
use crate::large::{Large, Refused};
use crate::number::Number;

/// What is measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Course {
    /// The instruction set.
    pub set: InstructionSet,
    /// How many threads step the ensemble; those that step alone have one.
    pub threads: NonZeroUsize,
    /// Steps of each instance in a round.
    pub steps: u64,
    /// Rounds, of which each times both.
    pub rounds: NonZeroUsize,
}

/// Steps per second, of all instances together.
#[derive(Clone, Debug, PartialEq)]
pub struct Pace {
    /// Instances, a full batch for each thread.
    pub instances: usize,
    /// Of the ensemble, round by round.
    pub together: Vec<f64>,
    /// Of its instances one after the other on one thread, round by round.
    pub alone: Vec<f64>,
}

impl Pace {
    /// How many times faster the ensemble is: the median of the rounds' ratios.
    #[must_use]
    pub fn ratio(&self) -> f64 {
        let ratios = self.ratios();
        ratios.get(ratios.len() / 2).copied().unwrap_or(f64::NAN)
    }

    /// How far the middle half of the rounds' ratios lies apart, half of it over the median.
    #[must_use]
    pub fn spread(&self) -> f64 {
        let ratios = self.ratios();
        let at = |quarters: usize| ratios.get(quarters * ratios.len() / 4).copied();
        at(1).zip(at(3)).map_or(f64::NAN, |(low, high)| 0.5 * (high - low) / self.ratio())
    }

    /// The rounds' ratios, the least first.
    fn ratios(&self) -> Vec<f64> {
        let rounds = self.together.iter().zip(&self.alone);
        let mut ratios: Vec<f64> = rounds.map(|(together, alone)| together / alone).collect();
        ratios.sort_by(f64::total_cmp);
        ratios
    }

    /// The ratio of the fastest rounds of each: what other programs took least from.
    #[must_use]
    pub fn best_ratio(&self) -> f64 {
        let most = |rates: &[f64]| rates.iter().copied().fold(f64::NAN, f64::max);
        most(&self.together) / most(&self.alone)
    }
}

/// Times an ensemble of alike instances of `model` against the same plants by themselves.
///
/// # Errors
/// [`EnsembleError`] where the machine lacks the instruction set, or the step is none.
pub fn pace<R: Number, S: InLanes + Send + 'static>(
    model: &SceneModel<Float<R>>,
    scheme: S,
    step_size: f64,
    course: Course,
) -> Result<Pace, EnsembleError> {
    let Course { set, threads, steps, rounds } = course;
    let instances = R::lanes(set) * threads.get();
    let models = vec![model.clone(); instances];
    let mut plants = Vec::with_capacity(instances);
    for model in &models {
        let plant: PlantOf<R, S> = Plant::new(Box::new(model.clone()), scheme, step_size)
            .map_err(|_| EnsembleError::Step { step: step_size })?;
        plants.push(plant);
    }
    let mut ensemble = Ensemble::with_instructions(models, scheme, step_size, set)?;
    let mut pace = Pace { instances, together: Vec::new(), alone: Vec::new() };
    let done = steps as f64 * instances as f64;
    // The first round brings code and data in.
    for round in 0..=rounds.get() {
        (0..instances).for_each(|instance| ensemble.plant_mut(instance).reset());
        plants.iter_mut().for_each(Plant::reset);
        // Lanes are filled before their first step.
        ensemble.advance(1);
        plants.iter_mut().for_each(|plant| _ = plant.step());
        let start = Instant::now();
        ensemble.advance_on(threads, steps);
        let together = done / start.elapsed().as_secs_f64();
        let start = Instant::now();
        for plant in &mut plants {
            let _ = plant.advance(steps);
        }
        let alone = done / start.elapsed().as_secs_f64();
        if round > 0 {
            pace.together.push(together);
            pace.alone.push(alone);
        }
    }
    Ok(pace)
}

/// Times a large model in lanes against its plant by itself, leapfrog.
///
/// # Errors
/// [`Refused`] where the model does not fit or the machine lacks the instruction set.
///
/// # Panics
/// Where the step is none.
pub fn pace_of_large<R: Number>(
    model: &SceneModel<Float<R>>,
    step_size: f64,
    course: Course,
) -> Result<Pace, Refused<R>> {
    let Course { set, threads, steps, rounds } = course;
    let plant = || -> PlantOf<R, Leapfrog> {
        Plant::new(Box::new(model.clone()), Leapfrog, step_size).expect("a step")
    };
    let mut plant_alone = plant();
    let mut large = Large::with_instructions(plant(), set)?.on(threads);
    let mut pace = Pace { instances: 1, together: Vec::new(), alone: Vec::new() };
    for round in 0..=rounds.get() {
        large.plant_mut().reset();
        plant_alone.reset();
        // Lanes are filled before their first step.
        let _ = (large.advance(1), plant_alone.step());
        let start = Instant::now();
        let _ = large.advance(steps);
        let together = steps as f64 / start.elapsed().as_secs_f64();
        let start = Instant::now();
        let _ = plant_alone.advance(steps);
        let alone = steps as f64 / start.elapsed().as_secs_f64();
        if round > 0 {
            pace.together.push(together);
            pace.alone.push(alone);
        }
    }
    Ok(pace)
}
