//! Interactions at the command line: what `check`, pictures and summaries state of them, and the tables of their laws.

use dbd_plant::digits::significant;
use dbd_scene::laws::{KnownLaw, known_laws};
use dbd_tests::page::{block, table};
use dbd_tests::results::path;
use host_sim::terminal::Exit;
use serde_json::Value;

use crate::{Folder, call};

fn scene() -> String {
    std::fs::read_to_string(path("tests/fuzz/corpus/scene/interactions.toml")).unwrap()
}

#[test]
fn the_page_has_a_table_of_each_law() {
    for law in known_laws().into_iter().filter(KnownLaw::is_between) {
        let row = |field: &dbd_kernel::laws::Field| {
            let value = match field.kind {
                "points" => "[[x, y, z], [x, y, z]] m or points".into(),
                "normal" | "axis" | "axle" => "[x, y, z] or two points".into(),
                "count" => "a whole number".into(),
                "matrix" => {
                    format!("six rows of six numbers, blocks in {}", field.units.join(", "))
                }
                "table" => format!("[[{}], …], the first ascending", field.units.join(", ")),
                _ => field.units.join(", "),
            };
            let default = field.default.map(|value| significant(value, 15)).unwrap_or_default();
            let required = if field.default.is_none() { " **·**" } else { "" };
            vec![format!("`{}`{required}", field.name), value, default, field.about.to_owned()]
        };
        let rows: Vec<_> = law.fields.iter().map(row).collect();
        let shows = law.quantities.iter();
        let shows: Vec<_> =
            shows.map(|shown| format!("`{}` ({})", shown.name, shown.unit)).collect();
        let text = format!(
            "{}\n\n{}\nQuantities: {}.",
            law.about,
            table(&["key", "value", "default", "meaning"], &rows),
            shows.join(", "),
        );
        block("docs/scene-reference.md", law.name, &text);
    }
}

#[test]
fn check_lists_them() {
    let folder = Folder::new();
    let file = folder.scene(&scene());
    let done = call(&["check", &file]);
    assert_eq!((done.exit, done.err.as_str()), (Exit::Done, ""));
    let count = done.out.lines().find(|line| line.starts_with("interactions "));
    assert!(count.is_some_and(|line| line.trim_end().ends_with(" 3")), "{}", done.out);
    let words = |line: &str| line.split_whitespace().map(str::to_owned).collect::<Vec<_>>();
    let rows: Vec<_> = done.out.lines().map(words).collect();
    for row in [
        &["interaction", "law", "between", "dampers"][..],
        &["rub", "hinge-friction", "world–bar", "2"],
        &["stop", "end-stop", "world–bar", "1"],
        &["interaction", "3", "(world–bar)", "hinge-stop", "world–bar", "1"],
    ] {
        assert!(rows.iter().any(|found| found == row), "{row:?}: {}", done.out);
    }
    let json: Value = serde_json::from_str(&call(&["check", &file, "--json"]).out).unwrap();
    let stop = serde_json::json!({
        "name": "stop", "law": "end-stop", "between": ["world", "bar"], "dampers": 1
    });
    assert_eq!(json["interactions"][1], stop);
    assert_eq!(json["warnings"], serde_json::json!([]));
}

#[test]
fn pictures_show_them() {
    let folder = Folder::new();
    let file = folder.scene(&scene());
    let picture = call(&["check", &file, "--svg", "-"]).out;
    for part in [">rub<", ">stop<", "interaction at points", "2 interactions about axes"] {
        assert!(picture.contains(part), "{part}");
    }
    folder.run(&file, &["--duration", "1ms"]);
    let page = std::fs::read_to_string(folder.path("out/scene/report.html")).unwrap();
    assert!(page.contains("interaction at points"));
}

