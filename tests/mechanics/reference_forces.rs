//! The std reference against the kernel: two writings of one set of equations.

use dbd_bench::plain::Plain;
use dbd_kernel::builder::{LineLaw, Triples};
use dbd_kernel::elements::input::InputKind;
use dbd_kernel::forces::wrenches;
use dbd_kernel::schedule::Signal;
use dbd_kernel::{
    BodyIndex, Dbd, F64, GroupIndex, Leapfrog, Load, LoadFrame, ModelOwner, Plant, Scheme, State,
    Vec3,
};
use dbd_study::reference::signals::Clock;
use dbd_study::reference::{self as reference, Mechanism, naive::Naive};
use dbd_tests::{Bench, hung_ring, run, scene, scene_names};
use nalgebra::Vector3;

/// The largest difference of a body's accelerations over the largest acceleration of all bodies,
/// an angular one as that of a point at the radius of gyration.
fn difference<M: ModelOwner<Precision = F64>>(model: &M, state: &State<M>, h: f64) -> f64 {
    let (mechanism, _) = Mechanism::of_model(model);
    let clock = Clock::at(state.step as f64 * h);
    let same = reference::State::of(state);
    let at = mechanism.at(&same, clock);
    let naive = mechanism.respond(&at);
    // A state keeps the signals of the step that led to it; those of its own time are meant here.
    let mut state = state.clone();
    for (signal, now) in state.signals.as_mut().iter_mut().zip(&at.signals) {
        *signal = Signal { value: now.value, rate: now.rate };
    }
    let kernel = wrenches(model, &state, h).unwrap();
    let (mut worst, mut largest) = (0.0_f64, 0.0_f64);
    let rows = model.view().bodies.iter().zip(state.bodies.as_ref());
    for (((body, state), wrench), naive) in rows.zip(kernel.as_ref()).zip(&naive) {
        let w = state.angular_velocity;
        let linear = wrench.force * body.inverse_mass;
        let torque = wrench.torque - w.cross(body.inertia.scale(w));
        let angular = torque.scale(body.inverse_inertia);
        let gyration = Vector3::from((body.inertia * body.inverse_mass).to_f64()).map(f64::sqrt);
        let size = |linear: Vector3<f64>, angular: Vector3<f64>| {
            linear.norm().hypot(angular.component_mul(&gyration).norm())
        };
        let [linear, angular] = [linear, angular].map(|a| Vector3::from(a.to_f64()));
        worst = worst.max(size(linear - naive.linear, angular - naive.angular));
        largest = largest.max(size(naive.linear, naive.angular));
    }
    worst / largest
}

#[test]
fn every_scene_has_the_same_accelerations() {
    for name in scene_names() {
        let scene = scene(&name);
        let h = scene.step.unwrap();
        let mut plant = Plant::new(&scene.model, Leapfrog, h).unwrap();
        for steps in [0, 400, 2_000] {
            while plant.state().step < steps {
                plant.step().unwrap();
            }
            let difference = difference(&scene.model, plant.state(), h);
            assert!(difference < 1e-9, "{name} after {steps}: {difference:e}");
        }
    }
}

/// Every element kind, damped, loose and loaded, with every input, tables and a moving ground.
fn everything() -> Bench<F64> {
    let mut model = hung_ring::<F64>(0.7);
    let [a, b, c] = [0, 1, 2].map(BodyIndex);
    let x = Vec3::new(1.0, 0.0, 0.0);
    let axis = Vec3::new(0.0, 0.6, 0.8);
    let steps = [[0.002, 1.0], [0.004, -2.0], [0.02, 0.0]];
    let road = [[0.0, 0.0], [0.003, 0.01], [0.03, -0.02]];
    let kind = InputKind::Anchor { direction: axis };
    let anchor = BodyIndex::anchor(model.add_table(kind, &road, true).unwrap());
    let frame = LoadFrame::Body;
    let point = Vec3::new(0.1, 0.2, 0.0);
    let push = InputKind::Force { body: a, point, direction: x, frame };
    model.add_table(push, &steps, false).unwrap();
    model.add_input(InputKind::Torque { body: b, axis, frame: LoadFrame::World }, 0.4).unwrap();
    model.add_table(InputKind::JointTorque { a, b: c, axes: [axis; 2] }, &road, true).unwrap();
    model.add_input(InputKind::JointForce { a: c, b, point, axis }, 2.5).unwrap();
    model.add_input(InputKind::Actuator { group: GroupIndex(2), element: 0 }, 3.0).unwrap();
    model.add_table(InputKind::Gravity { direction: axis }, &steps, false).unwrap();
    model.add_tsda([anchor, b], [[0.0, 1.0, 0.0], [0.1; 3]], 80.0, 1.5, 0.4).unwrap();
    model.add_tsda([a, anchor], [[0.1; 3], [0.5, 1.0, 0.0]], 60.0, 2.0, 0.0).unwrap();
    let law = LineLaw { stiffness: 30.0, damping: 0.9, free_length: 0.1, clearance: 0.2 };
    let points = [[0.2, 0.1, 0.0], [0.1, -0.3, 0.2]];
    model.add_points_on_line([b, a], [0.1, 0.0, 0.3], [0.3, 0.4, 1.2], &points, law).unwrap();
    let triples = Triples {
        between: [c, a],
        centres: &[[0.0; 3]],
        arms: &[[0.9, 0.0, 0.0], [0.0, 0.7, 0.0], [0.0, 0.0, 2.0]],
        stiffness: 40.0,
        damping: 0.6,
        free_length: 1.5,
        clearance: 0.1,
    };
    model.add_triples(triples).unwrap();
    let load = |body, frame, until| Load {
        body,
        frame,
        force: Vec3::new(3.0, -1.0, 2.0),
        torque: Vec3::new(0.1, 0.2, -0.3),
        from: 0.001,
        until,
    };
    model.add_load(load(b, LoadFrame::Body, f64::INFINITY)).unwrap();
    model.add_load(load(c, LoadFrame::World, 0.01)).unwrap();
    model
}

