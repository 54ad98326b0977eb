//! What single precision costs beside double: the same steps in both, without the discretisation.

use dbd_kernel::energy::energy;
use dbd_kernel::{BodyState, F64, State, frequency};
use dbd_plant::{DampingName, Method, Named as _, PrecisionName, SchemeName, plant};
use dbd_scene::Scene;
use dbd_tests::page::{block, figure, table};
use dbd_tests::{distance, scene};

/// Two bars in a row on damped revolutes that a wound torsion spring spins up to some 40 rad/s.
fn spun_up(preload: f64) -> Scene {
    let text = format!(
        r#"
        name = "spun up"
        duration = 1
        gravity = [0, -9.81, 0]
        [[body]]
        name = "upper"
        mass = 1
        inertia = [0.02, 0.002, 0.02]
        position = [0, -0.25, 0]
        [[body]]
        name = "lower"
        mass = 1
        inertia = [0.02, 0.002, 0.02]
        position = [0, -0.75, 0]
        [[joint]]
        name = "pivot"
        type = "revolute"
        between = ["world", "upper"]
        at = [0, 0, 0]
        axis = [0, 0, 1]
        stiffness = 1e5
        damping_ratio = 0.05
        frequency = 100
        span = 0.1
        [[joint]]
        name = "elbow"
        type = "revolute"
        between = ["upper", "lower"]
        at = [0, -0.5, 0]
        axis = [0, 0, 1]
        stiffness = 1e5
        damping_ratio = 0.05
        frequency = 100
        span = 0.1
        [[torsion_spring]]
        between = ["world", "upper"]
        axis = [0, 0, 1]
        stiffness = 2
        preload = {preload}
        "#
    );
    Scene::parse(&text, "spun-up.toml").unwrap_or_else(|error| panic!("{error:?}"))
}

/// Bodies and energy \[J\] after `steps` of `step` \[s\] in a precision; the energy is computed from
/// the stored words in double precision.
fn end(
    scene: &Scene,
    precision: PrecisionName,
    damping: DampingName,
    step: f64,
    steps: u64,
) -> (Vec<BodyState<F64>>, f64) {
    let method = Method::new(SchemeName::Leapfrog, None, precision).unwrap();
    let method = method.with_damping(damping).unwrap();
    let mut plant = plant(scene, &method, step).unwrap();
    plant.advance(steps).unwrap();
    let state = plant.state();
    let energy = energy(&scene.model, &state, step).total();
    (state.bodies.to_vec(), energy)
}

/// The root of the mean square.
fn rms(values: &[f64]) -> f64 {
    (values.iter().map(|v| v * v).sum::<f64>() / values.len() as f64).sqrt()
}

#[test]
fn sweeps_of_a_fast_mechanism_lose_no_more_to_rounding_than_explicit_dampers() {
    let (step, steps) = (24.5e-6, 40_000);
    let scenes: Vec<_> = (0..8).map(|i| spun_up(30.0 + 6.0 * f64::from(i))).collect();
    let off = |damping| {
        let off = scenes.iter().map(|scene| {
            let (single, with) = end(scene, PrecisionName::F32, damping, step, steps);
            let (double, without) = end(scene, PrecisionName::F64, damping, step, steps);
            (distance(&single, &double), with - without)
        });
        off.unzip::<_, _, Vec<_>, Vec<_>>()
    };
    let (sweeps, gained) = off(DampingName::Sweeps);
    let (explicit, explicit_gained) = off(DampingName::Explicit);
    let [sweeps, explicit] = [rms(&sweeps), rms(&explicit)];
    assert!(sweeps < 3.0 * explicit, "{sweeps:e} m, explicit {explicit:e} m");
    // Energy comes and goes with rounding; dampers do not add to it.
    let [gained, explicit] = [rms(&gained), rms(&explicit_gained)];
    assert!(gained < 3.0 * explicit, "{gained:e} J, explicit {explicit:e} J");
}

/// A double pendulum that turns over several times, spun up by a torsion spring. Its pivots are revolute
/// joints of TSDAs, or the same TSDAs one by one.
fn double_pendulum(raw: bool) -> Scene {
    let mut text = r#"
        name = "double pendulum"
        duration = 2
        gravity = [0, -9.81, 0]
        body = [
            { name = "upper", mass = 2, inertia = [0.015, 3e-4, 0.015], position = [0, -0.15, 0] },
            { name = "lower", mass = 1, inertia = [3.3e-3, 6.7e-5, 3.3e-3], position = [0, -0.4, 0] },
        ]
        torsion_spring = [
            { between = ["world", "upper"], axis = [0, 0, 1], stiffness = 0.35, damping = 0.02, preload = 14 },
            { between = ["upper", "lower"], axis = [0, 0, 1], stiffness = 0.8, damping = 0.01 },
        ]
    "#
    .to_owned();
    // Heights of each pivot: of its place, in the axes of its first and of its second body.
    let pivots = [(["world", "upper"], [0.0, 0.0, 0.15]), (["upper", "lower"], [-0.3, -0.15, 0.1])];
    for (i, ([a, b], [place, in_a, in_b])) in pivots.into_iter().enumerate() {
        if raw {
            for z in [-0.03, 0.03] {
                for (x, y) in [(0.0, -0.0245), (0.0212, 0.0122), (-0.0212, 0.0122)] {
                    let (at, beyond) = (in_b + y, z + if z > 0.0 { 0.0173 } else { -0.0173 });
                    text += &format!(
                        "[[tsda]]\nbetween = [\"{a}\", \"{b}\"]\n\
                         points = [[0, {in_a}, {z}], [{x}, {at}, {beyond}]]\n\
                         stiffness = 5e5\ndamping = 30\nfree_length = \"initial\"\n"
                    );
                }
            }
        } else {
            text += &format!(
                "[[joint]]\nname = \"{i}\"\ntype = \"revolute\"\nbetween = [\"{a}\", \"{b}\"]\n\
                 at = [0, {place}, 0]\naxis = [0, 0, 1]\nspan = 0.06\nstiffness = 5e5\ndamping = 30\n"
            );
        }
    }
    Scene::parse(&text, "double-pendulum.toml").unwrap_or_else(|error| panic!("{error:?}"))
}

