//! `cargo xtask bench`: what it prints and what it refuses. No time is judged here.

use std::collections::BTreeSet;

use host_sim::terminal::{Console, Exit};
use serde_json::Value;

use crate::Done;

/// The fewest steps that can be measured.
const SHORT: [&str; 4] = ["--rounds", "3", "--steps", "1"];

fn call(words: &[&str]) -> Done {
    let (mut out, mut err) = (Vec::new(), Vec::new());
    let mut console = Console::plain(&mut out, &mut err);
    let exit = dbd_bench::command::main_with([&["bench"], words].concat(), &mut console);
    let text = |bytes| String::from_utf8(bytes).unwrap();
    Done { exit, out: text(out), err: text(err) }
}

fn bench(words: &[&str]) -> Done {
    call(&[words, &SHORT].concat())
}

fn measured(words: &[&str]) -> Value {
    let done = bench(&[words, &["--json"]].concat());
    assert_eq!(done.exit, Exit::Done, "{}", done.err);
    serde_json::from_str(&done.out).unwrap()
}

/// All keys of objects within a value.
fn keys(value: &Value, into: &mut BTreeSet<String>) {
    match value {
        Value::Object(object) => {
            into.extend(object.keys().cloned());
            object.values().for_each(|value| keys(value, into));
        }
        Value::Array(values) => values.iter().for_each(|value| keys(value, into)),
        _ => {}
    }
}

#[test]
fn the_page_names_every_key() {
    let outcome = measured(&[
        "four-bar",
        "cart-pendulum",
        "hexagon",
        "3ruu",
        "hanging-chain",
        "--chains",
        "2,4",
        "--nets",
        "2,31",
    ]);
    let page = std::fs::read_to_string(dbd_tests::results::path("docs/speed.md")).unwrap();
    let section = page
        .split_once("\n## Options of `cargo xtask bench`\n")
        .unwrap()
        .1
        .split("\n## ")
        .next()
        .unwrap();
    let mut named = BTreeSet::new();
    keys(&outcome, &mut named);
    for key in named {
        let found =
            section.split(|c: char| !c.is_alphanumeric() && c != '_').any(|word| word == key);
        assert!(found, "docs/speed.md does not name `{key}`");
    }
    assert!(outcome["fit"]["parts"].as_array().unwrap().len() == 6, "{outcome}");
    let goals = outcome["goals"].as_array().unwrap();
    let growth = goals.iter().filter(|goal| goal["what"].as_str().unwrap().starts_with("time"));
    assert_eq!(growth.count(), 1);
    let nets: Vec<u64> = outcome["nets"]
        .as_array()
        .unwrap()
        .iter()
        .map(|net| net["bodies"].as_u64().unwrap())
        .collect();
    assert_eq!(nets, [4, 961]);
    assert_eq!(goals.iter().filter(|goal| goal["at_most"] == 1500.0).count(), 1);
    // Every machine has lanes of its own, and threads.
    let ensembles = outcome["ensembles"].as_array().unwrap();
    assert!(ensembles.len() >= 4 && ensembles.iter().all(|row| row["name"] == "four-bar"));
}

#[test]
fn what_the_plain_loop_lacks_is_said() {
    let outcome = measured(&["cart-pendulum", "--chains", "3"]);
    let [scene, chain] = &outcome["systems"].as_array().unwrap()[..] else { panic!("{outcome}") };
    assert_eq!(scene["plain"]["why_not"], "the plain loop has no inputs");
    assert!(scene["plain"]["time_s"].is_null() && scene["std"]["time_s"].is_object());
    assert_eq!((&chain["name"], &chain["links"]), (&"chain-3".into(), &3.into()));
    // Counted, not measured: exactly the same each time.
    assert_eq!(measured(&["--chains", "3"])["systems"][0]["flops"], chain["flops"]);
}

#[test]
fn scenes_and_chains_are_those_that_are_named() {
    let outcome = measured(&["--chains", "2"]);
    assert_eq!(outcome["systems"].as_array().unwrap().len(), 1);
    // A planar scene is measured in its plane: the elements that step there, no count of operations in space.
    let counts = |options: &[&str]| {
        let row = measured(&[&["four-bar"], options].concat())["systems"][0].clone();
        (row["tsdas"].clone(), row["flops"].is_null())
    };
    assert_eq!(counts(&[]), (24.into(), false));
    assert_eq!(counts(&["--set", "planar=true"]), (8.into(), true));
    let text = bench(&["hexagon", "--set", "joint.*.stiffness=1e6"]).out;
    assert!(text.starts_with("system") && text.contains("hexagon"), "{text}");
}

#[test]
fn bad_input_is_refused() {
    for words in [
        &["no-such-scene"][..],
        &["--chains", "0"],
        &["--chains", "10923"],
        &["--chains", "ten"],
        &["four-bar", "--rounds", "2"],
        &["four-bar", "--steps", "0"],
        &["--set", "step=1ms"],
        &["four-bar", "--set", "no.such=1"],
    ] {
        let done = call(words);
        assert!(done.exit == Exit::Refused && !done.err.is_empty(), "{words:?}: {}", done.err);
        assert!(done.out.is_empty(), "{words:?}");
    }
}
