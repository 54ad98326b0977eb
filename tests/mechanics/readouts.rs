//! Read-outs against what is known.

use dbd_kernel::elements::input::InputKind;
use dbd_kernel::energy::energy;
use dbd_kernel::model::Law;
use dbd_kernel::readouts::{Reading, Readout, each_force, each_tension, read};
use dbd_kernel::space::Linear as _;
use dbd_kernel::{
    BodyIndex, BodyState, F32, F64, Geometry, GroupIndex, InputIndex, Leapfrog, Load, LoadFrame,
    Planar32, Planar64, Plant, Real as _, TorsionIndex, Vec3,
};
use dbd_tests::{Bench, at, scene, scene_names, turned};

const WORLD: BodyIndex = BodyIndex::WORLD;

fn near(a: Vec3<f64>, b: [f64; 3], tolerance: f64) -> bool {
    let d = a - Vec3::from_f64(b);
    d.dot(d).sqrt() < tolerance
}

#[test]
fn angles_are_unwrapped_and_rates_signed() {
    let mut model = Bench::<F64>::new();
    let state = BodyState::from_f64([0.0; 3], [1.0, 0.0, 0.0, 0.0], [0.0; 3], [0.0, 0.0, -4.0]);
    let body = model.add_body(1.0, [0.25; 3], state).unwrap();
    model.add_torsion_spring([WORLD, body], [0.0, 0.0, 1.0], 0.0, 0.0, 0.0).unwrap();
    let mut plant = Plant::new(&model, Leapfrog, 1e-3).unwrap();
    plant.advance(5_000).unwrap();
    let angle = plant
        .read(&Readout::JointAngle { spring: TorsionIndex(0), offset: dbd_kernel::Real::ZERO })
        .unwrap()
        .scalar()
        .unwrap();
    let rate =
        plant.read(&Readout::JointRate { spring: TorsionIndex(0) }).unwrap().scalar().unwrap();
    assert!((angle + 20.0).abs() < 1e-9 && (rate + 4.0).abs() < 1e-12, "{angle} {rate}");
    assert_eq!(
        plant
            .read(&Readout::JointAngle { spring: TorsionIndex(1), offset: dbd_kernel::Real::ZERO }),
        None
    );
}

#[test]
fn points_of_a_turned_moving_body() {
    let mut model = Bench::<F64>::new();
    let quarter = turned([0.0, 0.0, 1.0], std::f64::consts::FRAC_PI_2);
    let state = BodyState::from_f64([1.0, 2.0, 3.0], quarter, [0.5, 0.0, 0.0], [0.0, 0.0, 2.0]);
    let body = model.add_body(1.0, [0.25; 3], state).unwrap();
    let plant = Plant::new(&model, Leapfrog, 1e-3).unwrap();
    let point = Vec3::new(0.1, 0.0, 0.0);
    let read = |readout| plant.read(&readout).unwrap().vector().unwrap();
    assert!(near(read(Readout::Point { body, point }), [1.0, 2.1, 3.0], 1e-12));
    assert!(near(read(Readout::PointVelocity { body, point }), [0.3, 0.0, 0.0], 1e-12));
    let missing = Readout::Point { body: BodyIndex(7), point };
    assert_eq!(plant.read(&missing), None);
}

