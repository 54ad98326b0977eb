//! Variants of a scene: other models of the same mechanism, and the difference of their motion.
//!
//! `scene => variants; (scene, variant, grid) => difference, steps, cost`. A variant is a change of the scene's text;
//! add one to the list below. Both run in double precision far below the largest stable step, so that only the model
//! differs; spiders of universal joints are ignored if only one model has them. The largest stable step is that of the
//! stepped model: for a planar one in its plane.

use crate::reference::metric::Metric;
use crate::reference::{Mechanism, State};
use dbd_plant::{AnyPlant, Method, PrecisionName, SchemeName, plant};
use dbd_scene::Scene;
use serde::{Deserialize, Serialize};

use crate::costs::Costs;
use crate::grid::Grid;
use crate::limits::{Limit, Limits};
use crate::stability::MARGIN;
use crate::timing::costs;
use crate::ways::Way;

/// Variants: name and changes.
const KINDS: &[(&str, &[&str])] = &[
    ("bushing", &["realisation=bushing"]),
    ("planar", &["planar=true"]),
    ("planar-bushing", &["planar=true", "realisation=bushing"]),
    (SPATIAL, &["planar=false"]),
    ("spatial-bushing", &["planar=false", "realisation=bushing"]),
];

/// Name of the unchanged scene among its variants.
pub const AS_IT_IS: &str = "as it is";

/// Name of the spatial model of a planar scene.
pub const SPATIAL: &str = "spatial";

/// Name of the scene with joints of twice the stiffness.
pub const STIFFER: &str = "twice-as-stiff";

/// The part of the largest stable step of leapfrog at which motions are compared.
const FINE: f64 = 0.1;

/// A scene made otherwise.
#[derive(Clone, Debug)]
pub struct Variant {
    /// Its name: `bushing`.
    pub name: &'static str,
    /// The scene.
    pub scene: Scene,
}

/// A scene and a variant of it, as surveyed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Compared {
    /// [`AS_IT_IS`], or the variant's name.
    pub name: String,
    /// Whether it is planar, with three degrees of freedom per body.
    pub planar: bool,
    /// Bodies.
    pub bodies: usize,
    /// Elements that count as a TSDA.
    pub elements: usize,
    /// \[m\] root mean square over bodies and samples of the distance from the scene as it is; 0 of that,
    /// `None` where one of them cannot be run.
    pub difference: Option<f64>,
    /// \[s\] the largest stable step of leapfrog about the pose at t = 0; `None` where every step is.
    pub stable_step: Option<f64>,
    /// \[s\] the largest step of leapfrog that is advised.
    pub step: f64,
    /// \[s\] a step of leapfrog in double precision on one core of this machine.
    pub host_seconds: f64,
    /// Instructions of a step of leapfrog in single precision on Cortex-M4F, where they were counted.
    pub target_instructions: Option<f64>,
}

/// The variants of a scene that are other models than it, and than each other.
#[must_use]
pub fn variants(scene: &Scene) -> Vec<Variant> {
    let mut found: Vec<Variant> = Vec::new();
    for (name, changes) in KINDS {
        let made = changes.iter().try_fold(scene.clone(), |scene, change| scene.with(change));
        let Ok(made) = made else { continue };
        let known = |other: &Scene| steps_alike(&made, other);
        if !known(scene) && !found.iter().any(|other| known(&other.scene)) {
            found.push(Variant { name, scene: made });
        }
    }
    found
}

/// Whether the same model steps.
fn steps_alike(one: &Scene, other: &Scene) -> bool {
    one.planar.is_some() == other.planar.is_some() && one.stepped() == other.stepped()
}

/// Name of a scene in the table of costs: its name, with a variant's name as suffix; `None` if the scene is neither
/// `shipped`, the scene of that name, nor a variant of it.
#[must_use]
pub fn counted_as(shipped: &Scene, scene: &Scene) -> Option<String> {
    if steps_alike(shipped, scene) {
        return Some(shipped.name.clone());
    }
    let alike = |variant: &Variant| steps_alike(&variant.scene, scene);
    let found = variants(shipped).into_iter().find(alike);
    found.map(|variant| format!("{}-{}", shipped.name, variant.name))
}

