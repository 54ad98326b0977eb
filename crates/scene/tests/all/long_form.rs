//! Scenes in their long form: the same bits, nothing to look up, comments kept.

use dbd_scene::Scene;

fn scene(text: &str) -> Scene {
    Scene::parse(text, "a.toml").unwrap_or_else(|error| panic!("{error}\n{}\n{text}", error.help()))
}

/// Writes a scene, reads it back and compares all that runs. Their bits, not their values: `{:?}` tells −0 from 0.
fn back(text: &str, changes: &[&str]) -> String {
    let before = Scene::parse_with(text, "a.toml", changes).unwrap();
    let written = Scene::long_form(text, "a.toml", changes).unwrap();
    let after = scene(&written);
    let shown = |scene: &Scene| {
        let Scene {
            name, description, duration, step, every, joints, inputs, readouts, model, ..
        } = scene;
        format!(
            "{name} {description} {duration:?} {step:?} {every:?}\n{joints:#?}\n{inputs:#?}\n{readouts:#?}\n{model:#?}"
        )
    };
    let (a, b) = (shown(&before), shown(&after));
    let gap = a.lines().zip(b.lines()).find(|(a, b)| a != b);
    assert!(a == b, "{gap:?}\n{written}");
    assert!(after.assembled.is_none() && after.changes.is_empty());
    // Of what is long already nothing changes.
    assert_eq!(Scene::long_form(&written, "a.toml", &[""; 0]).unwrap(), written);
    written
}

#[test]
fn every_scene_that_ships_reads_back_to_the_same_bits() {
    let folder = format!("{}/../../scenes", env!("CARGO_MANIFEST_DIR"));
    let mut files: Vec<_> = std::fs::read_dir(folder).unwrap().map(|f| f.unwrap().path()).collect();
    files.retain(|file| file.extension().is_some_and(|end| end == "toml"));
    files.sort();
    assert!(files.len() > 20);
    for file in files {
        let text = std::fs::read_to_string(&file).unwrap();
        let written = back(&text, &[]);
        // Comments and all.
        let comments = |text: &str| text.lines().filter(|line| line.contains('#')).count();
        assert_eq!(comments(&written), comments(&text), "{}:\n{written}", file.display());
    }
}

#[test]
fn sources_of_inputs_read_back() {
    let text = r#"
name = "pushed"
duration = 1
[parameters]
f = "12 Hz"
[[body]]
name = "b"
mass = 1
inertia = [1, 1, 1]
position = [0, 0, 0]
[[readout]]
name = "at"
type = "point"
body = "b"
[[input]]
name = "hum"
type = "force"
body = "b"
axis = [1, 0, 0]
sine = { amplitude = "2 kN", frequency = "2 * f", phase = "30 deg" }
[[input]]
name = "beat"
type = "force"
body = "b"
axis = [1, 0, 0]
table = [[0, 1], ["3 ms", 2], [1, "-1 N"]]
periodic = true
jump = true
[[input]]
name = "wind"
type = "force"
body = "b"
axis = [1, 0, 0]
over = "at.x"
table = [["-1 cm", 1], [1, 2]]
"#;
    let written = back(text, &["input.hum.sine.frequency=7"]);
    assert!(written.contains("over = \"at.x\"") && written.contains("frequency = 7"), "{written}");
}

/// What `[assemble]` moved, with velocities, spiders and what is given in the world beside it.
const ASSEMBLED: &str = r#"# Shafts that do not meet.

name = "shafts"
duration = "500 ms" # half a second
gravity = [0, 0, "-fall"]

[parameters]
fall = "9.81 m/s^2"
k = "1 MN/m"

[assemble]
rates = { drive = "10 rad/s", ram = { slide = 0.05 } }

# Turns in the world.
[[body]]
name = "in" # driven
mass = "500 g"
inertia = [1, 1, 1]
position = [0, 0.01, 0]

[[body]]
name = "out"
mass = 1
inertia = [1, 1, 1]
position = [1, 0, 0]
orientation = { axis = [1, 1, 0], angle = "3 deg" }

[[body]]
name = "rod"
mass = 1
inertia = [1, 1, 1]
position = [3, 0, 0]
orientation = { quaternion = [1, 0.1, 0.2, 0.3] }

[[joint]]
name = "drive"
type = "revolute"
between = ["world", "in"]
at = { first = [0, 0, 0], second = [0, 0.02, 0] }
axis = [1, 0, 0]
stiffness = "k"
span = "10 cm"

# Between them.
[[joint]]
name = "cross"
type = "universal"
between = ["in", "out"]
at = [0.5, 0, 0]
axes = [[0, 0.8, 0.6], [0.5, -0.6, 0.8]]
stiffness = "k"
span = 0.1
reference = [0.3, 1, -2]
spider = { mass = 1, inertia = [1, 1, 1] }

