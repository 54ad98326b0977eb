//! Points and links: where they lie, and that a mechanism written by them has the bits of its long form.
//!
//! `(short form, long form) => equal models and hashes`.

#[path = "authoring/places.rs"]
mod places;
#[path = "authoring/refusals.rs"]
mod refusals;

use std::path::Path;

use dbd_kernel::{Dbd, Leapfrog, Plant, Scheme, State};
use dbd_scene::Scene;

fn load(path: &str) -> Scene {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(path).with_extension("toml");
    Scene::load(path).unwrap_or_else(|error| panic!("{error}: {}", error.help()))
}

/// A mechanism of `tests/authoring`.
fn written(name: &str) -> Scene {
    load(&format!("tests/authoring/{name}"))
}

fn hash<S: Scheme>(scene: &Scene, scheme: S, steps: u64) -> u64 {
    let mut plant = Plant::new(&scene.model, scheme, scene.step.unwrap()).unwrap();
    for _ in 0..steps {
        plant.step().ok().unwrap();
    }
    plant.hash()
}

/// Equal to the last bit: `==` takes 0 for −0, the hash does not.
fn assert_same(short: &Scene, long: &Scene) {
    assert_eq!(short.body_names, long.body_names);
    assert_eq!(short.model.initial, long.model.initial);
    assert_eq!(short.model, long.model);
    assert_eq!(State::initial(&short.model).hash(), State::initial(&long.model).hash());
    assert_eq!(hash(short, Dbd::default(), 1000), hash(long, Dbd::default(), 1000));
    assert_eq!(hash(short, Leapfrog, 1000), hash(long, Leapfrog, 1000));
}

/// The long form ships; its hashes are those of `tests/golden/hashes.csv`.
#[test]
fn the_four_bar_of_points_is_that_of_numbers() {
    let (short, long) = (written("four-bar"), load("scenes/four-bar"));
    assert_same(&short, &long);
    let golden = include_str!("../../tests/golden/hashes.csv");
    let hash = format!("four-bar,dbd,f64,2e-5,1000,{:016x}\n", hash(&short, Dbd::default(), 1000));
    assert!(golden.contains(&hash), "{hash}");
}
