//! A planned run, sample by sample.
//!
//! `(scene, method, plan) => samples to an observer, ending`. The kernel steps in the method's
//! precision; what is said of a sample is computed in double precision from its stored words.

use std::io;
use std::time::{Duration, Instant};

use dbd_kernel::energy::{energy, largest_extension};
use dbd_kernel::model::Group;
use dbd_kernel::plant::PlantError;
use dbd_kernel::status::Cause;
use dbd_kernel::{BodyState, Energy, F64, Geometry, Plant, Scheme, State, Status};
use dbd_scene::{Scene, SceneModel, widen};

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
    pub numerals: &'s Numerals,
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
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Trouble {
    /// A step failed.
    Step(Cause),
    /// The energy of a sample is infinite or not a number, though no velocity is.
    Energy {
        /// The row of the fastest body.
        body: usize,
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
        let mut trouble = judge.observe(&plant, observer)?;
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
                trouble = judge.observe(&plant, observer)?;
            }
        }
        let (steps, evaluations) = (plant.state().step, plant.evaluations());
        Ok(Ending { steps, evaluations, wall, trouble })
    }
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

/// The model that runs, its stored words taken as exact in double precision.
struct Judge {
    model: SceneModel<F64>,
    /// The joints' elements alone.
    joints: SceneModel<F64>,
    numerals: Numerals,
    step_size: f64,
}

impl Judge {
    fn new<P: Geometry>(scene: &Scene, model: &SceneModel<P>, step_size: f64) -> Self {
        let model_of_judge: SceneModel<F64> = model.convert();
        let mut joints = model_of_judge.clone();
        joints.groups.truncate(joint_groups(scene));
        Self { model: model_of_judge, joints, numerals: Numerals::of::<P>(), step_size }
    }

    /// Hands the plant's present state to the observer, unless its energy is not a number.
    fn observe<P: Geometry, S: Scheme>(
        &self,
        plant: &Plant<'_, SceneModel<P>, S>,
        observer: &mut dyn Observer,
    ) -> Result<Option<Trouble>, SimulationError> {
        let state = widen(plant.state());
        let energy = energy(&self.model, &state, self.step_size);
        let extension = largest_extension(&self.joints, &state);
        if !energy.total().is_finite() {
            return Ok(Some(Trouble::Energy { body: fastest(&state) }));
        }
        let sample = Sample {
            time: plant.time(),
            state: &state,
            numerals: &self.numerals,
            energy,
            extension,
            hash: plant.hash(),
        };
        observer.sample(&sample).map_err(SimulationError::Observer)?;
        Ok(None)
    }
}

/// The row of the body with the largest component of a velocity.
fn fastest(state: &State<SceneModel<F64>>) -> usize {
    let speed = |body: &BodyState<F64>| {
        let components = [body.velocity.to_f64(), body.angular_velocity.to_f64()];
        components.as_flattened().iter().fold(0.0, |most: f64, v| most.max(v.abs()))
    };
    let speeds = state.bodies.iter().map(speed).enumerate();
    speeds.max_by(|a, b| a.1.total_cmp(&b.1)).map_or(0, |(row, _)| row)
}

/// The number of groups that joints expanded into; raw elements come after them.
fn joint_groups(scene: &Scene) -> usize {
    let elements: usize = scene.joints.iter().map(|joint| joint.tsdas).sum();
    let mut counted = 0;
    let is_of_joint = |group: &&Group| {
        counted += group.elements();
        counted <= elements
    };
    scene.model.groups.iter().take_while(is_of_joint).count()
}
