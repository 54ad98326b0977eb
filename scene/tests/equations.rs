//! Counts of freedoms and equations beside the paper's, and what the facts say of a joint.

use std::path::Path;

use dbd_scene::Scene;

fn scene(name: &str) -> Scene {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes");
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
        let facts = scene(name).facts();
        assert_eq!((facts.constraint_equations, facts.equations), (constraint, dbd), "{name}");
        // What is left when nothing is held twice is what the mechanism can do.
        let mobility = facts.degrees_of_freedom + 3 * facts.planar_loops as i64;
        assert_eq!(mobility, freedoms, "{name}");
    }
}

/// Five-bar and six-bar have one loop, the open chains none, the crank-slider is spatial: its
/// revolute, spherical, universal and translational joint hold nothing twice.
#[test]
fn loops_are_counted_where_they_are_planar() {
    for (name, loops, freedoms) in [
        ("six-bar", 1, 0),
        ("hexagon", 1, 0),
        ("chain-open-60", 0, 10),
        ("chain-closed", 1, 5),
        ("crank-slider", 0, 1),
        ("3ruu", 0, 3),
        ("three-systems", 2, 1),
    ] {
        let facts = scene(name).facts();
        assert_eq!((facts.planar_loops, facts.degrees_of_freedom), (loops, freedoms), "{name}");
    }
}

/// Two bodies, three revolutes and a joint of `kind` that closes the loop; z is out of plane.
fn closed_by(joint: &str) -> Scene {
    let mut text = "name = \"loop\"\nduration = 1\n".to_owned();
    for (name, x) in [("a", 0.5), ("b", 1.5), ("c", 2.0)] {
        text += &format!(
            "[[body]]\nname = \"{name}\"\nmass = 1\ninertia = [0.1, 0.1, 0.1]\nposition = [{x}, 0, 0]\n"
        );
    }
    for (i, (between, x)) in
        [("\"world\", \"a\"", 0), ("\"a\", \"b\"", 1), ("\"b\", \"c\"", 2)].into_iter().enumerate()
    {
        text += &format!(
            "[[joint]]\nname = \"r{i}\"\ntype = \"revolute\"\nbetween = [{between}]\nat = [{x}, 0, 0]\n\
             axis = [0, 0, {sign}]\nstiffness = 1\nspan = 0.1\n",
            sign = if i == 1 { -1 } else { 1 }
        );
    }
    text += &format!(
        "[[joint]]\nname = \"last\"\nbetween = [\"world\", \"c\"]\nat = [2, 0, 0]\nstiffness = 1\n{joint}"
    );
    Scene::parse(&text, "loop.toml").unwrap_or_else(|error| panic!("{error}"))
}

#[test]
fn a_slide_in_the_plane_closes_a_planar_loop_and_one_across_it_does_not() {
    let slide = "type = \"translational\"\nspan = 0.1\ngauge = 0.1\noffset = 0.01\n";
    for (joint, loops) in [
        (format!("{slide}axis = [1, 2, 0]"), 1),
        (format!("{slide}axis = [0, 0, 1]"), 0),
        (format!("{slide}axis = [1, 0, 1]"), 0),
        ("type = \"revolute\"\naxis = [0, 0, -1]\nspan = 0.1".into(), 1),
        ("type = \"revolute\"\naxis = [0, 1e-3, 1]\nspan = 0.1".into(), 0),
        ("type = \"fixed\"\naxis = [0, 1, 1]\nspan = 0.1\narm = 0.1".into(), 1),
        ("type = \"spherical\"\narm = 0.1".into(), 0),
        ("type = \"cylindrical\"\naxis = [0, 0, 1]\nspan = 0.1\noffset = 0.01".into(), 0),
    ] {
        assert_eq!(closed_by(&joint).facts().planar_loops, loops, "{joint}");
    }
}

#[test]
fn a_joints_lengths_and_rates_are_told() {
    let scene = scene("crank-slider");
    let facts = scene.facts();
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
        Scene::parse(&text, "c.toml").unwrap().facts().joints[0].stretching_rate
    };
    assert!(rate("[0, 0, 3]", "[0, 0, 5]") < 1e-14);
    assert!((rate("[0, 2, 0]", "[0, 0, 5]") - 2.0).abs() < 1e-14);
    // The far end is 0.5 m from the centre of mass.
    assert!((rate("[0, 0, 0]", "[0, 1, 0]") - 0.5).abs() < 1e-14);
}
