//! Joints of bushings in motion: forces as the reference writes them, energy, momentum, order, bound, bits.

use dbd_kernel::energy::energy;
use dbd_kernel::forces::wrenches;
use dbd_kernel::{F32, F64, Geometry, Leapfrog, Pefrl, Plant, State, Vec3, frequency};
use dbd_scene::{Scene, SceneModel};
use dbd_study::reference::signals::Clock;
use dbd_study::reference::{self as reference, Mechanism};
use dbd_tests::{momenta, scene};

/// Two bodies that a joint of each type holds, one after the other, free in space.
const CHAIN: &str = r#"
    name = "chain of bushings"
    duration = 1
    realisation = "bushing"
    defaults.joint = { stiffness = 2e4, damping = DAMPING, span = 0.1 }
    [[body]]
    name = "a"
    mass = 1.2
    inertia = [0.02, 0.03, 0.025]
    position = [0, 0, 0]
    orientation = { euler_321 = [0.4, 1.1, -0.7] }
    angular_velocity = [1, -2, 0.5]
    [[body]]
    name = "b"
    mass = 0.8
    inertia = [0.01, 0.02, 0.015]
    position = [0.4, 0.1, 0]
    orientation = { euler_321 = [-1.4, 0.2, 0.9] }
    velocity = [0.3, 0, -0.2]
    [[body]]
    name = "c"
    mass = 0.5
    inertia = [0.01, 0.01, 0.01]
    position = [0.8, 0, 0.1]
    [[body]]
    name = "d"
    mass = 0.6
    inertia = [0.01, 0.012, 0.008]
    position = [1.2, 0, 0]
    [[body]]
    name = "e"
    mass = 0.4
    inertia = [0.004, 0.005, 0.006]
    position = [1.5, 0.1, 0]
    [[joint]]
    name = "stiffer along"
    type = "revolute"
    between = ["a", "b"]
    at = [0.2, 0, 0]
    axis = [0.2, 1, 0.4]
    ring = 0.04
    [[joint]]
    name = "cardan"
    type = "universal"
    between = ["b", "c"]
    at = [0.6, 0, 0]
    axes = [[0, 1, 0], [0, 0, 1]]
    [[joint]]
    name = "ball"
    type = "spherical"
    between = ["c", "d"]
    at = [1, 0, 0]
    [[joint]]
    name = "hinge"
    type = "revolute"
    between = ["d", "e"]
    at = [1.3, 0, 0]
    axis = [0, 0, 1]
    [[joint]]
    name = "weld"
    type = "fixed"
    between = ["a", "c"]
    at = [0.5, 0.3, 0]
    axis = [0, 0, 1]
    stiffness = 500
"#;

fn chain(damping: f64) -> Scene {
    Scene::parse(&CHAIN.replace("DAMPING", &format!("{damping:?}")), "chain.toml").unwrap()
}

/// The state after some steps, far from the pose of assembly.
fn state_after(model: &SceneModel<F64>, h: f64, steps: u64) -> State<SceneModel<F64>> {
    let mut plant = Plant::new(model, Leapfrog, h).unwrap();
    plant.advance(steps).unwrap();
    plant.state().clone()
}

#[test]
fn forces_are_those_of_the_reference() {
    for damping in [0.0, 40.0] {
        let scene = chain(damping);
        for steps in [0, 37, 400] {
            let state = state_after(&scene.model, 2e-4, steps);
            let (mechanism, _) = Mechanism::of(&scene);
            let clock = Clock::at(state.step as f64 * 2e-4);
            let same = reference::State::of(&state);
            let accelerations = mechanism.respond(&mechanism.at(&same, clock));
            let found = wrenches(&scene.model, &state, 2e-4).unwrap();
            for ((body, state), (wrench, other)) in
                scene.model.bodies.iter().zip(&state.bodies).zip(found.iter().zip(&accelerations))
            {
                let rate = state.angular_velocity;
                let torque = wrench.torque - rate.cross(body.inertia.scale(rate));
                let linear = wrench.force * body.inverse_mass - vector(&other.linear);
                let angular = torque.scale(body.inverse_inertia) - vector(&other.angular);
                let size = 1.0 + other.linear.norm() + other.angular.norm();
                let off = linear.dot(linear).sqrt().max(angular.dot(angular).sqrt());
                assert!(off < 1e-10 * size, "{damping} after {steps}: {off:e} of {size:e}");
            }
        }
    }
}

