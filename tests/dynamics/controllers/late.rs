//! A controller's bug that a plain test does not see and a golden run does: the worked example of `docs/golden.md`.

use dbd_golden::{Bands, Recording, Tolerance};
use dbd_plant::{Method, plant};
use dbd_tests::page::{block, figure, table};
use dbd_tests::scene;

use super::balance::force;

/// A run of 10 s under the controller of the example `balance`, its rates so many looks old, with samples every so
/// many steps; and how far from upright \[rad\] the pendulum is in the last second.
fn run(late: usize, every: u64) -> (Recording, f64) {
    let scene = scene("cart-pendulum");
    let mut plant = plant(&scene, &Method::default(), 5e-4).unwrap();
    let mut recording =
        Recording::of_scene(&scene, plant.as_ref(), every, &["angle", "drive"]).unwrap();
    let [cart, angle, speed, rate] =
        ["cart_point", "angle", "cart_velocity", "rate"].map(|name| scene.readout(name).unwrap());
    let drive = scene.input("drive").unwrap();
    let (mut rates, mut furthest) = (Vec::new(), 0.0_f64);
    for look in 0..=10_000 {
        recording.look(plant.as_ref()).unwrap();
        let along = |readout| plant.read(readout).unwrap().vector().unwrap().x;
        let about = |readout| plant.read(readout).unwrap().scalar().unwrap();
        let upright = about(&angle) + 5_f64.to_radians();
        rates.push([along(&speed), about(&rate)]);
        let [v, w] = rates[rates.len() - 1 - late.min(rates.len() - 1)];
        let value = force([along(&cart), upright, v, w]);
        if look > 9_000 {
            furthest = furthest.max(upright.abs());
        }
        plant.set(drive, value, 0.0).unwrap();
        plant.advance(2).unwrap();
    }
    (recording, furthest)
}

/// Whoever tests only that the pendulum stays up does not see it.
#[test]
fn a_golden_run_sees_what_staying_upright_does_not() {
    let golden = run(0, 100);
    let text = golden.0.text();
    assert!(run(0, 100).0.compare(&text, &Tolerance::Bits).is_ok());
    let late = run(1, 100);
    for (_, upright) in [&golden, &late] {
        assert!(*upright < 1e-3, "{upright}");
    }
    let bits = late.0.compare(&text, &Tolerance::Bits).unwrap_err().to_string();
    block("docs/golden.md", "late", &format!("```text\n{}\n```", bits.trim_end()));

    // At every look: the very one.
    let step = |every| {
        let refused = run(1, every).0.compare(&run(0, every).0.text(), &Tolerance::Bits);
        let words = refused.unwrap_err().to_string();
        let place = words.find("step ").unwrap();
        let digits = words[place + 5..].split(|c: char| !c.is_ascii_digit()).next().unwrap();
        digits.to_owned()
    };
    let held = |band: f64| late.0.compare(&text, &Tolerance::Within(Bands::all(band))).is_ok();
    let [tight, wide] = [1e-3, 1.0].map(held);
    assert!(!tight && wide);
    let words = |is_seen: bool| if is_seen { "fails" } else { "passes" }.to_owned();
    let rows = [
        ("upright within 1e-3 rad in the last second", {
            let [right, wrong] = [golden.1, late.1].map(|angle| figure(angle, 1));
            format!("passes: {wrong} rad, before {right} rad")
        }),
        ("a golden run within bands of 1", words(!wide)),
        ("a golden run within bands of 1e-3", words(!tight)),
        ("a golden run bit for bit, every 100 steps", format!("fails at step {}", step(100))),
        ("the same, every 2 steps", format!("fails at step {}", step(2))),
    ];
    let rows = rows.map(|(test, says)| vec![test.to_owned(), says]);
    block("docs/golden.md", "tests", &table(&["test of the late controller", "says"], &rows));
}
