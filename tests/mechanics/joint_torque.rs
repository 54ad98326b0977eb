//! A joint's torque acts along the gradient of the joint's angle.

use dbd_kernel::elements::input::InputKind;
use dbd_kernel::energy::energy;
use dbd_kernel::readouts::{Reading, Readout};
use dbd_kernel::{BodyIndex, F64, Leapfrog, ModelOwner as _, Plant, TorsionIndex, Vec3};
use dbd_scene::Scene;
use dbd_tests::{Bench, free_ring};

/// The free ring with a torque of 3 N·m between two tumbling bodies: of an input, or of a spring's preload.
fn driven(by_input: bool) -> Bench<F64> {
    let mut model = free_ring::<F64>(0.0);
    let [a, b] = [BodyIndex(0), BodyIndex(2)];
    let axis = Vec3::new(0.0, 0.6, 0.8);
    let (torque, of_sensor) = if by_input { (0.0, 3.0) } else { (3.0, 0.0) };
    model.add_torsion_spring([a, b], axis.to_f64(), 0.0, 0.0, torque).unwrap();
    let rotation = |body: BodyIndex| model.initial()[body.row()].orientation.rotation();
    let in_b = rotation(b).to_body(rotation(a).to_world(axis));
    model.add_input(InputKind::JointTorque { a, b, axes: [axis, in_b] }, of_sensor).unwrap();
    model
}

#[test]
fn a_joint_torque_does_what_a_preload_does() {
    let [input, preload] = [true, false].map(driven);
    let mut plants = [&input, &preload].map(|model| Plant::new(model, Leapfrog, 1e-4).unwrap());
    for plant in &mut plants {
        plant.advance(10_000).unwrap();
    }
    let [input, preload] = plants.each_ref().map(|plant| plant.state().bodies.to_vec());
    let turned = input[2].orientation.v.dot(input[2].orientation.v);
    assert!(turned > 0.1, "{turned}");
    assert!(dbd_tests::distance(&input, &preload) < 1e-9);
}

/// The energy that a torque gives is the torque times the rate that the sensor reports.
#[test]
fn the_power_is_the_torque_times_the_rate_of_the_angle() {
    let model = driven(true);
    let h = 1e-4;
    let mut plant = Plant::new(&model, Leapfrog, h).unwrap();
    let spring = TorsionIndex((model.view().torsions.len() - 1) as u16);
    let rate = |reading| match reading {
        Some(Reading::Scalar(rate)) => rate,
        other => panic!("{other:?}"),
    };
    let sensor = Readout::JointRate { spring };
    let start = energy(&model, plant.state(), h).total();
    let (mut work, mut before) = (0.0, rate(plant.read(&sensor)));
    for _ in 0..10_000 {
        plant.advance(1).unwrap();
        let now: f64 = rate(plant.read(&sensor));
        work += 0.5 * 3.0 * (before + now) * h;
        before = now;
    }
    let gained = energy(&model, plant.state(), h).total() - start;
    assert!(
        gained.abs() > 0.1 && (gained - work).abs() < 1e-4 * gained.abs(),
        "{gained} J of {work} J"
    );
}

/// About the first body's axis a torque is circulatory, and tilts a body on a soft joint ever more.
#[test]
fn a_tilt_does_not_grow_under_a_torque() {
    let text = r#"
        name = "tilt"
        duration = 1
        body = [{ name = "b", mass = 1, inertia = [0.01, 0.01, 0.01], position = [0, 0, 0],
            angular_velocity = [1e-3, 0, 0] }]
        joint = [{ name = "j", type = "revolute", between = ["world", "b"], at = [0, 0, 0],
            axis = [0, 0, 1], span = 0.05, stiffness = 1e6 }]
        torsion_spring = [{ between = ["world", "b"], axis = [0, 0, 1], stiffness = 1e4 }]
        input = [{ name = "t", type = "joint_torque", target = "j", value = 200 }]
    "#;
    let scene = Scene::parse(text, "tilt.toml").unwrap_or_else(|error| panic!("{error:?}"));
    let mut plant = Plant::new(&scene.model, Leapfrog, 2e-5).unwrap();
    let mut most = [0.0_f64; 2];
    for step in 0..100_000 {
        plant.advance(1).unwrap();
        let axis =
            plant.state().bodies[0].orientation.rotation().to_world(Vec3::new(0.0, 0.0, 1.0));
        let tilt = axis.x.hypot(axis.y);
        let half = usize::from(step >= 50_000);
        most[half] = most[half].max(tilt);
    }
    assert!(most[1] < 1.1 * most[0], "{most:?}");
}