#[test]
fn every_kind_of_element_and_input_has_the_same_accelerations() {
    let model = everything();
    let h = 1e-4;
    let mut plant = Plant::new(&model, Dbd::default(), h).unwrap();
    for steps in [0, 10, 15, 40, 99, 100, 600, 4_000] {
        plant.advance(steps - plant.state().step).unwrap();
        let difference = difference(&model, plant.state(), h);
        assert!(difference < 1e-12, "{steps}: {difference:e}");
    }
}

#[test]
fn tables_say_what_the_kernel_takes_from_them() {
    let model = everything();
    let h = 1e-4;
    let (mechanism, start) = Mechanism::of_model(&model);
    assert_eq!(mechanism.jumps([0.0, 1.0]), [0.001, 0.002, 0.003, 0.004, 0.01, 0.02, 0.03]);
    let mut plant = Plant::new(&model, Leapfrog, h).unwrap();
    for n in 0..400 {
        let naive = mechanism.at(&start, Clock::at(f64::from(n) * h)).signals;
        for (naive, kernel) in naive.iter().zip(&plant.state().signals) {
            let apart = (naive.value - kernel.value).abs() + (naive.rate - kernel.rate).abs();
            assert!(apart < 1e-14, "step {n}: {naive:?} {kernel:?}");
        }
        plant.step().unwrap();
    }
}

/// The largest distance \[m\] between the bodies of a naive run and the kernel's.
fn apart<S: Scheme>(scheme: S, steps: u64, step: fn(&mut Naive<'_>)) -> f64 {
    let scene = scene("four-bar");
    let h = 2e-5;
    let (mechanism, start) = Mechanism::of(&scene);
    let mut naive = Naive::new(&mechanism, start, h);
    for _ in 0..steps {
        step(&mut naive);
    }
    let kernel = run(&scene.model, scheme, h, steps);
    let positions = naive.state.positions();
    let pairs = positions.iter().zip(&kernel.bodies);
    pairs.map(|(a, b)| (a - Vector3::from(b.position.to_f64())).norm()).fold(0.0, f64::max)
}

/// A planar motion without dampers: the paper's step is semi-implicit Euler, and both drifts are
/// the exact turn about one axis.
#[test]
fn the_naive_steps_are_the_kernels_steps() {
    let euler = apart(Dbd::default(), 1_000, |run| run.semi_implicit_euler());
    let leapfrog = apart(Leapfrog, 1_000, |run| run.leapfrog());
    assert!(euler < 1e-10 && leapfrog < 1e-10, "{euler:e} {leapfrog:e}");
    // The measure tells the two apart.
    assert!(apart(Leapfrog, 1_000, |run| run.semi_implicit_euler()) > 1e-7);
}

/// The plain loop that times are compared with takes the reference's steps, of every scene that it does not refuse.
#[test]
fn a_plain_loop_takes_the_same_steps() {
    let mut compared = 0;
    for name in scene_names() {
        let scene = scene(&name);
        let h = scene.step.unwrap();
        let plain = Plain::of_model(&scene.model, h);
        let lacks = !scene.model.inputs.is_empty() || !scene.model.clearances.is_empty();
        assert_eq!(plain.is_err(), lacks, "{name}");
        let Ok(mut plain) = plain else { continue };
        compared += 1;
        let (mechanism, start) = Mechanism::of(&scene);
        let mut naive = Naive::new(&mechanism, start, h);
        (0..200).for_each(|_| naive.leapfrog());
        plain.advance(200);
        for (plain, naive) in plain.bodies.iter().zip(&naive.state.bodies) {
            let apart =
                |a: [f64; 3], b: Vector3<f64>| (Vector3::from(a) - b).norm() / (1.0 + b.norm());
            let position = apart(plain.position, naive.position);
            let rate = apart(plain.rate, naive.rate);
            assert!(position < 1e-10 && rate < 1e-7, "{name}: {position:e} {rate:e}");
        }
    }
    assert!(compared > 15, "{compared} scenes were compared");
}
