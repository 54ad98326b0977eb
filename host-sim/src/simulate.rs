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

/// Steps between two reports of progress.
const STRIDE_OF_PROGRESS: u64 = 1024;

/// What is known at a sample.
pub struct Sample<'s> {
    /// \[s\] the time.
    pub time: f64,
    /// The state, widened exactly.
    pub state: &'s State<SceneModel<F64>>,
    /// How many digits its words have.
    pub numerals: Numerals,
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
        let judge = Judge::new(scene, &model, plan.step);
        let mut plant = Plant::new(&model, scheme, plan.step).map_err(SimulationError::Plant)?;
        let mut wall = Duration::ZERO;
        let mut trouble = sample(&judge, &plant, observer)?;
        let mut next_sample = 0;
        while trouble.is_none() && plant.state().step < plan.steps {
            next_sample = plan.steps.min(next_sample + plan.stride);
            while trouble.is_none() && plant.state().step < next_sample {
                let pause = next_sample.min(plant.state().step + STRIDE_OF_PROGRESS);
                let start = Instant::now();
                trouble = step_to(&mut plant, pause);
                wall += start.elapsed();
                observer.progress(plant.state().step);
            }
            if trouble.is_none() {
                trouble = sample(&judge, &plant, observer)?;
            }
        }
        let (steps, evaluations) = (plant.state().step, plant.evaluations());
        Ok(Ending { steps, evaluations, wall, trouble })
    }
}

/// Hands the plant's present state to the observer, unless it is none to go on from.
fn sample<P: Geometry, S: Scheme>(
    judge: &Judge,
    plant: &Plant<'_, SceneModel<P>, S>,
    observer: &mut dyn Observer,
) -> Result<Option<Trouble>, SimulationError> {
    let state = widen(plant.state());
    let Verdict { energy, extension } = match judge.judge(&state) {
        Ok(verdict) => verdict,
        Err(trouble) => return Ok(Some(trouble)),
    };
    let sample = Sample {
        time: plant.time(),
        state: &state,
        numerals: Numerals::of::<P>(),
        energy,
        extension,
        hash: plant.hash(),
    };
    observer.sample(&sample).map_err(SimulationError::Observer)?;
    Ok(None)
}

fn step_to<P: Geometry, S: Scheme>(
    plant: &mut Plant<'_, SceneModel<P>, S>,
    end: u64,
) -> Option<Trouble> {
    while plant.state().step < end {
        if let Status::Failed(failure) = plant.step() {
            return Some(Trouble::Step(failure.cause));
        }
    }
    None
}
