//! What is said without running: `list`, `check`, `export`; and the step that `check` advises.

use host_sim::terminal::Exit;
use serde_json::Value;

use crate::{Folder, PENDULUM, call};

#[test]
fn list_shows_every_scene_on_a_line() {
    let done = call(&["list"]);
    assert_eq!((done.exit, done.err.as_str()), (Exit::Done, ""));
    let line = done.out.lines().find(|line| line.starts_with("four-bar ")).unwrap();
    for part in ["3 bodies", "24 TSDAs", "Four-bar linkage"] {
        assert!(line.contains(part), "{line}");
    }
    let done = call(&["list", "--json"]);
    let scenes: Vec<Value> = serde_json::from_str(&done.out).unwrap();
    let four_bar = scenes.iter().find(|scene| scene["name"] == "four-bar").unwrap();
    assert_eq!((&four_bar["bodies"], &four_bar["tsdas"]), (&3.into(), &24.into()));
}

#[test]
fn check_counts_and_warns_without_running() {
    let done = call(&["check", "four-bar", "--json"]);
    assert_eq!((done.exit, done.err.as_str()), (Exit::Done, ""));
    let check: Value = serde_json::from_str(&done.out).unwrap();
    assert_eq!((&check["bodies"], &check["tsdas"]), (&3.into(), &24.into()));
    assert_eq!(
        (&check["freedoms_by_rank"], &check["first_order_freedoms"]),
        (&1.into(), &1.into())
    );
    assert_eq!((&check["constraint_equations"], &check["equations"]), (&35.into(), &18.into()));
    assert_eq!(check["joints"].as_array().unwrap().len(), 4);
    assert_eq!(check["warnings"].as_array().unwrap().len(), 0);
    assert!(check["assembly_error"].as_f64().unwrap() < 1e-12);

    let folder = Folder::new();
    let text = PENDULUM.replace("duration = 0.5", "duration = 0.5\nstep = 0.05")
        + "\n[[body]]\nname = \"stone\"\nmass = 1\ninertia = [1, 1, 1]\nposition = [0, 5, 0]\n";
    let scene = folder.scene(&text);
    let done = call(&["check", &scene]);
    assert_eq!(done.exit, Exit::Done);
    for part in
        ["body `stone` (line ", "no element acts on it", "the scene's step of 50ms", "12; 12 with"]
    {
        assert!(done.out.contains(part), "{part}: {}", done.out);
    }
}

#[test]
fn check_finds_the_largest_stable_step_on_demand() {
    let arguments = ["check", "spring-ball", "--stability", "--scheme", "dbd", "--newton", "1"];
    let done = call(&[&arguments[..], &["--json"]].concat());
    let check: Value = serde_json::from_str(&done.out).unwrap();
    let stability = &check["stability"];
    let step = stability["largest_step"].as_f64().unwrap();
    assert!((step * 1e3_f64.sqrt() - 1.0).abs() < 0.02, "{stability}");
    assert_eq!((&stability["scheme"], &stability["newton"]), (&"dbd".into(), &1.into()));
    assert!(call(&arguments).out.contains("largest stable step"));
    // What tips out of the plane bears less than what stays in it.
    let planar = ["check", "cart-pendulum", "--planar", "--stability", "--scheme", "pefrl"];
    let check: Value =
        serde_json::from_str(&call(&[&planar[..], &["--json"]].concat()).out).unwrap();
    let [plane, space] = ["largest_step", "largest_step_in_space"]
        .map(|key| check["stability"][key].as_f64().unwrap());
    assert!(0.0 < space && space <= plane, "{space} {plane}");
    assert!(call(&planar).out.contains("stable in space") && !done.out.contains("in_space"));
    let without = call(&["check", "spring-ball", "--json"]).out;
    assert!(!without.contains("stability"));
    let refused = call(&["check", "spring-ball", "--scheme", "dbd"]);
    assert!(refused.err.contains("--stability") && refused.out.is_empty());
}

