//! The suspensions: their modes lie where those of cars do and where Franco & Degani (2026,
//! section 4.7) say, and the wheel hops after a step of the road as its mode does.

use std::f64::consts::TAU;
use std::ops::Range;

use dbd_kernel::readouts::Reading;
use dbd_kernel::{F64, Leapfrog, Plant, State, Vec3};
use dbd_scene::{Scene, SceneModel};
use dbd_study::modes::{Modes, modes, scaled_damping, scaled_stiffness};
use dbd_tests::page::figure;
use dbd_tests::scene;
use nalgebra::{DVector, SymmetricEigen};

/// \[s\] both scenes have settled by then and the road has not moved.
const SETTLED: f64 = 0.5;

/// The model with those joints and torsion springs only whose names `keep` likes, without
/// gravity, loads, inputs and raw elements.
fn held_by(scene: &Scene, keep: impl Fn(&str) -> bool) -> SceneModel<F64> {
    let mut model = scene.model.clone();
    model.gravity.clear();
    model.loads.clear();
    let kept = |group: usize| {
        scene.joints.iter().any(|joint| joint.groups.contains(&group) && keep(&joint.name))
    };
    let groups: Vec<_> = (0..model.groups.len()).filter(|g| kept(*g)).collect();
    model.groups = groups.iter().map(|g| model.groups[*g]).collect();
    let springs = model.torsions.iter_mut().zip(&scene.torsion_names);
    for (spring, _) in springs.filter(|(_, name)| !keep(name)) {
        (spring.stiffness, spring.preload) = (0.0, 0.0);
    }
    model
}

/// The state after `time` \[s\] of the scene.
fn after(scene: &Scene, time: f64) -> State<SceneModel<F64>> {
    let step = scene.step.expect("the scene states its step");
    let mut plant = Plant::new(&scene.model, Leapfrog, step).unwrap();
    plant.advance((time / step).round() as u64).unwrap();
    plant.state().clone()
}

/// A scene, at rest on its springs, and its modes there.
fn settled(name: &str) -> (Scene, State<SceneModel<F64>>, Modes) {
    let scene = scene(name);
    let state = after(&scene, SETTLED);
    let modes = modes(&scene.model, &state).unwrap();
    assert!(modes.asymmetry < 1e-3, "{name} is not at rest: {:e}", modes.asymmetry);
    (scene, state, modes)
}

/// The mode that moves `bodies` most along z, and their share in it.
fn heave(modes: &Modes, bodies: &[usize]) -> (usize, f64) {
    let share = |mode: usize| -> f64 {
        bodies.iter().map(|body| modes.shapes[(6 * body + 2, mode)].powi(2)).sum()
    };
    let mode = (0..modes.frequencies.len()).max_by(|a, b| share(*a).total_cmp(&share(*b)));
    mode.map(|mode| (mode, share(mode))).unwrap()
}

/// The frequencies \[Hz\] of the modes that keep more than half of their energy in what `rubber`
/// names.
fn rubber_modes(
    scene: &Scene,
    state: &State<SceneModel<F64>>,
    modes: &Modes,
    rubber: impl Fn(&str) -> bool,
) -> Vec<f64> {
    let whole = scaled_stiffness(&scene.model, state).unwrap().0;
    let part = scaled_stiffness(&held_by(scene, rubber), state).unwrap().0;
    let elastic = (0..modes.frequencies.len()).filter(|mode| modes.frequencies[*mode] > 0.5);
    elastic
        .filter(|mode| {
            let x = modes.shapes.column(*mode);
            x.dot(&(&part * x)) > 0.5 * x.dot(&(&whole * x))
        })
        .map(|mode| modes.frequencies[mode])
        .collect()
}

/// The share of a mode's damping ratio that comes from the joints that `by` names, and all of it.
fn damping_ratios(
    scene: &Scene,
    state: &State<SceneModel<F64>>,
    modes: &Modes,
    mode: usize,
    by: impl Fn(&str) -> bool,
) -> [f64; 2] {
    let shape = modes.shapes.column(mode);
    let of = |model: &SceneModel<F64>| {
        shape.dot(&(scaled_damping(model, state).unwrap() * shape))
            / (2.0 * TAU * modes.frequencies[mode])
    };
    [of(&held_by(scene, by)), of(&scene.model)]
}

/// The shares of the modes in a rigid heave and in a rigid pitch of `bodies` about their common
/// centre of mass: the squared projections.
fn heave_and_pitch(
    scene: &Scene,
    state: &State<SceneModel<F64>>,
    modes: &Modes,
    bodies: &[usize],
) -> Vec<[f64; 2]> {
    let of = |row: usize| (&scene.model.bodies[row], state.bodies[row].position);
    let mass: f64 = bodies.iter().map(|row| of(*row).0.mass).sum();
    let moment = |row: &usize| of(*row).1 * of(*row).0.mass;
    let centre = bodies.iter().map(moment).fold(Vec3::ZERO, |sum, m| sum + m) * (1.0 / mass);
    let mut heave = DVector::zeros(modes.shapes.nrows());
    let mut pitch = heave.clone();
    for row in bodies {
        let (body, position) = of(*row);
        let (arm, root) = (position - centre, body.mass.sqrt());
        heave[6 * row + 2] = root;
        pitch[6 * row] = root * arm.z;
        pitch[6 * row + 2] = -root * arm.x;
        pitch[6 * row + 4] = body.inertia.y.sqrt();
    }
    heave.normalize_mut();
    pitch.normalize_mut();
    let shapes = modes.shapes.column_iter();
    shapes.map(|shape| [&heave, &pitch].map(|motion| shape.dot(motion).powi(2))).collect()
}

