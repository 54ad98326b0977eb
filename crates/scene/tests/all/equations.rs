//! Counts of freedoms and equations beside the paper's, and what the facts say of a joint.

use std::path::Path;

use dbd_scene::Scene;

fn scene(name: &str) -> Scene {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes");
    Scene::load(path.join(name).with_extension("toml")).unwrap_or_else(|error| panic!("{error}"))
}

/// Franco & Degani 2026, Table 7a: equations of the constraint solver and of DBD, and how many
/// freedoms the mechanism has.
#[test]
fn equations_are_those_of_table_7a() {
    for (name, constraint, dbd, freedoms) in [
        ("four-bar", 35, 18, 1),
        ("five-bar-a", 46, 24, 2),
        ("five-bar-b", 46, 24, 2),
        ("3rrr-2", 59, 30, 1),
        ("3rrr-1", 70, 36, 2),
        ("3rrr", 81, 42, 3),
        ("3ruu-2", 131, 66, 1),
        ("3ruu-1", 142, 72, 2),
        ("3ruu", 153, 78, 3),
        ("two-3ruu", 306, 156, 6),
        ("three-systems", 365, 186, 7),
    ] {
        let facts = dbd_scene::facts(&scene(name));
        assert_eq!((facts.constraint_equations, facts.equations), (constraint, dbd), "{name}");
        assert_eq!(facts.freedoms, Some(freedoms), "{name}");
    }
}

#[test]
fn a_joints_lengths_and_rates_are_told() {
    let scene = scene("crank-slider");
    let facts = dbd_scene::facts(&scene);
    for (joint, facts) in scene.joints.iter().zip(&facts.joints) {
        let [shortest, longest] = facts.initial_length;
        assert!(shortest > 0.0 && longest - shortest < 1e-15, "{}", joint.name);
        assert!((longest - facts.free_length).abs() < 1e-15, "{}", joint.name);
        assert_eq!((facts.assembly_error, facts.stretching_rate), (joint.assembly_error, 0.0));
    }
    assert_eq!(facts.joints[3].free_length, 0.01);
    assert_eq!(facts.islands.len(), 1);
    assert!(facts.islands[0].grounded && facts.islands[0].bodies == [0, 1, 2, 3]);
}

/// Turning about its axis and sliding along it, a cylindrical joint is not pulled at; moving
/// across, it is, by the speed.
#[test]
fn velocities_along_what_is_free_pull_at_nothing() {
    let rate = |velocity: &str, spin: &str| {
        let text = format!(
            "name = \"c\"\nduration = 1\n[[body]]\nname = \"b\"\nmass = 1\ninertia = [1, 1, 1]\n\
             position = [0, 0, 0.4]\nvelocity = {velocity}\nangular_velocity = {spin}\n[[joint]]\n\
             name = \"c\"\ntype = \"cylindrical\"\nbetween = [\"world\", \"b\"]\nat = [0, 0, 0]\n\
             axis = [0, 0, 1]\nstiffness = 1\nspan = 0.2\noffset = 0.1"
        );
        dbd_scene::facts(&Scene::parse(&text, "c.toml").unwrap()).joints[0].stretching_rate
    };
    assert!(rate("[0, 0, 3]", "[0, 0, 5]") < 1e-14);
    assert!((rate("[0, 2, 0]", "[0, 0, 5]") - 2.0).abs() < 1e-14);
    // The far end is 0.5 m from the centre of mass.
    assert!((rate("[0, 0, 0]", "[0, 1, 0]") - 0.5).abs() < 1e-14);
}
