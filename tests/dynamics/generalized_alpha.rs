//! The schemes generalized-alpha and generalized-alpha-3: the reference's steps, its order with joints that are all but rigid, what
//! it survives, what it remembers and what it refuses.

use dbd_kernel::plant::PlantError;
use dbd_kernel::snapshot::SnapshotError;
use dbd_kernel::status::{Cause, Failure};
use dbd_kernel::{
    BodyState, F32, F64, Fixed, GeneralizedAlpha, GeneralizedAlpha3, Geometry, Leapfrog,
    ModelOwner, Planar64, Plant, Scheme,
};
use dbd_scene::{Eliminated, Scene, SceneModel};
use dbd_study::reference::Mechanism;
use dbd_study::reference::generalized_alpha::GeneralizedAlpha as Reference;
use dbd_tests::{run, scene, uneven_ring};

const SCHEME: GeneralizedAlpha = GeneralizedAlpha::DEFAULT;

/// A scene's joints at another stiffness \[N/m\].
fn with_stiffness(name: &str, stiffness: &str) -> Scene {
    scene(name).with(&format!("joint.*.stiffness={stiffness}")).unwrap()
}

/// \[m\] positions after `time` \[s\] in a precision.
fn positions<P: Geometry>(
    model: &SceneModel<F64>,
    scheme: impl Scheme,
    step: f64,
    time: f64,
) -> Vec<[f64; 3]> {
    let model: SceneModel<P> = model.clone().planned().convert();
    let mut plant = Plant::new(&model, scheme, step).unwrap();
    plant.advance((time / step).round() as u64).unwrap();
    let bodies: &[BodyState<P>] = &plant.state().bodies;
    bodies.iter().map(|body| P::position_to_f64(&body.position)).collect()
}

/// \[m\] the largest distance of a body.
fn apart(a: &[[f64; 3]], b: &[[f64; 3]]) -> f64 {
    let between = |(a, b): (&[f64; 3], &[f64; 3])| {
        a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt()
    };
    a.iter().zip(b).map(between).fold(0.0, f64::max)
}

/// Every kind of element: where none is taken for a point and an axis, the steps are those of the
/// reference to rounding.
#[test]
fn the_steps_are_those_of_the_reference() {
    for rho in [0.0, 0.3, 0.5, 0.8] {
        let ring = uneven_ring::<F64>(2.0);
        let (mechanism, start) = Mechanism::of_model(&ring);
        let mut reference = Reference::new(&mechanism, start, 1e-3, rho);
        let model = Eliminated::new(&ring).unwrap();
        let mut plant = Plant::new(&model, GeneralizedAlpha::new(rho).unwrap(), 1e-3).unwrap();
        for _ in 0..100 {
            reference.step();
            plant.step().unwrap();
        }
        let own: Vec<[f64; 3]> =
            plant.state().bodies.iter().map(|body| body.position.to_f64()).collect();
        let meant: Vec<[f64; 3]> =
            reference.state.bodies.iter().map(|body| body.position.into()).collect();
        assert!(apart(&own, &meant) < 1e-13, "{rho}: {:e}", apart(&own, &meant));
    }
}

#[test]
fn single_precision_and_fixed_point_follow_it() {
    for (name, stiffness, single, fixed) in [
        ("3ruu", "9e8", 5e-6, 2e-6),
        ("double-wishbone", "9e8", 1e-6, 1e-7),
        ("hexagon", "9e6", 1e-6, 1e-7),
    ] {
        let model = with_stiffness(name, stiffness).model;
        macro_rules! check {
            ($scheme:expr) => {{
                let reference_solution = positions::<F64>(&model, $scheme, 1e-3, 0.1);
                let off = [
                    apart(&positions::<F32>(&model, $scheme, 1e-3, 0.1), &reference_solution),
                    apart(&positions::<Fixed>(&model, $scheme, 1e-3, 0.1), &reference_solution),
                ];
                println!("{name}: {off:?}");
                assert!(off[0] < single && off[1] < fixed, "{name}: {off:?}");
            }};
        }
        check!(SCHEME);
        check!(GeneralizedAlpha3);
    }
}

/// A minute at 1 ms, where explicit schemes take steps of microseconds, of what is not in the table of
/// `near_rigid`.
#[test]
fn a_minute_with_joints_all_but_rigid() {
    for name in
        ["chain-closed", "chain-open-30", "chain-open-60", "two-3ruu", "gripper", "cart-pendulum"]
    {
        let model = with_stiffness(name, "9e8").model.planned();
        let mut plant = Plant::new(&model, SCHEME, 1e-3).unwrap();
        assert_eq!(plant.advance(60_000), Ok(()), "{name}");
        let mut third = Plant::new(&model, GeneralizedAlpha3, 1e-3).unwrap();
        assert_eq!(third.advance(20_000), Ok(()), "{name}");
        // Leapfrog does not take ten steps of it.
        let mut explicit = Plant::new(&model, Leapfrog, 1e-3).unwrap();
        assert!(explicit.advance(200).is_err(), "{name}");
    }
}