/// Single precision is off double by no more than twice what explicit damping is or what the step costs.
#[test]
fn damper_passes_lose_little_to_rounding_at_any_step() {
    for raw in [true, false] {
        let scene = double_pendulum(raw);
        let end = |precision, damping, step: f64| {
            end(&scene, precision, damping, step, (1.5 / step).round() as u64).0
        };
        let (double, single) = (PrecisionName::F64, PrecisionName::F32);
        let exact = end(double, DampingName::Sweeps, 2.5e-6);
        for step in [1e-5, 2e-5] {
            let off = |damping| {
                let without = end(double, damping, step);
                (distance(&end(single, damping, step), &without), distance(&without, &exact))
            };
            let (explicit, _) = off(DampingName::Explicit);
            for damping in [DampingName::Sweeps, DampingName::JointWise] {
                let (off, discretisation) = off(damping);
                let most = 2.0 * explicit.max(discretisation);
                assert!(off < most, "{raw} {damping:?} {step:e} s: {off:e} m, {most:e} m");
            }
        }
    }
}

/// The steps of the page, as ω·h of the bound.
const STEPS: [f64; 6] = [1.6, 0.8, 0.4, 0.2, 0.05, 0.0125];

/// Errors \[m\] in single precision at the steps, against fourth order in double.
fn errors<const N: usize>(
    name: &str,
    time: f64,
    scheme: SchemeName,
    products: [f64; N],
) -> [f64; N] {
    let scene = scene(name);
    let omega = frequency::bound(&scene.model, &State::initial(&scene.model));
    let end = |scheme, precision, product: f64| {
        let steps = (time * omega / product).ceil();
        let method = Method::new(scheme, None, precision).unwrap();
        let mut plant = plant(&scene, &method, time / steps).unwrap();
        plant.advance(steps as u64).unwrap();
        plant.state().bodies.to_vec()
    };
    let reference_solution = end(SchemeName::BlanesMoanS6, PrecisionName::F64, 0.1);
    products.map(|product| distance(&end(scheme, PrecisionName::F32, product), &reference_solution))
}

#[test]
fn from_some_step_on_a_smaller_one_is_less_accurate() {
    let mut rows = Vec::new();
    for (name, time) in [("six-bar", 0.1), ("3ruu", 0.05), ("hexagon", 0.2)] {
        for scheme in [SchemeName::Leapfrog, SchemeName::Rk4, SchemeName::Pefrl] {
            let errors = errors(name, time, scheme, STEPS);
            let best = (0..errors.len()).min_by(|a, b| errors[*a].total_cmp(&errors[*b])).unwrap();
            // Fourth order that rounds every part of a step gains nothing from a shorter one.
            let products = match scheme {
                SchemeName::Pefrl => 0.8..2.0,
                SchemeName::Rk4 => 0.1..1.0,
                _ => 0.05..0.5,
            };
            assert!(products.contains(&STEPS[best]), "{name}, {scheme:?}: {errors:?}");
            // Where a run warns of a step, the error has grown to several times its least.
            let [.., short, shortest] = errors;
            let warned = if scheme == SchemeName::Pefrl { short } else { shortest };
            assert!(warned > 3.0 * errors[best], "{name}, {scheme:?}: {errors:?}");
            let cells = errors.iter().enumerate().map(|(i, error)| {
                let text = figure(*error, 2);
                if i == best { format!("**{text}**") } else { text }
            });
            rows.push([format!("`{name}`, {}", scheme.name())].into_iter().chain(cells).collect());
        }
    }
    let head: Vec<_> = STEPS.iter().map(|product| format!("ω·h = {product}")).collect();
    let head: Vec<_> = [""].into_iter().chain(head.iter().map(String::as_str)).collect();
    block("docs/schemes-measured.md", "single precision", &table(&head, &rows));
}

/// Where a run under a scheme of first order warns of a step, its error has grown, too.
#[test]
fn first_order_bears_shorter_steps_but_not_any() {
    for (name, time) in [("six-bar", 0.02), ("3ruu", 0.01), ("hexagon", 0.02)] {
        let errors = errors(name, time, SchemeName::SemiImplicitEuler, [0.2, 0.05, 0.0125, 0.003]);
        let best = errors.into_iter().fold(f64::MAX, f64::min);
        assert!(errors[3] > 1.5 * best, "{name}: {errors:?}");
    }
}
