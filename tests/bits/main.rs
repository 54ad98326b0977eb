//! Golden bits: the state's hash per scene, scheme, precision, step and number of steps.
//!
//! The table `hashes.csv` is part of the interface, `orientations.csv` holds those of Euler angles,
//! `planar.csv` those of scenes in their plane, `joint-wise.csv` those of damping joint by joint,
//! `fixed.csv` those of fixed point, `laws.csv` those of scenes with laws, `generalized-alpha.csv` those of the scheme with a matrix.
//! `DBD_BLESS=golden cargo test -p dbd-bits --all-features` writes the present hashes; a changed one needs its
//! reason in the commit.

#[path = "../../host-sim/templates/laws/cam.rs.in"]
mod cam;
#[path = "../../host-sim/templates/laws/drag.rs.in"]
mod drag;

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use dbd_plant::{DampingName, Method, Named as _, PrecisionName, SchemeName, plant};
use dbd_scene::laws::{known_laws, register};
use dbd_scene::{Scene, interactions};
use dbd_tests::page::golden;
use dbd_tests::{scene, scene_names};

const HEADER: &str = "scene,scheme,precision,step,steps,hash";

/// Steps of every scene, at its own step, and the longer run of one.
const STEPS: u64 = 1_000;
const LONG: (&str, u64) = ("four-bar", 10_000);

/// \[s\] the step of the scheme with a matrix.
const SOLVED: f64 = 1e-3;

/// Scenes of all schemes: planar, with torsion springs, with points on lines, in space, damped.
const ALL_SCHEMES: [&str; 5] = ["four-bar", "3rrr", "crank-slider", "3ruu", "double-wishbone"];

/// The scene of the corpus with bodies that inputs move, beside those with laws.
const DRIVEN: &str = "driven";
/// Examples of the documentation with laws.
const EXAMPLES: [&str; 6] =
    ["balance-robot", "crane", "gate-opener", "grasp", "quarter-car", "wiper"];

const F64: PrecisionName = PrecisionName::F64;
const F32: PrecisionName = PrecisionName::F32;
const FIXED: PrecisionName = PrecisionName::Fixed;

/// A method and what the tables call its scheme.
#[derive(Clone)]
struct Way(Method, String);

fn way(scheme: SchemeName) -> Way {
    Way(Method::new(scheme, None, F64).unwrap(), scheme.name().to_owned())
}

impl Way {
    fn newton(iterations: u32) -> Self {
        let method = Method::new(SchemeName::Dbd, Some(iterations), F64).unwrap();
        Self(method, format!("dbd-newton-{iterations}"))
    }

    fn damped(self, damping: DampingName) -> Self {
        Self(self.0.with_damping(damping).unwrap(), format!("{}-{}", self.1, damping.name()))
    }
}

/// Compares what is with the golden table, or blesses it.
fn compare(name: &str, present: &str) {
    golden(&format!("tests/bits/{name}"), present, "cargo test -p dbd-bits --all-features");
}

fn row(scene: &Scene, Way(method, called): &Way, precision: PrecisionName, steps: u64) -> String {
    let method = method.with_precision(precision);
    let step = scene.step.expect("a golden scene states its step");
    let mut plant = plant(scene, &method, step).unwrap();
    for _ in 0..steps {
        plant.step().unwrap();
    }
    let (name, precision) = (&scene.name, precision.name());
    format!("{name},{called},{precision},{step:e},{steps},{:016x}\n", plant.hash())
}

fn rows(
    present: &mut String,
    scene: &Scene,
    ways: &[Way],
    precisions: &[PrecisionName],
    steps: u64,
) {
    for way in ways {
        for precision in precisions {
            present.push_str(&row(scene, way, *precision, steps));
        }
    }
}

