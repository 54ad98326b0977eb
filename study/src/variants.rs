//! A scene made otherwise: the same mechanism with joints of another kind, and how much its motion differs.
//!
//! `scene => variants; (scene, variant, grid) => difference, step, cost`. A variant is a change of the scene's text
//! that is read anew; a further one is an entry of the list below. Both run in double precision far
//! below the largest stable step, so that what differs is the model; the spiders of universal joints that
//! only one of them has do not count.

use dbd_plant::{Method, PrecisionName, SchemeName, plant};
use dbd_reference::metric::Metric;
use dbd_reference::{Mechanism, State};
use dbd_scene::Scene;
use serde::{Deserialize, Serialize};

use crate::costs::Costs;
use crate::grid::Grid;
use crate::limits::Limits;
use crate::stability::MARGIN;
use crate::timing::costs;
use crate::ways::Way;

/// What a scene can be made into: a name, and the change that does it.
const KINDS: &[(&str, &str)] = &[("bushing", "realisation=bushing")];

/// The part of the largest stable step at which motions are compared.
const FINE: f64 = 0.1;

/// A scene made otherwise.
#[derive(Clone, Debug)]
pub struct Variant {
    /// What people call it: `bushing`.
    pub name: &'static str,
    /// The scene.
    pub scene: Scene,
}

/// A scene and a variant of it, as surveyed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Compared {
    /// `as it is`, or the variant's name.
    pub name: String,
    /// Bodies.
    pub bodies: usize,
    /// Elements that count as a TSDA.
    pub elements: usize,
    /// \[m\] root mean square over bodies and samples of the distance from the scene as it is; 0 of that,
    /// `None` where one of them cannot be run.
    pub difference: Option<f64>,
    /// \[s\] the largest step of leapfrog that is advised.
    pub step: f64,
    /// \[s\] a step of leapfrog in double precision on one core of this machine.
    pub host_seconds: f64,
    /// Instructions of a step of leapfrog in single precision on Cortex-M4F, where they were counted.
    pub target_instructions: Option<f64>,
}

/// The variants of a scene that are other models than it.
#[must_use]
pub fn variants(scene: &Scene) -> Vec<Variant> {
    let kinds = KINDS.iter().filter_map(|(name, change)| {
        let variant = Variant { name, scene: scene.with(change).ok()? };
        (variant.scene.model != scene.model).then_some(variant)
    });
    kinds.collect()
}

/// A scene beside its variants, itself first; nothing where it has none.
#[must_use]
pub fn compare(scene: &Scene, grid: &Grid, counted: &Costs) -> Vec<Compared> {
    let variants = variants(scene);
    if variants.is_empty() {
        return Vec::new();
    }
    let fine = Method::new(SchemeName::Pefrl, None, PrecisionName::F64).ok();
    let run = |scene: &Scene| fine.as_ref().and_then(|method| motion(scene, method, grid));
    let own = run(scene);
    let mut all = vec![of(scene, "as it is", own.as_ref().map(|_| 0.0), counted, &scene.name)];
    for Variant { name, scene: other } in &variants {
        let states = own.as_ref().zip(run(other));
        let difference = states.map(|(own, states)| distance((scene, own), (other, &states)));
        let chip = format!("{}-{name}", scene.name);
        all.push(of(other, name, difference.filter(|d| d.is_finite()), counted, &chip));
    }
    all
}

fn of(scene: &Scene, name: &str, difference: Option<f64>, counted: &Costs, chip: &str) -> Compared {
    let step = largest_step(scene, &Method::default());
    let way = [Way::Kernel(Method::default())];
    let cost = costs(scene, &way, step, &mut |_, _| ());
    let target_instructions =
        counted.instructions_per_step(chip, "leapfrog", None, false, "f32", "quaternion");
    Compared {
        name: name.into(),
        bodies: scene.model.bodies.len(),
        elements: scene.model.tsda_count(),
        difference,
        step,
        host_seconds: cost.first().map_or(f64::INFINITY, |cost| cost.least),
        target_instructions,
    }
}