/// The smallest of a scene's tyre forces on the wheels \[N\], up, over its run, by read-out.
fn least_pressure(scene: &Scene, tyres: &[&str]) -> f64 {
    let step = scene.step.unwrap();
    let readouts: Vec<_> = tyres.iter().map(|name| scene.readout(name).unwrap()).collect();
    let mut plant = Plant::new(&scene.model, Leapfrog, step).unwrap();
    let mut least = f64::INFINITY;
    while plant.time() < scene.duration - 0.5 * step {
        plant.step().unwrap();
        for readout in &readouts {
            least = least.min(match plant.read(readout) {
                Some(Reading::Scalar(tension)) => -tension,
                Some(Reading::Vector(force)) => force.z,
                other => panic!("{other:?}"),
            });
        }
    }
    least
}

/// Nothing in these tyres would let go of the road, so the road is not to ask for it.
#[test]
fn tyres_press_on_the_road_all_the_time() {
    assert!(least_pressure(&scene("double-wishbone"), &["tyre_force"]) > 1000.0);
    let tyres = ["left_tyre_force", "right_tyre_force"];
    assert!(least_pressure(&scene("macpherson"), &tyres) > 500.0);
}

fn within(range: Range<f64>, what: &str, frequency: f64) {
    assert!(range.contains(&frequency), "{what}: {frequency} Hz, not in {range:?}");
}

/// Wheel hop of a corner with a standing body: √((tyre + wheel rate)/unsprung mass), 10 to 15 Hz
/// for passenger cars (Gillespie, Fundamentals of Vehicle Dynamics, chapter 5).
#[test]
fn the_double_wishbone_vibrates_as_a_corner_of_a_car_does() {
    let (scene, state, modes) = settled("double-wishbone");
    let knuckle = scene.body_names.iter().position(|name| name == "knuckle").unwrap();
    let (hop, share) = heave(&modes, &[knuckle]);
    within(10.0..15.0, "wishbone, hop of the wheel", modes.frequencies[hop]);
    assert!(share > 0.8, "{share}");
    let bushing = |name: &str| ["front", "rear"].iter().any(|end| name.ends_with(end));
    let rubber = rubber_modes(&scene, &state, &modes, bushing);
    within(12.0..25.0, "wishbone, first in rubber", rubber[0]);
    within(150.0..250.0, "wishbone, last in rubber", rubber[rubber.len() - 1]);
    assert!(rubber.len() >= 6, "{rubber:?}");
    // The arms on their bushings: rubber damps them by what the scene says of it, the fluid of the
    // lower rear one more, and the strut's damper adds its share.
    let arms = (0..modes.frequencies.len())
        .filter(|mode| (100.0..250.0).contains(&modes.frequencies[*mode]))
        .map(|mode| (mode, damping_ratios(&scene, &state, &modes, mode, bushing)));
    let ratios: Vec<[f64; 3]> =
        arms.map(|(mode, [rubber, all])| [modes.frequencies[mode], rubber, all]).collect();
    for [frequency, rubber, all] in &ratios {
        let fluid = *frequency < 180.0;
        let band = if fluid { 0.06..0.16 } else { 0.01..0.07 };
        assert!(band.contains(rubber), "{frequency} Hz: {rubber}");
        assert!((0.02..0.25).contains(all), "{frequency} Hz: {all}");
    }
    assert_eq!(ratios.len(), 8);
}

