//! The schema of scene files and the reader agree: on every scene here, and on what is wrong with it.

use std::cell::RefCell;
use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use dbd_scene::Scene;
use dbd_scene::vocabulary::vocabulary;
use dbd_tests::results::path;
use host_sim::terminal::Exit;
use jsonschema::Validator;
use serde_json::{Value, json};

use crate::{Folder, call};

fn schema() -> Value {
    let done = call(&["schema"]);
    assert_eq!((done.exit, done.err.as_str()), (Exit::Done, ""));
    serde_json::from_str(&done.out).unwrap()
}

fn validator() -> Validator {
    jsonschema::draft7::new(&schema()).unwrap()
}

/// The scenes of folders: their names and texts.
fn scenes(folders: &[&str]) -> Vec<(String, String)> {
    let files = folders.iter().flat_map(|folder| fs::read_dir(path(folder)).unwrap());
    let files = files.map(|file| file.unwrap().path());
    let is_scene = |file: &Path| file.extension().is_some_and(|end| end == "toml");
    let mut files: Vec<_> = files.filter(|file| is_scene(file)).collect();
    files.sort();
    files
        .iter()
        .map(|file| (file.display().to_string(), fs::read_to_string(file).unwrap()))
        .collect()
}

#[test]
fn the_file_of_the_repository_is_what_the_command_prints() {
    let command = "cargo test -p dbd-tests --test command_line schema";
    dbd_tests::page::file("docs/scene.schema.json", &call(&["schema"]).out, command);
}

#[test]
fn every_scene_is_valid() {
    let validator = validator();
    let all = scenes(&["scenes", "tests/authoring", "tests/fuzz/corpus/scene"]);
    assert!(all.len() > 30);
    for (file, text) in all {
        let scene: Value = toml::from_str(&text).unwrap();
        let wrong: Vec<String> = validator
            .iter_errors(&scene)
            .map(|error| format!("{}: {error}", error.instance_path()))
            .collect();
        assert!(wrong.is_empty(), "{file}: {wrong:#?}");
    }
}

/// All tables in a value with their pointers.
fn tables(value: &Value, pointer: String, into: &mut Vec<String>) {
    match value {
        Value::Object(map) => {
            for (key, value) in map {
                tables(value, format!("{pointer}/{key}"), into);
            }
            into.push(pointer);
        }
        Value::Array(entries) => {
            for (row, entry) in entries.iter().enumerate() {
                tables(entry, format!("{pointer}/{row}"), into);
            }
        }
        _ => {}
    }
}

/// The same value for a scene file: serialised directly, a number of this crate may be a table.
fn as_toml(value: &Value) -> toml::Value {
    match value {
        Value::Null => panic!("a scene file has no null"),
        Value::Bool(is) => toml::Value::Boolean(*is),
        Value::Number(number) => match number.as_i64() {
            Some(number) => toml::Value::Integer(number),
            None => toml::Value::Float(number.as_f64().unwrap()),
        },
        Value::String(text) => toml::Value::String(text.clone()),
        Value::Array(entries) => toml::Value::Array(entries.iter().map(as_toml).collect()),
        Value::Object(map) => {
            toml::Value::Table(map.iter().map(|(key, one)| (key.clone(), as_toml(one))).collect())
        }
    }
}

/// What the reader says of a scene; `None` where it takes it.
fn refusal(scene: &Value) -> Option<String> {
    let text = toml::to_string(&as_toml(scene)).unwrap();
    Scene::parse(&text, "a.toml").err().map(|error| error.message().to_owned())
}

/// Keys that are required by the value of another key or by the type of a joint.
const DEPENDENT: [&str; 12] = [
    "about",
    "axis",
    "factor",
    "freedom",
    "gear",
    "inductance_d",
    "inductance_q",
    "kd",
    "kp",
    "radius",
    "resistance",
    "winding",
];

