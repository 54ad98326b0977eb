//! Freedoms of mechanisms: redundant loops, singular poses, joints in centres of mass.

use std::path::Path;

use dbd_scene::{Facts, Scene};

/// Freedoms of the mechanisms that ship; none of them is at a singular pose, and none is locked.
#[test]
fn constraints_that_loops_imply_count_once() {
    for (name, freedoms) in [
        ("four-bar", 1),
        ("five-bar-a", 2),
        ("3rrr", 3),
        ("3rrr-1", 2),
        ("3rrr-2", 1),
        ("3ruu", 3),
        ("crank-slider", 1),
        ("chain-closed", 8),
        ("delta-pick-and-place", 3),
        // Bounce, and the tie rod about its own axis.
        ("double-wishbone", 2),
        ("hanging-chain", 60),
        ("gyroscope", 3),
        ("spring-ball", 6),
        ("six-bar", 3),
        ("hexagon", 3),
        ("chain-open-60", 10),
        ("three-systems", 7),
    ] {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes").join(name);
        let facts = dbd_scene::facts(&Scene::load(path.with_extension("toml")).unwrap());
        assert_eq!(counts(&facts), [freedoms; 2], "{name}");
        assert_eq!(facts.locked, [0; 0], "{name}");
    }
}

fn counts(facts: &Facts) -> [usize; 2] {
    [facts.freedoms, facts.first_order_freedoms].map(Option::unwrap)
}

/// Bodies `a`, `b`, … at places, turned by 30° about x so that nothing lies along an axis by chance, and joints.
fn mechanism(places: &[[f64; 3]], joints: &[(&str, [&str; 2], [f64; 3])]) -> Facts {
    let mut text = "name = \"m\"\nduration = 1\n".to_owned();
    for (name, place) in ["a", "b", "c", "d"].into_iter().zip(places) {
        text += &format!(
            "[[body]]\nname = \"{name}\"\nmass = 1\ninertia = [0.1, 0.2, 0.15]\nposition = {place:?}\n\
             orientation = {{ axis = [1, 0, 0], angle = \"30 deg\" }}\n"
        );
    }
    for (number, (joint, between, at)) in joints.iter().enumerate() {
        text += &format!(
            "[[joint]]\nname = \"j{number}\"\nbetween = {between:?}\nat = {at:?}\nstiffness = 1e6\n{joint}\n"
        );
    }
    dbd_scene::facts(
        &Scene::parse(&text, "m.toml").unwrap_or_else(|error| panic!("{error}\n{text}")),
    )
}

const HINGE: &str = "type = \"revolute\"\naxis = [0, 0, 1]\nspan = 0.1";
const BALL: &str = "type = \"spherical\"\narm = 0.05";

fn slide(axis: &str) -> String {
    format!("type = \"translational\"\nspan = 0.1\ngauge = 0.1\noffset = 0.01\naxis = {axis}")
}

/// An engine at top dead centre: the piston rests to first order and is not locked.
#[test]
fn at_a_dead_centre_nothing_is_locked() {
    let along = slide("[1, 0, 0]");
    for crank in [0.5, 0.05, 0.9] {
        let facts = mechanism(
            &[[0.5 * crank, 0.0, 0.0], [0.5 + 0.5 * crank, 0.0, 0.0], [1.0, 0.0, 0.0]],
            &[
                (HINGE, ["world", "a"], [0.0; 3]),
                (HINGE, ["a", "b"], [crank, 0.0, 0.0]),
                (HINGE, ["b", "c"], [1.0, 0.0, 0.0]),
                (&along, ["world", "c"], [1.0, 0.0, 0.0]),
            ],
        );
        assert_eq!(counts(&facts), [1, 1], "{crank}");
        assert_eq!(facts.locked, [0; 0], "{crank}");
    }
}

