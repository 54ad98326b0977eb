//! Failed runs: position, cause, and a step that works.
//!
//! `(failure, scene, plan) => sentence`, the cause before the symptom if it is known: the step is the cause if it
//! exceeds the scheme's stability limit at t = 0, or if a shorter one works. A step is only named after a run with it
//! over the same duration has completed. The candidates are the advised step, shortened to a round one that fits, and
//! its halves, all shorter than the failed one. Together they cost no more evaluations than the failed run, or
//! `LEAST_BUDGET` if that is more.

use std::fmt;

use dbd_scene::Scene;
use miette::Diagnostic;

use crate::digits::significant;
use crate::monitor::{Monitor, RunFailure};
use crate::plan::{Request, StepRequest, plan};
use crate::time::display;
use crate::{Frequencies, Method, Plan, plant};

/// How often the advised step is halved.
const HALVINGS: u32 = 4;

/// Minimum budget of the candidates in evaluations of an element or body: 2 s at 10 ns each.
const LEAST_BUDGET: f64 = 2e8;

/// A run that failed.
#[derive(Clone, Debug, PartialEq)]
pub struct FailedRun {
    /// Cause, if it is known, e.g. `step too large: ω·h = 3.1 at t = 0`.
    pub cause: Option<String>,
    /// Symptom, e.g. ``the velocity of body `crank` is not finite``.
    pub what: String,
    /// The step that failed, counted from 1.
    pub step: u64,
    /// Planned number of steps.
    pub steps: u64,
    /// \[s\] the step size.
    pub step_size: f64,
    /// \[s\] the time after the step that failed.
    pub time: f64,
    /// Remedy.
    pub remedy: Remedy,
}

/// Remedy of a failed run.
#[derive(Clone, Debug, PartialEq)]
pub enum Remedy {
    /// \[s\] a step with which the same run completes.
    Step(f64),
    /// \[s\] these shorter steps fail, too.
    NoneOf(Vec<f64>),
    /// \[s\] a step whose run would take too long to test.
    Untried(f64),
    /// No search for a step was made.
    Unsought,
}

impl FailedRun {
    /// Describes the failure of a run in its step `failed`, and searches for a step that works; `every` is the sampling
    /// interval, if given. `progress` receives the evaluations made and allowed.
    #[must_use]
    pub fn new(
        scene: &Scene,
        method: &Method,
        run: &Plan,
        every: Option<f64>,
        failed: u64,
        run_failure: RunFailure,
        progress: &mut dyn FnMut(u64, u64),
    ) -> Self {
        let budget = LEAST_BUDGET.max(cost(scene, method, failed));
        let search = Search { scene, method, budget, spent: 0.0, progress };
        let remedy = search.remedy(run, every);
        let cause = cause(scene, method, run.step, &remedy);
        Self { cause, remedy, ..Self::untried(scene, run, failed, run_failure) }
    }

    /// Describes the failure without searching for a step, which would require further runs.
    #[must_use]
    pub fn untried(scene: &Scene, run: &Plan, failed: u64, run_failure: RunFailure) -> Self {
        Self {
            cause: None,
            what: describe(scene, run_failure),
            step: failed,
            steps: run.steps,
            step_size: run.step,
            time: run.time(failed),
            remedy: Remedy::Unsought,
        }
    }

    /// The remedy as a sentence.
    #[must_use]
    pub fn advice(&self) -> String {
        match &self.remedy {
            Remedy::Step(step) => {
                format!("--step {} works: a run over the same duration completed", display(*step))
            }
            Remedy::NoneOf(tried) => {
                let tried: Vec<String> = tried.iter().map(|step| display(*step)).collect();
                format!(
                    "shorter steps fail, too ({}): check the scene's pose, stiffnesses, preloads, loads and inputs",
                    tried.join(", ")
                )
            }
            Remedy::Untried(step) => {
                format!(
                    "try --step {}; it was not tested here because the run takes too long",
                    display(*step)
                )
            }
            Remedy::Unsought => "run this case alone to search for a step that works".to_owned(),
        }
    }
}

impl fmt::Display for FailedRun {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { cause, what, step, steps, step_size, time, .. } = self;
        let (time, size) = (display(*time), display(*step_size));
        match cause {
            Some(cause) => write!(f, "{cause}; then ")?,
            None => f.write_str("the run failed: ")?,
        }
        write!(f, "{what} at t = {time}, in step {step} of {steps} with the step size {size}")
    }
}

impl std::error::Error for FailedRun {}

impl Diagnostic for FailedRun {
    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        Some(Box::new(self.advice()))
    }
}