/// Each key of each table is left out, becomes a truth value or a negative number, and gets a neighbour that nobody knows.
/// The schema never refuses what the reader takes; it refuses unknown keys, wrong types and, where there are no
/// defaults, what is missing.
#[test]
fn schema_and_reader_refuse_alike() {
    let validator = validator();
    let mut met = BTreeSet::new();
    let unlike = RefCell::new(Vec::new());
    let hold = |holds: bool, words: String| {
        if !holds {
            unlike.borrow_mut().push(words);
        }
    };
    for (file, text) in scenes(&["tests/fuzz/corpus/scene"]) {
        let scene: Value = toml::from_str(&text).unwrap();
        assert_eq!(refusal(&scene), None, "{file}");
        let has_defaults = ["defaults", "realisation"].iter().any(|key| scene.get(key).is_some());
        let mut places = Vec::new();
        tables(&scene, String::new(), &mut places);
        for place in places {
            let keys: Vec<String> =
                scene.pointer(&place).unwrap().as_object().unwrap().keys().cloned().collect();
            // Their keys are names.
            let named = place == "/points"
                || place == "/parameters"
                || place == "/start"
                || place == "/assemble/rates"
                || place == "/assemble/angles";
            let changed = |key: &str, value: Option<Value>| {
                let mut changed = scene.clone();
                let table = changed.pointer_mut(&place).unwrap().as_object_mut().unwrap();
                match value {
                    Some(value) => drop(table.insert(key.into(), value)),
                    None => drop(table.remove(key)),
                }
                let (said, valid) = (refusal(&changed), validator.is_valid(&changed));
                let words = format!("{file}{place}/{key}: the reader says {said:?}");
                hold(valid || said.is_some(), format!("{words}, the schema refuses"));
                (said, valid, words)
            };
            if !named {
                let (said, valid, words) = changed("kolour", Some(json!(1)));
                hold(said.is_some() && !valid, format!("{words}, the schema takes it: {valid}"));
            }
            for key in &keys {
                met.insert(key.clone());
                // Where a truth value stands a number must not.
                let switches = ["planar", "settle", "periodic", "jump", "driven"];
                let wrong = if switches.contains(&key.as_str()) { json!(1) } else { json!(true) };
                let (said, valid, words) = changed(key, Some(wrong));
                hold(said.is_some() && !valid, format!("{words}, the schema takes it: {valid}"));
                changed(key, Some(json!(-1)));
                changed(key, Some(json!("no such word")));
                changed(key, Some(json!([])));
                let (said, valid, words) = changed(key, None);
                let missing = said.is_some_and(|said| said.ends_with(&format!("has no `{key}`")));
                // Which form a point has, what a target or a joint needs and what a mode needs, the keys alone do not
                // say.
                let depends = place.starts_with("/points/") || DEPENDENT.contains(&key.as_str());
                let may_pass = has_defaults || depends;
                hold(!missing || !valid || may_pass, format!("{words}, the schema takes it"));
            }
        }
    }
    let unlike = unlike.into_inner();
    assert!(unlike.is_empty(), "{unlike:#?}");
    let known = vocabulary().into_iter().flat_map(|table| table.keys);
    let unmet: BTreeSet<&str> = known.filter(|key| !met.contains(*key)).collect();
    assert!(unmet.is_empty(), "no scene here has {unmet:?}");
}

#[test]
fn a_new_scene_is_valid_and_runs_and_nothing_is_overwritten() {
    let validator = validator();
    let folder = Folder::new();
    for (name, options) in [("mine", &[][..]), ("copy", &["--from", "double-wishbone"])] {
        let file = folder.path(&format!("{name}.toml"));
        let called = folder.path(name);
        let done = call(&[&["new", "scene", called.to_str().unwrap()], options].concat());
        assert_eq!((done.exit, done.err.as_str()), (Exit::Done, ""));
        assert!(done.out.contains("--watch") && done.out.contains("host-sim run "), "{}", done.out);
        let text = fs::read_to_string(&file).unwrap();
        assert!(text.starts_with("#:schema ./scene.schema.json\n") && !text.contains("{{"));
        assert_eq!(Scene::parse(&text, "a").unwrap().name, name);
        let beside = fs::read_to_string(folder.path("scene.schema.json")).unwrap();
        assert!(beside == call(&["schema"]).out);
        assert!(validator.is_valid(&toml::from_str(&text).unwrap()));
        let checked = call(&["check", file.to_str().unwrap()]);
        assert_eq!((checked.exit, checked.err.as_str()), (Exit::Done, ""));
        assert!(!checked.out.contains("warning"), "{}", checked.out);
        // With or without its ending, there or elsewhere, it is taken.
        for again in [&called, &file] {
            let again = call(&["new", "scene", again.to_str().unwrap()]);
            assert_eq!(again.exit, Exit::Refused);
            assert!(again.err.contains("already"), "{}", again.err);
        }
        assert_eq!(fs::read_to_string(&file).unwrap(), text);
    }
    let summary =
        folder.summary(folder.path("mine.toml").to_str().unwrap(), &["--duration", "0.1s"]);
    assert_eq!(summary["status"], "ok");
    fs::write(folder.path("scene.schema.json"), "{ \"title\": \"another's\" }").unwrap();
    for (name, said) in [
        ("other", "scene.schema.json already"),
        ("a b", "a-b"),
        ("nul", "operating system"),
        ("none/x", "cannot write to"),
    ] {
        let done = call(&["new", "scene", folder.path(name).to_str().unwrap()]);
        assert!(done.exit != Exit::Done && done.err.contains(said), "{name}: {}", done.err);
        assert!(!folder.path(&format!("{name}.toml")).exists());
    }
    let done = call(&["new", "scene", "x", "--from", "double-wishbon"]);
    assert!(done.exit == Exit::Refused && done.err.contains("did you mean double-wishbone?"));
}