/// The first free cycles of the wheel's height after the step of the road.
pub fn hop() -> String {
    let scene = scene("double-wishbone");
    let step = scene.step.unwrap();
    let knuckle = scene.body_names.iter().position(|name| name == "knuckle").unwrap();
    let mut plant = Plant::new(&scene.model, Leapfrog, step).unwrap();
    let mut heights = Vec::new();
    while plant.time() < scene.duration - 0.5 * step {
        plant.step().unwrap();
        heights.push((plant.time(), plant.state().bodies[knuckle].position.z));
    }
    let end = *heights.last().unwrap();
    let road = scene.model.knots.iter().map(|knot| knot.value).fold(0.0, f64::max);
    let before = heights.iter().find(|(t, _)| *t >= SETTLED).unwrap().1;
    let highest = heights.iter().map(|(_, z)| *z).fold(0.0, f64::max);
    // The pose after the step has its own modes: springs and dampers have turned a little.
    let state = plant.state();
    let modes = modes(&scene.model, state).unwrap();
    let (hop, _) = heave(&modes, &[knuckle]);
    let shape = modes.shapes.column(hop);
    let omega = TAU * modes.frequencies[hop];
    let damping = scaled_damping(&scene.model, state).unwrap();
    let ratio = shape.dot(&(damping * shape)) / (2.0 * omega);
    let theory = modes.frequencies[hop] * (1.0 - ratio * ratio).sqrt();
    let mut crossings = Vec::new();
    for pair in heights.windows(2) {
        let [(t0, y0), (t, y)] = [(pair[0].0, pair[0].1 - end.1), (pair[1].0, pair[1].1 - end.1)];
        if t0 > SETTLED + 0.04 && y0 * y < 0.0 {
            crossings.push(t0 + (t - t0) * y0 / (y0 - y));
        }
    }
    let measured = 2.5 / (crossings[5] - crossings[0]);
    // The modes are linear and the wheel swings by 10 mm; five half cycles of 42 ms.
    assert!((measured / theory - 1.0).abs() < 0.03, "{measured} {theory}");
    assert!((0.1..0.3).contains(&ratio), "{ratio}");
    // The tyre is seven to nine times as stiff as the wheel's spring rate.
    let share = (end.1 - before) / road;
    assert!((0.85..0.93).contains(&share), "{share}");
    assert!(highest - end.1 > 0.2 * road, "{highest}");
    format!(
        "wheel hops at {measured:.1} Hz after a step of the road; its damped mode is at {theory:.1} Hz"
    )
}

/// Section 4.7: twenty bodies, the first mode of the bushings near 20 Hz, the sixth near 250 Hz.
pub fn macpherson() -> String {
    let (scene, state, modes) = settled("macpherson");
    assert_eq!(scene.model.bodies.len(), 20);
    // An arm alone on its two bushings, as in the paper's source: six freedoms, six modes.
    let mut range = [f64::INFINITY, 0.0_f64];
    for side in ["left", "right"] {
        let arm = format!("{side} arm");
        let row = scene.body_names.iter().position(|name| *name == arm).unwrap();
        let bushings = held_by(&scene, |name| name.contains(&arm));
        let stiffness = scaled_stiffness(&bushings, &state).unwrap().0;
        let block = stiffness.view((6 * row, 6 * row), (6, 6)).into_owned();
        let squares = SymmetricEigen::new(block).eigenvalues;
        let mut alone: Vec<f64> = squares.iter().map(|s| s.sqrt() / TAU).collect();
        alone.sort_by(f64::total_cmp);
        within(15.0..25.0, "macpherson, first mode of an arm on its bushings", alone[0]);
        within(200.0..280.0, "macpherson, sixth mode of an arm on its bushings", alone[5]);
        range = [range[0].min(alone[0]), range[1].max(alone[5])];
    }
    let rubber = ["arm", "mount", "bearing", "subframe"];
    let bushing = |name: &str| rubber.iter().any(|part| name.contains(part));
    let rubber = rubber_modes(&scene, &state, &modes, bushing);
    within(12.0..25.0, "macpherson, first in rubber", rubber[0]);
    within(200.0..280.0, "macpherson, last in rubber", rubber[rubber.len() - 1]);
    assert!(rubber.len() >= 12, "{rubber:?}");
    let row = |name: &str| scene.body_names.iter().position(|n| n == name).unwrap();
    // The axles' springs differ, so that bounce and pitch each hold a third of the other.
    let sprung = ["body shell", "power unit", "subframe", "rack"].map(row);
    let shares = heave_and_pitch(&scene, &state, &modes, &sprung);
    let most = |motion: usize| {
        let by = |a: &usize, b: &usize| shares[*a][motion].total_cmp(&shares[*b][motion]);
        (0..shares.len()).max_by(by).unwrap()
    };
    let (bounce, pitch) = (most(0), most(1));
    within(1.2..1.6, "macpherson, bounce of the body", modes.frequencies[bounce]);
    within(1.75..2.25, "macpherson, pitch of the body", modes.frequencies[pitch]);
    assert!(shares[bounce][0] > 0.6 && shares[pitch][1] > 0.6, "{shares:?}");
    let above = modes.frequencies.iter().filter(|frequency| **frequency > 250.0).count();
    let highest = modes.frequencies[modes.frequencies.len() - 1];
    assert_eq!((above, modes.frequencies.len()), (40, 120));
    within(640.0..650.0, "macpherson, highest of all", highest);
    let (hop, _) = heave(&modes, &[row("left wheel"), row("right wheel")]);
    within(10.0..15.0, "macpherson, hop of the wheels", modes.frequencies[hop]);
    format!(
        "an arm alone on its bushings: six modes, {} to {} Hz (paper: 20 to 250); modes mostly in \
         rubber {} to {} Hz",
        figure(range[0], 3),
        figure(range[1], 3),
        figure(rubber[0], 2),
        figure(rubber[rubber.len() - 1], 3)
    )
}
