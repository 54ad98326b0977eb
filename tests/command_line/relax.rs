//! `relax`: closed forms of the pose at rest, the file that it writes, and what it refuses.

use std::fmt::Write as _;
use std::fs;
use std::path::PathBuf;

use dbd_scene::Scene;
use host_sim::terminal::Exit;
use serde_json::Value;

use crate::{Done, Folder, call};

/// \[N, N·m\] what may remain of weights of some newtons.
const RESIDUAL: f64 = 1e-9;

const MASSES: [f64; 3] = [2.0, 0.5, 1.25];
const STIFFNESSES: [f64; 3] = [400.0, 150.0, 3000.0];

/// Three masses that hang from each other by springs of 0.3 m.
fn hanging() -> String {
    let mut text = "name = \"hanging\"\nduration = 1\ngravity = [0, 0, -9.81]\n".to_owned();
    let mut above = "world".to_owned();
    for (i, (mass, stiffness)) in MASSES.iter().zip(STIFFNESSES).enumerate() {
        let z = -0.3 * (i + 1) as f64;
        let _ = write!(
            text,
            "[[body]]\nname = \"m{i}\"\nmass = {mass}\ninertia = [0.01, 0.01, 0.02]\nposition = [0, 0, {z}]\n\
             velocity = [0, 0, 0.5]\n[[tsda]]\nbetween = [\"{above}\", \"m{i}\"]\n\
             points = [[0, 0, 0], [0, 0, 0]]\nstiffness = {stiffness}\nfree_length = 0.3\n"
        );
        above = format!("m{i}");
    }
    text
}

fn json(done: &Done) -> Value {
    serde_json::from_str(&done.out).unwrap_or_else(|_| panic!("{} {}", done.out, done.err))
}

/// The scene that `relax` writes.
fn at_rest(folder: &Folder, scene: &str, more: &[&str]) -> Scene {
    let file = folder.path("rest.toml");
    let out = ["--out", file.to_str().unwrap(), "--overwrite"];
    let done = call(&[&["relax", scene][..], &out, more].concat());
    assert_eq!((done.exit, done.err.as_str()), (Exit::Done, ""));
    Scene::load(file).unwrap()
}

fn shipped(name: &str) -> String {
    let root = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../scenes");
    root.join(name).with_extension("toml").to_str().unwrap().to_owned()
}

#[test]
fn a_chain_of_springs_hangs_by_the_weights_below_each() {
    let folder = Folder::new();
    let scene = folder.scene(&hanging());
    let done = call(&["relax", &scene, "--json"]);
    let said = json(&done);
    for key in ["residual_force", "residual_torque"] {
        assert!(said[key].as_f64().unwrap() < RESIDUAL, "{said}");
    }
    let rest = at_rest(&folder, &scene, &[]);
    let (mut z, mut lowest) = (0.0, 0.0);
    for (i, stiffness) in STIFFNESSES.iter().enumerate() {
        let below: f64 = MASSES[i..].iter().sum();
        z -= 0.3 + below * 9.81 / stiffness;
        lowest = z + 0.3 * (i + 1) as f64;
        let state = &rest.model.initial[i];
        assert!((state.position.z - z).abs() < 1e-9, "{i}: {:?} {z}", state.position);
        assert_eq!(state.velocity, dbd_kernel::Vec3::ZERO);
    }
    let moved = said["largest_distance"].as_f64().unwrap();
    assert!((moved + lowest).abs() < 1e-9, "{moved} {lowest}");
}

#[test]
fn a_mass_hangs_in_a_rope_of_a_distance_stop() {
    let folder = Folder::new();
    let text = "name = \"rope\"\nduration = 1\ngravity = [0, 0, -10]\n[[body]]\nname = \"bob\"\nmass = 2\n\
        inertia = [0.1, 0.1, 0.1]\nposition = [0.3, 0, -0.4]\n[[interaction]]\nlaw = \"distance-stop\"\n\
        between = [\"world\", \"bob\"]\npoints = [[0, 0, 0], [0, 0, 0]]\nto = 1\nstiffness = 1e4\n";
    let position = at_rest(&folder, &folder.scene(text), &[]).model.initial[0].position;
    assert!((position.z + 1.002).abs() < 1e-8 && position.x.abs() < 1e-7, "{position:?}");
}