/// A scene and its variants, itself first, with joints twice as stiff last; empty without variants and joints. `called`
/// returns a scene's name in the table of costs.
#[must_use]
pub fn compare(
    scene: &Scene,
    grid: &Grid,
    counted: &Costs,
    called: &dyn Fn(&Scene) -> Option<String>,
) -> Vec<Compared> {
    let variants = variants(scene);
    if variants.is_empty() && scene.joints.is_empty() {
        return Vec::new();
    }
    let own_limit = limit(scene);
    let own = motion(scene, own_limit, grid);
    let instructions = |scene: &Scene| {
        let called = called(scene)?;
        counted.instructions_per_step(&called, "leapfrog", None, None, "f32", "quaternion")
    };
    let difference = own.as_ref().map(|_| 0.0);
    let mut all = vec![of(scene, AS_IT_IS, own_limit, difference, instructions(scene))];
    for Variant { name, scene: other } in &variants {
        let limit = limit(other);
        let states = own.as_ref().zip(motion(other, limit, grid));
        let difference = states.map(|(own, states)| distance((scene, own), (other, &states)));
        let difference = difference.filter(|difference| difference.is_finite());
        all.push(of(other, name, limit, difference, instructions(other)));
    }
    if !scene.joints.is_empty() {
        // Both in space, so that nothing else differs.
        let [softer, stiffer] =
            [1.0, 2.0].map(|factor| dbd_scene::with_stiffer_joints(scene, factor));
        let limit = limit(&stiffer);
        let states = [&softer, &stiffer].map(|scene| motion(scene, limit, grid));
        let difference = match &states {
            [Some(own), Some(states)] => Some(distance((&softer, own), (&stiffer, states))),
            _ => None,
        };
        let difference = difference.filter(|difference| difference.is_finite());
        all.push(of(&stiffer, STIFFER, limit, difference, None));
    }
    all
}

fn of(
    scene: &Scene,
    name: &str,
    limit: Limit,
    difference: Option<f64>,
    target_instructions: Option<f64>,
) -> Compared {
    let Limit { stable, .. } = limit;
    let step = limit.advised.min(scene.duration);
    let way = [Way::Kernel(Method::default())];
    let cost = costs(scene, &way, step, &mut |_, _| ());
    Compared {
        name: name.into(),
        planar: scene.planar.is_some(),
        bodies: scene.model.bodies.len(),
        elements: scene.stepped().tsda_count(),
        difference,
        stable_step: Some(stable).filter(|step| step.is_finite()),
        step,
        host_seconds: cost.first().map_or(f64::INFINITY, |cost| cost.least),
        target_instructions,
    }
}

/// How long a step of leapfrog may be.
fn limit(scene: &Scene) -> Limit {
    let limits = Limits::of(scene);
    let way = Way::Kernel(Method::default());
    let found = limits.decisive(&way).map(|method| limits.found(&method));
    limits.limit(&way, found)
}

/// The states of a scene at a grid's times, t = 0 first; `None` where a run fails.
fn motion(scene: &Scene, limit: Limit, grid: &Grid) -> Option<Vec<State>> {
    // It is stable at leapfrog's steps and far more accurate.
    let method = Method::new(SchemeName::Pefrl, None, PrecisionName::F64).ok()?;
    let steps = grid.steps(FINE * limit.advised.min(scene.duration) / (1.0 - MARGIN));
    let plant = plant(scene, &method, grid.step(steps)).ok()?;
    sampled(plant, steps, grid.samples.into())
}

/// The states of a plant now and after each `steps` steps, `samples` times; `None` where it fails.
pub(crate) fn sampled(
    mut plant: Box<dyn AnyPlant>,
    steps: u64,
    samples: u64,
) -> Option<Vec<State>> {
    let mut states = vec![State::of(&plant.state())];
    for _ in 0..samples {
        if plant.advance(steps).is_err() {
            return None;
        }
        states.push(State::of(&plant.state()));
    }
    Some(states)
}

