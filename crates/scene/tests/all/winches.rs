//! Inputs of the type `free_length`: the law that they stand for, the value at t = 0, what is refused.

use dbd_kernel::{Leapfrog, Plant};
use dbd_scene::Scene;

fn scene(more: &str) -> Result<Scene, String> {
    let text = format!(
        r#"
name = "winch"
duration = 1
[[body]]
name = "b"
mass = 1
inertia = [0.01, 0.01, 0.01]
position = [0, 0, 0]
[[joint]]
name = "pivot"
type = "revolute"
between = ["world", "b"]
at = [1, 0, 0]
axis = [0, 0, 1]
span = 0.1
stiffness = 1e6
[[tsda]]
name = "plain"
between = ["world", "b"]
points = [[0, 3, 0], [0, 0, 0]]
stiffness = 10
free_length = 1
{more}
"#
    );
    Scene::parse(&text, "winch.toml").map_err(|error| format!("{:?}", miette::Report::new(error)))
}

fn tsda(name: &str, keys: &str) -> String {
    format!(
        "[[tsda]]\nname = \"{name}\"\nbetween = [\"b\", \"world\"]\npoints = [[0, 0.1, 0], [0, 2, 0]]\n\
         stiffness = 100\ndamping = 3\n{keys}\n"
    )
}

fn input(target: &str, keys: &str) -> String {
    format!("[[input]]\nname = \"winch\"\ntype = \"free_length\"\ntarget = \"{target}\"\n{keys}\n")
}

#[test]
fn a_driven_tsda_is_the_interaction_of_its_name() {
    let more = tsda("rope", "acts = \"tension\"") + &input("rope", "value = 1.5");
    let keyed = scene(&more).unwrap();
    let info = &keyed.inputs[0];
    assert_eq!((info.name.as_str(), info.kind, info.unit), ("winch", "free_length", "m"));
    assert_eq!(info.range, [0.0, f64::INFINITY]);
    let law = &dbd_scene::interactions(&keyed)[0];
    assert_eq!((law.law, law.name()), ("distance-winch", Some("rope")));
    assert!(law.bodies[0].is_world());
    assert_eq!(keyed.raw_names(), ["tsda `plain` (world–b)"]);
    let listed = scene(
        "[[input]]\nname = \"u\"\ntype = \"signal\"\nvalue = 1.5\n[[interaction]]\nlaw = \"distance-winch\"\n\
         between = [\"world\", \"b\"]\npoints = [[0, 2, 0], [0, 0.1, 0]]\ninput = \"u\"\nstiffness = 100\n\
         damping = 3\npushes = 0",
    )
    .unwrap();
    let state = |scene: &Scene| {
        let mut plant = Plant::new(&scene.model, Leapfrog, 1e-3).unwrap();
        for _ in 0..100 {
            let _ = plant.step();
        }
        plant.state().hash()
    };
    assert_eq!(state(&keyed), state(&listed));
    // Its long form is the same scene, also in a plane.
    for planar in ["", "planar = true\n"] {
        let text = format!(
            "name = \"w\"\nduration = 1\n{planar}[[body]]\nname = \"b\"\nmass = 1\n\
             inertia = [0.01, 0.01, 0.01]\nposition = [0, 0, 0]\n{}{}",
            tsda(
                "rope",
                "acts = \"compression\"\nfree_length = \"initial\"\nlimits = { to = 3, stiffness = 10 }"
            ),
            input("rope", "range = [\"1 cm\", 3]")
        );
        let long = Scene::long_form(&text, "w.toml", &[""; 0]).unwrap();
        let [own, of_long] = [&text, &long].map(|text| Scene::parse(text, "w.toml").unwrap());
        assert_eq!(state(&own), state(&of_long), "{long}");
        let names: Vec<_> = dbd_scene::interactions(&own).iter().map(|law| law.law).collect();
        assert_eq!(names, ["distance-stop", "distance-winch"]);
    }
}

