//! `settle = true` and `--settle`: the scene starts at rest, held against closed forms and against runs.

use std::path::Path;

use dbd_plant::{Method, plant};
use dbd_scene::Scene;
use host_sim::terminal::Exit;

use crate::{Folder, call};

fn shipped(name: &str, changes: &[&str]) -> Result<Scene, String> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap();
    let text = std::fs::read_to_string(root.join(format!("scenes/{name}.toml"))).unwrap();
    let changes: Vec<String> = changes.iter().map(|change| (*change).to_owned()).collect();
    Scene::parse_with(&text, name, &changes).map_err(|error| error.message())
}

fn parsed(elements: &str) -> Result<Scene, String> {
    let text = format!(
        "name = \"s\"\nduration = 1\nstep = 1e-4\nsettle = true\ngravity = [0, -9.81, 0]\n{elements}"
    );
    Scene::parse(&text, "s.toml").map_err(|error| format!("{} ({})", error.message(), error.help()))
}

/// \[m/s\] the fastest speed of a centre of mass over some steps.
fn fastest(scene: &Scene, step: f64, steps: u64) -> f64 {
    let mut plant = plant(scene, &Method::default(), step).unwrap();
    let mut most = 0.0_f64;
    for _ in 0..steps {
        plant.advance(1).unwrap();
        for body in &plant.state().bodies {
            most = most.max(body.velocity.dot(body.velocity).sqrt());
        }
    }
    most
}

const PENDULUM: &str = "[[body]]\nname = \"arm\"\nmass = 2\ninertia = [0.1, 0.01, 0.1]\nposition = [X, Y, 0]\n\
    orientation = { axis = [0, 0, 1], angle = \"A deg\" }\n[[joint]]\nname = \"pin\"\ntype = \"revolute\"\n\
    between = [\"world\", \"arm\"]\nat = [0, 0, 0]\naxis = [0, 0, 1]\nstiffness = 1e6\nspan = 0.1\n";

/// A pendulum of 0.5 m that is written at an angle from hanging.
fn pendulum(degrees: f64, more: &str) -> Result<Scene, String> {
    let (sine, cosine) = degrees.to_radians().sin_cos();
    let text = PENDULUM.replace('X', &format!("{:?}", 0.5 * sine));
    let text = text
        .replace('Y', &format!("{:?}", -0.5 * cosine))
        .replace("A deg", &format!("{degrees:?} deg"));
    parsed(&format!("{text}{more}"))
}

#[test]
fn a_mass_hangs_from_its_spring_by_its_weight_over_the_stiffness() {
    for stiffness in ["3e2", "3e9"] {
        let scene = parsed(&format!(
            "[[body]]\nname = \"b\"\nmass = 2\ninertia = [1, 1, 1]\nposition = [0, 0, 0]\n[[tsda]]\nname = \"spring\"\n\
             between = [\"world\", \"b\"]\npoints = [[0, 1, 0], [0, 0, 0]]\nfree_length = 1\nstiffness = {stiffness}\n"
        ));
        let scene = scene.unwrap();
        let sag = 2.0 * 9.81 / stiffness.parse::<f64>().unwrap();
        let found = -scene.model.initial[0].position.y;
        assert!((found - sag).abs() < 1e-12 + 1e-9 * sag, "{found:e} {sag:e}");
    }
}

#[test]
fn a_pendulum_hangs_down_from_any_angle() {
    for degrees in [1.0, 60.0, -90.0, 135.0, 179.0] {
        let scene = pendulum(degrees, "").unwrap();
        let position = scene.model.initial[0].position;
        assert!(
            position.x.abs() < 1e-9 && (position.y + 0.5).abs() < 1e-4,
            "{degrees}: {position:?}"
        );
        // 6e6 N/m under 20 N: what is left is rounding.
        assert!(fastest(&scene, 1e-5, 2000) < 1e-8, "{degrees}");
    }
}

#[test]
fn loads_that_act_at_the_start_count() {
    let load = "[[load]]\nbody = \"arm\"\nforce = [19.62, 0, 0]\n";
    let position = pendulum(30.0, load).unwrap().model.initial[0].position;
    assert!((position.x + position.y).abs() < 1e-5, "{position:?}");
    let later = format!("{load}from = 0.5\n");
    assert!(pendulum(30.0, &later).unwrap().model.initial[0].position.x.abs() < 1e-9);
}