#[test]
fn check_says_what_the_initial_velocities_do_to_the_joints() {
    let folder = Folder::new();
    let text = r#"
name = "kicked"
duration = 0.1

[[body]]
name = "arm"
mass = 1
inertia = [0.1, 0.1, 0.1]
position = [1, 0, 0]
velocity = [0.5, 0, 0]

[[joint]]
name = "hinge"
type = "spherical"
between = ["world", "arm"]
at = [0, 0, 0]
stiffness = 1e5
arm = 0.03
"#;
    let done = call(&["check", &folder.scene(text), "--json"]);
    let check: Value = serde_json::from_str(&done.out).unwrap();
    let rate = check["joints"][0]["stretching_rate"].as_f64().unwrap();
    // At most the whole velocity, along the spring most nearly parallel to it.
    assert!(rate > 0.2 && rate <= 0.5, "{rate}");
    assert!(check["notes"][0].as_str().unwrap().contains("hinge"));
    let turning = text
        .replace("velocity = [0.5, 0, 0]", "velocity = [0, 2, 0]\nangular_velocity = [0, 0, 2]");
    let done = call(&["check", &folder.scene(&turning), "--json"]);
    let check: Value = serde_json::from_str(&done.out).unwrap();
    assert!(check["joints"][0]["stretching_rate"].as_f64().unwrap() < 1e-12);
}

#[test]
fn export_writes_the_bits_of_the_model() {
    let done = call(&["export", "four-bar", "--precision", "f32"]);
    assert_eq!(done.exit, Exit::Done);
    // 9 MN/m and the crank's mass of 1 kg in single precision.
    for part in [
        "pub type FourBarF32 = Model<F32, 3, 4, 20, 24,",
        "pub const FOUR_BAR_STEP: f64 = f64::from_bits(0x3ef4f8b588e368f1)",
        "stiffness: f32::from_bits(0x4b095440)",
        "mass: f32::from_bits(0x3f800000)",
    ] {
        assert!(done.out.contains(part), "{part}: {}", &done.out[..600]);
    }
    assert!(!done.out.contains("FOUR_BAR_F64"));
    assert!(call(&["export", "four-bar"]).out.contains("FOUR_BAR_F64"));
}

#[test]
fn stability_is_about_a_pose_at_rest() {
    let done = call(&["check", "spring-ball", "--stability"]);
    assert!(done.out.contains("without velocities"), "{}", done.out);
    // A square root that is off by per cents leaves no pose at rest.
    let done = call(&["check", "spring-ball", "--stability", "--precision", "f32-micromath"]);
    assert_eq!((done.exit, done.out.as_str()), (Exit::Refused, ""));
    for part in ["f32-micromath", "square root", "--precision f64"] {
        assert!(done.err.contains(part), "{part}: {}", done.err);
    }
}

/// A rotor on a soft spring off its axis, whose spin is much faster than its vibration.
const ROTOR: &str = r#"
name = "rotor"
duration = 10

[[body]]
name = "top"
mass = 1
inertia = [0.3, 0.5, 0.68]
position = [0, 0, 0]
angular_velocity = [3, 2, 55]

[[tsda]]
between = ["world", "top"]
points = [[1, 0, 0], [0.1, 0, 0]]
stiffness = 40
free_length = 0.9
"#;