/// What is written rests, keeps its elements and reads back; planar scenes, spiders and dampers among them.
#[test]
fn the_scene_at_rest_has_the_elements_that_it_had() {
    let folder = Folder::new();
    for (name, more) in [("3ruu", ""), ("hexagon", ""), ("double-wishbone", ""), ("gyroscope", "")]
    {
        let more: Vec<&str> = if more.is_empty() { Vec::new() } else { vec![more] };
        let rest = at_rest(&folder, &shipped(name), &more);
        let before = Scene::load(shipped(name)).unwrap();
        assert_eq!(rest.model.tsdas, before.model.tsdas, "{name}");
        assert_eq!(rest.model.points, before.model.points, "{name}");
        assert_ne!(rest.model.initial, before.model.initial, "{name}");
        assert_eq!(rest.planar.is_some(), !more.is_empty(), "{name}");
        let again = json(&call(&["relax", folder.path("rest.toml").to_str().unwrap(), "--json"]));
        assert!(again["largest_distance"].as_f64().unwrap() < 1e-8, "{name}: {again}");
        assert!(again["residual_force"].as_f64().unwrap() < 1e-7, "{name}: {again}");
    }
}

#[test]
fn what_falls_or_is_driven_is_refused_with_its_acceleration() {
    let folder = Folder::new();
    let text = "name = \"stone\"\nduration = 1\ngravity = [0, 0, -9.81]\n[[body]]\nname = \"stone\"\n\
        mass = 3\ninertia = [1, 1, 1]\nposition = [0, 0, 0]\n";
    let done = call(&["relax", &folder.scene(text), "--out", folder.path("x").to_str().unwrap()]);
    assert_eq!((done.exit, done.out.as_str()), (Exit::Failed, ""));
    assert!(done.err.contains("nothing holds `stone`") && done.err.contains("9.810e0 m/s²"));
    assert!(!folder.path("x").exists());
    let done = call(&["relax", "crank-slider"]);
    assert!(
        done.exit == Exit::Failed && done.err.contains("nothing holds `crank`"),
        "{}",
        done.err
    );
}

#[test]
fn outputs_that_clash_are_refused() {
    let folder = Folder::new();
    let scene = folder.scene(&hanging());
    let done = call(&["relax", &scene, "--json", "--out", "-"]);
    assert!(done.exit == Exit::Refused && done.err.contains("--out -"), "{}", done.err);
    let done = call(&["relax", &scene, "--out", &scene]);
    assert!(done.exit == Exit::Refused && done.err.contains("exists"), "{}", done.err);
    assert_eq!(fs::read_to_string(&scene).unwrap(), hanging());
    let done = call(&["relax", &scene, "--overwrite"]);
    assert_eq!((done.exit, done.out.as_str()), (Exit::Refused, ""));
    let done = call(&["relax", &scene, "--out", "-"]);
    assert!(done.exit == Exit::Done && done.out.contains("[start.m0]"), "{}", done.out);
}

/// Of a body whose axes are not the principal ones `start` is in the axes of its table.
#[test]
fn a_start_is_in_the_axes_that_the_body_is_written_in() {
    let text = "name = \"s\"\nduration = 1\n[[body]]\nname = \"b\"\nmass = 1\nposition = [1, 2, 3]\n\
        inertia = [[2, 0.3, 0], [0.3, 3, 0.2], [0, 0.2, 4]]\norientation = { axis = [1, 2, 2], angle = 0.8 }\n\
        angular_velocity = [0.1, 0.2, 0.3]\n";
    let parse = |text: &str| Scene::parse(text, "s.toml");
    let plain = parse(text).unwrap().model.initial[0];
    let start = "[start.b]\norientation = { axis = [1, 2, 2], angle = 0.8 }\n";
    let started = parse(&format!("{text}{start}angular_velocity = [0.1, 0.2, 0.3]\n")).unwrap();
    assert_eq!(started.model.initial[0], plain);
    // Without its own it has no velocity; a position alone leaves the attitude.
    let moved =
        parse(&format!("{text}[start.b]\nposition = [0, 0, 1]\n")).unwrap().model.initial[0];
    assert_eq!(moved.orientation, plain.orientation);
    assert_eq!(
        (moved.position.to_f64(), moved.angular_velocity.to_f64()),
        ([0.0, 0.0, 1.0], [0.0; 3])
    );
    for (wrong, said) in [
        ("[start.c]\n", "`c` of [start] is not a body of the scene"),
        ("[start.b]\nplace = [0, 0, 1]\n", "[start.b] has no key `place`"),
        ("[start.b]\nposition = 1\n", "`position` of [start.b]"),
    ] {
        let error = parse(&format!("{text}{wrong}")).unwrap_err();
        assert!(error.message().contains(said), "{}", error.message());
    }
}
