//! Dampers joint by joint: energy, momenta, order, resuming, and how far from the law of the single
//! dampers.

use dbd_kernel::energy::energy;
use dbd_kernel::{
    F32, F64, Geometry, JointWise, Leapfrog, Plant, Scheme, SemiImplicitEuler, State,
};
use dbd_scene::{Scene, SceneModel, widen};
use dbd_tests::mechanisms::Random;
use dbd_tests::page::{block, figure, table};
use dbd_tests::{momenta, scene};

/// The scenes with damped joints.
const DAMPED: [&str; 5] =
    ["cart-pendulum", "delta-pick-and-place", "double-wishbone", "gripper", "macpherson"];

/// A joint's keys beside its place; those of the first six keep both momenta.
const JOINTS: [&str; 9] = [
    "type = \"revolute\"\naxis = [0.6, 0, 0.8]\nspan = 0.1",
    "type = \"spherical\"\narm = 0.07",
    "type = \"fixed\"\naxis = [0, 1, 0]\nreference = [1, 0, 0]\nspan = 0.1\narm = 0.05",
    "type = \"revolute\"\naxis = [0.6, 0, 0.8]\nspan = 0.1\nrealisation = \"bushing\"",
    "type = \"spherical\"\narm = 0.07\nrealisation = \"bushing\"",
    "type = \"fixed\"\naxis = [0, 1, 0]\nreference = [1, 0, 0]\nspan = 0.1\narm = 0.05\nrealisation = \"bushing\"",
    "type = \"translational\"\naxis = [1, 0, 0]\nreference = [0, 1, 0]\nspan = 0.1\ngauge = 0.06\n\
     offset = 0.01",
    "type = \"cylindrical\"\naxis = [1, 0, 0]\nspan = 0.1\noffset = 0.01",
    "type = \"universal\"\naxes = [[1, 0, 0], [0, 1, 0]]\nspan = 0.1\nrealisation = \"bushing\"",
];

/// A shipped scene, its joints of bushings where that stands behind its name.
fn realised(name: &str) -> Scene {
    match name.strip_suffix(", bushings") {
        Some(name) => scene(name).with("realisation=bushing").unwrap(),
        None => scene(name),
    }
}

/// Two bodies of equal inertias about all axes in no field, joined to each other, with friction against
/// turning, and, by `grounded`, to the ground.
fn pair(joint: &str, grounded: Option<&str>) -> Scene {
    let mut text = "name = \"pair\"\nduration = 1\n".to_owned();
    for (name, mass, position) in [("a", 2.0, [0.1, 0.2, 0.0]), ("b", 0.7, [0.5, -0.1, 0.2])] {
        text += &format!(
            "[[body]]\nname = \"{name}\"\nmass = {mass:?}\ninertia = [0.01, 0.01, 0.01]\n\
             position = {position:?}\n"
        );
    }
    let joints = [("a", "b", Some(joint)), ("world", "a", grounded), ("world", "b", grounded)];
    for (i, (a, b, keys)) in joints.into_iter().enumerate() {
        if let Some(keys) = keys {
            text += &format!(
                "[[joint]]\nname = \"j{i}\"\nbetween = [\"{a}\", \"{b}\"]\nat = [0.3, 0.{i}, 0.1]\n\
                 stiffness = 1e3\ndamping = 1\n{keys}\n"
            );
        }
    }
    // The damper of a hinge's friction: a moment alone.
    text += "[[torsion_spring]]\nbetween = [\"a\", \"b\"]\naxis = [0, 0.6, 0.8]\nstiffness = 0\n\
             damping = 1\n";
    Scene::parse(&text, "pair.toml").unwrap()
}