/// The model has the value at t = 0 before its first step.
#[test]
fn a_free_length_starts_with_its_drive() {
    for (rope, keys, value) in [
        ("free_length = 1.25", "", 1.25),
        ("free_length = \"initial\"", "", 1.9),
        ("", "value = \"1.5 m\"", 1.5),
        ("", "table = [[-1, 1], [1, 2]]", 1.0),
        ("", "table = [[-1, 1], [1, 2]]\ninterpolate = \"linear\"", 1.5),
        ("", "table = [[0.5, 1], [1, 2]]\ninterpolate = \"linear\"", 1.0),
        (
            "",
            "table = [[0.5, 1], [1, 2], [1.5, 1]]\ninterpolate = \"linear\"\nperiodic = true",
            2.0,
        ),
        (
            "",
            "table = [[0.25, 1], [0.75, 2], [1.25, 1]]\ninterpolate = \"linear\"\nperiodic = true",
            1.5,
        ),
        ("", "sine = { amplitude = 0.5, frequency = 2, phase = \"90 deg\", offset = 1 }", 1.5),
    ] {
        let scene = scene(&(tsda("rope", rope) + &input("rope", keys))).unwrap();
        assert!((scene.model.inputs[0].value - value).abs() < 1e-12, "{keys}");
    }
}

#[test]
fn what_is_no_free_length_is_refused() {
    let rope = |keys: &str| tsda("rope", keys);
    let start = "value = 1";
    let over = "table = [[0, 1], [1, -1]]\nover = \"p.y\"\n[[readout]]\nname = \"p\"\ntype = \"point\"\nbody = \"b\"";
    for (text, parts) in [
        (rope("free_length = 1") + &input("rode", start), ["names nothing", "the name of a tsda"]),
        (
            rope("free_length = 1") + &input("pivot", start),
            ["names the joint", "the name of a tsda"],
        ),
        (
            rope("") + &input("rope", start) + &input("rope", start).replace("winch", "other"),
            ["whose free length input `winch` sets", "one input only"],
        ),
        (rope("") + &input("rope", ""), ["has no value", "or `free_length` to tsda `rope`"]),
        (
            rope("free_length = 1") + &input("rope", start),
            ["contradicts the `value` of input `winch`", "remove one"],
        ),
        (rope(""), ["has no `free_length`, and no input sets it", "initial"]),
        (rope("free_length = 1\nacts = \"tension\""), ["`acts`", "distance-spring"]),
        (rope("acts = \"both\"") + &input("rope", start), ["`acts`", "compression"]),
        (rope("") + &input("rope", "value = -1"), ["-1.0 m", "≥ 0 in m"]),
        (rope("") + &input("rope", "table = [[0, 1], [1, -0.5]]"), ["-0.5 m", "≥ 0 in m"]),
        (
            rope("") + &input("rope", "sine = { amplitude = 2, frequency = 1, offset = 1 }"),
            ["-1.0 m", "≥ 0 in m"],
        ),
        (rope("") + &input("rope", over), ["-1.0 m", "≥ 0 in m"]),
        (
            rope("") + &input("rope", "value = 1\nrange = [-1, 2]"),
            ["negative free length", "lower"],
        ),
        (rope("") + &input("rope", "value = 1\nmode = 2"), ["has no key `mode`", "target"]),
        (
            rope("").replace("stiffness = 100", "stiffness = 0") + &input("rope", start),
            ["is not positive", "> 0"],
        ),
        (
            rope("").replace("[0, 2, 0]", "[0, 0.1, 0]") + &input("rope", start),
            ["coincide", "two different points"],
        ),
        (
            rope("")
                + &input("rope", start)
                + "[[input]]\nname = \"pull\"\ntype = \"actuator\"\ntarget = \"rope\"\n",
            ["names the driven tsda", "the name of a tsda"],
        ),
        (rope("") + &input("rope", start) + &rope("free_length = 1"), ["rope", "unique name"]),
    ] {
        let said = scene(&text).err().unwrap_or_default();
        let said_words = said.split_whitespace().collect::<Vec<_>>().join(" ");
        let flat = said_words.replace("│ ", "");
        assert!(parts.iter().all(|part| flat.contains(part)), "{text}: {said}");
    }
}