#[test]
fn an_imu_shows_specific_force() {
    let point = Vec3::new(0.2, 0.0, 0.0);
    let imu = |model: &Bench<F64>| {
        let plant = Plant::new(model, Leapfrog, 1e-3).unwrap();
        match plant.read(&Readout::Imu { body: BodyIndex(0), point }) {
            Some(Reading::Imu { specific_force, rate }) => (specific_force, rate),
            other => panic!("{other:?}"),
        }
    };
    // Falling and spinning: weightless but for the centripetal part.
    let mut falling = Bench::new();
    falling.set_gravity([0.0, -9.81, 0.0]).unwrap();
    let spin = BodyState::from_f64([0.0; 3], [1.0, 0.0, 0.0, 0.0], [0.0; 3], [0.0, 0.0, 3.0]);
    falling.add_body(2.0, [0.1; 3], spin).unwrap();
    let (force, rate) = imu(&falling);
    assert!(near(force, [-9.0 * 0.2, 0.0, 0.0], 1e-12), "{force:?}");
    assert!(near(rate, [0.0, 0.0, 3.0], 1e-15));
    // Hung at rest, turned by a quarter: gravity's reaction points along body x.
    let mut hung = Bench::new();
    hung.set_gravity([0.0, -9.81, 0.0]).unwrap();
    let quarter = turned([0.0, 0.0, 1.0], std::f64::consts::FRAC_PI_2);
    let state = BodyState::from_f64([0.0; 3], quarter, [0.0; 3], [0.0; 3]);
    let body = hung.add_body(2.0, [0.1; 3], state).unwrap();
    let points = [[0.0, 1.0, 0.0], [0.0; 3]];
    hung.add_tsda([WORLD, body], points, 1e3, 0.0, 1.0 - 2.0 * 9.81 / 1e3).unwrap();
    let (force, _) = imu(&hung);
    assert!(near(force, [9.81, 0.0, 0.0], 1e-9), "{force:?}");
}

#[test]
fn tensions_and_joint_forces() {
    let mut model = Bench::<F64>::new();
    let moving = BodyState { velocity: Vec3::new(0.5, 0.0, 0.0), ..at([1.2, 0.0, 0.0]) };
    let body = model.add_body(2.0, [0.1; 3], moving).unwrap();
    model.add_tsda([WORLD, body], [[0.0; 3]; 2], 100.0, 4.0, 1.0).unwrap();
    let plant = Plant::new(&model, Leapfrog, 1e-3).unwrap();
    let tension = plant.read(&Readout::TsdaForce { group: GroupIndex(0), element: 0 }).unwrap();
    assert!((tension.scalar().unwrap() - (100.0 * 0.2 + 4.0 * 0.5)).abs() < 1e-12);
    let force =
        plant.read(&Readout::JointForce { group: GroupIndex(0) }).unwrap().vector().unwrap();
    assert!(near(force, [-22.0, 0.0, 0.0], 1e-12), "on the second body: {force:?}");
}

/// An oblique TSDA between two moving bodies with two actuators, a second one without, in space
/// or in the plane: the joint's force is the tension along its line, and what moves the body.
fn pulled<P: Geometry>(damping: f64, tolerance: f64) {
    let mut model = Bench::<P>::new();
    let state = |x: [f64; 3], v: [f64; 3]| {
        BodyState::<P>::from_f64(x, [1.0, 0.0, 0.0, 0.0], v, [0.0, 0.0, 0.7])
    };
    let a = model.add_body(2.0, [0.1; 3], state([0.0; 3], [0.3, -0.2, 0.0])).unwrap();
    let b = model.add_body(1.5, [0.2; 3], state([0.6, 0.9, 0.0], [-0.4, 0.5, 0.0])).unwrap();
    let points = [[0.1, 0.05, 0.0], [-0.05, 0.1, 0.0]];
    model.add_tsda([a, b], points, 80.0, damping, 0.7).unwrap();
    model.add_tsda([WORLD, a], points, 60.0, damping, 0.2).unwrap();
    let pull = InputKind::Actuator { group: GroupIndex(0), element: 0 };
    model.add_input(pull, 7.0).unwrap();
    model.add_table(pull, &[[0.0, -3.0], [1.0, 9.0]], true).unwrap();
    let mut plant = Plant::new(&model, Leapfrog, 1e-3).unwrap();
    plant.advance(40).unwrap();
    let close = |x: f64, y: f64| (x - y).abs() < tolerance;
    let mut on_b = Vec3::<f64>::ZERO;
    for group in [0, 1].map(GroupIndex) {
        let tension = plant.read(&Readout::TsdaForce { group, element: 0 }).unwrap();
        let tension = tension.scalar().unwrap().to_f64();
        let force = plant.read(&Readout::JointForce { group }).unwrap().vector().unwrap();
        let force = Vec3::from_f64(force.to_f64());
        let ends = [[a, b], [WORLD, a]][group.row()];
        let at = |end: usize| match ends[end] {
            WORLD => Vec3::<f64>::from_f64(points[end]),
            body => {
                let point = P::local_from_f64(points[end]);
                let point = plant.read(&Readout::Point { body, point }).unwrap().vector().unwrap();
                Vec3::<f64>::from_f64(point.to_f64())
            }
        };
        let d = at(0) - at(1);
        let along = d * (tension / d.dot(d).sqrt());
        for (x, y) in force.to_f64().into_iter().zip(along.to_f64()) {
            assert!(close(x, y), "group {group:?}, damping {damping}: {force:?} {along:?}");
        }
        assert!(tension.abs() > 1.0);
        if group.row() == 0 {
            on_b = force;
        }
    }
    // What moves the second body is that force alone.
    let point = P::local_from_f64([0.0; 3]);
    let Some(Reading::Imu { specific_force, .. }) = plant.read(&Readout::Imu { body: b, point })
    else {
        panic!("no reading");
    };
    let felt = Vec3::<f64>::from_f64(specific_force.to_f64());
    assert!(close(1.5 * felt.dot(felt).sqrt(), on_b.dot(on_b).sqrt()), "{felt:?} {on_b:?}");
}