fn vector(v: &nalgebra::Vector3<f64>) -> Vec3<f64> {
    Vec3::new(v.x, v.y, v.z)
}

/// Sweeps of any strength take energy and linear momentum stays; halving the step quarters the error.
#[test]
fn damped_bushings_lose_energy_and_are_of_second_order() {
    for damping in [10.0, 1e3, 1e6] {
        let scene = chain(damping);
        let h = 0.5 / frequency::bound(&scene.model, &State::initial(&scene.model));
        let mut plant = Plant::new(&scene.model, Leapfrog, h).unwrap();
        let start = energy(&scene.model, plant.state(), h).total();
        let before = momentum(&scene.model, plant.state());
        for _ in 0..4000 {
            plant.step().unwrap();
        }
        let end = energy(&scene.model, plant.state(), h).total();
        assert!(end < start, "{damping}: {start} {end}");
        let lost = momentum(&scene.model, plant.state()) - before;
        assert!(lost.dot(lost).sqrt() < 1e-12, "{damping}: {lost:?}");
    }
    let scene = chain(10.0);
    let at = |halvings: u32| {
        let steps = 500 * 2_u64.pow(halvings);
        state_after(&scene.model, 0.05 / steps as f64, steps)
    };
    let reference_solution = at(5);
    let error = |halvings: u32| {
        let pairs = at(halvings).bodies.into_iter().zip(reference_solution.bodies.clone());
        let gaps = pairs.map(|(a, b)| (a.position - b.position).dot(a.position - b.position));
        gaps.sum::<f64>().sqrt()
    };
    let [coarse, fine] = [error(0), error(1)];
    assert!((3.5..4.6).contains(&(coarse / fine)), "{coarse:e} {fine:e}");
}

fn momentum(model: &SceneModel<F64>, state: &State<SceneModel<F64>>) -> Vec3<f64> {
    model.bodies.iter().zip(&state.bodies).fold(Vec3::ZERO, |sum, (body, state)| {
        sum + momenta(&[(body.mass, body.inertia.to_f64())], &[*state]).0
    })
}

/// The damper of a revolute acts on both bodies at one place: the angular momentum stays, too.
#[test]
fn a_damped_revolute_keeps_the_angular_momentum() {
    let mut model = chain(1e3).model;
    model.groups.retain(|group| group.law == dbd_kernel::model::Law::Revolute);
    let whole = |state: &State<SceneModel<F64>>| {
        model.bodies.iter().zip(&state.bodies).fold(Vec3::ZERO, |sum, (body, state)| {
            sum + momenta(&[(body.mass, body.inertia.to_f64())], &[*state]).1
        })
    };
    let loads = |damped: bool| {
        let state = state_after(&model, 2e-4, 50);
        let mut still = state.clone();
        if !damped {
            still.bodies.iter_mut().for_each(|body| body.velocity = Vec3::ZERO);
        }
        let wrenches = wrenches(&model, &still, 1e-3).unwrap();
        wrenches.iter().zip(&still.bodies).fold(Vec3::ZERO, |sum, (wrench, state)| {
            let torque = state.orientation.rotation().to_world(wrench.torque);
            sum + state.position.cross(wrench.force) + torque
        })
    };
    for damped in [false, true] {
        let torque = loads(damped);
        assert!(torque.dot(torque).sqrt() < 1e-9, "{torque:?}");
    }
    assert!(whole(&State::initial(&model)).is_finite());
}

#[test]
fn the_bound_of_the_frequency_is_above_the_estimate() {
    for steps in [0, 37, 400] {
        let scene = chain(0.0);
        let state = state_after(&scene.model, 2e-4, steps);
        let bound = frequency::bound(&scene.model, &state);
        let estimate = frequency::estimate(&scene.model, &state, 400);
        assert!(bound > 0.999 * estimate && bound < 4.0 * estimate, "{bound} {estimate}");
    }
}

