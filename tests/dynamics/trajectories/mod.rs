//! Golden trajectories of two of the project's own scenes, as users have them of theirs: a four-bar that
//! swings by itself, and a cart-pendulum under the controller of the example `balance`.
//!
//! `DBD_BLESS=golden cargo test -p dbd-tests --test dynamics trajectories` writes the files, which are those of
//! leapfrog in single precision; a changed one needs its reason in the commit. What is `bare` holds the
//! files as they were when it was compiled: after blessing it passes at the next run.

mod bare;

use crate::controllers::balance;
use dbd_golden::{Bands, GoldenFile, Mismatch, Recording, Tolerance};
use dbd_kernel::euler::EulerF32;
use dbd_kernel::fingerprint::model_hash;
use dbd_kernel::readouts::Reading;
use dbd_kernel::{F32, F64, Geometry, Leapfrog, Pefrl, Plant, Real, Scheme};
use dbd_plant::{Method, PrecisionName, SchemeName};
use dbd_scene::SceneModel;
use dbd_tests::results::path;
use dbd_tests::{scene, scene_names};

type Owned<P, S> = Plant<Box<SceneModel<P>>, S>;

/// What of the cart-pendulum is recorded beside its bodies.
const SEEN: [&str; 2] = ["angle", "drive"];

fn golden(name: &str) -> GoldenFile {
    GoldenFile::new(path(&format!("tests/dynamics/trajectories/{name}.golden")))
}

fn plant<P: Geometry, S: Scheme>(name: &str, scheme: S) -> Owned<P, S> {
    let scene = scene(name);
    Plant::new(Box::new(scene.model.convert()), scheme, scene.step.unwrap()).unwrap()
}

/// 0.1 s of the four-bar, every 2 ms.
fn four_bar<P: Geometry, S: Scheme>(scheme: S) -> Recording {
    let mut plant: Owned<P, S> = plant("four-bar", scheme);
    let mut run = Recording::of_scene(&scene("four-bar"), &plant, 100, &[]).unwrap();
    while run.look(&plant).unwrap() && plant.state().step < 5_000 {
        plant.advance(100).unwrap();
    }
    run
}

/// The cart-pendulum for 3 s under its controller, which acts every millisecond, two steps; `look` sees
/// the plant before each.
fn balance<P: Geometry, S: Scheme>(plant: &mut Owned<P, S>, mut look: impl FnMut(&Owned<P, S>)) {
    let scene = scene("cart-pendulum");
    let drive = scene.input("drive").unwrap();
    let readouts = ["cart_point", "angle", "cart_velocity", "rate"]
        .map(|name| scene.readout(name).unwrap().convert());
    while plant.state().step <= 6_000 {
        look(plant);
        let mut state = readouts.map(|readout| match plant.read(&readout) {
            Some(Reading::Scalar(value)) => value.to_f64(),
            Some(Reading::Vector(vector)) => vector.x.to_f64(),
            other => panic!("{other:?}"),
        });
        state[1] += 5_f64.to_radians();
        plant.set_input(drive, balance::force(state)).unwrap();
        plant.advance(2).unwrap();
    }
}

fn balanced<P: Geometry, S: Scheme>(scheme: S) -> Recording {
    let mut plant: Owned<P, S> = plant("cart-pendulum", scheme);
    let scene = scene("cart-pendulum");
    let mut run = Recording::of_scene(&scene, &plant, 120, &SEEN).unwrap();
    balance(&mut plant, |plant| {
        run.look(plant).unwrap();
    });
    run
}

#[test]
fn a_linkage_keeps_its_bits() {
    golden("four-bar").assert(&four_bar::<F32, _>(Leapfrog), &Tolerance::Bits);
}

#[test]
fn a_controlled_plant_keeps_its_bits() {
    golden("balance").assert(&balanced::<F32, _>(Leapfrog), &Tolerance::Bits);
}

/// A plant by name is the same plant.
#[test]
fn a_plant_by_name_has_the_golden_bits() {
    let scene = scene("four-bar");
    let method = Method::new(SchemeName::Leapfrog, None, PrecisionName::F32).unwrap();
    let mut plant = dbd_plant::plant(&scene, &method, scene.step.unwrap()).unwrap();
    let mut run = Recording::of_scene(&scene, plant.as_ref(), 100, &[]).unwrap();
    while run.look(plant.as_ref()).unwrap() && plant.steps() < 5_000 {
        plant.advance(100).unwrap();
    }
    assert_eq!(run.text(), four_bar::<F32, _>(Leapfrog).text());
}

/// Double precision and another scheme. The bands are two to four times what is seen, and say what they
/// say of the scenes: the four-bar's joints are not damped, so that rounding rings in its velocities.
#[test]
fn other_methods_stay_within_their_bands() {
    let bands = Tolerance::AnyMethod(Bands {
        position: 2e-5,
        orientation: 3e-5,
        velocity: 0.15,
        angular_velocity: 0.3,
        values: &[],
        others: None,
    });
    golden("four-bar").assert(&four_bar::<F64, _>(Leapfrog), &bands);
    let bands = Tolerance::AnyMethod(Bands {
        position: 5e-6,
        orientation: 6e-6,
        velocity: 4e-4,
        angular_velocity: 8e-4,
        values: &[("angle", 1e-5), ("drive", 6e-3)],
        others: None,
    });
    golden("balance").assert(&balanced::<F64, _>(Leapfrog), &bands);
    golden("balance").assert(&balanced::<F32, _>(Pefrl), &bands);
}

/// The hash by which a file knows its scene: one in all precisions, another for another scene.
#[test]
fn a_model_has_one_hash_in_every_precision() {
    let mut seen = std::collections::BTreeSet::new();
    for name in scene_names() {
        let model = scene(&name).model;
        let hash = model_hash(&model);
        assert_eq!(hash, model_hash(&model.convert::<F32>()), "{name}");
        assert_eq!(hash, model_hash(&model.convert::<EulerF32>().convert::<F64>()), "{name}");
        assert!(seen.insert(hash), "{name}");
        let mut other = model.clone();
        other.bodies[0].mass *= 1.0 + 1e-6;
        assert!(seen.insert(model_hash(&other)), "{name}");
        // Where it starts is no part of it: the first sample shows that.
        let mut other = model.clone();
        other.initial[0].velocity.x += 1.0;
        assert_eq!(hash, model_hash(&other), "{name}");
    }
}

/// Each file is of its own run and small enough to be looked at.
#[test]
fn the_files_are_not_taken_for_each_other() {
    let text = std::fs::read_to_string(path("tests/dynamics/trajectories/balance.golden")).unwrap();
    let other = four_bar::<F32, _>(Leapfrog).compare(&text, &Tolerance::Bits);
    let scenes = ["cart-pendulum", "four-bar"].map(str::to_owned);
    let [golden, present] = scenes;
    assert_eq!(other, Err(Box::new(Mismatch::Scene { golden, present })));
    assert!(text.lines().count() < 100);
}
