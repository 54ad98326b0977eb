//! The largest stable steps of every scheme on the paper's mechanisms, beside the linear limits.
//!
//! About the initial pose, frozen; see `host_sim::stability` for the criterion. The limits are those
//! of one oscillator. `DBD_PRINT=1 cargo test --release -p dbd-tests --test stability -- --nocapture`
//! prints the table.

use dbd_kernel::State;
use dbd_kernel::model::{DamperIndex, Law};
use dbd_scene::Scene;
use dbd_tests::scene;
use host_sim::method::{DampingName, Method, PrecisionName, SchemeName};
use host_sim::reference::Trajectory;
use host_sim::stability::{Stability, stability};

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

fn limits_hold(name: &str) {
    let scene = scene(name);
    for (scheme, newton, limit) in LIMITS {
        let method = method(scheme, newton);
        let found = of(&scene, &method);
        let z = found.z();
        if std::env::var_os("DBD_PRINT").is_some() {
            let label = format!("{} {}", method.scheme_name(), newton.unwrap_or(0));
            println!("{name:12} {label:20} z = {z:.3}  {:.3?}", found.ranges);
        }
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
}

macro_rules! limits {
    ($($test:ident: $name:literal),*) => {$(
        #[test]
        fn $test() {
            limits_hold($name);
        }
    )*};
}

limits! {
    four_bar: "four-bar", five_bar_b: "five-bar-b", six_bar: "six-bar", three_rrr: "3rrr",
    crank_slider: "crank-slider"
}

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
        };
        model.dampers.extend(stiffnesses.iter().map(|stiffness| 2.0 * stiffness / dominant));
    }
    scene
}

/// Strong dampers, ζ = 2 in the fastest mode, leave the sweeps their step. Explicit damping at one
/// velocity per step, as in semi-implicit Euler, ends at `2·(√(ζ² + 1) − ζ)`, 0.47, the paper's step
/// earlier still; leapfrog's two half kicks at `2/ζ`, 1. The errors of the trajectory, each at its
/// own limit, are printed beside each other.
#[test]
fn sweeps_keep_the_step_that_explicit_damping_loses() {
    for name in ["four-bar", "five-bar-b", "six-bar", "3rrr", "crank-slider"] {
        let scene = damped(name);
        let truth = Trajectory::truth(&scene, 0.1, 10).unwrap();
        let sweeps = method(SchemeName::Leapfrog, None);
        let explicit = sweeps.with_damping(DampingName::Explicit).unwrap();
        let paper = method(SchemeName::Dbd, Some(0));
        let euler = method(SchemeName::SemiImplicitEuler, None);
        let euler = euler.with_damping(DampingName::Explicit).unwrap();
        let [sweeps, explicit, euler, paper] = [sweeps, explicit, euler, paper].map(|method| {
            let found = of(&scene, &method);
            // The longest step that divides the interval between samples.
            let steps = (truth.times[1] / found.largest_step * 1.02).ceil() as u64;
            let error = truth.error(&truth.run(&scene, &method, steps));
            let z = found.frequency * truth.times[1] / steps as f64;
            if std::env::var_os("DBD_PRINT").is_some() {
                let label = format!("{} {}", method.scheme_name(), method.damping().name());
                println!(
                    "{name:12} {label:18} limit {:.3}, error at z = {z:.3}: {error:.1e} m",
                    found.z()
                );
            }
            (found.z(), error)
        });
        assert!(sweeps.0 >= 1.9, "{name}: {sweeps:?}");
        assert!(euler.0 < 0.5 && paper.0 < 0.5, "{name}: {euler:?} {paper:?}");
        assert!((explicit.0 - 1.0).abs() < 0.05, "{name}: {explicit:?}");
        // Each at its own limit: sweeps at five times the paper's step have up to three times its
        // error, explicit damping in leapfrog at nearly three times the step up to half of it.
        let [ratio, second] = [sweeps.1 / paper.1, explicit.1 / paper.1];
        if std::env::var_os("DBD_PRINT").is_some() {
            println!("{name:12} of dbd's error: sweeps {ratio:.2}, explicit {second:.3}");
        }
        assert!(ratio < 4.0 && second < 0.6, "{name}: {ratio} {second}");
        let still = vec![truth.states[0].positions(); truth.times.len()];
        let moved = truth.errors(&still).into_iter().fold(0.0, f64::max);
        for (_, error) in [sweeps, explicit, euler, paper] {
            assert!(error < 0.1 * moved, "{name}: {error:e} of {moved:e}");
        }
    }
}

#[test]
fn single_precision_has_the_same_limits() {
    let scene = scene("six-bar");
    for (scheme, newton, limit) in [
        (SchemeName::Leapfrog, None, 2.0),
        (SchemeName::Dbd, Some(1), 1.0),
        (SchemeName::Pefrl, None, 2.989),
    ] {
        let method = Method::new(scheme, newton, PrecisionName::F32).unwrap();
        let found = of(&scene, &method);
        assert!((found.z() / limit - 1.0).abs() < 0.05, "{method:?}: {found:?}");
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
    let loose = Method::new(SchemeName::Leapfrog, None, PrecisionName::F32Micromath).unwrap();
    assert!(stability(&free.model, &state, &loose).is_err(), "no pose is at rest in it");
}