/// \[m\] distance of the common bodies.
#[must_use]
pub fn distance((scene, own): (&Scene, &[State]), (other, states): (&Scene, &[State])) -> f64 {
    let place = |name: &String| other.body_names.iter().position(|known| known == name);
    let names = scene.body_names.iter().enumerate();
    let pairs: Vec<(usize, usize)> =
        names.filter_map(|(row, name)| Some((row, place(name)?))).collect();
    let mut mechanism = Mechanism::of(scene).0;
    mechanism.bodies = pairs.iter().map(|(row, _)| mechanism.bodies[*row]).collect();
    let of = |states: &[State], rows: &[usize]| -> Vec<State> {
        let bodies = |state: &State| rows.iter().map(|row| state.bodies[*row]).collect();
        states
            .iter()
            .map(|state| State { bodies: bodies(state), torsion_angles: Vec::new() })
            .collect()
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
        let compared = compare(&scene, &Grid::new(1e-3, 0.1), &Costs::none(), &|_| None);
        let [own, bushing, stiffer] = &compared[..] else { panic!("{compared:?}") };
        assert_eq!((own.bodies, own.elements, own.difference), (3, 12, Some(0.0)));
        assert_eq!((bushing.bodies, bushing.elements), (2, 1));
        let difference = bushing.difference.unwrap();
        assert!(difference > 0.0 && difference < 1e-3, "{difference:e}");
        assert!(bushing.step > 2.0 * own.step, "{} {}", bushing.step, own.step);
        // √2 times as fast.
        let [slow, fast] = [own, stiffer].map(|one| one.stable_step.unwrap());
        assert!((slow / fast - 2_f64.sqrt()).abs() < 0.05, "{slow} {fast}");
        // Scenes already built from bushings have no variant.
        assert!(variants(&found[0].scene).is_empty());
    }

    /// Three bars in the plane z = 0.
    const BARS: &str = r#"
        name = "bars"
        duration = 0.2
        gravity = [0, -9.81, 0]
        [[body]]
        name = "left"
        mass = 1
        inertia = [0.001, 0.01, 0.01]
        position = [0.15, 0, 0]
        [[body]]
        name = "right"
        mass = 1
        inertia = [0.001, 0.01, 0.01]
        position = [0.45, 0, 0]
        [[joint]]
        name = "pivot"
        type = "revolute"
        between = ["world", "left"]
        at = [0, 0, 0]
        axis = [0, 0, 1]
        span = 0.05
        stiffness = 1e5
        [[joint]]
        name = "knee"
        type = "revolute"
        between = ["left", "right"]
        at = [0.3, 0, 0]
        axis = [0, 0, 1]
        span = 0.05
        stiffness = 1e5
    "#;

    #[test]
    fn a_planar_scene_stands_beside_the_one_in_space() {
        let scene = Scene::parse(BARS, "b.toml").unwrap();
        let names = |scene: &Scene| variants(scene).iter().map(|one| one.name).collect::<Vec<_>>();
        assert_eq!(names(&scene), ["bushing", "planar", "planar-bushing"]);
        let planar = scene.with("planar=true").unwrap();
        // Planar first: unchanged parts stay as they are.
        assert_eq!(names(&planar), ["bushing", "spatial", "spatial-bushing"]);
        let called = |scene: &Scene| counted_as(&Scene::parse(BARS, "b.toml").unwrap(), scene);
        assert_eq!(called(&scene).as_deref(), Some("bars"));
        assert_eq!(called(&planar).as_deref(), Some("bars-planar"));
        let bushing = planar.with("realisation=bushing").unwrap();
        assert_eq!(called(&bushing).as_deref(), Some("bars-planar-bushing"));
        assert_eq!(called(&scene.with("body.left.mass=2").unwrap()), None);
        let grid = Grid::new(1e-3, 0.1);
        let there = compare(&scene, &grid, &Costs::none(), &|_| None);
        let back = compare(&planar, &grid, &Costs::none(), &|_| None);
        let elements = |all: &[Compared]| all.iter().map(|one| one.elements).collect::<Vec<_>>();
        assert_eq!(elements(&there), [12, 2, 4, 2, 12]);
        assert_eq!(elements(&back), [4, 2, 12, 2, 12]);
        assert!(there[2].planar && !there[0].planar && back[0].planar && !back[2].planar);
        // The same two models in either order.
        assert_eq!(
            [there[0].stable_step, there[2].stable_step],
            [back[2].stable_step, back[0].stable_step]
        );
        let [one, other] = [there[2].difference, back[2].difference].map(Option::unwrap);
        assert!(one > 0.0 && one < 1e-3 && (one / other - 1.0).abs() < 1e-9, "{one:e} {other:e}");
        // The deflection of joints falls with their stiffness.
        let depends = |stiffness: &str| {
            let scene = scene.with(&format!("joint.*.stiffness={stiffness}")).unwrap();
            compare(&scene, &grid, &Costs::none(), &|_| None).pop().unwrap()
        };
        let [soft, stiff] = ["1e4", "1e6"].map(|stiffness| depends(stiffness).difference.unwrap());
        assert_eq!(depends("1e4").name, STIFFER);
        assert!(stiff > 0.0 && stiff < 0.1 * soft, "{soft:e} {stiff:e}");
        // Vibration out of the plane is faster than all in it.
        assert!(there[2].stable_step > there[0].stable_step, "{there:?}");
    }
}