/// A planar scene takes the same steps in its plane as in space, but for what its joints' deflections, which
/// other springs bear there, make of their tangents.
#[test]
fn a_plane_is_a_part_of_space() {
    for name in ["four-bar", "six-bar", "hexagon"] {
        let text = dbd_tests::scene_text(name);
        let flat = Scene::parse(&format!("planar = true\n{text}"), name).unwrap();
        let flat = flat.with("joint.*.stiffness=9e8").unwrap();
        let planar = flat.planar.as_ref().unwrap();
        let model = planar.model.clone().planned().convert::<Planar64>();
        let off = |step: f64| {
            let end = run(&model, SCHEME, step, (0.1 / step).round() as u64);
            let mut state = dbd_scene::widen(&end);
            planar.states_outward(&mut state.bodies);
            let own: Vec<[f64; 3]> = state.bodies.iter().map(|b| b.position.to_f64()).collect();
            apart(&own, &positions::<F64>(&with_stiffness(name, "9e8").model, SCHEME, step, 0.1))
        };
        let found = [5e-4, 2e-4].map(off);
        println!("{name} {found:?}");
        assert!(found[0] < 2e-4 && found[1] < 2e-5, "{name}: {found:?}");
    }
}

/// Loads and inputs jump: what they push is not mixed with what was known of the step before.
#[test]
fn a_force_that_begins_and_ends_has_its_whole_effect_and_no_more() {
    let text = r#"
name = "pushed"
duration = 0.5
[[body]]
name = "weight"
mass = 2.0
inertia = [0.01, 0.01, 0.01]
position = [0, 0, 0]
[[load]]
body = "weight"
force = [4, 0, 0]
from = 0.1
until = 0.3
[[input]]
name = "push"
type = "force"
body = "weight"
axis = [0, 1, 0]
"#;
    fn check(scheme: impl Scheme, text: &str) {
        let model = Scene::parse(text, "pushed.toml").unwrap().model.planned();
        let mut plant = Plant::new(&model, scheme, 0.01).unwrap();
        for step in 0..50 {
            let on = (10..30).contains(&step);
            plant.set_input(dbd_kernel::InputIndex(0), if on { 4.0 } else { 0.0 }).unwrap();
            plant.step().unwrap();
        }
        // ½·2 m/s²·(0.2 s)², then 0.4 m/s for 0.2 s.
        let [x, y, _] = plant.state().bodies[0].position.to_f64();
        assert!((x - 0.12).abs() < 1e-12 && (y - 0.12).abs() < 1e-12, "{x} {y}");
    }
    check(SCHEME, text);
    check(GeneralizedAlpha3, text);
}

/// A net of point masses, hung from a beam with lever arms, a joint, a torsion spring and an interaction.
const HUNG_NET: &str = r#"
name = "hung-net"
duration = 0.2
gravity = [0, -9.81, 0]
[[body]]
name = "beam"
mass = 2.0
inertia = [0.01, 0.02, 0.02]
position = [0.2, 0, 0]
[[joint]]
name = "pivot"
type = "revolute"
between = ["world", "beam"]
at = [0, 0, 0]
axis = [0, 0, 1]
stiffness = 1e6
span = 0.1
[[interaction]]
law = "hinge-spring"
between = ["world", "beam"]
axis = [0, 0, 1]
torque = [[-1, -20], [1, 20]]
[[torsion_spring]]
between = ["world", "beam"]
axis = [0, 0, 1]
stiffness = 20.0
"#;

fn hung_net() -> String {
    let mut text = HUNG_NET.to_owned();
    let tie = |a: &str, b: &str, arm: [f64; 3]| {
        format!(
            "[[tsda]]\nbetween = [\"{a}\", \"{b}\"]\npoints = [{arm:?}, [0, 0, 0]]\n\
             stiffness = 3e4\ndamping = 2.0\nfree_length = 0.1\n"
        )
    };
    for (x, y) in (0..4).flat_map(|y| (0..4).map(move |x| (x, y))) {
        let place = [0.1 * f64::from(x), -0.1 * f64::from(y + 1), 0.0];
        text += &format!(
            "[[body]]\nname = \"n{x}{y}\"\nmass = 0.1\ninertia = [1e-5, 2e-5, 2e-5]\n\
             position = {place:?}\nangular_velocity = [0, 0, 3]\n"
        );
    }
    for (x, y) in (0..4).flat_map(|y| (0..4).map(move |x| (x, y))) {
        let at = |x: i32, y: i32| format!("n{x}{y}");
        if y == 0 {
            text += &tie("beam", &at(x, y), [0.1 * f64::from(x) - 0.2, 0.0, 0.0]);
        } else {
            text += &tie(&at(x, y - 1), &at(x, y), [0.0; 3]);
        }
        if x > 0 {
            text += &tie(&at(x - 1, y), &at(x, y), [0.0; 3]);
        }
    }
    text + "[[input]]\nname = \"spin\"\ntype = \"torque\"\nbody = \"n11\"\naxis = [0, 0, 1]\nvalue = 1e-3\n"
}

