//! A planned run, sample by sample.
//!
//! `(scene, method, plan) => samples to an observer, ending`. The kernel steps in the method's
//! precision; the quantities of a sample are computed in double precision from its stored words.

use std::io;
use std::time::{Duration, Instant};

use dbd_kernel::{Energy, F64, Failure, State};
use dbd_plant::monitor::{Monitor, Opening, Reversal, RunFailure, Turning, Verdict};
use dbd_plant::number_format::NumberFormat;
use dbd_plant::readings::append;
use dbd_plant::rounding::{Loss, RoundingWatch};
use dbd_plant::{AnyPlant, Method, Plan, PlantError, plant};
use dbd_scene::{Scene, SceneModel};
use miette::Diagnostic;
use thiserror::Error;

use crate::simulate::engaged::{Engagement, Engagements};

/// A sample.
pub struct Sample<'s> {
    /// \[s\] the time.
    pub time: f64,
    /// The state, widened exactly.
    pub state: &'s State<SceneModel<F64>>,
    /// The precision of its words.
    pub number_format: NumberFormat,
    /// The scene's read-outs, one number per column; NaN if a torsion angle is undefined.
    pub readings: &'s [f64],
    /// \[J\] its energy.
    pub energy: Energy<f64>,
    /// \[m\] the largest extension of the joints' elements.
    pub extension: f64,
    /// \[m\] the largest of each joint's, in scene order.
    pub extensions: &'s [f64],
    /// The hash of the stored words.
    pub hash: u64,
}

/// Observes a run.
pub trait Observer {
    /// Takes the next sample. The first is at t = 0, the last at the duration.
    ///
    /// # Errors
    /// If it cannot be recorded; the run then ends.
    fn sample(&mut self, sample: &Sample<'_>) -> io::Result<()>;

    /// Whether the run continues after the last sample.
    fn goes_on(&self) -> bool {
        true
    }

    /// Called occasionally with the number of steps done.
    fn progress(&mut self, steps: u64) {
        let _ = steps;
    }
}

/// How a run ended.
#[derive(Clone, Debug, PartialEq)]
pub struct Ending {
    /// Steps done, the failed one included.
    pub steps: u64,
    /// Force evaluations performed.
    pub evaluations: u64,
    /// Time on the clock spent stepping; sampling does not count.
    pub wall: Duration,
    /// Why it ended early.
    pub run_failure: Option<RunFailure>,
    /// The largest opening of each joint, checked at the samples and about a thousand times per run.
    pub openings: Vec<Opening>,
    /// The body with the largest rotation in a step, checked likewise.
    pub turning: Turning,
    /// The motion of bodies lost in single precision, checked at every step.
    pub losses: Vec<Loss>,
    /// The springs named as one-sided parts, and whether they acted on the other side, checked likewise.
    pub reversals: Vec<Reversal>,
    /// Engagements of stops, ropes and contacts, checked likewise.
    pub engagements: Vec<Engagement>,
}

/// Why a run could not be carried out.
#[derive(Debug, Error, Diagnostic)]
pub enum SimulationError {
    /// There is no plant of the method with this step.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Plant(#[from] PlantError),
    /// A sample could not be recorded.
    #[error("cannot write the results: {0}")]
    Observer(io::Error),
}

/// Runs the plan to its end, to the first failure or until the observer stops it.
///
/// # Errors
/// Where there is no plant of the method with the plan's step, or the observer fails.
pub fn simulate(
    scene: &Scene,
    method: &Method,
    plan: &Plan,
    observer: &mut dyn Observer,
) -> Result<Ending, SimulationError> {
    let mut course = Course::new(scene, method, plan)?;
    let mut wall = Duration::ZERO;
    let run_failure = loop {
        let steps = match course.look(observer)? {
            Ok(0) => break None,
            Ok(steps) => steps,
            Err(run_failure) => break Some(run_failure),
        };
        if let Err(failure) = course.advance(steps, &mut wall) {
            break Some(RunFailure::Step(failure.cause));
        }
    };
    let evaluations = course.plant.evaluations();
    Ok(course.ending(evaluations, wall, run_failure))
}

/// A run in progress, from check to check.
pub(super) struct Course<'c> {
    scene: &'c Scene,
    plan: &'c Plan,
    /// The checked quantities.
    pub(super) plant: Box<dyn AnyPlant>,
    monitor: Monitor,
    rounding: Option<RoundingWatch>,
    engagements: Engagements,
    readings: Vec<f64>,
    /// Largest number of steps between two checks.
    stride: u64,
    next_sample: u64,
}

