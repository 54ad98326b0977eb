//! `host-sim advise`: what it says holds when it is done.

use host_sim::terminal::Exit;
use serde_json::Value;

use crate::{Folder, call};

/// A pendulum that is done in a moment.
const SCENE: &str = "cart-pendulum";

fn advised(options: &[&str]) -> (Exit, Value) {
    let arguments: Vec<&str> =
        ["advise", SCENE].into_iter().chain(options.iter().copied()).collect();
    let done = call(&[&arguments[..], &["--json"]].concat());
    let json = serde_json::from_str(&done.out).unwrap_or_else(|_| panic!("{}", done.err));
    (done.exit, json)
}

/// The step divides the controller's period, keeps below the stable one and is as accurate as asked; the line that
/// runs it does.
#[test]
fn what_is_advised_runs() {
    let options = ["--rate", "1kHz", "--accuracy", "0.1mm", "--window", "0.2s"];
    let (exit, advice) = advised(&options);
    assert_eq!(exit, Exit::Done);
    let number = |value: &Value| value.as_f64().unwrap_or_else(|| panic!("{advice:#}"));
    let way = &advice["way"];
    let (step, stable) = (number(&way["step"]), number(&advice["stable_step"]));
    let parts = 1e-3 / step;
    assert!((parts - parts.round()).abs() < 1e-9 && step < 0.86 * stable, "{advice:#}");
    assert!(number(&way["error"]) <= 1e-4 && number(&way["load"]) < 1.0);
    assert_eq!(advice["accuracy"], 1e-4);
    let words = call(&[&["advise", SCENE][..], &options].concat()).out;
    let line = words.lines().find(|line| line.starts_with("run it")).unwrap();
    let line: Vec<&str> = line.trim_start_matches("run it").split_whitespace().collect();
    let folder = Folder::new();
    let out = folder.path("out");
    let mut arguments = line[1..].to_vec();
    arguments.extend(["--out", out.to_str().unwrap(), "--duration", "0.2s", "--json"]);
    let done = call(&arguments);
    assert_eq!(done.exit, Exit::Done, "{line:?}: {}", done.err);
    // A run takes the advised way without a warning.
    assert!(!done.err.contains("warning"), "{}", done.err);
    let summary: Value = serde_json::from_str(&done.out).unwrap();
    assert_eq!(summary["status"], "ok", "{summary:#}");
}

/// Of a moment of the scene: what is advised is verified over ten times its duration.
const MOMENT: [&str; 4] = ["--window", "0.05s", "--set", "duration=0.1"];

/// What cannot be had ends with exit code 1 and the nearest that can.
#[test]
fn what_cannot_be_met_names_the_nearest() {
    let (exit, slow) = advised(&[&MOMENT[..], &["--clock", "100kHz"]].concat());
    assert_eq!(exit, Exit::Failed);
    assert_eq!(slow["meets"], false);
    let said = slow["shortfall"].as_str().unwrap();
    let load = slow["way"]["load"].as_f64().unwrap();
    assert!(load > 1.0 && said.contains("not in real time") && said.contains("it needs"), "{said}");
    let (exit, fine) = advised(&[&MOMENT[..], &["--accuracy", "1e-14"]].concat());
    assert_eq!(exit, Exit::Failed);
    let said = fine["shortfall"].as_str().unwrap();
    assert!(said.contains("the best has an error of"), "{said}");
}

/// Twice the clock is half the load; another precision or core has other instructions.
#[test]
fn the_load_is_of_the_microcontroller() {
    let load = |options: &[&str]| {
        let (_, advice) = advised(&[options, &MOMENT].concat());
        (advice["way"]["load"].as_f64().unwrap(), advice["way"]["instructions"].as_f64().unwrap())
    };
    let (slow, per_step) = load(&["--clock", "84MHz"]);
    let (fast, same) = load(&["--clock", "168MHz"]);
    assert!((slow / fast - 2.0).abs() < 1e-9 && per_step == same);
    let (_, soft) = load(&["--mcu", "cortex-m0plus"]);
    assert!(soft > 2.0 * same, "{soft} {same}");
}

#[test]
fn bad_requests_are_refused_with_what_would_do() {
    for (options, words) in [
        (&["--mcu", "z80"][..], "cortex-m33 (160 MHz)"),
        (&["--clock", "168kg"], "usual: cortex-m0plus (64 MHz)"),
        (&["--rate", "-1kHz"], "for example 1kHz"),
        (&["--accuracy", "0"], "for example 0.1mm"),
        (&["--accuracy", "1e-30"], "the reference solution is accurate to"),
        (&["--rate", "3.14159Hz"], "no step divides both the period"),
        (&["--window", "1000s"], "exceeds the scene's duration"),
    ] {
        let done = call(&[&["advise", SCENE][..], options].concat());
        assert_eq!((done.exit, done.err.contains(words)), (Exit::Refused, true), "{}", done.err);
    }
}