/// The scenes of the two schemes that every scene has, the longer run first.
fn all_scenes() -> impl Iterator<Item = (Scene, u64)> {
    let runs = scene_names().into_iter().map(|name| (name, STEPS));
    let runs = std::iter::once((LONG.0.to_owned(), LONG.1)).chain(runs);
    runs.map(|(name, steps)| (scene(&name), steps))
}

/// The ways beside dbd and leapfrog.
fn other_ways() -> Vec<Way> {
    let other = [
        SchemeName::DbdP1,
        SchemeName::DbdP2,
        SchemeName::SemiImplicitEuler,
        SchemeName::Pefrl,
        SchemeName::BlanesMoanS6,
        SchemeName::Rk4,
    ];
    std::iter::once(Way::newton(1)).chain(other.map(way)).collect()
}

#[test]
fn states_have_their_golden_hashes() {
    let mut present = format!("{HEADER}\n");
    let both = [way(SchemeName::Dbd), way(SchemeName::Leapfrog)];
    for (scene, steps) in all_scenes() {
        rows(&mut present, &scene, &both, &[F64, F32], steps);
    }
    for name in ALL_SCHEMES {
        rows(&mut present, &scene(name), &other_ways(), &[F64, F32], STEPS);
    }
    compare("hashes.csv", &present);
}

/// Of scenes with damped joints: to the ground and between bodies, raw springs, torsion springs, clearances.
#[test]
fn states_of_joint_wise_damping_have_their_golden_hashes() {
    let mut present = format!("{HEADER}\n");
    let way = way(SchemeName::Leapfrog).damped(DampingName::JointWise);
    for name in
        ["cart-pendulum", "delta-pick-and-place", "double-wishbone", "gripper", "macpherson"]
    {
        rows(&mut present, &scene(name), std::slice::from_ref(&way), &[F64, F32], STEPS);
    }
    compare("joint-wise.csv", &present);
}

/// Of all scenes, and of those of all schemes, of the damped one with its dampers in all ways.
#[test]
fn states_in_fixed_point_have_their_golden_hashes() {
    let mut present = format!("{HEADER}\n");
    let both = [way(SchemeName::Dbd), way(SchemeName::Leapfrog)];
    for (scene, steps) in all_scenes() {
        rows(&mut present, &scene, &both, &[FIXED], steps);
    }
    for name in ALL_SCHEMES {
        let scene = scene(name);
        rows(&mut present, &scene, &other_ways(), &[FIXED], STEPS);
        if !scene.model.dampers.is_empty() {
            let damped = [DampingName::Explicit, DampingName::JointWise];
            let damped = damped.map(|damping| way(SchemeName::Leapfrog).damped(damping));
            rows(&mut present, &scene, &damped, &[FIXED], STEPS);
        }
    }
    compare("fixed.csv", &present);
}

/// Of the paper's mechanisms, of joints without a tangent in closed form, clearances, bushings, inputs and a
/// matrix that is filled.
#[test]
fn states_of_generalized_alpha_have_their_golden_hashes() {
    let mut present = format!("{HEADER}\n");
    let mut scenes = ALL_SCHEMES.to_vec();
    scenes.extend(["six-bar", "gripper", "cart-pendulum", "delta-pick-and-place", "macpherson"]);
    for name in scenes {
        let mut scene = scene(name);
        scene.step = Some(SOLVED);
        let solved = [SchemeName::GeneralizedAlpha, SchemeName::GeneralizedAlpha3].map(way);
        rows(&mut present, &scene, &solved, &[F64, F32, FIXED], STEPS);
    }
    compare("generalized-alpha.csv", &present);
}

