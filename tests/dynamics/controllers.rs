//! The controllers among the examples do what they say.

#[allow(dead_code, reason = "an example has a main function of its own")]
#[path = "../../host-sim/examples/balance.rs"]
pub mod balance;
#[allow(dead_code, reason = "an example has a main function of its own")]
#[path = "../../host-sim/examples/balance_robot.rs"]
mod balance_robot;
mod examples;
#[allow(dead_code, reason = "an example has a main function of its own")]
#[path = "../../host-sim/examples/follow.rs"]
mod follow;
#[path = "../../docs/examples/gate-opener/controller.rs"]
mod gate;
mod late;

use dbd_kernel::readouts::Reading;
use dbd_kernel::{F32, Leapfrog, Plant, Real};
use dbd_scene::SceneModel;
use dbd_tests::scene;

#[test]
fn the_examples_do_what_they_say() {
    the_pendulum_stays_up_for_a_minute();
    the_robot_is_pushed_and_stays_up("f64");
    the_delta_keeps_to_its_path();
}

fn the_pendulum_stays_up_for_a_minute() {
    let seconds = balance::balance(60_000).unwrap();
    assert_eq!(seconds.len(), 60);
    // Released five degrees off; upright and still after a few seconds, to the end.
    assert!(seconds[0][1] > 0.08, "{:?}", seconds[0]);
    for [cart, angle] in &seconds[5..] {
        assert!(*cart < 1e-3 && *angle < 1e-3, "{cart} {angle}");
    }
}

/// Lines `STEPS HASH` of the robot's run, as a project of `host-sim new firmware` shows them.
fn the_robot_is_pushed_and_stays_up(precision: &str) -> String {
    let (mut lines, mut next, mut leant, mut late) = (String::new(), 1, 0.0_f64, 0.0_f64);
    balance_robot::balance(precision, 10_000, |robot| {
        let step = robot.plant().state().step;
        if step == next || step == 10_000 {
            lines += &format!("{step} {:016x}\n", robot.hash());
            next *= 10;
        }
        let value = |name| robot.value(robot.output(name).unwrap());
        let pitch = value("pitch").to_degrees().abs();
        leant = leant.max(pitch);
        if robot.time() > 5.0 {
            late = late.max(pitch);
            assert!(value("axle.x").abs() < 0.02, "{precision}: {} m", value("axle.x"));
        }
    })
    .unwrap();
    // The push is seen, the bumpers at 20° do not touch the floor, and rolling resistance leaves a fraction of a degree.
    assert!(leant > 5.0 && leant < 20.0 && late < 0.5, "{precision}: {leant}° {late}°");
    lines
}

/// In single precision with the bits that the target has, too: `xtask/src/chip/project.rs`.
#[test]
fn the_robot_stays_up_in_single_precision() {
    let lines = the_robot_is_pushed_and_stays_up("f32");
    let command = "cargo test -p dbd-tests --test dynamics controllers";
    dbd_tests::page::golden("docs/examples/balance-robot/golden.txt", &lines, command);
}

/// The gate opens to its switch, waits, and closes; with the bits that the target has, too: `xtask/src/chip/project.rs`.
#[test]
fn the_gate_opens_and_closes() {
    use dbd_plant::instance::{Blueprint, Instance, Settings};
    let file = "docs/examples/gate-opener/gate-opener.toml";
    let text = std::fs::read_to_string(dbd_tests::results::path(file)).unwrap();
    let kept = text
        .lines()
        .filter(|line| !(line.starts_with("table = ") || line.starts_with("interpolate = ")));
    let text: String = kept.map(|line| format!("{line}\n")).collect();
    let damping = Some("joint-wise".to_owned());
    let settings = Settings { precision: Some("f32".into()), damping, ..Settings::default() };
    let mut run = Instance::new(Blueprint::new("gate-opener.toml", text), settings).unwrap();
    let (angle, motor) = (run.output("angle").unwrap(), run.input("motor").unwrap());
    let encoder = run.output("angle.sensor").unwrap();
    // As many as a project runs.
    let steps = 10_000;
    let (mut lines, mut next, mut open) = (String::new(), 1, 0.0);
    for step in 1..=steps {
        let time = (step - 1) as f32 * run.step_size() as f32;
        let voltage = gate::voltage(time, run.value(encoder) as f32);
        run.set_input(motor, f64::from(voltage)).unwrap();
        run.advance(1).unwrap();
        if step == next || step == steps {
            lines += &format!("{step} {:016x}\n", run.hash());
            next *= 10;
        }
        if time < 12.4 {
            open = run.value(angle);
        }
    }
    // Open it leans on its switch, short of the stop at 90°; closed it is back.
    assert!((1.56..1.575).contains(&open), "{open} rad");
    assert!(run.value(angle).abs() < 0.01, "{} rad", run.value(angle));
    let command = "cargo test -p dbd-tests --test dynamics controllers";
    dbd_tests::page::golden("docs/examples/gate-opener/golden.txt", &lines, command);
}

fn the_delta_keeps_to_its_path() {
    let furthest = follow::follow(12_000).unwrap();
    // Of it the joints' compliance is what no joint controller sees.
    assert!(furthest > 1e-5 && furthest < 1.5e-3, "{furthest}");
}

/// The same state feedback on a plant in single precision, for 10 s.
#[test]
fn the_pendulum_stays_up_in_single_precision() {
    use balance::GAINS;
    let scene = scene("cart-pendulum");
    let model: SceneModel<F32> = scene.model.convert();
    let mut plant = Plant::new(&model, Leapfrog, scene.step.unwrap()).unwrap();
    let drive = scene.input("drive").unwrap();
    let readouts = ["cart_point", "angle", "cart_velocity", "rate"]
        .map(|name| scene.readout(name).unwrap().convert());
    let seen = |plant: &Plant<&SceneModel<F32>, Leapfrog>| {
        let mut state = readouts.map(|readout| match plant.read(&readout) {
            Some(Reading::Scalar(value)) => value.to_f64(),
            Some(Reading::Vector(vector)) => vector.x.to_f64(),
            other => panic!("{other:?}"),
        });
        state[1] += 5_f64.to_radians();
        state
    };
    for _ in 0..10_000 {
        let force = -seen(&plant).iter().zip(GAINS).map(|(x, k)| x * k).sum::<f64>();
        plant.set_input(drive, force.clamp(-20.0, 20.0)).unwrap();
        plant.advance(2).unwrap();
    }
    let [x, angle, ..] = seen(&plant);
    assert!(x.abs() < 1e-3 && angle.abs() < 1e-3, "{x} {angle}");
}
