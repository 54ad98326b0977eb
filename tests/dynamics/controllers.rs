//! The controllers among the examples do what they say.

#[allow(dead_code, reason = "an example has a main function of its own")]
#[path = "../../host-sim/examples/balance.rs"]
pub mod balance;
mod examples;
#[allow(dead_code, reason = "an example has a main function of its own")]
#[path = "../../host-sim/examples/follow.rs"]
mod follow;
mod late;

use dbd_kernel::readouts::Reading;
use dbd_kernel::{F32, Leapfrog, Plant, Real};
use dbd_scene::SceneModel;
use dbd_tests::page::{block, table};
use dbd_tests::scene;

#[test]
fn the_examples_do_what_they_say() {
    // Each asserts what it is about; the page says how well.
    let upright = the_pendulum_stays_up_for_a_minute();
    let furthest = the_delta_keeps_to_its_path();
    let rows = [
        vec![
            "`cargo run --release --example balance`".to_owned(),
            format!(
                "state feedback holds the cart-pendulum upright for 60 s: from 5° to {upright:.0e} rad"
            ),
        ],
        vec![
            "`cargo run --release --example follow`".to_owned(),
            format!(
                "a delta robot's tool keeps within {:.2} mm of a circle of 100 mm radius, 1 Hz",
                1e3 * furthest
            ),
        ],
    ];
    block(
        "docs/measured.md",
        "examples",
        &table(&["example, under 40 lines of code", "does"], &rows),
    );
}

/// How far from upright \[rad\] it is in the last second.
fn the_pendulum_stays_up_for_a_minute() -> f64 {
    let seconds = balance::balance(60_000).unwrap();
    assert_eq!(seconds.len(), 60);
    // Released five degrees off; upright and still after a few seconds, to the end.
    assert!(seconds[0][1] > 0.08, "{:?}", seconds[0]);
    for [cart, angle] in &seconds[5..] {
        assert!(*cart < 1e-3 && *angle < 1e-3, "{cart} {angle}");
    }
    seconds[59][1]
}

/// How far the tool is off at most \[m\].
fn the_delta_keeps_to_its_path() -> f64 {
    let furthest = follow::follow(12_000).unwrap();
    // Of it the joints' compliance is what no joint controller sees.
    assert!(furthest > 1e-5 && furthest < 1.5e-3, "{furthest}");
    furthest
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
        plant.advance(2).ok().unwrap();
    }
    let [x, angle, ..] = seen(&plant);
    assert!(x.abs() < 1e-3 && angle.abs() < 1e-3, "{x} {angle}");
}