/// The model without springs, with dampers and motions at random.
fn shaken<P: Geometry>(scene: &Scene, random: &mut Random) -> SceneModel<P> {
    let mut model = scene.model.clone();
    for tsda in &mut model.tsdas {
        tsda.stiffness = 0.0;
    }
    for line in &mut model.lines {
        line.stiffness = 0.0;
    }
    for bushing in &mut model.bushings {
        bushing.stiffness = 0.0;
    }
    for revolute in &mut model.revolutes {
        revolute.stiffness = 0.0;
    }
    for universal in &mut model.universals {
        universal.stiffness = 0.0;
    }
    let strength = 8.0 * random.unit() - 3.0;
    for damper in &mut model.dampers {
        *damper = 10_f64.powf(strength + 2.0 * random.unit());
    }
    for state in &mut model.initial {
        let [v, w] = [(); 2].map(|()| random.vector());
        *state =
            dbd_kernel::BodyState::from_f64(state.position.to_f64(), [1.0, 0.0, 0.0, 0.0], v, w);
    }
    model.convert()
}

/// Without springs and fields a body's kinetic energy is all there is, and each drift keeps it:
/// whatever the dampers, the joints and the step, no step adds to it.
#[test]
fn a_step_never_adds_energy() {
    fn check<P: Geometry, S: Scheme>(scheme: S, scene: &Scene, random: &mut Random, rounding: f64) {
        let model = shaken::<P>(scene, random);
        let exact: SceneModel<F64> = model.convert();
        let h = 10_f64.powf(-4.0 + 2.0 * random.unit());
        let mut plant = Plant::new(&model, scheme, h).unwrap();
        let total =
            |plant: &Plant<&SceneModel<P>, S>| energy(&exact, &widen(plant.state()), h).total();
        let mut last = total(&plant);
        for step in 0..30 {
            plant.advance(1).unwrap();
            let now = total(&plant);
            let name = &scene.joints[0].name;
            assert!(now <= last * (1.0 + rounding), "{name}, {step}: {now:e} of {last:e}");
            last = now;
        }
    }
    let mut random = Random(11);
    for joint in JOINTS {
        for grounded in [None, Some(JOINTS[0]), Some(JOINTS[3]), Some(JOINTS[6])] {
            let scene = pair(joint, grounded);
            for _ in 0..40 {
                check::<F64, _>(JointWise(Leapfrog), &scene, &mut random, 1e-13);
                check::<F64, _>(JointWise(SemiImplicitEuler), &scene, &mut random, 1e-13);
                check::<F32, _>(JointWise(Leapfrog), &scene, &mut random, 2e-6);
            }
        }
    }
}

/// A joint's levers are forces and moments on both bodies at one place.
#[test]
fn a_joint_keeps_both_momenta() {
    let mut random = Random(5);
    for joint in &JOINTS[..6] {
        let model = shaken::<F64>(&pair(joint, None), &mut random);
        let masses = [0, 1].map(|i| {
            let body = &model.bodies[i];
            (body.mass, body.inertia.to_f64())
        });
        let (p, l) = momenta(&masses, &State::initial(&model).bodies);
        let mut plant = Plant::new(&model, JointWise(Leapfrog), 1e-3).unwrap();
        plant.advance(1000).unwrap();
        let (q, m) = momenta(&masses, &plant.state().bodies);
        for (before, after) in [(p, q), (l, m)] {
            let change = after - before;
            assert!(change.dot(change).sqrt() < 1e-12 * before.dot(before).sqrt(), "{joint}");
        }
    }
}

/// \[m\] where the bodies are at ten times of a window.
fn run<S: Scheme>(model: &SceneModel<F64>, scheme: S, window: f64, steps: u64) -> Vec<[f64; 3]> {
    let mut plant = Plant::new(model, scheme, window / steps as f64).unwrap();
    let mut positions = Vec::new();
    for _ in 0..10 {
        plant.advance(steps / 10).unwrap();
        positions.extend(plant.state().bodies.iter().map(|body| body.position.to_f64()));
    }
    positions
}

fn distance(a: &[[f64; 3]], b: &[[f64; 3]]) -> f64 {
    let between = |(a, b): (&[f64; 3], &[f64; 3])| {
        a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt()
    };
    a.iter().zip(b).map(between).fold(0.0, f64::max)
}

