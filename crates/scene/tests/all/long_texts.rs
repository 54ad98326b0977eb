//! Names, keys and values of any length: refused at their place, in a message that can be read.

use dbd_scene::Scene;

/// A scene with one of everything that has a name or names something.
const BASE: &str = r#"name = "scene"
duration = 1
[[body]]
name = "body"
mass = 1
inertia = [1, 1, 1]
position = [0, 0, 0]
[[joint]]
name = "joint"
type = "revolute"
between = ["world", "body"]
at = [0, 0, 0]
axis = [0, 0, 1]
stiffness = 1e3
span = 0.1
[[tsda]]
name = "tsda"
between = ["world", "body"]
points = [[0, 0, 0], [1, 0, 0]]
stiffness = 1
free_length = 1
[[point_on_line]]
name = "line"
between = ["world", "body"]
line_point = [0, 0, 0]
line_direction = [1, 0, 0]
point = [0, 0, 0]
stiffness = 1
free_length = 0
[[torsion_spring]]
name = "twist"
between = ["world", "body"]
axis = [0, 0, 1]
stiffness = 1
[[load]]
body = "body"
force = [0, 0, 1]
[[input]]
name = "input"
type = "joint_torque"
target = "joint"
[[readout]]
name = "readout"
type = "joint_angle"
target = "joint"
[[readout]]
name = "second"
type = "input"
target = "input"
"#;

/// The longest name.
const LONGEST: usize = 200;

/// The base scene with `from`, which begins one line, replaced; the number of that line.
fn edited(from: &str, to: &str) -> (String, usize) {
    let (before, after) = BASE.split_once(&format!("\n{from}")).unwrap_or_else(|| panic!("{from}"));
    (format!("{before}\n{to}{after}"), before.matches('\n').count() + 2)
}

const NAMES: [&str; 8] = ["body", "joint", "tsda", "line", "twist", "input", "readout", "second"];

#[test]
fn the_longest_name_is_taken_and_one_byte_more_is_refused() {
    Scene::parse(BASE, "base.toml").unwrap_or_else(|error| panic!("{error:?}"));
    let refused = |text: &str, line: usize, bytes: usize| {
        let error = Scene::parse(text, "scene.toml").unwrap_err();
        assert_eq!((error.line(), error.column()), (Some(line), Some(8)), "{error}");
        assert!(error.message().contains(&format!("is {bytes} bytes long")), "{error}");
        assert!(error.help().contains(&format!("at most {LONGEST} bytes")), "{}", error.help());
    };
    for name in NAMES {
        // A letter of two bytes: it is bytes that file systems count.
        for (letter, bytes) in [("n", 1), ("ö", 2)] {
            let with = |count: usize| {
                let long = letter.repeat(count);
                let (text, line) =
                    edited(&format!("name = \"{name}\""), &format!("name = \"{long}\""));
                // What names it does so by its new name.
                let referring = [format!("target = \"{name}\""), format!("body = \"{name}\"")];
                let text = text
                    .replace(&format!("\"world\", \"{name}\""), &format!("\"world\", \"{long}\""));
                let text = referring.iter().fold(text, |text, old| {
                    text.replace(old, &old.replace(&format!("\"{name}\""), &format!("\"{long}\"")))
                });
                (text, line)
            };
            let (text, _) = with(LONGEST / bytes);
            Scene::parse(&text, "scene.toml").unwrap_or_else(|error| panic!("{name}: {error}"));
            let (text, line) = with(LONGEST / bytes + 1);
            refused(&text, line, (LONGEST / bytes + 1) * bytes);
        }
    }
    refused(&BASE.replacen("\"scene\"", &format!("\"{}\"", "n".repeat(300)), 1), 1, 300);
}

/// Of 150,000 letters: nothing is compared letter by letter, and nobody has to read them.
#[test]
fn endless_texts_are_refused_at_once_and_not_repeated() {
    let endless = "n".repeat(150_000);
    let other = "m".repeat(150_000);
    let quoted = |key: &str| format!("{key} = \"{endless}\"");
    let mut cases = Vec::new();
    for name in NAMES {
        cases.push((format!("name = \"{name}\""), quoted("name"), 8));
    }
    let line = |from: &str, to: String, column: usize| (from.to_owned(), to, column);
    cases.extend([
        // The word within the quotes.
        line("duration = 1", quoted("duration"), 13),
        line("duration = 1", format!("duration = {endless}"), 12),
        line("duration = 1", format!("duration = -{}", "1".repeat(150_000)), 12),
        line("duration = 1", format!("duration = 1\n{endless} = 1"), 1),
        line("mass = 1", format!("mass = 1\n{endless} = 1"), 1),
        line("type = \"revolute\"", quoted("type"), 8),
        line("type = \"joint_torque\"", quoted("type"), 8),
        line("type = \"joint_angle\"", quoted("type"), 8),
        line(
            "type = \"input\"\ntarget = \"input\"",
            format!("type = \"input\"\n{}", quoted("target")),
            10,
        ),
        line("target = \"joint\"", quoted("target"), 10),
        line("body = \"body\"", quoted("body"), 8),
        line(
            "between = [\"world\", \"body\"]",
            format!("between = [\"world\", \"{endless}\"]"),
            21,
        ),
        line("[[joint]]", format!("[{endless}]\n[[{endless}]]\n[[joint]]"), 3),
    ]);
    for (from, to, column) in cases {
        let (text, line) = edited(&from, &to);
        for text in
            [text.clone(), text.replacen("name = \"body\"", &format!("name = \"{other}\""), 1)]
        {
            let error = Scene::parse(&text, "scene.toml").unwrap_err();
            let said = error.message().len() + error.help().len();
            assert!(said < 1500, "{from}: {said} bytes");
            if !text.contains(&other) {
                // The second of two lines that are put in is at fault.
                let lines = to.matches('\n').count().min(1);
                assert_eq!(
                    (error.line(), error.column()),
                    (Some(line + lines), Some(column)),
                    "{from}"
                );
            }
        }
    }
}
