//! A planned run, sample by sample.
//!
//! `(scene, method, plan) => samples to an observer, ending`. The kernel steps in the method's
//! precision; what is said of a sample is computed in double precision from its stored words.

use std::io;
use std::time::{Duration, Instant};

use dbd_kernel::plant::PlantError;
use dbd_kernel::status::Cause;
use dbd_kernel::{Energy, F64, Geometry, Plant, Scheme, State, Status};
use dbd_scene::{Scene, SceneModel, widen};

use crate::judge::{Judge, Verdict};
use crate::method::{Method, MethodVisitor};
use crate::numerals::Numerals;
use crate::plan::Plan;
use crate::sensors::Sensors;

/// A run is looked at this often at least, whatever its sampling interval.
const LOOKS: u64 = 1000;

/// Steps between two looks at most, so that progress is seen.
const MOST_STEPS_UNSEEN: u64 = 1024;

/// What is known at a sample.
pub struct Sample<'s> {
    /// \[s\] the time.
    pub time: f64,
    /// The state, widened exactly.
    pub state: &'s State<SceneModel<F64>>,
    /// How many digits its words have.
    pub numerals: Numerals,
    /// The scene's read-outs, one number per column; NaN where a twist is undefined.
    pub readings: &'s [f64],
    /// \[J\] its energy.
    pub energy: Energy<f64>,
    /// \[m\] the largest extension of the joints' elements.
    pub extension: f64,
    /// The hash of the stored words.
    pub hash: u64,
}

/// Receives what a run has to say.
pub trait Observer {
    /// Takes the next sample. The first is at t = 0, the last at the duration.
    ///
    /// # Errors
    /// Where it cannot be recorded; the run then ends.
    fn sample(&mut self, sample: &Sample<'_>) -> io::Result<()>;

    /// Hears of the number of steps done, now and then.
    fn progress(&mut self, steps: u64) {
        let _ = steps;
    }
}

/// How a run ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ending {
    /// Steps done, the failed one included.
    pub steps: u64,
    /// Force evaluations performed.
    pub evaluations: u64,
    /// Time on the clock spent stepping; sampling does not count.
    pub wall: Duration,
    /// Why it ended early.
    pub trouble: Option<Trouble>,
}

/// Why a run ended early.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Trouble {
    /// A step failed.
    Step(Cause),
    /// The energy of a sample is infinite or not a number, though no velocity is.
    Energy {
        /// The row of the fastest body.
        body: usize,
    },
    /// The energy grew beyond all measure, though nothing drives the scene.
    Growth {
        /// \[J\] by so much.
        growth: f64,
        /// The row of the fastest body.
        body: usize,
    },
    /// A joint is stretched beyond all that can be meant, though everything is finite.
    Torn {
        /// The row of the joint.
        joint: usize,
        /// \[m\] the extension of its elements.
        extension: f64,
    },
}

/// Why a run could not be carried out.
#[derive(Debug)]
pub enum SimulationError {
    /// The step is nothing in the method's precision.
    Plant(PlantError),
    /// A sample could not be recorded.
    Observer(io::Error),
}

/// Runs the plan to its end or to the first failure.
///
/// # Errors
/// Where the step is nothing in the method's precision, or the observer fails.
pub fn simulate(
    scene: &Scene,
    method: &Method,
    plan: &Plan,
    observer: &mut dyn Observer,
) -> Result<Ending, SimulationError> {
    method.visit(Simulation { scene, plan, observer })
}

struct Simulation<'a> {
    scene: &'a Scene,
    plan: &'a Plan,
    observer: &'a mut dyn Observer,
}

impl MethodVisitor for Simulation<'_> {
    type Output = Result<Ending, SimulationError>;

    fn visit<P: Geometry, S: Scheme>(self, scheme: S) -> Self::Output {
        let Self { scene, plan, observer } = self;
        let model: SceneModel<P> = scene.model.convert();
        let mut sensors = Sensors::<P>::new(scene);
        let mut judge = Judge::new(scene, &model, plan.step);
        let mut plant = Plant::new(&model, scheme, plan.step).map_err(SimulationError::Plant)?;
        let stride = (plan.steps / LOOKS).clamp(1, MOST_STEPS_UNSEEN);
        let mut wall = Duration::ZERO;
        let mut next_sample = 0;
        let trouble = loop {
            let state = widen(plant.state());
            let verdict = match judge.judge(&state) {
                Ok(verdict) => verdict,
                Err(trouble) => break Some(trouble),
            };
            let done = state.step;
            observer.progress(done);
            if done == next_sample {
                let readings = sensors.read(&plant);
                let sample = Sample::new(&plant, &state, readings, &verdict);
                observer.sample(&sample).map_err(SimulationError::Observer)?;
                next_sample = plan.steps.min(next_sample + plan.stride);
            }
            if done == plan.steps {
                break None;
            }
            let start = Instant::now();
            let trouble = step_to(&mut plant, next_sample.min(done + stride));
            wall += start.elapsed();
            if trouble.is_some() {
                break trouble;
            }
        };
        let (steps, evaluations) = (plant.state().step, plant.evaluations());
        Ok(Ending { steps, evaluations, wall, trouble })
    }
}

impl<'s> Sample<'s> {
    fn new<P: Geometry, S: Scheme>(
        plant: &Plant<&SceneModel<P>, S>,
        state: &'s State<SceneModel<F64>>,
        readings: &'s [f64],
        verdict: &Verdict,
    ) -> Self {
        Self {
            time: plant.time(),
            state,
            numerals: Numerals::of::<P>(),
            readings,
            energy: verdict.energy,
            extension: verdict.extension,
            hash: plant.hash(),
        }
    }
}

fn step_to<P: Geometry, S: Scheme>(
    plant: &mut Plant<&SceneModel<P>, S>,
    end: u64,
) -> Option<Trouble> {
    while plant.state().step < end {
        if let Status::Failed(failure) = plant.step() {
            return Some(Trouble::Step(failure.cause));
        }
    }
    None
}