impl<'c> Course<'c> {
    /// A run at its start.
    ///
    /// # Errors
    /// Where there is no plant of the method with the plan's step.
    pub(super) fn new(
        scene: &'c Scene,
        method: &Method,
        plan: &'c Plan,
    ) -> Result<Self, PlantError> {
        let plant = plant(scene, method, plan.step)?;
        let monitor = Monitor::new(scene, plant.as_ref());
        let rounding = RoundingWatch::new(plant.as_ref());
        let engagements = Engagements::new(scene);
        let stride = plan.unseen();
        let readings = Vec::new();
        Ok(Self {
            scene,
            plan,
            plant,
            monitor,
            rounding,
            engagements,
            readings,
            stride,
            next_sample: 0,
        })
    }

    /// Steps, one by one where rounding is watched. `wall` grows by the time spent stepping.
    fn advance(&mut self, steps: u64, wall: &mut Duration) -> Result<(), Failure> {
        let mut timed = |plant: &mut dyn AnyPlant, steps| {
            let start = Instant::now();
            let status = plant.advance(steps);
            *wall += start.elapsed();
            status
        };
        let Some(rounding) = &mut self.rounding else { return timed(self.plant.as_mut(), steps) };
        let mut status = self.plant.status();
        for _ in 0..steps {
            status = timed(self.plant.as_mut(), 1);
            if status.is_err() {
                break;
            }
            rounding.look(self.plant.as_ref());
        }
        status
    }

    /// Checks the plant; the observer receives a sample if one is due. Returns the steps to the next check, `None` if
    /// the run is complete.
    ///
    /// # Errors
    /// If the observer fails; inside, if the run cannot continue.
    pub(super) fn look(
        &mut self,
        observer: &mut dyn Observer,
    ) -> Result<Result<u64, RunFailure>, SimulationError> {
        let state = self.plant.state();
        let verdict = match self.monitor.check(&state) {
            Ok(verdict) => verdict,
            Err(run_failure) => return Ok(Err(run_failure)),
        };
        let done = state.step;
        self.engagements.look(self.plant.as_ref());
        observer.progress(done);
        if done == self.next_sample {
            read(self.scene, self.plant.as_ref(), &mut self.readings);
            let sample = Sample {
                extensions: self.monitor.extensions(),
                ..Sample::new(self.plant.as_ref(), &state, &self.readings, &verdict)
            };
            observer.sample(&sample).map_err(SimulationError::Observer)?;
            self.next_sample = self.plan.steps.min(self.next_sample + self.plan.stride);
        }
        if done == self.plan.steps || !observer.goes_on() {
            return Ok(Ok(0));
        }
        Ok(Ok(self.next_sample.min(done + self.stride) - done))
    }

    /// How it ended.
    pub(super) fn ending(
        self,
        evaluations: u64,
        wall: Duration,
        run_failure: Option<RunFailure>,
    ) -> Ending {
        Ending {
            steps: self.plant.steps(),
            evaluations,
            wall,
            run_failure,
            openings: self.monitor.openings().to_vec(),
            turning: self.monitor.turning(),
            losses: self.rounding.as_ref().map(RoundingWatch::losses).unwrap_or_default(),
            reversals: self.monitor.reversals().to_vec(),
            engagements: self.engagements.found(),
        }
    }
}

/// The scene's read-outs now, one number per column of the trace.
fn read(scene: &Scene, plant: &dyn AnyPlant, readings: &mut Vec<f64>) {
    readings.clear();
    for info in &scene.readouts {
        append(plant.read(&info.readout), info.columns.len(), readings);
    }
}

impl<'s> Sample<'s> {
    fn new(
        plant: &dyn AnyPlant,
        state: &'s State<SceneModel<F64>>,
        readings: &'s [f64],
        verdict: &Verdict,
    ) -> Self {
        Self {
            time: plant.time(),
            state,
            number_format: plant.number_format(),
            readings,
            energy: verdict.energy,
            extension: verdict.extension,
            extensions: &[],
            hash: plant.hash(),
        }
    }
}
