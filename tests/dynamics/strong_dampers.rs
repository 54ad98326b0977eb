//! Strong dampers that cross: what a step of leapfrog makes of mechanisms at random with sliders, and whether it is
//! warned of.

use dbd_plant::{DampingName, Frequencies, Method, PrecisionName, SchemeName};
use dbd_scene::Scene;
use dbd_study::reference::reference_solution::{Integrator, integrate};
use dbd_study::reference::trajectory::{Positions, sample_times};
use dbd_study::reference::{Mechanism, Trajectory};
use dbd_tests::mechanisms::{JOINTS, Kind, mechanism};
use dbd_tests::page::{block, table};
use dbd_tests::{scene, scene_names};
use host_sim::commands::warnings::of_step;

/// \[s\] the window and its samples.
const WINDOW: f64 = 0.3;
const SAMPLES: u32 = 15;

/// What a warning says that may be lost of a motion, and what is lost without one at most.
const WARNED: f64 = 0.01;
const LEVEL: f64 = 0.015;

fn method(scheme: SchemeName) -> Method {
    Method::new(scheme, None, PrecisionName::F64).unwrap()
}

/// What is said of the dampers at a step.
fn warning(scene: &Scene, method: &Method, step: f64) -> Option<String> {
    let all = of_step(scene, &Frequencies::of(scene), method, step, "the step");
    all.into_iter().find(|warning| warning.contains("is long for the dampers"))
}

/// \[s\] the step that a warning names.
fn named(warning: &str) -> f64 {
    let (_, advice) = warning.split_once("a step of at most ").unwrap();
    let (advice, _) = advice.split_once(", or generalized-alpha").unwrap();
    let units = [("us", 1e-6), ("ms", 1e-3)];
    let read =
        |(unit, size): (&str, f64)| Some(advice.strip_suffix(unit)?.parse::<f64>().ok()? * size);
    units.into_iter().find_map(read).unwrap_or_else(|| panic!("{warning}"))
}

fn reference_solution(scene: &Scene) -> Trajectory {
    let (mechanism, start) = Mechanism::of(scene);
    let times = sample_times(WINDOW, SAMPLES);
    let states = integrate(Integrator::Dop853, &mechanism, &start, &times).unwrap();
    let uncertainty = vec![0.0; times.len()];
    Trajectory { times, states, uncertainty }
}

/// The largest distance of a body from the truth over the largest way of one.
fn error(reference_solution: &Trajectory, run: &[Positions]) -> f64 {
    let start = reference_solution.states[0].positions();
    let (mut motion, mut worst) = (0.0_f64, 0.0_f64);
    for (state, run) in reference_solution.states.iter().zip(run) {
        for ((reference_solution, run), start) in state.positions().iter().zip(run).zip(&start) {
            motion = motion.max((reference_solution - start).norm());
            worst = worst.max((reference_solution - run).norm());
        }
    }
    if run.len() == reference_solution.states.len() { worst / motion } else { f64::INFINITY }
}

#[test]
fn what_is_off_by_more_than_a_percent_is_warned_of() {
    let mut rows: Vec<Vec<String>> = Vec::new();
    for damping in [[0.2, 0.4], [0.4, 0.8]] {
        let kind =
            Kind { planar: false, joints: JOINTS, damping, driven: false, approximate: false };
        let texts = (1..).map(|seed| mechanism(seed, kind));
        let slides = |text: &String| text.contains("cylindrical") || text.contains("translational");
        let [mut off, mut warned] = [0; 2];
        let mut worst = [0.0_f64; 3];
        for text in texts.filter(slides).take(60) {
            let scene = Scene::parse(&text, "random.toml").unwrap_or_else(|why| panic!("{why}"));
            let reference_solution = reference_solution(&scene);
            let at = |scheme, step: f64| {
                let steps = (WINDOW / f64::from(SAMPLES) / step).ceil();
                error(
                    &reference_solution,
                    &reference_solution.run(&scene, &method(scheme), steps as u64),
                )
            };
            let step = Frequencies::of(&scene).advised_step().unwrap();
            let found = at(SchemeName::Leapfrog, step);
            off += u32::from(found > WARNED);
            let Some(warning) = warning(&scene, &method(SchemeName::Leapfrog), step) else {
                worst[0] = worst[0].max(found);
                continue;
            };
            warned += 1;
            worst[1] = worst[1].max(at(SchemeName::Leapfrog, named(&warning)));
            worst[2] = worst[2].max(at(SchemeName::GeneralizedAlpha, step));
        }
        println!("{damping:?} {off} {warned} {worst:?}");
        assert!(off > 0, "no mechanism needs a warning");
        assert!(worst.iter().all(|error| *error < LEVEL), "{damping:?}: {worst:?}");
        let [from, to] = damping;
        let row = [format!("{from} to {to}"), "60".into(), off.to_string(), warned.to_string()];
        let percent = worst.map(|error| format!("{:.1} %", 100.0 * error));
        rows.push(row.into_iter().chain(percent).collect());
    }
    let head = [
        "damping ratio",
        "mechanisms",
        "off by more than 1 %",
        "warned of",
        "worst without a warning",
        "worst at the step that the warning names",
        "worst of those by `generalized-alpha`",
    ];
    block("docs/schemes-measured.md", "strong dampers", &table(&head, &rows));
}

/// Nor at twice its step.
#[test]
fn no_scene_that_ships_is_warned_of() {
    let leapfrog = method(SchemeName::Leapfrog);
    for name in scene_names() {
        let scene = scene(&name);
        let advised = Frequencies::of(&scene).advised_step();
        for step in scene.step.into_iter().chain(advised) {
            for damping in [DampingName::Sweeps, DampingName::JointWise] {
                let method = leapfrog.with_damping(damping).unwrap();
                assert_eq!(warning(&scene, &method, step), None, "{name} at {step}");
                assert_eq!(warning(&scene, &method, 2.0 * step), None, "{name} at {step}");
            }
        }
    }
}
