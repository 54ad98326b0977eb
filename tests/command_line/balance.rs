//! The energy balance of a run: what loads, inputs, moved ground and dampers did, and what remains.

use serde_json::Value;

use crate::Folder;

/// A body on a spring with a damper to ground that shakes; a load that begins and ends, an input that pushes
/// through a damper at another body, one that jumps.
const DRIVEN: &str = r#"
name = "driven"
duration = 1
gravity = [0, -9.81, 0]
[[body]]
name = "a"
mass = 1
inertia = [0.1, 0.1, 0.1]
position = [1, 0, 0]
angular_velocity = [0, 0, 1]
[[body]]
name = "b"
mass = 2
inertia = [0.1, 0.2, 0.2]
position = [2, 0.1, 0]
[[tsda]]
name = "mount"
between = ["world", "a"]
points = [[0, 0, 0], [0, 0.1, 0]]
stiffness = 400
damping = 3
free_length = 1
[[tsda]]
name = "dashpot"
between = ["a", "b"]
points = [[0, 0, 0], [-0.1, 0, 0]]
stiffness = 100
damping = 6
free_length = 0.9
[[torsion_spring]]
between = ["a", "b"]
axis = [0, 0, 1]
stiffness = 5
damping = 0.2
[[load]]
body = "b"
force = [10, 4, 0]
torque = [0, 0, 0.5]
frame = "body"
from = 0.25
until = 0.5
[[input]]
name = "push"
type = "force"
body = "a"
point = [0, 0.2, 0]
axis = [1, 1, 0]
table = [[0, 0], [0.25, 20], [0.75, -20]]
[[input]]
name = "shake"
type = "anchor"
target = "mount"
axis = [1, 0, 0]
sine = { amplitude = "2 cm", frequency = 6 }
"#;

const PARTS: [&str; 4] = ["loads", "inputs", "anchors", "dampers"];

fn balance(text: &str, options: &[&str]) -> (Value, f64, [f64; 4], f64) {
    let folder = Folder::new();
    let summary = folder.summary(&folder.scene(text), options);
    let own = &summary["energy_balance"];
    let number = |value: &Value| value.as_f64().unwrap_or_else(|| panic!("{summary}"));
    let change = number(&summary["energy_final"]) - number(&summary["energy_initial"]);
    let (parts, remains) = (PARTS.map(|part| number(&own[part])), number(&own["remains"]));
    (summary, change, parts, remains)
}

#[test]
fn what_remains_falls_with_the_square_of_the_step_and_is_no_part() {
    for precision in ["f64", "f32", "fixed"] {
        let of = |step: &str| balance(DRIVEN, &["--step", step, "--precision", precision]);
        let (_, change, parts, coarse) = of("2ms");
        let (_, _, _, fine) = of("1ms");
        let [loads, inputs, anchors, dampers] = parts;
        let closed = loads + inputs + anchors - dampers + coarse;
        assert!((closed - change).abs() < 1e-9 * dampers, "{parts:?} {coarse} {change}");
        // With another sign of any part as much as twice that part would remain.
        for (part, name) in parts.iter().zip(PARTS) {
            assert!(part.abs() > 0.1, "{name}: {parts:?}");
            assert!(coarse.abs() < 0.01 * part.abs(), "{name}: {part}, {coarse} remain");
        }
        if precision == "f64" {
            let ratio = coarse / fine;
            assert!((3.5..4.5).contains(&ratio), "{coarse} {fine}");
        } else {
            assert!(fine.abs() < 1e-3, "{precision}: {fine}");
        }
    }
}

/// Of fourth order with a scheme that is.
#[test]
fn what_remains_is_of_the_order_of_the_scheme() {
    let of = |step: &str| balance(DRIVEN, &["--step", step, "--scheme", "rk4"]).3;
    let [coarse, fine] = ["3.90625ms", "1.953125ms"].map(of);
    let order = (coarse / fine).abs().log2();
    assert!((3.5..5.5).contains(&order), "{coarse} {fine}");
}

/// A force of 10 N does 10 N times the way of the body, a step of the ground ½·k·s².
#[test]
fn works_are_those_of_closed_forms() {
    let free = "name = \"free\"\nduration = 1\n[[body]]\nname = \"b\"\nmass = 2\ninertia = [1, 1, 1]\n\
                position = [0, 0, 0]\n[[load]]\nbody = \"b\"\nforce = [10, 0, 0]\nfrom = 0.5\nuntil = 0.75\n";
    let (summary, change, [loads, ..], remains) = balance(free, &["--step", "1ms"]);
    // ½·m·v², v = F·t/m.
    let exact = 0.5 * 2.0 * (10.0_f64 * 0.25 / 2.0).powi(2);
    assert!((loads - exact).abs() < 1e-9 && (change - exact).abs() < 1e-9, "{loads} {change}");
    assert!(remains.abs() < 1e-9, "{summary}");

    let jump = "name = \"jump\"\nduration = 1\n[[body]]\nname = \"b\"\nmass = 2\ninertia = [1, 1, 1]\n\
                position = [1, 0, 0]\n[[tsda]]\nname = \"s\"\nbetween = [\"world\", \"b\"]\n\
                points = [[0, 0, 0], [0, 0, 0]]\nstiffness = 50\nfree_length = 1\n\
                [[input]]\nname = \"step\"\ntype = \"anchor\"\ntarget = \"s\"\naxis = [1, 0, 0]\n\
                table = [[0, 0], [0.5, 0.1]]\n";
    let (_, change, [_, _, anchors, dampers], remains) = balance(jump, &["--step", "1ms"]);
    assert!((anchors - 0.25).abs() < 1e-12 && dampers == 0.0, "{anchors}");
    assert!((change - anchors - remains).abs() < 1e-12 && remains.abs() < 1e-4, "{remains}");
}

#[test]
fn the_table_and_the_page_say_what_gave_and_took() {
    let folder = Folder::new();
    let scene = folder.scene(DRIVEN);
    let done = folder.run(&scene, &["--step", "1ms"]);
    let row = done.out.lines().find(|line| line.contains("energy, balance")).unwrap();
    for word in ["loads −", "inputs +", "moved ground +", "dampers −", "remain"] {
        assert!(row.contains(word), "{row}");
    }
    let page = std::fs::read_to_string(folder.path("out/scene/report.html")).unwrap();
    assert!(page.contains("energy, balance"));
    // Where nothing drives there is nothing to say.
    let summary = folder.summary(&folder.scene(crate::PENDULUM), &[]);
    assert_eq!(summary.get("energy_balance"), None);
}