[[joint]]
name = "bearing"
type = "spherical"
between = ["rod", "out"]
at = { first = [2, 0.1, 0], second = [2, 0.05, 0.1] }
stiffness = { load = "10 N", deflection = 1e-5 }
arm = 0.1

[[joint]]
name = "ram"
type = "cylindrical"
between = ["world", "rod"]
at = { first = [3, 0.2, 0], second = [3.1, 0.2, 0.3] }
axis = { first = [0, 0.1, 1], second = [0.2, 0, 1] }
stiffness = 1e6
span = 0.1
offset = 0.05

[[tsda]]
between = ["out", "rod"]
points = [[0.1, 0, 0], [0, "5 mm", 0]]
stiffness = "2 * k / 3"
free_length = 0.2

[[torsion_spring]]
between = ["in", "out"]
axis = [1, 2, 3]
stiffness = 5

[[input]]
name = "motor"
type = "joint_torque"
target = "bearing"
axis = [3, 2, 1]
table = [["0 s", 0], ["10 ms", "2 N*m"]]

[[readout]]
name = "turn"
type = "joint_angle"
target = "cross"
about = "second"
"#;

#[test]
fn what_was_assembled_reads_back_to_the_same_bits() {
    let written = back(ASSEMBLED, &[]);
    for gone in ["assemble", "parameters", "first =", "deg", "mm", "\"k\""] {
        assert!(!written.contains(gone), "{gone}\n{written}");
    }
    for kept in [
        "# Shafts that do not meet.\n\nname = \"shafts\"\nduration = 0.5  # half a second\n",
        "# Turns in the world.\n[[body]]\nname = \"in\"  # driven\nmass = 0.5\n",
        "# Between them.\n[[joint]]\nname = \"cross\"\n",
        "inertia = [1, 1, 1], angular_velocity = [",
        "table = [[0.0, 0], [0.01, 2.0]]",
    ] {
        assert!(written.contains(kept), "{kept}\n{written}");
    }
}

#[test]
fn points_links_and_changes_are_resolved() {
    let text = include_str!("../../../../tests/authoring/four-bar.toml");
    let written = back(text, &[]);
    assert!(!written.contains("link") && !written.contains("points"), "{written}");
    let changed = back(text, &["joint.*.stiffness=9 kN/mm", "body.crank.mass=1500 g", "every=2ms"]);
    assert!(
        changed.contains("stiffness = 9000000.0") && changed.contains("mass = 1.5"),
        "{changed}"
    );
    let open = text
        .replace("to = \"A\",", "to = \"A\", length = 1.1,")
        .replace("duration = 0.5", "duration = 0.5\nassemble = { fixed = [\"rocker\"] }");
    back(&open, &[]);
}

/// Turns and axes in every direction: their last bits survive being brought to unit length.
#[test]
fn unit_lengths_keep_their_bits() {
    for i in 0..40_u32 {
        let x = |k: u32| f64::from((i * 7919 + k * 104_729) % 1999) / 1000.0 - 1.0;
        let text = ASSEMBLED
            .replace(
                "quaternion = [1, 0.1, 0.2, 0.3]",
                &format!("quaternion = [1, {:?}, {:?}, {:?}]", x(0), x(1), x(2)),
            )
            .replace("axis = [1, 2, 3]", &format!("axis = [2, {:?}, {:?}]", x(3), x(4)))
            .replace(
                "second = [0.2, 0, 1]",
                &format!("second = [{:?}, {:?}, 1]", 0.1 * x(5), 0.1 * x(6)),
            );
        back(&text, &[]);
    }
}

/// Of inputs and read-outs each takes the defaults of its own type alone.
#[test]
fn defaults_of_other_types_are_not_written() {
    let text = r#"
        name = "defaults"
        duration = 1
        defaults.input = { axis = [0, 0, 1], target = "spring", body = "bob", value = "2 N" }
        defaults.readout = { axis = [0, 0, 1], target = "spring", body = "bob", point = [0, 0, 0] }
        [[body]]
        name = "bob"
        mass = 1
        inertia = [1, 1, 1]
        position = [0, 0, 0]
        [[tsda]]
        name = "spring"
        between = ["world", "bob"]
        points = [[0, 1, 0], [0, 0, 0]]
        free_length = 1
        stiffness = 100
        [[input]]
        name = "push"
        type = "force"
        [[input]]
        name = "pull"
        type = "actuator"
        [[readout]]
        name = "tip"
        type = "point"
        [[readout]]
        name = "tension"
        type = "tsda_force"
    "#;
    let written = back(text, &[]);
    assert_eq!(written.matches("target = ").count(), 2, "{written}");
}
