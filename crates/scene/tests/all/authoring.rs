//! Points and links: where they lie, and that a mechanism written by them has the bits of its long form.
//!
//! `(short form, long form) => equal models and hashes`.

mod bodies;
mod places;
mod refusals;

use std::path::Path;

use dbd_kernel::{Dbd, Leapfrog, Plant, Scheme, State};
use dbd_scene::Scene;

fn load(path: &str) -> Scene {
    let path =
        Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(path).with_extension("toml");
    Scene::load(path).unwrap_or_else(|error| panic!("{error}: {}", error.help()))
}

/// A mechanism of `tests/authoring`.
fn written(name: &str) -> Scene {
    load(&format!("tests/authoring/{name}"))
}

fn hash<S: Scheme>(scene: &Scene, scheme: S, steps: u64) -> u64 {
    let mut plant = Plant::new(&scene.model, scheme, scene.step.unwrap()).unwrap();
    for _ in 0..steps {
        plant.step().unwrap();
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

/// The long form ships; its hashes are those of `tests/bits/hashes.csv`.
#[test]
fn the_four_bar_of_points_is_that_of_numbers() {
    let (short, long) = (written("four-bar"), load("scenes/four-bar"));
    assert_same(&short, &long);
    let golden = include_str!("../../../../tests/bits/hashes.csv");
    let hash = format!("four-bar,dbd,f64,2e-5,1000,{:016x}\n", hash(&short, Dbd::default(), 1000));
    assert!(golden.contains(&hash), "{hash}");
}

/// The long form is of another program, which computed with 60 digits.
#[test]
fn the_peaucellier_linkage_of_points_is_that_of_numbers() {
    assert_same(&written("peaucellier"), &written("peaucellier-long"));
}

/// So few lines, comments and all.
#[test]
fn mechanisms_are_short() {
    for (name, most) in [("four-bar", 20), ("peaucellier", 60)] {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/authoring").join(name);
        let text = std::fs::read_to_string(path.with_extension("toml")).unwrap();
        assert!(text.lines().count() <= most, "{name}: {} lines", text.lines().count());
        assert!(text.lines().all(|line| line.chars().count() <= 180), "{name}");
    }
}

/// The page shows the very file.
#[test]
fn the_page_shows_the_four_bar() {
    let page = include_str!("../../../../docs/authoring.md");
    let scene = include_str!("../../../../tests/authoring/four-bar.toml");
    assert!(page.contains(&format!("```toml\n{scene}```")));
}

/// The springs of the legs carry it; what rests falls no further than they give way. Besides the platform's six
/// freedoms each leg turns about itself.
#[test]
fn the_stewart_platform_of_points_stands() {
    let scene = written("stewart-platform");
    assert_eq!((scene.body_names.len(), scene.joints.len()), (13, 18));
    assert_eq!(dbd_scene::facts(&scene).freedoms, Some(12));
    let error = scene.joints.iter().map(|joint| joint.assembly_error).fold(0.0, f64::max);
    assert!(error < 1e-14, "{error:e}");
    let step = scene.step.unwrap();
    let mut plant = Plant::new(&scene.model, Leapfrog, step).unwrap();
    let begin = scene.model.initial[0].position.z;
    let (mut least, mut greatest) = (begin, begin);
    for _ in 0..(0.1 / step) as u64 {
        plant.step().unwrap();
        let height = plant.state().bodies[0].position.z;
        (least, greatest) = (least.min(height), greatest.max(height));
    }
    assert!(greatest - least < 1e-3 && least < begin, "{begin} {least} {greatest}");
}

/// What random texts of points begin with is a scene.
#[test]
fn the_seed_of_random_texts_is_taken() {
    let scene = load("tests/fuzz/corpus/scene/points");
    assert_eq!((scene.body_names.len(), scene.derived.len()), (4, 4));
}