/// Shipped scenes rest, or say what does not.
#[test]
fn shipped_scenes_rest() {
    for name in ["double-wishbone", "gripper", "hanging-chain", "3ruu", "macpherson"] {
        let step = shipped(name, &[]).unwrap().step.unwrap();
        let [rest, written] = [&["settle=true"][..], &[]].map(|changes| {
            // Loads that begin later do not act yet.
            fastest(&shipped(name, changes).unwrap(), step, 20)
        });
        assert!(rest < 1e-3 * written, "{name}: {rest:e} m/s, as written {written:e} m/s");
    }
}

#[test]
fn a_planar_scene_rests_in_its_plane_as_in_space() {
    let [space, plane] =
        ["planar=false", "planar=true"].map(|planar| shipped("six-bar", &["settle=true", planar]));
    let (space, plane) = (space.unwrap(), plane.unwrap());
    for (space, plane) in space.model.initial.iter().zip(&plane.model.initial) {
        let apart = space.position - plane.position;
        assert!(apart.dot(apart) < 1e-6, "{space:?} {plane:?}");
    }
    for scene in [space, plane] {
        let speed = fastest(&scene, 1e-6, 20);
        assert!(speed < 1e-7, "{speed:e}");
    }
}

/// The crank of the four-bar is turned, the other links follow and the joints stay closed.
#[test]
fn joints_start_at_the_angles_that_are_asked_for() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap();
    let text = std::fs::read_to_string(root.join("scenes/four-bar.toml")).unwrap();
    let parse = |angles: &str| {
        let text = format!("{text}\n[assemble]\nangles = {{ {angles} }}\n");
        Scene::parse(&text, "four-bar.toml").map_err(|e| format!("{} ({})", e.message(), e.help()))
    };
    let plain = Scene::parse(&text, "four-bar.toml").unwrap();
    for degrees in [0.0, 7.5, -20.0] {
        let scene = parse(&format!("A0 = \"{degrees:?} deg\"")).unwrap();
        let [now, before] = [&scene, &plain].map(|scene| scene.model.initial[0].orientation);
        let turn = now.product(before.conjugate());
        let found = 2.0 * turn.v.z.atan2(turn.w).to_degrees();
        assert!((found - degrees).abs() < 1e-9, "{degrees} {found}");
        let assembled = scene.assembled.unwrap();
        // The joints' own freedom, which the angle does not take.
        assert_eq!(assembled.freedoms, 1);
        assert!(assembled.left.unwrap().distance < 1e-9);
    }
    let said = parse("nobody = 1").unwrap_err();
    assert!(said.contains("is not a joint") && said.contains("`angles`"), "{said}");
    let said = parse("A0 = \"3 m\"").unwrap_err();
    assert!(said.contains("rad"), "{said}");
}

#[test]
fn what_cannot_rest_is_refused_with_its_reason() {
    let free = "[[body]]\nname = \"ball\"\nmass = 1\ninertia = [1, 1, 1]\nposition = [0, 0, 0]\n";
    let said = parsed(free).unwrap_err();
    assert!(said.contains("finds no pose at which `ball` is at rest"), "{said}");
    let said = parsed(&format!("{free}velocity = [0, 0, 1]\n")).unwrap_err();
    assert!(said.contains("`ball` to rest, which has an initial velocity"), "{said}");
}

#[test]
fn the_option_settles_and_says_so() {
    let folder = Folder::new();
    let done = call(&["check", "double-wishbone", "--settle"]);
    assert_eq!(done.exit, Exit::Done, "{}", done.err);
    assert!(done.out.contains("settled") && done.out.contains(" steps)"), "{}", done.out);
    let summary = folder.summary("double-wishbone", &["--settle", "--duration", "5ms"]);
    assert!(summary["settled"].as_str().unwrap().contains(" m and "), "{summary}");
    assert_eq!(summary["set"][0]["path"].as_str(), Some("settle"));
}
