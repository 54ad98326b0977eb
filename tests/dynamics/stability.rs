//! The largest stable steps of every scheme on the paper's mechanisms, beside the linear limits.
//!
//! About the initial pose, frozen; see `dbd_study::stability` for the criterion. The limits are those
//! of one oscillator.

use std::sync::OnceLock;

use dbd_kernel::State;
use dbd_kernel::index::DamperIndex;
use dbd_kernel::model::Law;
use dbd_plant::{DampingName, Method, PrecisionName, SchemeName, plant};
use dbd_scene::Scene;
use dbd_study::reference::Trajectory;
use dbd_study::stability::{Stability, Vibration, stability};
use dbd_tests::page::{block, figure, table};
use dbd_tests::scene;

fn of(scene: &Scene, method: &Method) -> Stability {
    stability(&scene.model, &State::initial(&scene.model), method).unwrap().unwrap()
}

fn method(scheme: SchemeName, newton: Option<u32>) -> Method {
    Method::new(scheme, newton, PrecisionName::F64).unwrap()
}

/// Schemes, Newton iterations and the linear limits of `ω·h` without damping.
const LIMITS: [(SchemeName, Option<u32>, f64); 14] = [
    (SchemeName::SemiImplicitEuler, None, 2.0),
    (SchemeName::Leapfrog, None, 2.0),
    (SchemeName::Dbd, Some(0), 2.0),
    (SchemeName::Dbd, Some(1), 1.0),
    (SchemeName::Dbd, Some(3), 1.0),
    (SchemeName::DbdP1, Some(0), 1.414),
    (SchemeName::DbdP1, Some(1), 1.414),
    (SchemeName::DbdP1, Some(3), 1.242),
    (SchemeName::DbdP2, Some(0), 1.0),
    (SchemeName::DbdP2, Some(1), 1.0),
    (SchemeName::DbdP2, Some(3), 1.0),
    (SchemeName::Pefrl, None, 2.989),
    (SchemeName::BlanesMoanS6, None, 3.133),
    (SchemeName::Rk4, None, 2.828),
];

/// The mechanisms looked at: one loop, two, and points on lines.
const SCENES: [&str; 3] = ["four-bar", "six-bar", "crank-slider"];

/// The largest stable `ω·h` of each of [`LIMITS`] on a mechanism, found once however many ask.
fn limits(name: &str) -> &'static [f64] {
    static FOUND: [OnceLock<Vec<f64>>; SCENES.len()] = [const { OnceLock::new() }; SCENES.len()];
    let place = SCENES.iter().position(|scene| *scene == name).unwrap();
    FOUND[place].get_or_init(|| limits_hold(name))
}

fn limits_hold(name: &str) -> Vec<f64> {
    let scene = scene(name);
    let mut all = Vec::new();
    for (scheme, newton, limit) in LIMITS {
        let method = method(scheme, newton);
        let found = of(&scene, &method);
        let z = found.z();
        all.push(z);
        assert!((z / limit - 1.0).abs() < 0.05, "{name} {method:?}: {z} of {limit}");
        assert!(found.ranges[0][0] == 0.0 && (found.ranges[0][1] - z).abs() < 1e-12);
        if scheme == SchemeName::BlanesMoanS6 {
            // The highest mode leaves the window of growth and ends at 6.31 as if it were not
            // there; each lower mode has its window further up.
            let [_, second, ..] = found.ranges[..] else { panic!("{:?}", found.ranges) };
            let end = found.ranges[found.ranges.len() - 1][1];
            assert!((3.15..3.17).contains(&second[0]), "{name}: {second:?}");
            assert!((end / 6.31 - 1.0).abs() < 0.05, "{name}: {end}");
        }
    }
    all
}