/// A stretched arch of two rods between two pins moves to first order only; turning in the plane of its pins it is a
/// truss. The same with balls, whose rods turn about themselves.
#[test]
fn what_moves_to_first_order_only_is_no_freedom() {
    for (joint, freedoms, first) in [(HINGE, 0, 1), (BALL, 2, 4)] {
        let facts = mechanism(
            &[[0.5, 0.0, 0.0], [1.5, 0.0, 0.0]],
            &[
                (joint, ["world", "a"], [0.0; 3]),
                (joint, ["a", "b"], [1.0, 0.0, 0.0]),
                (joint, ["world", "b"], [2.0, 0.0, 0.0]),
            ],
        );
        assert_eq!(counts(&facts), [freedoms, first], "{joint}");
    }
}

/// A parallelogram that lies flat: two branches of one freedom cross there.
#[test]
fn where_branches_cross_a_branch_counts() {
    let facts = mechanism(
        &[[0.25, 0.0, 0.0], [1.0, 0.0, 0.0], [1.25, 0.0, 0.0]],
        &[
            (HINGE, ["world", "a"], [0.0; 3]),
            (HINGE, ["a", "b"], [0.5, 0.0, 0.0]),
            (HINGE, ["b", "c"], [1.5, 0.0, 0.0]),
            (HINGE, ["world", "c"], [1.0, 0.0, 0.0]),
        ],
    );
    assert_eq!(counts(&facts), [1, 2]);
    assert_eq!(facts.locked, [0; 0]);
}

/// Two sliders on parallel rails, as far apart as the rod between them is long: it may tilt by an infinitesimal, at every
/// pose, and the pair moves as one.
#[test]
fn a_freedom_of_first_order_at_every_pose_is_none() {
    let up = slide("[0, 1, 0]");
    let facts = mechanism(
        &[[0.0; 3], [1.0, 0.0, 0.0], [0.5, 0.0, 0.0]],
        &[
            (&up, ["world", "a"], [0.0; 3]),
            (&up, ["world", "b"], [1.0, 0.0, 0.0]),
            (HINGE, ["a", "c"], [0.0; 3]),
            (HINGE, ["b", "c"], [1.0, 0.0, 0.0]),
        ],
    );
    assert_eq!(counts(&facts), [1, 2]);
    assert_eq!(facts.locked, [0; 0]);
}

/// A wheel, a train of wheels, a gimbal: every joint lies in the centres of its bodies.
#[test]
fn joints_in_centres_of_mass_hold_what_they_hold() {
    let tilted = "type = \"revolute\"\naxis = [0.3, 0.5, -0.2]\nspan = 0.1";
    let universal = "type = \"universal\"\naxes = [[1, 0, 0], [0, 1, 0]]\nspan = 0.1\nrealisation = \"bushing\"";
    for (joints, freedoms) in [
        (&[(HINGE, ["world", "a"])][..], 1),
        (&[(tilted, ["world", "a"])], 1),
        (&[(BALL, ["world", "a"])], 3),
        (&[(universal, ["world", "a"])], 2),
        (&[("type = \"fixed\"\naxis = [0, 0, 1]\nspan = 0.1\narm = 0.1", ["world", "a"])], 0),
        (&[(HINGE, ["world", "a"]), (tilted, ["a", "b"])], 2),
        (&[(HINGE, ["world", "a"]), (HINGE, ["world", "b"]), (HINGE, ["a", "b"])], 2),
    ] {
        let bodies = if joints.len() > 1 { 2 } else { 1 };
        let at = |(joint, between): &(&'static str, [&'static str; 2])| {
            (*joint, *between, [0.25, 0.5, 0.0])
        };
        let joints: Vec<_> = joints.iter().map(at).collect();
        let facts = mechanism(&vec![[0.25, 0.5, 0.0]; bodies], &joints);
        assert_eq!(counts(&facts), [freedoms; 2], "{joints:?}");
        assert_eq!(facts.locked, [0; 0], "{joints:?}");
    }
}