#[test]
fn a_spin_limits_the_step() {
    let folder = Folder::new();
    let scene = folder.scene(ROTOR);
    let checked: Value = serde_json::from_str(&call(&["check", &scene, "--json"]).out).unwrap();
    let advised = checked["advised_step"].as_f64().unwrap();
    let spin = (3.0_f64 * 3.0 + 2.0 * 2.0 + 55.0 * 55.0).sqrt();
    assert!((advised * spin - 0.1).abs() < 1e-12, "{advised}");
    assert!(checked["frequency_bound_hz"].as_f64().unwrap() < 3.0);
    assert!(call(&["check", &scene]).out.contains("of the fastest body"));
    assert_eq!(checked["warnings"].as_array().unwrap().len(), 0);

    let loss = |options: &[&str]| {
        let summary = folder.summary(&scene, options);
        let [start, end] =
            ["energy_initial", "energy_final"].map(|key| summary[key].as_f64().unwrap());
        assert_eq!(summary["status"], "ok");
        (end - start).abs() / start
    };
    let (ours, long) = (loss(&[]), loss(&["--step", "16ms"]));
    assert!(ours < 1e-4 && long > 3.0 * ours, "{ours:e} {long:e}");
    let warned = |text: &str| text.contains("body `top` turns by 0.88 rad in a step of 16ms");
    let long = ["--step", "16ms"];
    assert!(warned(&folder.run(&scene, &long).out));
    assert!(warned(&folder.run(&scene, &[&long[..], &["--json"]].concat()).err));
    let quiet = folder.run(&scene, &[&long[..], &["--quiet"]].concat());
    assert_eq!((quiet.out.as_str(), quiet.err.as_str()), ("", ""));
    assert!(!warned(&folder.run(&scene, &[]).out));
    let given = folder.scene(&ROTOR.replace("duration = 10", "duration = 10\nstep = 0.016"));
    assert!(warned(&call(&["check", &given]).out));
}

/// A pendulum whose pivot lies a little off the end of its bar, spun by its joint.
const OPEN: &str = r#"
name = "open"
duration = 0.1
[assemble]
rates = { pivot = "2 rad/s" }
[[body]]
name = "bar" # one of oak
mass = "500 g"
inertia = [0.1, 0.1, 0.1]
position = [0.5, 0.01, 0]
[[joint]]
name = "pivot"
type = "revolute"
between = ["world", "bar"]
at = { first = [0, 0, 0], second = [0, 0.01, 0] }
axis = [0, 0, 1]
stiffness = 1e6
span = 0.1
"#;

#[test]
fn check_says_what_was_assembled_and_writes_it() {
    let folder = Folder::new();
    let scene = folder.scene(OPEN);
    let done = call(&["check", &scene]);
    assert_eq!(done.exit, Exit::Done, "{}", done.err);
    for part in [
        "assembled",
        "`bar` by 0.005 m and 0.01 rad",
        "`pivot` by 0.01 m",
        "set moving",
        "1 remain",
    ] {
        assert!(done.out.contains(part), "{part}: {}", done.out);
    }
    let check: Value = serde_json::from_str(&call(&["check", &scene, "--json"]).out).unwrap();
    assert_eq!(check["assembled"]["moved"][0]["body"], "bar");
    assert_eq!(check["assembled"]["freedoms"], 1);

    let file = format!("{}.long.toml", scene.trim_end_matches(".toml"));
    let write = |more: &[&str]| call(&[&["check", &scene, "--write", &file][..], more].concat());
    assert_eq!(write(&[]).exit, Exit::Done);
    let text = std::fs::read_to_string(&file).unwrap();
    assert!(text.contains("name = \"bar\"  # one of oak\nmass = 0.5\n"), "{text}");
    assert!(!text.contains("assemble"), "{text}");
    let refused = write(&["--set", "body.bar.mass=2"]);
    assert!(
        refused.exit == Exit::Refused && refused.err.contains("--overwrite"),
        "{}",
        refused.err
    );
    assert_eq!(std::fs::read_to_string(&file).unwrap(), text);
    assert_eq!(write(&["--set", "body.bar.mass=2", "--overwrite"]).exit, Exit::Done);
    assert!(std::fs::read_to_string(&file).unwrap().contains("mass = 2"));
    let printed = call(&["check", &scene, "--write", "-"]);
    assert_eq!(printed.out, text);
    assert_eq!(call(&["check", &scene, "--write", "-", "--json"]).exit, Exit::Refused);

    // Both run to the same bits.
    let hash = |scene: &str| {
        let summary = folder.summary(scene, &[]);
        (summary["state_hash"].clone(), summary.get("assembled").is_some())
    };
    std::fs::write(&file, text).unwrap();
    let (first, second) = (hash(&scene), hash(&file));
    assert!(first.0 == second.0 && first.0.is_string(), "{first:?} {second:?}");
    assert!(first.1 && !second.1);
}