/// At every scene's step: the error of either way against its own limit, and how far apart the limits
/// are, for the levers stand as the joints do at the start.
#[test]
fn it_is_of_second_order_and_near_the_law_of_the_dampers() {
    let mut rows = Vec::new();
    for (name, window, apart) in [
        ("cart-pendulum", 0.5, 3e-7),
        ("double-wishbone", 0.1, 1e-5),
        ("gripper", 0.05, 3e-6),
        ("macpherson", 0.05, 1e-5),
        ("double-wishbone, bushings", 0.1, 1e-5),
        ("gripper, bushings", 0.05, 1e-5),
    ] {
        let scene = realised(name);
        let step = scene.step.unwrap();
        let steps = 10 * (window / step / 10.0).round() as u64;
        let errors = |way: &dyn Fn(u64) -> Vec<[f64; 3]>| {
            let reference_solution = way(16 * steps);
            let errors = [1, 2].map(|parts| distance(&way(parts * steps), &reference_solution));
            (reference_solution, errors)
        };
        let (law, swept) = errors(&|steps| run(&scene.model, Leapfrog, window, steps));
        let (own, joined) = errors(&|steps| run(&scene.model, JointWise(Leapfrog), window, steps));
        let order = (joined[0] / joined[1]).log2();
        assert!((order - 2.0).abs() < 0.1, "{name}: {order} from {joined:?}");
        assert!(joined[0] < 1.05 * swept[0], "{name}: {joined:?}, {swept:?}");
        let limits = distance(&own, &law);
        assert!(limits < apart, "{name}: {limits:e}");
        let cells = [swept[0], joined[0], limits].map(|error| figure(error, 2));
        let head = [format!("`{name}`"), format!("{:.0} µs", 1e6 * step)];
        rows.push(head.into_iter().chain(cells).collect());
    }
    let head = ["", "step", "error, sweeps [m]", "error, joint-wise [m]", "limits apart [m]"];
    block("docs/schemes-measured.md", "joint-wise", &table(&head, &rows));
}

/// The largest rise of the energy after what drives a scene has ended, over the kinetic energy.
fn rise<P: Geometry>(scene: &Scene) -> f64 {
    let model: SceneModel<P> = scene.model.convert();
    let exact: SceneModel<F64> = model.convert();
    let h = scene.step.unwrap();
    let loads = scene.model.loads.iter().map(|load| load.until);
    let knots = scene.model.knots.iter().map(|knot| knot.time);
    let driven = loads.chain(knots).fold(0.0, f64::max);
    let mut plant = Plant::new(&model, JointWise(Leapfrog), h).unwrap();
    let (mut least, mut worst, mut kinetic) = (None, 0.0_f64, 0.0_f64);
    for n in 0..(scene.duration / h).round() as u64 {
        if n % 10 == 0 {
            let now = energy(&exact, &widen(plant.state()), h);
            kinetic = kinetic.max(now.kinetic);
            if plant.time() >= driven {
                let least = least.get_or_insert(now.total());
                worst = worst.max(now.total() - *least);
                *least = least.min(now.total());
            }
        }
        plant.step().unwrap();
    }
    worst / kinetic
}

#[test]
fn shipped_scenes_gain_no_energy() {
    for name in DAMPED.into_iter().chain(["double-wishbone, bushings", "gripper, bushings"]) {
        let scene = realised(name);
        let (double, single) = (rise::<F64>(&scene), rise::<F32>(&scene));
        assert!(double < 1e-9 && single < 3e-5, "{name}: {double:e}, {single:e}");
    }
}

/// What is kept from step to step is no state: a plant that takes another's state over goes on bit by
/// bit as that one.
#[test]
fn levers_are_made_anew_with_the_same_bits() {
    for name in ["double-wishbone", "gripper", "gripper, bushings"] {
        let model: SceneModel<F32> = realised(name).model.convert();
        let plant = || Plant::new(&model, JointWise(Leapfrog), 1e-4).unwrap();
        let (mut whole, mut second) = (plant(), plant());
        whole.advance(300).unwrap();
        second.set_state(whole.state().clone()).unwrap();
        for _ in 0..20 {
            whole.advance(1).unwrap();
            second.advance(1).unwrap();
            assert_eq!(whole.hash(), second.hash(), "{name}");
            let state = second.state().clone();
            second.set_state(state).unwrap();
        }
    }
}