#[test]
fn written_in_the_page() {
    let columns = SCENES.map(limits);
    let rows = LIMITS.iter().enumerate().map(|(i, (scheme, newton, limit))| {
        let name = method(*scheme, *newton).scheme_name();
        let newton = newton.map(|newton| format!(", {newton}")).unwrap_or_default();
        let cells = columns.map(|column| format!("{:.3}", column[i]));
        [format!("{name}{newton}"), format!("{limit}")].into_iter().chain(cells).collect()
    });
    let rows: Vec<Vec<String>> = rows.collect();
    let head = [&["scheme, Newton iterations", "one oscillator"], &SCENES[..]].concat();
    block("docs/reference-solvers.md", "limits", &table(&head, &rows));
}

macro_rules! limits {
    ($($test:ident: $name:literal),*) => {$(
        #[test]
        fn $test() {
            assert_eq!(limits($name).len(), LIMITS.len());
        }
    )*};
}

limits! { four_bar: "four-bar", six_bar: "six-bar", crank_slider: "crank-slider" }

/// The scene with c = 2k/ω_dom on every TSDA and point on line, ω_dom half the highest frequency: the
/// paper's mechanisms have dominant frequencies of 1/2.5 to 1/1.7 of it.
fn damped(name: &str) -> Scene {
    let mut scene = scene(name);
    let dominant = 0.5 * of(&scene, &method(SchemeName::Leapfrog, None)).frequency;
    let model = &mut scene.model;
    for group in &mut model.groups {
        group.damper = DamperIndex(model.dampers.len() as u16);
        let first = usize::from(group.element);
        let elements = first..first + group.elements();
        let stiffnesses: Vec<f64> = match group.law {
            Law::Tsda => model.tsdas[elements].iter().map(|tsda| tsda.stiffness).collect(),
            Law::PointOnLine => model.lines[elements].iter().map(|line| line.stiffness).collect(),
            Law::PointBushing => model.bushings[elements].iter().map(|b| b.stiffness).collect(),
            Law::Revolute => model.revolutes[elements].iter().map(|b| b.stiffness).collect(),
            Law::Universal => model.universals[elements].iter().map(|b| b.stiffness).collect(),
        };
        model.dampers.extend(stiffnesses.iter().map(|stiffness| 2.0 * stiffness / dominant));
    }
    scene
}

/// Strong dampers, ζ = 2 in the fastest mode, leave the sweeps their step or let it grow; steps
/// beyond the undamped limit are not advised, so errors are taken there at most. Explicit damping at one
/// velocity per step, as in semi-implicit Euler, ends at `2·(√(ζ² + 1) − ζ)`, 0.47, the paper's step
/// earlier still; leapfrog's two half kicks at `2/ζ`, 1.
#[test]
fn sweeps_keep_the_step_that_explicit_damping_loses() {
    let sweeps = method(SchemeName::Leapfrog, None);
    let explicit = sweeps.with_damping(DampingName::Explicit).unwrap();
    let euler = method(SchemeName::SemiImplicitEuler, None);
    let euler = euler.with_damping(DampingName::Explicit).unwrap();
    let methods = [sweeps, explicit, euler, method(SchemeName::Dbd, Some(0))];
    let found = std::thread::scope(|scope| {
        SCENES
            .map(|name| scope.spawn(move || damped_limits(name, &methods)))
            .map(|found| found.join().unwrap())
    });
    let title = |method: &Method| format!("{}, {}", method.scheme_name(), method.damping().name());
    let mut rows: Vec<Vec<String>> = Vec::new();
    for (i, method) in methods.iter().enumerate() {
        let cells = found.map(|limits| format!("{:.2} / {:.1e}", limits[i].0, limits[i].1));
        rows.push([title(method)].into_iter().chain(cells).collect());
    }
    let ratios = found.map(|limits| figure(limits[0].1 / limits[3].1, 2));
    rows.push(["sweeps over dbd's error".to_owned()].into_iter().chain(ratios).collect());
    let head = [&["limit of ω·h / error at it, at 2 at most [m]"], &SCENES[..]].concat();
    block("docs/reference-solvers.md", "damped", &table(&head, &rows));
}

