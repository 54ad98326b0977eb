//! A run that failed: where, and which step works instead.
//!
//! `(trouble, scene, plan) => sentence`, the cause before the symptom where it is known: the step is
//! the cause where it is beyond what the scheme bears at t = 0, or where a shorter one works. A step
//! is only named after a run with it over the same
//! duration has come to its end; the candidates are the advised step, shortened to a round one that
//! fits, and its halves, all shorter than the one that failed.

use std::fmt;
use std::io;

use dbd_plant::digits::significant;
use dbd_plant::judge::Trouble;
use dbd_plant::plan::{Request, StepRequest, plan};
use dbd_plant::time::display;
use dbd_plant::{Frequencies, Method, Plan};
use dbd_scene::Scene;
use miette::Diagnostic;

use crate::simulate::run::{Ending, Observer, Sample, simulate};

/// How often the advised step is halved.
const HALVINGS: u32 = 4;

/// Candidates that would take more evaluations of an element or body are not tried: at 10 ns
/// each, that is the better part of a minute.
const MOST_EVALUATIONS: f64 = 4e9;

/// A run that failed.
#[derive(Clone, Debug, PartialEq)]
pub struct FailedRun {
    /// Why, where that is known, e.g. `step too large: ω·h = 3.1 at t = 0`.
    pub cause: Option<String>,
    /// What went wrong, e.g. ``the velocity of body `crank` is not finite``.
    pub what: String,
    /// The step that failed, counted from 1.
    pub step: u64,
    /// Steps the run was to take.
    pub steps: u64,
    /// \[s\] the step size.
    pub step_size: f64,
    /// \[s\] the time after the step that failed.
    pub time: f64,
    /// What helps.
    pub remedy: Remedy,
}

/// What helps a run that failed.
#[derive(Clone, Debug, PartialEq)]
pub enum Remedy {
    /// \[s\] a step with which the same run comes to its end.
    Step(f64),
    /// \[s\] these shorter steps fail, too.
    NoneOf(Vec<f64>),
    /// \[s\] a step that takes too long to try.
    Untried(f64),
    /// No step was looked for.
    Unsought,
}

impl FailedRun {
    /// Describes the failure and looks for a step that works; `every` is the sampling interval
    /// where one was given.
    #[must_use]
    pub fn new(
        scene: &Scene,
        method: &Method,
        run: &Plan,
        every: Option<f64>,
        ending: &Ending,
        trouble: Trouble,
    ) -> Self {
        let remedy = find_remedy(scene, method, run, every);
        let cause = cause(scene, method, run.step, &remedy);
        Self { cause, remedy, ..Self::untried(scene, run, ending, trouble) }
    }

    /// Describes the failure; no step is looked for, which takes further runs.
    #[must_use]
    pub fn untried(scene: &Scene, run: &Plan, ending: &Ending, trouble: Trouble) -> Self {
        Self {
            cause: None,
            what: describe(scene, trouble),
            step: ending.steps,
            steps: run.steps,
            step_size: run.step,
            time: run.time(ending.steps),
            remedy: Remedy::Unsought,
        }
    }

    /// What helps, in words.
    #[must_use]
    pub fn advice(&self) -> String {
        match &self.remedy {
            Remedy::Step(step) => {
                format!("--step {} works: it was run over the same time", display(*step))
            }
            Remedy::NoneOf(tried) => {
                let tried: Vec<String> = tried.iter().map(|step| display(*step)).collect();
                format!(
                    "shorter steps fail, too ({}): look at the scene's pose, stiffnesses, \
                     preloads, loads and inputs",
                    tried.join(", ")
                )
            }
            Remedy::Untried(step) => {
                format!("--step {} is advised; it takes too long to be tried here", display(*step))
            }
            Remedy::Unsought => "a run of this case alone looks for a step that works".to_owned(),
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

fn describe(scene: &Scene, trouble: Trouble) -> String {
    match trouble {
        Trouble::Step(cause) => scene.fault(&cause),
        Trouble::Growth { growth, body } => {
            let (growth, body) = (significant(growth, 2), scene.body_name(body));
            format!("{growth} J came from nowhere, body `{body}` is the fastest,")
        }
        Trouble::Torn { joint, extension } => {
            let joint = scene.joints.get(joint).map(|joint| joint.name.clone()).unwrap_or_default();
            let extension = significant(extension, 2);
            format!("joint `{joint}` is stretched by {extension} m")
        }
        Trouble::Energy { body } => {
            format!("the energy of body `{}` is not finite", scene.body_name(body))
        }
    }
}

/// Why a run failed, as far as its step is to blame.
fn cause(scene: &Scene, method: &Method, step: f64, remedy: &Remedy) -> Option<String> {
    let frequencies = Frequencies::of(scene);
    let limit = method.stability_limit();
    let [least, most] = [frequencies.estimate * step, frequencies.bound * step];
    let scheme = method.scheme_name();
    let shown = |z: f64| significant(z, 3);
    let beyond = |sign: &str, z: f64| {
        format!(
            "step too large: ω·h {sign} {} at t = 0, {scheme} bears {}",
            shown(z),
            significant(limit, 4)
        )
    };
    // The estimate is never above the truth: nothing needs to be tried.
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
    Some(format!(
        "step too large: a shorter one works (ω·h ≤ {} at t = 0, {scheme} bears {}, but frequencies \
         rise along a motion, and dampers and spins have limits of their own)",
        shown(most),
        significant(limit, 4),
    ))
}

fn find_remedy(scene: &Scene, method: &Method, run: &Plan, every: Option<f64>) -> Remedy {
    let advised = Frequencies::of(scene).default_limit(method, run.duration);
    // Not the failed step itself, nor one as good as equal to it.
    let mut limit = advised.min(run.step / 2.0);
    let mut tried = Vec::new();
    for _ in 0..=HALVINGS {
        let request =
            Request { step: StepRequest::RoundAtMost(limit), duration: run.duration, every };
        let Ok(candidate) = plan(&request) else { return Remedy::Untried(limit) };
        if cost(scene, method, &candidate) > MOST_EVALUATIONS {
            return Remedy::Untried(candidate.step);
        }
        if comes_to_its_end(scene, method, &candidate) {
            return Remedy::Step(candidate.step);
        }
        tried.push(candidate.step);
        limit /= 2.0;
    }
    Remedy::NoneOf(tried)
}

fn cost(scene: &Scene, method: &Method, plan: &Plan) -> f64 {
    let parts = scene.model.bodies.len() + scene.model.tsda_count() + scene.model.torsions.len();
    plan.steps as f64 * f64::from(method.evaluations()) * parts as f64
}

fn comes_to_its_end(scene: &Scene, method: &Method, plan: &Plan) -> bool {
    struct Nobody;
    impl Observer for Nobody {
        fn sample(&mut self, _: &Sample<'_>) -> io::Result<()> {
            Ok(())
        }
    }
    simulate(scene, method, plan, &mut Nobody).is_ok_and(|ending| ending.trouble.is_none())
}
