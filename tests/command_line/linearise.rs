//! `linearise`: what is printed and written, and what is refused.

use std::fs;

use host_sim::terminal::Exit;
use serde_json::Value;

use crate::{Done, Folder, PENDULUM, call};

/// A mass hangs at rest on a spring and a damper along y: ω = 10 rad/s, damping ratio 0.15.
const HANGING: &str = r#"
name = "hanging"
duration = 1.0
step = "1 ms"
gravity = [0, -10, 0]
[[body]]
name = "weight"
mass = 2.0
inertia = [0.01, 0.01, 0.01]
position = [0, -1.1, 0]
[[tsda]]
between = ["world", "weight"]
points = [[0, 0, 0], [0, 0, 0]]
stiffness = 200.0
damping = 6.0
free_length = 1.0
[[input]]
name = "push"
type = "force"
body = "weight"
axis = [0, 1, 0]
"#;

const UPRIGHT: [&str; 5] = [
    "cart-pendulum",
    "--set",
    "body.pendulum.position=[0,0.33,0]",
    "--set",
    "body.pendulum.orientation={axis=[0,0,1],angle=0}",
];
const STATES: &str = "cart_point.x,angle,cart_velocity.x,rate";

fn linearise(words: &[&str]) -> Done {
    call(&[&["linearise"], words].concat())
}

fn upright(words: &[&str]) -> Done {
    linearise(&[&UPRIGHT, words].concat())
}

fn written(folder: &Folder, name: &str, words: &[&str]) -> String {
    let file = folder.path(name);
    let done = linearise(&[words, &["--out", file.to_str().unwrap()]].concat());
    assert_eq!((done.exit, done.err.as_str()), (Exit::Done, ""));
    assert_eq!(done.out, format!("written  {}\n", file.display()));
    fs::read_to_string(file).unwrap()
}

#[test]
fn the_summary_has_names_drift_poles_and_what_is_left_out() {
    let done = upright(&["--states", STATES]);
    assert_eq!((done.exit, done.err.as_str()), (Exit::Done, ""));
    for words in [
        "cart-pendulum at 0s",
        "cart_point.x [m], angle [rad], cart_velocity.x [m/s], rate [rad/s]",
        " m/s² of cart_velocity.x, ",
        "inputs    drive [N]",
        "left out  motions from ",
        "poles [rad/s]",
        "damping ratio",
    ] {
        assert!(done.out.contains(words), "{words}: {}", done.out);
    }
    // The pendulum falls at 5.1 rad/s.
    assert!(done.out.contains("5.11"), "{}", done.out);
    let folder = Folder::new();
    let whole = linearise(&[&folder.scene(HANGING)]);
    assert!(
        whole
            .out
            .contains("12, twelve coordinates per body; reduce to the slow motions with --states"),
        "{}",
        whole.out
    );
    assert!(whole.out.contains("-1.5 ± 9.8869i"), "{}", whole.out);
    assert!(whole.out.contains("left out  nothing"), "{}", whole.out);
}