fn describe(scene: &Scene, run_failure: RunFailure) -> String {
    match run_failure {
        RunFailure::Step(cause) => dbd_scene::fault(scene, &cause),
        RunFailure::Growth { growth, body } => {
            let (growth, body) = (significant(growth, 2), scene.body_name(body));
            format!("the energy balance is off by {growth} J (fastest body `{body}`)")
        }
        RunFailure::Torn { joint, extension } => {
            let joint = scene.joints.get(joint).map(|joint| joint.name.clone()).unwrap_or_default();
            let extension = significant(extension, 2);
            format!("joint `{joint}` is stretched by {extension} m")
        }
        RunFailure::Energy { body } => {
            format!("the energy of body `{}` is not finite", scene.body_name(body))
        }
    }
}

/// Cause of a failure, if it is the step.
fn cause(scene: &Scene, method: &Method, step: f64, remedy: &Remedy) -> Option<String> {
    let frequencies = Frequencies::of(scene);
    let limit = method.stability_limit();
    let [least, most] = [frequencies.estimate * step, frequencies.bound * step];
    let scheme = method.scheme_name();
    let shown = |z: f64| significant(z, 3);
    let beyond = |sign: &str, z: f64| {
        format!(
            "step too large: ω·h {sign} {} at t = 0, the limit of {scheme} is {}",
            shown(z),
            significant(limit, 4)
        )
    };
    // The estimate is a lower bound: no trial is needed.
    if least > limit {
        return Some(beyond("=", least));
    }
    let works = matches!(remedy, Remedy::Step(_));
    if !works {
        return None;
    }
    if most > limit {
        return Some(beyond("≤", most));
    }
    if let Some(turn) = frequencies.warning(scene, step) {
        return Some(format!("step too large: {turn}"));
    }
    if limit.is_infinite() {
        return Some(format!(
            "step too large: a shorter one works ({scheme} is stable at any ω·h about the pose at t = \
             0, but large motions within a step have other limits)"
        ));
    }
    Some(format!(
        "step too large: a shorter one works (ω·h ≤ {} at t = 0, the limit of {scheme} is {}, but \
         frequencies rise along a motion, and dampers and angular velocities have other limits)",
        shown(most),
        significant(limit, 4),
    ))
}

/// A search for a step that works.
struct Search<'s> {
    scene: &'s Scene,
    method: &'s Method,
    /// Evaluations allowed for all candidates together.
    budget: f64,
    spent: f64,
    progress: &'s mut dyn FnMut(u64, u64),
}

impl Search<'_> {
    fn remedy(mut self, run: &Plan, every: Option<f64>) -> Remedy {
        let advised = Frequencies::of(self.scene).default_limit(self.method, run.duration);
        // Shorter than the failed step, and not nearly equal to it.
        let mut limit = advised.min(run.step / 2.0);
        let mut tried = Vec::new();
        for _ in 0..=HALVINGS {
            let request =
                Request { step: StepRequest::AtMost(limit), duration: run.duration, every };
            let Ok(candidate) = plan(&request) else { return Remedy::Untried(limit) };
            let whole = cost(self.scene, self.method, candidate.steps);
            if self.spent + whole > self.budget {
                return Remedy::Untried(candidate.step);
            }
            if self.comes_to_its_end(&candidate) {
                return Remedy::Step(candidate.step);
            }
            tried.push(candidate.step);
            limit /= 2.0;
        }
        Remedy::NoneOf(tried)
    }

    /// Whether a run completes, checked at the same steps as in `run`.
    fn comes_to_its_end(&mut self, run: &Plan) -> bool {
        let Ok(mut plant) = plant(self.scene, self.method, run.step) else { return false };
        let mut monitor = Monitor::new(self.scene, plant.as_ref());
        let (mut done, mut sample) = (0, 0);
        loop {
            if monitor.check(&plant.state()).is_err() {
                return false;
            }
            if done == run.steps {
                return true;
            }
            if done == sample {
                sample = run.steps.min(sample + run.stride);
            }
            let next = sample.min(done + run.unseen());
            let status = plant.advance(next - done);
            self.spent += cost(self.scene, self.method, next - done);
            (self.progress)(self.spent as u64, self.budget as u64);
            done = next;
            if status.is_err() {
                return false;
            }
        }
    }
}

/// Evaluations of elements and bodies in the given number of steps.
fn cost(scene: &Scene, method: &Method, steps: u64) -> f64 {
    let parts = scene.model.bodies.len() + scene.model.tsda_count() + scene.model.torsions.len();
    steps as f64 * f64::from(method.evaluations()) * parts as f64
}
