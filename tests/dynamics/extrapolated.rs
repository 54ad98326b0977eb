//! The scheme generalized-alpha-3: no vibration grows, what a turning body gains, what its accuracy costs.

use dbd_kernel::energy::energy;
use dbd_kernel::{BodyState, F64, GeneralizedAlpha, GeneralizedAlpha3, Plant, Scheme};
use dbd_scene::{Scene, SceneModel};
use dbd_tests::page::{block, figure, table};
use dbd_tests::scene;

/// A weight that is held at its centre.
fn held(stiffness: f64, damping: f64) -> SceneModel<F64> {
    let text = format!(
        r#"
name = "held"
duration = 1.0
gravity = [0, 0, 0]
[[body]]
name = "weight"
mass = 1.0
inertia = [0.01, 0.01, 0.01]
position = [0, 0, 0]
velocity = [0.001, 0.002, -0.001]
[[joint]]
name = "hold"
type = "spherical"
between = ["world", "weight"]
at = [0, 0, 0]
arm = 0.1
stiffness = {stiffness}
damping = {damping}
"#
    );
    Scene::parse(&text, "held.toml").unwrap().model.planned()
}

/// From far below what a step resolves to far beyond, undamped to overdamped.
#[test]
fn no_vibration_grows() {
    const STEP: f64 = 1e-3;
    for exponent in -8..=24 {
        let z = 10.0_f64.powf(f64::from(exponent) / 4.0);
        let stiffness = (z / STEP) * (z / STEP);
        for ratio in [0.0, 1e-3, 0.1, 1.0, 30.0] {
            let damping = 2.0 * ratio * z / STEP;
            let model = held(stiffness, damping);
            let Ok(mut plant) = Plant::new(&model, GeneralizedAlpha3, STEP) else {
                assert!(z > 1e5, "{z} {ratio}");
                continue;
            };
            let total = |plant: &Plant<_, _>| energy(&model, plant.state(), STEP).total();
            plant.advance(20).unwrap();
            let mut before = total(&plant).max(1e-18);
            for _ in 0..20 {
                plant.advance(200).unwrap();
                let now = total(&plant);
                // What is stored and what moves are of one time to the order of the step.
                assert!(now < before * 1.001 + 1e-18, "{z} {ratio}: {now:e} after {before:e}");
                before = now.max(1e-18);
            }
        }
    }
}

/// A rod that turns about its end, free of gravity.
fn rotor(realisation: &str) -> SceneModel<F64> {
    let text = format!(
        r#"
name = "rotor"
duration = 1.0
gravity = [0, 0, 0]
[[body]]
name = "rod"
mass = 1.0
inertia = [0.01, 0.0833, 0.0833]
position = [0.5, 0, 0]
velocity = [0, {}, 0]
angular_velocity = [0, 0, {RATE}]
[[joint]]
name = "pin"
type = "revolute"
between = ["world", "rod"]
at = [0, 0, 0]
axis = [0, 0, 1]
span = 0.1
stiffness = 1e9
realisation = "{realisation}"
"#,
        0.5 * RATE
    );
    Scene::parse(&text, "rotor.toml").unwrap().model.planned()
}

/// \[rad/s\].
const RATE: f64 = 10.0;

/// Both schemes, per step, as a share of its energy.
#[test]
fn what_a_turning_body_gains() {
    fn per_step<S: Scheme>(model: &SceneModel<F64>, scheme: S, step: f64) -> f64 {
        let mut plant = Plant::new(model, scheme, step).unwrap();
        plant.advance(50).unwrap();
        let before = energy(model, plant.state(), step).total();
        plant.advance(100).unwrap();
        (energy(model, plant.state(), step).total() / before - 1.0) / 100.0
    }
    for (realisation, turns) in [("tsda", &[0.025, 0.05][..]), ("bushing", &[0.025, 0.05, 0.1])] {
        let model = rotor(realisation);
        let mut last: Option<f64> = None;
        for turn in turns {
            let step = turn / RATE;
            let second = per_step(&model, GeneralizedAlpha::DEFAULT, step);
            let third = per_step(&model, GeneralizedAlpha3, step);
            println!("{realisation} {turn}: {second:e} {third:e}");
            // No more than what the other loses, and of fourth order at least.
            assert!(
                second < 0.0 && third.abs() < 1.2 * second.abs(),
                "{turn}: {second:e} {third:e}"
            );
            assert!(
                last.is_none_or(|last| third > 10.0 * last),
                "{turn}: {third:e} after {last:?}"
            );
            last = Some(third);
        }
    }
}

/// \[m\] positions.
fn after<S: Scheme>(model: &SceneModel<F64>, scheme: S, step: f64, time: f64) -> Vec<[f64; 3]> {
    let mut plant = Plant::new(model, scheme, step).unwrap();
    plant.advance((time / step).round() as u64).unwrap();
    let bodies: &[BodyState<F64>] = &plant.state().bodies;
    bodies.iter().map(|body| body.position.to_f64()).collect()
}

fn apart(a: &[[f64; 3]], b: &[[f64; 3]]) -> f64 {
    let between = |(a, b): (&[f64; 3], &[f64; 3])| {
        a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt()
    };
    a.iter().zip(b).map(between).fold(0.0, f64::max)
}

/// At three solves per step: steps of `generalized-alpha` are a third as long.
#[test]
fn what_third_order_is_worth() {
    const TIME: f64 = 0.1;
    let mut rows = Vec::new();
    for (name, stiffness, least) in
        [("four-bar", "9e10", 10.0), ("six-bar", "9e10", 3.0), ("3rrr", "9e10", 3.0)]
    {
        let scene = scene(name).with(&format!("joint.*.stiffness={stiffness}")).unwrap();
        let model: SceneModel<F64> = scene.model.planned();
        let reference_solution = after(&model, GeneralizedAlpha3, 1e-5, TIME);
        for step in [1e-3, 5e-4, 2.5e-4] {
            let second = apart(
                &after(&model, GeneralizedAlpha::DEFAULT, step / 3.0, TIME),
                &reference_solution,
            );
            let third = apart(&after(&model, GeneralizedAlpha3, step, TIME), &reference_solution);
            println!("{name} {step}: {second:e} {third:e}");
            assert!(step > 6e-4 || third * least < second, "{name} {step}: {second:e} {third:e}");
            rows.push(vec![
                format!("`{name}`"),
                figure(step * 1e3, 2),
                figure(second, 2),
                figure(third, 2),
            ]);
        }
    }
    let head = [
        "scene",
        "step [ms]",
        "`generalized-alpha`, a third of the step [m]",
        "`generalized-alpha-3` [m]",
    ];
    block("docs/near-rigid.md", "near-rigid third order", &table(&head, &rows));
}
