//! What the heads of scenes say in figures, beside what a run gives.

use std::path::Path;

use dbd_kernel::energy::energy;
use dbd_kernel::{F64, Leapfrog, Plant, frequency};
use dbd_scene::SceneModel;
use dbd_tests::page::figure;
use dbd_tests::scene;

/// Runs a scene at its own step with leapfrog and looks at it at each of `samples`, the start first.
fn look(name: &str, samples: u64, mut visit: impl FnMut(&Plant<&SceneModel<F64>, Leapfrog>)) {
    let scene = scene(name);
    let h = scene.step.unwrap();
    let steps = (scene.duration / h).round() as u64;
    let mut plant = Plant::new(&scene.model, Leapfrog, h).unwrap();
    visit(&plant);
    for sample in 1..=samples {
        plant.advance(steps * sample / samples - plant.state().step).unwrap();
        visit(&plant);
    }
}

/// Holds the head of a scene to a phrase with what was computed.
fn says(name: &str, phrase: &str) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes").join(name);
    let text = std::fs::read_to_string(path.with_extension("toml")).unwrap();
    let head = text.lines().take_while(|line| line.starts_with('#'));
    let head: Vec<_> = head.map(|line| line.trim_start_matches(['#', ' '])).collect();
    let head = head.join(" ");
    assert!(head.contains(phrase), "{name} is to say: {phrase}\nit says: {head}");
}

#[test]
fn the_four_bars_energy_stays_within_a_band() {
    let (mut least, mut most, mut kinetic) = (f64::INFINITY, f64::NEG_INFINITY, 0.0_f64);
    look("four-bar", 2_500, |plant| {
        let energy = energy(plant.model(), plant.state(), plant.step_size());
        let total = energy.total();
        (least, most) = (least.min(total), most.max(total));
        kinetic = kinetic.max(energy.kinetic);
    });
    let band = 100.0 * (most - least) / kinetic;
    says("four-bar", &format!("a band of {band:.4} % of its largest kinetic energy"));
}

#[test]
fn the_five_bars_frequency_rises() {
    let mut frequencies = Vec::new();
    look("five-bar-a", 100, |plant| {
        frequencies.push(frequency::estimate(plant.model(), plant.state(), 100));
    });
    let rise = 100.0 * (frequencies.iter().copied().fold(0.0, f64::max) / frequencies[0] - 1.0);
    says("five-bar-a", &format!("rises along the motion by {} %", figure(rise, 1)));
}

#[test]
fn the_crank_takes_in_its_energy() {
    let (mut start, mut end, mut mean) = (None, 0.0, 0.0);
    look("crank-slider", 1_000, |plant| {
        end = energy(plant.model(), plant.state(), plant.step_size()).total();
        start = start.or(Some(end));
        mean += plant.state().bodies[0].angular_velocity.z.abs() / 1_001.0;
    });
    let taken = end - start.unwrap_or_default();
    let phrase = format!(
        "{} J go in and the crank turns at {} rad/s on average",
        figure(taken, 3),
        figure(mean, 2)
    );
    says("crank-slider", &phrase);
}
