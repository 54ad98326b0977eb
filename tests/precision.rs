//! What single precision costs beside double: the same steps in both, without the discretisation.

use dbd_kernel::energy::energy;
use dbd_kernel::{BodyState, F64};
use dbd_plant::{DampingName, Method, PrecisionName, SchemeName, plant};
use dbd_scene::Scene;
use dbd_tests::distance;

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
    plant.advance(steps).ok().unwrap();
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