/// A flywheel about the axis of its friction: it loses what friction takes, and nothing else.
const FLYWHEEL: &str = r#"
name = "flywheel"
duration = 0.5
[[body]]
name = "wheel"
mass = 1
inertia = [0.1, 0.1, 0.1]
position = [0, 0, 0]
angular_velocity = [0, 0, 10]
[[interaction]]
law = "hinge-friction"
between = ["world", "wheel"]
axis = [0, 0, 1]
coulomb = 1
breakaway = 1
give = "1 mrad"
"#;

#[test]
fn the_balance_states_what_friction_takes() {
    for precision in ["f64", "f32"] {
        let folder = Folder::new();
        let file = folder.scene(FLYWHEEL);
        let summary = folder.summary(&file, &["--step", "50us", "--precision", precision]);
        assert_eq!(summary["status"], "ok");
        assert_eq!(summary["energy_rms_error"], Value::Null);
        let number = |value: &Value| value.as_f64().unwrap_or_else(|| panic!("{summary}"));
        let balance = &summary["energy_balance"];
        let [laws, dampers, remains] =
            ["laws", "dampers", "remains"].map(|key| number(&balance[key]));
        // 1 N·m over 10·0.5 − ½·10·0.25 rad of the turn, less what the spring of its give holds.
        let turned = 10.0 * 0.5 - 0.5 * 10.0 * 0.25;
        assert!((laws - turned).abs() < 2e-3 * turned, "{precision}: {balance}");
        assert!(remains.abs() < 1e-3 * laws, "{precision}: {balance}");
        let change = number(&summary["energy_final"]) - number(&summary["energy_initial"]);
        assert!((change + laws + dampers - remains).abs() < 1e-9, "{balance}");
    }
    let folder = Folder::new();
    let done = folder.run(&folder.scene(FLYWHEEL), &["--step", "50us"]);
    let row = done.out.lines().find(|line| line.contains("energy, balance")).unwrap();
    assert!(row.contains("interactions −3.7"), "{row}");
    assert!(done.out.contains("– (dampers, interactions, loads or inputs change the energy)"));
}

/// A thrown disc that comes to roll loses ½·m·v² and ½·I·ω² less 1/12 J to friction, in space, in the plane of the paper
/// and in another plane, whatever its body's axes.
#[test]
fn the_balance_states_what_a_contact_takes() {
    let text = |planar: &str, normal: &str, start: &str| {
        let depth = 0.1 - 9.81 / 1e5;
        let [position, gravity] = [("0", depth), ("1", -9.81)].map(|(_, size)| {
            let parts = normal.split(", ").map(|part| match part {
                "1" => size.to_string(),
                part => part.to_owned(),
            });
            parts.collect::<Vec<_>>().join(", ")
        });
        format!(
            "name = \"thrown\"\nduration = 1\n{planar}gravity = [{gravity}]\n[[body]]\nname = \"disc\"\n\
             mass = 1\ninertia = [0.005, 0.005, 0.005]\nposition = [{position}]\n{start}\n[[interaction]]\n\
             law = \"plane-contact\"\nbetween = [\"world\", \"disc\"]\npoints = [[0, 0, 0], [0, 0, 0]]\n\
             normal = [{normal}]\nradius = 0.1\nstiffness = 1e5\ndissipation = 1\nfriction = 0.2\ndamping = 50\n"
        )
    };
    let turned = "orientation = { quaternion = [0.8, 0, 0.6, 0] }\n";
    let upright = "velocity = [2, 0, 0]\nangular_velocity = [0, 0, 30]";
    let flat = format!("{turned}velocity = [2, 0, 0]\nangular_velocity = [0, -30, 0]");
    let cases = [
        text("planar = false\n", "0, 1, 0", upright),
        text("planar = true\n", "0, 1, 0", upright),
        text("planar = false\n", "0, 0, 1", &flat),
        text("planar = true\n", "0, 0, 1", &flat),
    ];
    for case in cases {
        let folder = Folder::new();
        let summary = folder.summary(&folder.scene(&case), &["--step", "100us"]);
        assert_eq!(summary["status"], "ok", "{case}");
        let balance = &summary["energy_balance"];
        let [laws, remains] = ["laws", "remains"].map(|key| balance[key].as_f64().unwrap());
        assert!((laws - (2.0 + 2.25 - 1.0 / 12.0)).abs() < 2e-2, "{balance}: {case}");
        assert!(remains.abs() < 2e-2, "{balance}: {case}");
    }
}