/// Products of translations alone have the bits of products of whole blocks.
#[test]
fn decoupled_rotations_change_no_bit() {
    fn check<P: Geometry>(model: &SceneModel<F64>, least: usize, scheme: impl Scheme) {
        let model: SceneModel<P> = model.clone().planned().convert();
        let mut whole = model.clone();
        whole.plan.decoupled = vec![false; model.bodies.len()];
        let decoupled = model.plan.decoupled.iter().filter(|is| **is).count();
        assert!((least..model.bodies.len() - 1).contains(&decoupled), "{:?}", model.plan);
        let hash = |model: &SceneModel<P>| {
            let mut plant = Plant::new(model, scheme, 1e-3).unwrap();
            plant.advance(200).unwrap();
            plant.hash()
        };
        assert_eq!(hash(&model), hash(&whole));
    }
    let net = Scene::parse(&hung_net(), "net.toml").unwrap();
    let flat = Scene::parse(&format!("planar = true\n{}", hung_net()), "net.toml").unwrap();
    let flat = &flat.planar.unwrap().model;
    check::<F64>(&net.model, 8, SCHEME);
    check::<F32>(&net.model, 8, GeneralizedAlpha3);
    check::<Fixed>(&net.model, 8, SCHEME);
    check::<Planar64>(flat, 8, SCHEME);
    check::<Planar64>(flat, 8, GeneralizedAlpha3);
    // Joints and interactions couple all.
    for name in ["four-bar", "macpherson"] {
        assert!(!scene(name).model.planned().plan.decoupled.contains(&true), "{name}");
    }
}

fn plant_of<M: ModelOwner, S: Scheme>(model: &M, scheme: S) -> Plant<&M, S> {
    Plant::new(model, scheme, 1e-3).unwrap()
}

#[test]
fn a_snapshot_holds_what_it_remembers() {
    let model = scene("gripper").model.planned();
    is_restored(&model, SCHEME);
    is_restored(&model, GeneralizedAlpha3);
    let plant = plant_of(&model, SCHEME);
    let mut bytes = vec![0; plant.snapshot_size()];
    plant.snapshot(&mut bytes).unwrap();
    let other = GeneralizedAlpha::new(0.4).unwrap();
    assert_eq!(plant_of(&model, other).restore(&bytes), Err(SnapshotError::Scheme));
    assert_eq!(plant_of(&model, GeneralizedAlpha3).restore(&bytes), Err(SnapshotError::Scheme));
}

fn is_restored<S: Scheme>(model: &SceneModel<F64>, scheme: S) {
    let mut plant = plant_of(model, scheme);
    plant.advance(70).unwrap();
    let mut bytes = vec![0; plant.snapshot_size()];
    plant.snapshot(&mut bytes).unwrap();
    plant.advance(50).unwrap();
    let mut other = plant_of(model, scheme);
    let mut first = vec![0; other.snapshot_size()];
    assert_eq!(other.snapshot(&mut first), Ok(bytes.len()));
    other.restore(&bytes).unwrap();
    other.advance(50).unwrap();
    assert_eq!(other.hash(), plant.hash());
    // A state alone goes on with accelerations of its own: near, not the same.
    other.restore(&bytes).unwrap();
    let state = other.state().clone();
    other.set_state(state).unwrap();
    other.advance(50).unwrap();
    assert_ne!(other.hash(), plant.hash());
    // One of t = 0 begins as the plant did.
    other.restore(&first).unwrap();
    other.advance(120).unwrap();
    assert_eq!(other.hash(), plant.hash());
}

#[test]
fn what_it_cannot_do_is_refused() {
    assert!(GeneralizedAlpha::new(0.81).is_err() && GeneralizedAlpha::new(-0.1).is_err());
    assert!(GeneralizedAlpha::new(f64::NAN).is_err());
    let bare = scene("gripper").model;
    assert_eq!(Plant::new(&bare, SCHEME, 1e-3).err(), Some(PlantError::Plan));
    // A plan of another model is none.
    let mut other = bare.clone();
    other.plan = scene("four-bar").model.planned().plan;
    assert_eq!(Plant::new(&other, SCHEME, 1e-3).err(), Some(PlantError::Plan));
    let stiff = with_stiffness("gripper", "9e9").model.planned().convert::<F32>();
    let Err(PlantError::Stiff(most)) = Plant::new(&stiff, SCHEME, 1e-3) else { panic!() };
    assert!(Plant::new(&stiff, SCHEME, 0.99 * most).is_ok());
    assert!(Plant::new(&stiff, SCHEME, 1.01 * most).is_err());
}

#[test]
fn a_body_that_turns_too_far_in_a_step_is_named() {
    let model = scene("five-bar-a").model.planned();
    let mut plant = Plant::new(&model, SCHEME, 4e-3).unwrap();
    let Err(Failure { cause: Cause::Turn { body }, .. }) = plant.advance(100) else {
        panic!("{:?}", plant.status())
    };
    assert!(usize::from(body.0) < model.bodies.len());
    // It goes on after a state that it bears.
    plant.reset();
    assert!(plant.status().is_ok());
}