#[test]
fn the_force_of_a_tsda_is_its_tension_along_its_line() {
    for damping in [0.0, 5.0] {
        pulled::<F64>(damping, 1e-10);
        pulled::<F32>(damping, 1e-4);
        pulled::<Planar64>(damping, 1e-10);
        pulled::<Planar32>(damping, 1e-4);
    }
}

#[test]
fn every_column_of_every_scene_has_a_name_of_its_own() {
    for name in scene_names() {
        let mut columns = scene(&name).columns();
        let count = columns.len();
        columns.sort();
        columns.dedup();
        assert_eq!(columns.len(), count, "{name}");
    }
}

/// A mass on a TSDA that hangs from an anchor on a held table, which an actuator pulls likewise.
fn stepped<P: Geometry>() -> Bench<P> {
    let mut model = Bench::new();
    let body = model.add_body(2.0, [0.1; 3], at([0.0; 3])).unwrap();
    let direction = P::Vector::from_f64([1.0, 0.0, 0.0]);
    let road = [[0.0, 0.0], [0.005, 0.25]];
    let road = model.add_table(InputKind::Anchor { direction }, &road, false).unwrap();
    let points = [[-1.0, 0.0, 0.0], [0.0; 3]];
    model.add_tsda([BodyIndex::anchor(road), body], points, 40.0, 0.0, 1.0).unwrap();
    let pull = InputKind::Actuator { group: GroupIndex(0), element: 0 };
    model.add_table(pull, &[[0.0, 0.0], [0.005, 100.0]], false).unwrap();
    model
}

#[test]
fn what_a_table_drives_is_read_at_its_time() {
    let model = stepped::<F64>();
    let h = 1e-4;
    let mut plant = Plant::new(&model, Leapfrog, h).unwrap();
    let scalar = |plant: &Plant<_, Leapfrog>, readout| plant.read(&readout).unwrap().scalar();
    for n in 0..60 {
        assert_eq!(plant.state().step, n);
        let begun = n >= 50;
        let x = plant.state().bodies[0].position.x;
        let (road, pull) = if begun { (0.25, 100.0) } else { (0.0, 0.0) };
        let extension = x - road;
        let tension = 40.0 * extension + pull;
        assert_eq!(scalar(&plant, Readout::Input { input: InputIndex(1) }), Some(pull), "{n}");
        let read = scalar(&plant, Readout::TsdaForce { group: GroupIndex(0), element: 0 }).unwrap();
        assert!((read - tension).abs() < 1e-9, "step {n}: {read} {tension}");
        let potential = energy(&model, plant.state(), h).potential();
        assert!((potential - 20.0 * extension * extension).abs() < 1e-12, "step {n}: {potential}");
        match plant.read(&Readout::Imu { body: BodyIndex(0), point: Vec3::ZERO }) {
            Some(Reading::Imu { specific_force, .. }) => {
                assert!((specific_force.x + 0.5 * tension).abs() < 1e-9, "step {n}");
            }
            other => panic!("{other:?}"),
        }
        plant.step().unwrap();
    }
    // One evaluation per step, one to begin with, one where the tables jump.
    assert_eq!(plant.evaluations(), 62);
    // A restored plant reads the same at once.
    let mut bytes = vec![0; plant.snapshot_size()];
    plant.snapshot(&mut bytes).unwrap();
    let mut other = Plant::new(&model, Leapfrog, h).unwrap();
    other.restore(&bytes).unwrap();
    assert_eq!(scalar(&other, Readout::Input { input: InputIndex(1) }), Some(100.0));
}