/// The limit of each method on a damped mechanism, and the error \[m\] at it.
fn damped_limits(name: &str, methods: &[Method; 4]) -> [(f64, f64); 4] {
    let scene = damped(name);
    let reference_solution = Trajectory::reference_solution(&scene, 0.1, 10).unwrap();
    let limits = methods.each_ref().map(|method| {
        let found = of(&scene, method);
        // The longest step that divides the interval between samples.
        let usable = found.largest_step.min(method.stability_limit() / found.frequency);
        let steps = (reference_solution.times[1] / usable * 1.02).ceil() as u64;
        (found.z(), reference_solution.error(&reference_solution.run(&scene, method, steps)))
    });
    let [sweeps, explicit, euler, paper] = limits;
    assert!(sweeps.0 >= 1.9, "{name}: {sweeps:?}");
    assert!(euler.0 < 0.5 && paper.0 < 0.5, "{name}: {euler:?} {paper:?}");
    assert!((explicit.0 - 1.0).abs() < 0.05, "{name}: {explicit:?}");
    // Each at its own limit: sweeps at five times the paper's step have up to three times its
    // error, explicit damping in leapfrog at nearly three times the step up to half of it.
    let [ratio, second] = [sweeps.1 / paper.1, explicit.1 / paper.1];
    assert!(ratio < 4.0 && second < 0.6, "{name}: {ratio} {second}");
    let still = vec![reference_solution.states[0].positions(); reference_solution.times.len()];
    let moved = reference_solution.errors(&still).into_iter().fold(0.0, f64::max);
    for (_, error) in limits {
        assert!(error < 0.1 * moved, "{name}: {error:e} of {moved:e}");
    }
    limits
}

/// Rounding makes energy in soft modes, of long chains and of mechanisms far from the origin, that
/// is no growth: single precision steps calmly up to the limit of double, and fails beyond it.
#[test]
fn single_precision_has_the_same_limits() {
    for (name, scheme, newton, limit) in [
        ("six-bar", SchemeName::Leapfrog, None, 2.0),
        ("six-bar", SchemeName::Dbd, Some(1), 1.0),
        ("3ruu", SchemeName::Leapfrog, None, 2.0),
        ("hanging-chain", SchemeName::Leapfrog, None, 2.0),
    ] {
        let scene = scene(name);
        let method = Method::new(scheme, newton, PrecisionName::F32).unwrap();
        let found = Vibration::about(&scene.model, &State::initial(&scene.model)).unwrap();
        let found = found.first_range(&method).unwrap();
        assert!((found.z() / limit - 1.0).abs() < 0.05, "{name}, {method:?}: {found:?}");
        if name != "3ruu" {
            // Planar motion does not excite what grows.
            continue;
        }
        let grown = |share: f64| {
            let mut plant = plant(&scene, &method, share * found.largest_step).unwrap();
            let start = plant.energy().total();
            let running = plant.advance(300).is_ok();
            if running { plant.energy().total() - start } else { f64::INFINITY }
        };
        let (calm, torn) = (grown(0.85), grown(1.15));
        assert!(calm.abs() < 10.0 && torn > 1e6, "{name}, {method:?}: {calm:e} J, {torn:e} J");
    }
}

#[test]
fn one_oscillator_has_the_linear_limit_and_a_free_body_none() {
    let scene = scene("spring-ball");
    let found = of(&scene, &method(SchemeName::Leapfrog, None));
    assert!((found.z() - 2.0).abs() < 1e-2 && (found.frequency - 1e3_f64.sqrt()).abs() < 1e-3);
    assert_eq!(found, of(&scene, &method(SchemeName::Leapfrog, None)));
    let text = "name = \"f\"\nduration = 1\n[[body]]\nname = \"b\"\nmass = 1\ninertia = [1, 1, 1]\n\
                position = [0, 0, 0]";
    let free = Scene::parse(text, "free.toml").unwrap();
    let state = State::initial(&free.model);
    assert_eq!(stability(&free.model, &state, &method(SchemeName::Leapfrog, None)), Ok(None));
    let approximate = Method::new(SchemeName::Leapfrog, None, PrecisionName::F32Micromath).unwrap();
    assert!(stability(&free.model, &state, &approximate).is_err(), "no pose is at rest in it");
}
