//! A planned run, sample by sample.
//!
//! `(scene, method, plan) => samples to an observer, ending`. The kernel steps in the method's
//! precision; what is said of a sample is computed in double precision from its stored words.

use std::io;
use std::time::{Duration, Instant};

use dbd_kernel::{Energy, F64, State, Status};
use dbd_plant::judge::{Judge, Opening, Trouble, Turning, Verdict};
use dbd_plant::numerals::Numerals;
use dbd_plant::readings::append;
use dbd_plant::{AnyPlant, Method, Plan, PlantError, plant};
use dbd_scene::{Scene, SceneModel};
use miette::Diagnostic;
use thiserror::Error;

use super::rows::Rows;

/// A run is looked at about this often, whatever its sampling interval.
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
    /// \[m\] the largest of each joint's, in scene order.
    pub extensions: &'s [f64],
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

    /// Whether the run is to go on after the last sample.
    fn goes_on(&self) -> bool {
        true
    }

    /// Hears of the number of steps done, now and then.
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
    pub trouble: Option<Trouble>,
    /// How far each joint opened, seen at the samples and about a thousand times over the run.
    pub openings: Vec<Opening>,
    /// The body that turned furthest in a step, seen likewise.
    pub turning: Turning,
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

/// Runs the plan to its end, to the first failure or to where the observer has seen enough.
///
/// # Errors
/// Where there is no plant of the method with the plan's step, or the observer fails.
pub fn simulate(
    scene: &Scene,
    method: &Method,
    plan: &Plan,
    observer: &mut dyn Observer,
) -> Result<Ending, SimulationError> {
    let rows = Rows::new(scene, method, plan, unseen(plan).min(plan.stride));
    simulate_with(rows, scene, method, plan, observer)
}

/// [`simulate`] with steps of a chosen kind.
///
/// # Errors
/// As [`simulate`].
fn simulate_with(
    mut rows: Rows,
    scene: &Scene,
    method: &Method,
    plan: &Plan,
    observer: &mut dyn Observer,
) -> Result<Ending, SimulationError> {
    let mut course = Course::new(scene, method, plan)?;
    let mut wall = Duration::ZERO;
    let trouble = loop {
        let steps = match course.look(observer)? {
            Ok(0) => break None,
            Ok(steps) => steps,
            Err(trouble) => break Some(trouble),
        };
        let start = Instant::now();
        let status = rows.advance(course.plant.as_mut(), steps);
        wall += start.elapsed();
        if let Status::Failed(failure) = status {
            break Some(Trouble::Step(failure.cause));
        }
    };
    let evaluations = rows.evaluations(course.plant.as_ref());
    Ok(course.ending(evaluations, wall, trouble))
}

/// Steps between two looks at most.
fn unseen(plan: &Plan) -> u64 {
    (plan.steps / LOOKS).clamp(1, MOST_STEPS_UNSEEN)
}

/// A run under way, from look to look.
pub(super) struct Course<'c> {
    scene: &'c Scene,
    plan: &'c Plan,
    /// What is looked at.
    pub(super) plant: Box<dyn AnyPlant>,
    judge: Judge,
    readings: Vec<f64>,
    /// Steps between two looks at most.
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
        let judge = Judge::new(scene, plant.as_ref());
        let stride = unseen(plan);
        Ok(Self { scene, plan, plant, judge, readings: Vec::new(), stride, next_sample: 0 })
    }

    /// Looks at the plant; the observer hears of a sample where one is due. Steps to the next look, none where
    /// the run is at its end.
    ///
    /// # Errors
    /// Where the observer fails; inside, where the run cannot go on.
    pub(super) fn look(
        &mut self,
        observer: &mut dyn Observer,
    ) -> Result<Result<u64, Trouble>, SimulationError> {
        let state = self.plant.state();
        let verdict = match self.judge.judge(&state) {
            Ok(verdict) => verdict,
            Err(trouble) => return Ok(Err(trouble)),
        };
        let done = state.step;
        observer.progress(done);
        if done == self.next_sample {
            read(self.scene, self.plant.as_ref(), &mut self.readings);
            let sample = Sample {
                extensions: self.judge.extensions(),
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
        trouble: Option<Trouble>,
    ) -> Ending {
        Ending {
            steps: self.plant.steps(),
            evaluations,
            wall,
            trouble,
            openings: self.judge.openings().to_vec(),
            turning: self.judge.turning(),
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
            numerals: plant.numerals(),
            readings,
            energy: verdict.energy,
            extension: verdict.extension,
            extensions: &[],
            hash: plant.hash(),
        }
    }
}

#[cfg(test)]
mod tests {
    use std::io;

    use dbd_bench::chain::{self, Joints};
    use dbd_plant::PrecisionName;
    use dbd_plant::plan::{Request, StepRequest, plan};

    use super::*;
    use crate::simulate::rows::FEWEST;

    /// Keeps all hashes and energies.
    #[derive(Debug, Default, PartialEq)]
    struct Seen(Vec<(u64, f64)>);

    impl Observer for Seen {
        fn sample(&mut self, sample: &Sample<'_>) -> io::Result<()> {
            self.0.push((sample.hash, sample.energy.total()));
            Ok(())
        }
    }

    /// A run in lanes and one without, of the same chain.
    fn both(changes: &[String], precision: PrecisionName) -> (Seen, Ending) {
        let text = chain::text(FEWEST, Joints::Revolute);
        let scene = Scene::parse_with(&text, "chain.toml", changes).unwrap();
        let method = Method::default().with_precision(precision);
        let step = StepRequest::Given(chain::STEP);
        let request =
            Request { step, duration: 200.0 * chain::STEP, every: Some(40.0 * chain::STEP) };
        let plan = plan(&request).unwrap();
        let rows = Rows::of(&scene, &method, plan.step);
        assert!(rows.are_there());
        let mut seen = Seen::default();
        let ending = simulate_with(rows, &scene, &method, &plan, &mut seen).unwrap();
        // Too few steps between looks: by its plant.
        let mut alone = Seen::default();
        let own = simulate(&scene, &method, &plan, &mut alone).unwrap();
        assert_eq!(seen, alone);
        assert_eq!(Ending { wall: own.wall, ..ending }, own);
        (seen, own)
    }

    #[test]
    fn a_run_in_lanes_is_the_run_of_its_plant() {
        for precision in [PrecisionName::F64, PrecisionName::F32] {
            let (seen, ending) = both(&[], precision);
            assert_eq!((seen.0.len(), ending.steps, ending.evaluations), (6, 200, 201));
            // It comes apart on its way.
            let (_, ending) = both(&["joint.*.stiffness=3e9".to_owned()], precision);
            assert!(ending.trouble.is_some() && ending.steps > 1, "{ending:?}");
        }
    }
}
