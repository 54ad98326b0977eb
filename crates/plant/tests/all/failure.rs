//! A run that failed is looked into: which step works, and what looking for one may cost.

use dbd_plant::failure::Remedy;
use dbd_plant::monitor::{Monitor, RunFailure};
use dbd_plant::plan::{Request, StepRequest, plan};
use dbd_plant::{FailedRun, Method, plant};
use dbd_scene::Scene;

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
    let mut plant = plant(&scene, &method, run.step).unwrap();
    let mut monitor = Monitor::new(&scene, plant.as_ref());
    let run_failure: RunFailure = loop {
        match monitor.check(&plant.state()) {
            Ok(_) => assert!(plant.advance(1).is_ok()),
            Err(run_failure) => break run_failure,
        }
    };
    let mut heard = Vec::new();
    let mut progress = |done, all| heard.push((done, all));
    let steps = plant.steps();
    let failed = FailedRun::new(&scene, &method, &run, None, steps, run_failure, &mut progress);
    (failed, heard)
}

#[test]
fn a_short_run_is_tried_with_a_shorter_step_and_the_search_is_heard_of() {
    let (failed, heard) = failed(1.0);
    assert!(matches!(failed.remedy, Remedy::Step(_)), "{failed:?}");
    assert!(heard.len() > 2 && heard.is_sorted(), "{heard:?}");
    assert!(heard.iter().all(|(done, all)| done <= all && *all == 200_000_000));
}

/// 1e6 s would take 2e9 evaluations, the run itself failed after a few.
#[test]
fn a_search_takes_no_longer_than_the_run_or_a_few_seconds() {
    let (failed, heard) = failed(1e6);
    assert!(matches!(failed.remedy, Remedy::Untried(_)), "{failed:?}");
    assert!(heard.is_empty(), "{heard:?}");
}
