//! A run that failed: where, and which step works instead.
//!
//! `(trouble, scene, plan) => sentence`, the cause before the symptom where it is known: the step is
//! the cause where it is beyond what the scheme bears at t = 0, or where a shorter one works. A step is only
//! named after a run with it over the same duration has come to its end. The candidates are the advised step,
//! shortened to a round one that fits, and its halves, all shorter than the one that failed. Together they take
//! no more evaluations than the failed run, or `LEAST_BUDGET` where that is more.

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

/// Candidates may take so many evaluations of an element or body, however soon the run failed: at 10 ns each,
/// 2 s.
const LEAST_BUDGET: f64 = 2e8;

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
    /// where one was given. `progress` is given the evaluations that the search has made and may make.
    #[must_use]
    pub fn new(
        scene: &Scene,
        method: &Method,
        run: &Plan,
        every: Option<f64>,
        ending: &Ending,
        trouble: Trouble,
        progress: &mut dyn FnMut(u64, u64),
    ) -> Self {
        let budget = LEAST_BUDGET.max(cost(scene, method, ending.steps));
        let search = Search { scene, method, budget, spent: 0.0, progress };
        let remedy = search.remedy(run, every);
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
    if limit.is_infinite() {
        return Some(format!(
            "step too large: a shorter one works ({scheme} is stable at any ω·h about the pose at t = 0, but \
             large motions within a step have limits of their own)"
        ));
    }
    Some(format!(
        "step too large: a shorter one works (ω·h ≤ {} at t = 0, {scheme} bears {}, but frequencies \
         rise along a motion, and dampers and spins have limits of their own)",
        shown(most),
        significant(limit, 4),
    ))
}

/// A search for a step that works.
struct Search<'s> {
    scene: &'s Scene,
    method: &'s Method,
    /// Evaluations that all candidates together may take.
    budget: f64,
    spent: f64,
    progress: &'s mut dyn FnMut(u64, u64),
}

impl Search<'_> {
    fn remedy(mut self, run: &Plan, every: Option<f64>) -> Remedy {
        let advised = Frequencies::of(self.scene).default_limit(self.method, run.duration);
        // Not the failed step itself, nor one as good as equal to it.
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
            let (scene, method) = (self.scene, self.method);
            let mut observer = CandidateRun { search: &mut self, steps: 0 };
            let ending = simulate(scene, method, &candidate, &mut observer);
            if ending.is_ok_and(|ending| ending.trouble.is_none()) {
                return Remedy::Step(candidate.step);
            }
            tried.push(candidate.step);
            limit /= 2.0;
        }
        Remedy::NoneOf(tried)
    }

    fn evaluate(&mut self, steps: u64) {
        self.spent += cost(self.scene, self.method, steps);
        (self.progress)(self.spent as u64, self.budget as u64);
    }
}

/// Evaluations of an element or body in so many steps.
fn cost(scene: &Scene, method: &Method, steps: u64) -> f64 {
    let parts = scene.model.bodies.len() + scene.model.tsda_count() + scene.model.torsions.len();
    steps as f64 * f64::from(method.evaluations()) * parts as f64
}

/// A run of which nothing is kept but how far it comes.
struct CandidateRun<'r, 's> {
    search: &'r mut Search<'s>,
    steps: u64,
}

impl Observer for CandidateRun<'_, '_> {
    fn sample(&mut self, _: &Sample<'_>) -> io::Result<()> {
        Ok(())
    }

    fn progress(&mut self, steps: u64) {
        self.search.evaluate(steps - self.steps);
        self.steps = steps;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use dbd_plant::judge::Trouble;

    const OSCILLATOR: &str = r#"
name = "oscillator"
duration = 1.0
[[body]]
name = "block"
mass = 1.0
inertia = [1.0, 1.0, 1.0]
position = [1.0, 0.0, 0.0]
[[tsda]]
name = "spring"
between = ["world", "block"]
points = [[0, 0, 0], [0, 0, 0]]
free_length = 0.5
stiffness = 1e6
"#;

    /// The failed run of the oscillator at a step beyond its limit, and what was heard of the search.
    fn failed(duration: f64) -> (FailedRun, Vec<(u64, u64)>) {
        let scene = Scene::parse(OSCILLATOR, "oscillator.toml").unwrap();
        let method = Method::default();
        let request = Request { step: StepRequest::Given(4e-3), duration, every: None };
        let run = plan(&request).unwrap();
        let ending = simulate(&scene, &method, &run, &mut Silent).unwrap();
        let trouble: Trouble = ending.trouble.unwrap();
        let mut heard = Vec::new();
        let mut progress = |done, all| heard.push((done, all));
        let failed = FailedRun::new(&scene, &method, &run, None, &ending, trouble, &mut progress);
        (failed, heard)
    }

    struct Silent;

    impl Observer for Silent {
        fn sample(&mut self, _: &Sample<'_>) -> io::Result<()> {
            Ok(())
        }
    }

    #[test]
    fn a_short_run_is_tried_with_a_shorter_step_and_the_search_is_heard_of() {
        let (failed, heard) = failed(1.0);
        assert!(matches!(failed.remedy, Remedy::Step(_)), "{failed:?}");
        assert!(heard.len() > 2 && heard.is_sorted(), "{heard:?}");
        assert!(heard.iter().all(|(done, all)| done <= all && *all == LEAST_BUDGET as u64));
    }

    /// 1e6 s would take 2e9 evaluations, the run itself failed after a few.
    #[test]
    fn a_search_takes_no_longer_than_the_run_or_a_few_seconds() {
        let (failed, heard) = failed(1e6);
        assert!(matches!(failed.remedy, Remedy::Untried(_)), "{failed:?}");
        assert!(heard.is_empty(), "{heard:?}");
    }
}
