//! Changes of a scene that would allow longer steps: predicted and measured effect of each.

use dbd_plant::{Frequencies, Method};
use dbd_scene::Scene;
use dbd_scene::parameters::SceneNumber;
use serde::Serialize;

use crate::limits::Limits;
use crate::recommend::request::ceiling;
use crate::recommend::search::{Search, Trial};
use crate::variants::distance;
use crate::ways::Way;

/// Changes that are listed, at most.
const MAX: usize = 3;

/// \[1\] A change whose cost is above this fraction of the present one is not listed.
const WORTH: f64 = 0.9;

/// A change of the scene and its effect on the recommended method.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Change {
    /// In words.
    pub what: String,
    /// The values that make it.
    pub set: Vec<String>,
    /// \[1\] the cost per simulated second over that without it, by the frequencies at t = 0: no instruction changes.
    pub predicted: f64,
    /// \[1\] the same by the largest stable steps of both, found by running them, where a run of the changed scene came
    /// to its end; `None` where it did not.
    pub measured: Option<f64>,
    /// \[s\] the step of that run.
    pub step: Option<f64>,
    /// \[m\] by how much the motion differs, root mean square of bodies and time.
    pub moves: Option<f64>,
}

/// \[1\] Factor of a stiffness: doubles the step of parts that it alone supports.
const SOFTER: f64 = 0.25;

/// \[1\] Factor of a mass.
const HEAVIER: f64 = 2.0;

/// Single values that are looked at, at most.
const LOOKED_AT: usize = 40;

/// Candidates: descriptions and changes of values.
fn candidates(scene: &Scene) -> Vec<(String, Vec<String>)> {
    let numbers = scene.numbers().unwrap_or_default();
    let set = |numbers: &[&SceneNumber], factor: f64| -> Vec<String> {
        let scaled = numbers.iter().map(|number| (&number.path, number.value * factor));
        scaled.map(|(path, value)| format!("{path}={value:e}")).collect()
    };
    // Joints only, whose stiffness approximates a rigid one; that of a spring is a property of the mechanism.
    let last = |number: &&SceneNumber| {
        let mut steps = number.path.split('.');
        steps.next() == Some("joint")
            && steps.next_back() == Some("stiffness")
            && steps.count() == 1
    };
    let stiff: Vec<&SceneNumber> = numbers.iter().filter(last).collect();
    let mut all = Vec::new();
    if stiff.len() > 1 {
        all.push(("all joint stiffnesses reduced to a quarter".to_owned(), set(&stiff, SOFTER)));
    }
    for number in stiff.iter().take(LOOKED_AT) {
        let what = format!("`{}` reduced to a quarter", number.path);
        all.push((what, set(&[number], SOFTER)));
    }
    let masses = numbers.iter().filter(|number| number.path.ends_with(".mass"));
    for mass in masses.take(LOOKED_AT) {
        let of = &mass.path[..mass.path.len() - "mass".len()];
        let inertia = format!("{of}inertia");
        let whole =
            |number: &&SceneNumber| number.path == mass.path || number.path.starts_with(&inertia);
        let whole: Vec<&SceneNumber> = numbers.iter().filter(whole).collect();
        let what = format!("mass and inertia of `{}` doubled", of.trim_end_matches('.'));
        all.push((what, set(&whole, HEAVIER)));
    }
    all
}

/// The scene with changes of its values; `None` where it is refused.
fn changed(scene: &Scene, set: &[String]) -> Option<Scene> {
    set.iter().try_fold(scene.clone(), |scene, change| scene.with(change).ok())
}

/// The changes that would help a trial most, best first.
pub(super) fn of(search: &Search<'_>, trial: &Trial) -> Vec<Change> {
    let model = search.model(trial);
    let unit = search.head.grid.unit();
    let now = ceiling(&Frequencies::of(model), &trial.method).min(unit);
    let mut found: Vec<(f64, String, Vec<String>, Scene)> = Vec::new();
    for (what, set) in candidates(model) {
        let Some(changed) = changed(model, &set) else { continue };
        let then = ceiling(&Frequencies::of(&changed), &trial.method).min(unit);
        let predicted = now / then;
        if predicted < WORTH {
            found.push((predicted, what, set, changed));
        }
    }
    found.sort_by(|a, b| a.0.total_cmp(&b.0));
    let states = search.run(model, &trial.method, search.steps(trial.step));
    let own = longest(model, &trial.method).min(unit);
    let measure = |(predicted, what, set, changed): (f64, String, Vec<String>, Scene)| {
        let longest = longest(&changed, &trial.method).min(unit);
        let steps = search.head.grid.steps(longest);
        let run = search.run(&changed, &trial.method, steps);
        let moves = states.as_ref().zip(run.as_ref());
        let moves = moves.map(|(own, states)| distance((model, own), (&changed, states)));
        let measured = run.is_some().then_some(own / longest);
        let step = measured.map(|_| search.head.grid.step(steps));
        Change { what, set, predicted, measured, step, moves }
    };
    found.into_iter().take(MAX).map(measure).collect()
}

/// \[s\] the longest step of a method that may be advised, its stability found by running it.
fn longest(scene: &Scene, method: &Method) -> f64 {
    let (limits, way) = (Limits::of(scene), Way::Kernel(*method));
    let found = limits.decisive(&way).map(|method| limits.found(&method));
    limits.limit(&way, found).advised
}