#[test]
fn the_three_formats_hold_the_same_numbers() {
    let folder = Folder::new();
    let words = [&UPRIGHT[..], &["--states", STATES, "--outputs", "angle,pendulum.vx"]].concat();
    let json: Value = serde_json::from_str(&written(&folder, "a.json", &words)).unwrap();
    let a = |row: usize, column: usize| json["A"][row][column].as_f64().unwrap();
    assert!((a(3, 1) - 26.59).abs() < 0.1 && (a(0, 2) - 1.0).abs() < 1e-6, "{}", json["A"]);
    let sizes = ["A", "B", "C", "D", "drift"].map(|key| json[key].as_array().unwrap().len());
    assert_eq!(sizes, [4, 4, 2, 2, 4]);
    assert_eq!(json["states"][1], serde_json::json!({"name": "angle", "unit": "rad"}));
    assert_eq!(json["poles"].as_array().unwrap().len(), 4);
    assert!(json["slowest_left_out"].as_f64().unwrap() > 50.0);
    let csv = written(&folder, "a.csv", &words);
    assert_eq!(csv.lines().count(), 1 + 16 + 4 + 8 + 2 + 4);
    assert!(csv.contains(&format!("\nA,rate,angle,{:?}\n", a(3, 1))), "{csv}");
    assert!(csv.contains("\nD,pendulum.vx,drive,") && csv.contains("\ndrift,rate,,"), "{csv}");
    let matlab = written(&folder, "a.m", &words);
    let row: Vec<String> = (0..4).map(|column| format!("{:?}", a(3, column))).collect();
    assert!(matlab.contains(&format!("  {}\n];\nB = [\n", row.join(", "))), "{matlab}");
    for line in [
        "% host-sim linearise cart-pendulum, t = 0.0 s",
        "states = {'cart_point.x', 'angle', 'cart_velocity.x', 'rate'};",
        "inputs = {'drive'};",
    ] {
        assert!(matlab.lines().any(|found| found == line), "{line}: {matlab}");
    }
    // Its own file is replaced, another's is not.
    written(&folder, "a.m", &words);
    fs::write(folder.path("a.m"), "x = 1;\n").unwrap();
    let file = folder.path("a.m");
    let done = upright(&["--out", file.to_str().unwrap()]);
    assert_eq!(done.exit, Exit::Refused);
    assert!(done.err.contains("was not written by"), "{}", done.err);
    assert_eq!(fs::read_to_string(file).unwrap(), "x = 1;\n");
}

#[test]
fn what_there_is_none_of_is_an_empty_matrix() {
    let folder = Folder::new();
    let scene = folder.scene(PENDULUM);
    let matlab = written(&folder, "a.m", &[&scene]);
    assert!(matlab.contains("B = zeros(12, 0);") && matlab.contains("inputs = {};"), "{matlab}");
    assert!(matlab.contains("slowest_left_out = Inf;"), "{matlab}");
    let json: Value = serde_json::from_str(&written(&folder, "a.json", &[&scene])).unwrap();
    assert_eq!(json["slowest_left_out"], Value::Null);
}

#[test]
fn the_plant_runs_to_the_time_first() {
    let folder = Folder::new();
    let scene = folder.scene(&HANGING.replace("position = [0, -1.1", "position = [0, -1.2"));
    let drift = |at: &[&str]| {
        let text = written(&folder, "a.json", &[&[scene.as_str()], at].concat());
        let json: Value = serde_json::from_str(&text).unwrap();
        (json["time"].as_f64().unwrap(), json["drift"][1].as_f64().unwrap())
    };
    // The velocity: of a decaying vibration about -1.1 m.
    assert_eq!(drift(&[]), (0.0, 0.0));
    let (time, velocity) = drift(&["--at", "0.1s"]);
    let fast = (100.0_f64 - 1.5 * 1.5).sqrt();
    let exact = 0.1 * (-0.15_f64).exp() * (100.0 / fast) * (fast * 0.1).sin();
    assert!((time - 0.1).abs() < 1e-12 && (velocity - exact).abs() < 1e-5, "{velocity} {exact}");
}

#[test]
fn what_is_wrong_is_refused_with_what_there_is() {
    let folder = Folder::new();
    let scene = folder.scene(HANGING);
    let file = folder.path("a.txt");
    let out = file.to_str().unwrap();
    for (words, says) in [
        (vec!["--states", "weight.yy"], "did you mean weight.y? the outputs: weight.x, weight.y"),
        (vec!["--outputs", "weight.q"], "has no output `weight.q`"),
        (vec!["--inputs", "pull"], "the inputs: push"),
        (vec!["--at", "0.0004s"], "not a whole number of steps"),
        (vec!["--at", "-1s"], "a time must be positive"),
        (vec!["--states", "weight.y,weight.vy"], "the 2 slowest motions"),
        (vec!["--out", out], "does not end with .json, .csv or .m"),
        (vec!["--set", "body.weight.mass=-1"], "must be a finite number > 0"),
    ] {
        let done = linearise(&[&[scene.as_str()], &words[..]].concat());
        assert_eq!((done.exit, done.out.as_str()), (Exit::Refused, ""), "{words:?}");
        assert!(done.err.contains(says), "{says}: {}", done.err);
    }
    assert!(!file.exists());
}