/// Looking at all of them at once shows what reading each does, dampers and actuators included.
#[test]
fn all_tensions_and_forces_are_those_read_one_by_one() {
    for name in ["double-wishbone", "delta-pick-and-place", "gripper"] {
        let scene = scene(name);
        let model = &scene.model;
        let mut plant = Plant::new(model, Leapfrog, 1e-4).unwrap();
        plant.advance(100).unwrap();
        let one = |readout| read(model, plant.state(), 1e-4, &readout).unwrap();
        let (mut tensions, mut forces) = (Vec::new(), Vec::new());
        each_tension(model, plant.state(), |group, tension| tensions.push((group, tension)));
        each_force(model, plant.state(), |group, force| forces.push((group, force)));
        let (mut expected_tensions, mut expected_forces) = (Vec::new(), Vec::new());
        for (row, group) in model.groups.iter().enumerate() {
            let force = one(Readout::JointForce { group: GroupIndex(row as u16) });
            expected_forces.push((row, force.vector().unwrap()));
            let elements = if group.law == Law::Tsda { group.elements() } else { 0 };
            for element in 0..elements as u16 {
                let tension = one(Readout::TsdaForce { group: GroupIndex(row as u16), element });
                expected_tensions.push((row, tension.scalar().unwrap()));
            }
        }
        assert!(tensions == expected_tensions && forces == expected_forces, "{name}");
        assert!(tensions.iter().any(|(_, tension)| tension.abs() > 1.0), "{name}");
    }
}

/// A load far from the origin that begins and ends: between two steps the total energy changes by
/// the load's work alone.
fn loaded<P: Geometry>() {
    let mut model = Bench::<P>::new();
    let body = model.add_body(1.0, [1.0; 3], at([1e5, 0.0, 0.0])).unwrap();
    model.add_tsda([WORLD, body], [[1e5, 1.0, 0.0], [0.0; 3]], 10.0, 0.0, 1.0).unwrap();
    let force = P::Vector::from_f64([10.0, 2.0, 0.0]);
    let (torque, frame) = (P::Moment::ZERO, LoadFrame::World);
    model.add_load(Load { body, frame, force, torque, from: 0.5, until: 0.75 }).unwrap();
    let h = 1e-3;
    let mut plant = Plant::new(&model, Leapfrog, h).unwrap();
    let look = |plant: &Plant<&Bench<P>, Leapfrog>| {
        let now = energy(&model, plant.state(), h);
        assert!((now.total().to_f64() - (now.kinetic + now.potential()).to_f64()).abs() < 1e-12);
        let point = P::local_from_f64([0.0; 3]);
        let x = plant.read(&Readout::Point { body, point }).unwrap().vector().unwrap();
        (now.total().to_f64(), x.to_f64())
    };
    let (mut before, mut x) = look(&plant);
    let (mut work, mut begun) = (0.0, before);
    for n in 0..1_000 {
        plant.step().unwrap();
        let (total, now) = look(&plant);
        let acts = (500..750).contains(&n);
        let done = if acts { 10.0 * (now[0] - x[0]) + 2.0 * (now[1] - x[1]) } else { 0.0 };
        assert!((total - before - done).abs() < 1e-2, "step {n}: {before} {total}, work {done}");
        work += done;
        (before, x) = (total, now);
        if n == 499 {
            begun = total;
        }
    }
    assert!(work > 1.0 && (before - begun - work).abs() < 2e-2, "{begun} {before} {work}");
}

#[test]
fn the_total_energy_is_continuous_where_a_load_begins_and_ends() {
    loaded::<F64>();
    loaded::<Planar64>();
}