/// A ball falls 50 mm onto a stop and bounces: the times between bounces and depths are those of free fall and of a
/// spring; another stop is never met, and no word is said of it.
#[test]
fn a_run_states_what_stops_did() {
    let folder = Folder::new();
    let stop = |name: &str, at: f64| {
        format!(
            "[[interaction]]\nname = \"{name}\"\nlaw = \"end-stop\"\nbetween = [\"world\", \"ball\"]\n\
             points = [[0, 0, {at:?}], [0, 0, 0]]\nnormal = [0, 0, 1]\nstiffness = 1e5\ndissipation = 0\n"
        )
    };
    let file = folder.scene(&format!(
        "name = \"scene\"\nduration = 0.45\nstep = \"20us\"\nevery = \"50 ms\"\ngravity = [0, 0, -9.81]\n[[body]]\n\
         name = \"ball\"\nmass = 1\ninertia = [1e-3, 1e-3, 1e-3]\nposition = [0, 0, 0.05]\n{}{}",
        stop("floor", 0.0),
        stop("cellar", -1.0),
    ));
    let summary = folder.summary(&file, &[]);
    let all = summary["engagements"].as_array().unwrap();
    assert_eq!(all.len(), 1, "{all:?}");
    let of = |key: &str| all[0][key].as_f64().unwrap_or_else(|| panic!("{key} of {all:?}"));
    assert_eq!(all[0]["interaction"], "interaction `floor` (world–ball)");
    assert_eq!((&all[0]["unit"], &all[0]["times"]), (&Value::from("m"), &Value::from(2)));
    // Free fall, and half a period of ω = √(k/m) on the stop.
    let fall = (2.0 * 0.05 / 9.81_f64).sqrt();
    let speed = 9.81 * fall;
    let depth = 9.81 / 1e5 + ((9.81_f64 / 1e5).powi(2) + speed * speed / 1e5).sqrt();
    assert!((of("first") - fall).abs() < 1e-3, "{all:?}");
    assert!((of("depth") / depth - 1.0).abs() < 0.02, "{depth:e} of {all:?}");
    let half = std::f64::consts::PI / 1e5_f64.sqrt();
    assert!((of("share") - 2.0 * half / 0.45).abs() < 0.01, "{all:?}");
    assert!((of("free_since") - (3.0 * fall + 2.0 * half)).abs() < 2e-3, "{all:?}");
    let rows = folder.run(&file, &[]).out;
    let row = rows.lines().find(|line| line.starts_with("engaged ")).unwrap();
    assert!(row.contains("`floor` (world–ball): 2 times, first at t = 0.1"), "{row}");
    // A run without stops has no word of them.
    let none = folder.summary("spring-ball", &["--duration", "0.01"]);
    assert_eq!(none.get("engagements"), None);
}

/// A law of another program is no error of the scene's text; a wrong key of a law that is known is one.
#[test]
fn the_schema_takes_laws_of_other_programs() {
    let schema: Value = serde_json::from_str(&call(&["schema"]).out).unwrap();
    let validator = jsonschema::draft7::new(&schema).unwrap();
    let is_valid = |text: &str| validator.is_valid(&toml::from_str::<Value>(text).unwrap());
    let text = scene();
    assert!(is_valid(&text));
    let own = "\n[[interaction]]\nlaw = \"drag\"\nbetween = [\"world\", \"bar\"]\narea = 0.1\n";
    assert!(is_valid(&(text.clone() + own)));
    assert!(!is_valid(&(text.clone() + &own.replace("\"drag\"", "\"end-stop\""))));
    assert!(!is_valid(&text.replace("normal = [-1, 0, 0]\n", "")));
    assert!(!is_valid(&text.replace("law = \"end-stop\"\n", "")));
}