/// \[m\] how far the bodies of a scene, and of the same of bushings, come apart in a tenth of a second. Both run
/// so finely that what differs is the model.
fn apart(own: &Scene) -> f64 {
    let other = own.with("realisation=bushing").unwrap();
    assert!(other.model.tsda_count() < own.model.tsda_count() / 2);
    let step = 0.5 / frequency::bound(&own.model, &State::initial(&own.model));
    let mut plants = [own, &other].map(|scene| Plant::new(&scene.model, Pefrl, step).unwrap());
    let place = |name| own.body_names.iter().position(|known| known == name).unwrap();
    let rows: Vec<usize> = other.body_names.iter().map(place).collect();
    let mut farthest = 0.0_f64;
    for _ in 0..50 {
        plants.iter_mut().for_each(|plant| plant.advance((2e-3 / step) as u64).unwrap());
        let [a, b] = plants.each_ref().map(|plant| &plant.state().bodies);
        for (row, body) in rows.iter().zip(b) {
            let gap = a[*row].position - body.position;
            farthest = farthest.max(gap.dot(gap).sqrt());
        }
    }
    farthest
}

/// The same mechanism of TSDAs and of bushings is as stiff at t = 0. Joints give way by F/k; by the share of
/// their length that it is, TSDAs change their stiffness, and bushings do not: the difference of the motions
/// falls as 1/k at least, to nothing.
#[test]
fn a_mechanism_moves_as_with_tsdas_the_more_the_stiffer_it_is() {
    for (name, stiffness) in [("four-bar", 9e6), ("hexagon", 9e6)] {
        let of = |factor: f64| {
            let change = format!("joint.*.stiffness={:e}", factor * stiffness);
            apart(&scene(name).with(&change).unwrap())
        };
        let [soft, stiff] = [1.0, 4.0].map(of);
        assert!(stiff > 0.0 && soft / stiff > 4.0, "{name}: {soft:e} {stiff:e}");
    }
}

/// Universal joints of bushings have no spider: what it weighs is missing, and the difference falls with its mass.
/// What is left of light ones falls with the stiffness.
#[test]
fn without_spiders_a_mechanism_moves_as_with_light_ones() {
    let of = |stiffness: f64, mass: f64| {
        let inertia = 2.8e-4 * mass;
        let changes = [
            format!("joint.*.stiffness={stiffness:e}"),
            format!("joint.*.spider.mass={mass:e}"),
            format!("joint.*.spider.inertia=[{inertia:e}, {inertia:e}, {inertia:e}]"),
        ];
        apart(&changes.iter().fold(scene("3ruu"), |scene, change| scene.with(change).unwrap()))
    };
    let [whole, half] = [0.5, 0.25].map(|mass| of(4e6, mass));
    assert!((1.8..2.2).contains(&(whole / half)), "{whole:e} {half:e}");
    let [soft, stiff] = [1e6, 4e6].map(|stiffness| of(stiffness, 5e-3));
    assert!(stiff > 0.0 && soft / stiff > 4.0, "{soft:e} {stiff:e}");
}

/// Part of the interface, as the hashes of `tests/bits` are: leapfrog, 500 steps.
const GOLDEN: [(&str, u64, u64); 3] = [
    ("hexagon", 0x67f9_0856_6037_e63a, 0xcc66_1273_bc20_5767),
    ("3ruu", 0x20da_7d76_0732_d8bc, 0xbca4_ef0e_d9c6_5107),
    ("double-wishbone", 0xeb8b_24b6_1d5b_3696, 0x97ef_e3bb_1953_af2c),
];

#[test]
fn states_have_their_golden_hashes() {
    let present = GOLDEN.map(|(name, ..)| {
        let scene = scene(name).with("realisation=bushing").unwrap();
        (name, hash::<F64>(&scene), hash::<F32>(&scene))
    });
    assert_eq!(present, GOLDEN, "{present:#x?}");
}

fn hash<P: Geometry>(scene: &Scene) -> u64 {
    let model: SceneModel<P> = scene.model.convert();
    let mut plant = Plant::new(&model, Leapfrog, scene.step.unwrap()).unwrap();
    plant.advance(500).unwrap();
    plant.hash()
}