/// Of scenes in their plane: pins, a spherical and a universal joint with a guide, dampers.
#[test]
fn states_in_the_plane_have_their_golden_hashes() {
    let planar = |name: &str| scene(name).with("planar=true").unwrap();
    let mut present = format!("{HEADER}\n");
    let ways = [SchemeName::Dbd, SchemeName::Leapfrog, SchemeName::Rk4].map(way);
    for name in ["hexagon", "four-bar", "3rrr", "crank-slider", "cart-pendulum"] {
        rows(&mut present, &planar(name), &ways, &[F64, F32], STEPS);
    }
    let joint_wise = [way(SchemeName::Leapfrog).damped(DampingName::JointWise)];
    rows(&mut present, &planar("cart-pendulum"), &joint_wise, &[F64, F32], STEPS);
    for name in ["hexagon", "six-bar"] {
        let mut scene = planar(name);
        scene.step = Some(SOLVED);
        let solved = [SchemeName::GeneralizedAlpha, SchemeName::GeneralizedAlpha3].map(way);
        rows(&mut present, &scene, &solved, &[F64, F32], STEPS);
    }
    compare("planar.csv", &present);
}

/// Of scenes that have every law together, and of the examples with laws, in the plane, too, where they move there.
#[test]
fn states_with_laws_have_their_golden_hashes() {
    let folder = |path: &str| Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(path);
    register::<drag::Drag>("my_laws::Drag");
    register::<cam::Cam>("my_laws::Cam");
    let load = |file: PathBuf| {
        let text = std::fs::read_to_string(&file).unwrap();
        let mut scene = Scene::parse(&text, &file.to_string_lossy()).unwrap();
        let name = file.file_name().unwrap().to_string_lossy();
        scene.name = name.split('.').next().unwrap().to_owned();
        scene.step = Some(scene.step.unwrap_or(1e-4));
        scene
    };
    let (mut present, ways) = (format!("{HEADER}\n"), [way(SchemeName::Leapfrog)]);
    let mut unseen: BTreeSet<_> = known_laws().into_iter().map(|law| law.name).collect();
    let corpus = std::fs::read_dir(folder("tests/fuzz/corpus/scene")).unwrap();
    let mut files: Vec<_> = corpus.map(|entry| entry.unwrap().path()).collect();
    files.sort();
    let has_laws = |scene: &Scene| !interactions(scene).is_empty() || scene.name == DRIVEN;
    let scenes = files.into_iter().map(load).filter(has_laws);
    for scene in scenes.chain([load(folder("host-sim/templates/laws/drop.toml.in"))]) {
        for law in interactions(&scene) {
            unseen.remove(law.law);
        }
        rows(&mut present, &scene, &ways, &[F64, F32, FIXED], STEPS);
        // The target steps double precision less far.
        rows(&mut present, &scene, &ways, &[F64], 100);
    }
    assert!(unseen.is_empty(), "laws without a golden hash: {unseen:?}");
    for name in EXAMPLES {
        let file = folder("docs/examples").join(name).join(name).with_extension("toml");
        let scene = load(file);
        rows(&mut present, &scene, &ways, &[F64, F32, FIXED], STEPS);
        if let Ok(mut scene) = scene.with("planar=true") {
            scene.name += "-planar";
            scene.step = Some(scene.step.unwrap_or(1e-4));
            rows(&mut present, &scene, &ways, &[F64, F32], STEPS);
        }
    }
    compare("laws.csv", &present);
}

#[cfg(feature = "comparison")]
#[test]
fn states_of_euler_angles_have_their_golden_hashes() {
    let mut present = "scene,scheme,precision,step,steps,hash,orientation\n".to_owned();
    for name in ["four-bar", "crank-slider", "3ruu"] {
        let scene = scene(name);
        for precision in [F64, F32] {
            for scheme in [SchemeName::Leapfrog, SchemeName::Pefrl, SchemeName::Rk4] {
                let Way(method, called) = way(scheme);
                let orientation = dbd_plant::OrientationName::Euler321;
                let turned = Way(method.with_orientation(orientation), called);
                let row = row(&scene, &turned, precision, STEPS);
                present += &format!("{},{}\n", row.trim_end(), orientation.name());
            }
        }
    }
    compare("orientations.csv", &present);
}