/// \[s\] the largest step of a method that is advised.
fn largest_step(scene: &Scene, method: &Method) -> f64 {
    let limits = Limits::of(scene);
    let way = Way::Kernel(*method);
    let found = limits.decisive(&way).map(|method| limits.found(&method));
    limits.limit(&way, found).advised.min(scene.duration)
}

/// The states of a scene at a grid's times, t = 0 first; `None` where a run fails.
fn motion(scene: &Scene, method: &Method, grid: &Grid) -> Option<Vec<State>> {
    let steps = grid.steps(FINE * largest_step(scene, method) / (1.0 - MARGIN));
    let mut plant = plant(scene, method, grid.step(steps)).ok()?;
    let mut states = vec![State::of(&plant.state())];
    for _ in 1..grid.times().len() {
        if !plant.advance(steps).is_running() {
            return None;
        }
        states.push(State::of(&plant.state()));
    }
    Some(states)
}

/// \[m\] how far the bodies that both have are apart.
fn distance((scene, own): (&Scene, &[State]), (other, states): (&Scene, &[State])) -> f64 {
    let place = |name: &String| other.body_names.iter().position(|known| known == name);
    let names = scene.body_names.iter().enumerate();
    let pairs: Vec<(usize, usize)> =
        names.filter_map(|(row, name)| Some((row, place(name)?))).collect();
    let mut mechanism = Mechanism::of(scene).0;
    mechanism.bodies = pairs.iter().map(|(row, _)| mechanism.bodies[*row]).collect();
    let of = |states: &[State], rows: &[usize]| -> Vec<State> {
        let bodies = |state: &State| rows.iter().map(|row| state.bodies[*row]).collect();
        states.iter().map(|state| State { bodies: bodies(state), twists: Vec::new() }).collect()
    };
    let (rows, others): (Vec<_>, Vec<_>) = pairs.into_iter().unzip();
    let [own, states] = [of(&own[1..], &rows), of(&states[1..], &others)];
    Metric::of(&mechanism).error(&own, &states)
}

#[cfg(test)]
mod tests {
    use super::*;

    const CARDAN: &str = r#"
        name = "cardan"
        duration = 0.2
        [[body]]
        name = "in"
        mass = 1
        inertia = [0.01, 0.02, 0.02]
        position = [-0.2, 0, 0]
        angular_velocity = [5, 0, 0]
        [[body]]
        name = "out"
        mass = 1
        inertia = [0.01, 0.02, 0.02]
        position = [0.2, 0, 0]
        angular_velocity = [5, 0, 0]
        [[joint]]
        name = "u"
        type = "universal"
        between = ["in", "out"]
        at = [0, 0, 0]
        axes = [[0, 1, 0], [0, 0, 1]]
        span = 0.05
        spider = { mass = 1e-3, inertia = [1e-6, 1e-6, 1e-6] }
        stiffness = 1e5
    "#;

    /// A light spider hardly matters to the motion, and decides the step.
    #[test]
    fn a_bushing_moves_as_its_joint_and_takes_longer_steps() {
        let scene = Scene::parse(CARDAN, "c.toml").unwrap();
        let found = variants(&scene);
        assert_eq!(found.iter().map(|one| one.name).collect::<Vec<_>>(), ["bushing"]);
        let compared = compare(&scene, &Grid::new(1e-3, 0.1), &Costs::none());
        let [own, bushing] = &compared[..] else { panic!("{compared:?}") };
        assert_eq!((own.bodies, own.elements, own.difference), (3, 12, Some(0.0)));
        assert_eq!((bushing.bodies, bushing.elements), (2, 1));
        let difference = bushing.difference.unwrap();
        assert!(difference > 0.0 && difference < 1e-3, "{difference:e}");
        assert!(bushing.step > 2.0 * own.step, "{} {}", bushing.step, own.step);
        // What is of bushings already has no other make.
        assert!(variants(&found[0].scene).is_empty());
    }
}
