//! Errors of geometry put into scenes that ship, and all that is said of each.
//!
//! That none is said of the scenes as they are stands in `warnings.rs`.

use std::path::Path;

use dbd_scene::{Scene, Severity};

/// The scene, what stands there, what stands there instead, and the warnings.
type Case = (&'static str, &'static str, &'static str, &'static [&'static str]);

#[rustfmt::skip]
const CASES: &[Case] = &[
    // 30 degrees, written as such.
    ("four-bar", "angle = -0.5235987755982989", "angle = -30",
        &["body `crank` (line 26): `angle` of its orientation is -30 rad, more than one \
           revolution: -30 deg would be -0.5236 rad"]),
    ("four-bar", "{ axis = [0, 0, 1], angle = -0.5235987755982989 }", "{ euler_321 = [-0.5235987755982989, 0, 180] }",
        &["body `crank` (line 26): `euler_321` of its orientation is 180 rad, more than one \
           revolution: 180 deg would be 3.14 rad"]),
    // A pin 5 cm off the end of its rod.
    ("crank-slider", "at = [0.0, 0.05, 0.0]", "at = [0.0, 0.1, 0.0]",
        &["joint `crank pin` (line 52): lies 0.1029 m from the centre of mass of `rod`, 1.7 times \
           the extent that its mass and inertia imply; check the body and `at`"]),
    // The rocker's pin on the crank instead of the coupler.
    ("four-bar", "between = [\"coupler\", \"rocker\"]", "between = [\"crank\", \"rocker\"]",
        &["body `crank` (line 21): is locked: the joints leave it no degree of freedom at the \
           initial pose, and `rocker` cannot move either; check their bodies, types and axes",
          "joint `B` (line 60): lies 4.41 m from the centre of mass of `crank`, 10.06 times the \
           extent that its mass and inertia imply; check the body and `at`"]),
    // An axis across those of the others: the linkage cannot move.
    ("four-bar", "at = [4.193375245281536, 2.401922307076307, 0.0]\naxis = [0, 0, 1]", "at = [4.193375245281536, 2.401922307076307, 0.0]\naxis = [1, 0, 0]",
        &["body `crank` (line 21): is locked: the joints leave it no degree of freedom at the \
           initial pose, and `coupler`, `rocker` cannot move either; check their bodies, types and \
           axes"]),
    // A stiffness in N/mm that was multiplied by 1000 twice.
    ("four-bar", "at = [0.5, 0.8660254037844386, 0.0]\naxis = [0, 0, 1]\nstiffness = 9e6", "at = [0.5, 0.8660254037844386, 0.0]\naxis = [0, 0, 1]\nstiffness = 9e9",
        &["joint `A` (line 51): vibrates at 5.71e4 Hz, 39.32 times the median of the joints, and \
           alone limits the step size; check that its stiffness is in N/m and its bodies' masses \
           in kg"]),
];

fn warnings(text: &str) -> Vec<String> {
    let scene = Scene::parse(text, "scene.toml").unwrap_or_else(|error| panic!("{error}"));
    let warnings = dbd_scene::warnings(&scene).into_iter();
    warnings.filter(|w| w.severity == Severity::Warning).map(|w| w.to_string()).collect()
}

#[test]
fn each_error_is_warned_of_and_nothing_else() {
    let mut failures = String::new();
    for (name, from, to, said) in CASES {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes").join(name);
        let text = std::fs::read_to_string(path.with_extension("toml")).unwrap();
        assert_eq!(text.matches(from).count(), 1, "{from:?} occurs once in {name}");
        let found = warnings(&text.replacen(from, to, 1));
        if found != *said {
            failures += &format!("{name}: {to:?}\n  expected {said:#?}\n  found {found:#?}\n");
        }
    }
    assert!(failures.is_empty(), "{failures}");
}

/// What is meant is not warned of: a bob on a rod without mass, a mount of two joints, a truss whose
/// joints are softer by far than the others.
#[test]
fn what_may_well_be_meant_is_not_warned_of() {
    let body = |name: &str, x: f64, inertia: f64| {
        format!(
            "[[body]]\nname = \"{name}\"\nmass = 1\ninertia = [{inertia}, {inertia}, {inertia}]\n\
             position = [{x}, 0, 0]\n"
        )
    };
    let joint = |name: &str, kind: &str, between: [&str; 2], x: f64, rest: &str| {
        format!(
            "[[joint]]\nname = \"{name}\"\ntype = \"{kind}\"\nbetween = {between:?}\nat = [{x}, 0, 0]\n{rest}\n"
        )
    };
    let ball = "stiffness = 1e5\narm = 0.02";
    let hinge = |axis: &str| format!("stiffness = 1e5\nspan = 0.05\naxis = {axis}");
    let bobs = [
        body("upper", 0.5, 4e-4),
        body("lower", 1.0, 4e-4),
        joint("pivot", "spherical", ["world", "upper"], 0.0, ball),
        joint("middle", "spherical", ["upper", "lower"], 0.5, ball),
    ];
    let mount = [
        body("plate", 0.5, 0.1),
        joint("left", "revolute", ["world", "plate"], 0.2, &hinge("[0, 1, 0]")),
        joint("right", "spherical", ["world", "plate"], 0.8, ball),
    ];
    for elements in [bobs.concat(), mount.concat()] {
        let text = format!("name = \"meant\"\nduration = 1\n{elements}");
        assert_eq!(warnings(&text), [""; 0], "{text}");
    }
}
