//! A live view beside `run`: the same bits, and what a hand, a slider and an editor do to a plant.

use std::path::Path;

use dbd_plant::instance::{Blueprint, Instance, Settings};
use dbd_plant::monitor::Monitor;
use dbd_plant::{FailedRun, plant};
use dbd_play::refused::Refused;
use dbd_play::session::{Change, Grab, MAX_TEXT, STATUS};
use dbd_play::{Desk, Session};
use serde_json::{Value, json};

fn scenes() -> Vec<(String, String)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes");
    let files = std::fs::read_dir(folder).unwrap().map(|file| file.unwrap().path());
    let mut files: Vec<_> =
        files.filter(|file| file.extension().is_some_and(|e| e == "toml")).collect();
    files.sort();
    let named = |file: &std::path::PathBuf| file.file_stem().unwrap().to_str().unwrap().to_owned();
    files.iter().map(|file| (named(file), std::fs::read_to_string(file).unwrap())).collect()
}

fn asked(scene: &str, precision: &str) -> Change {
    let (name, text) = scenes().into_iter().find(|(name, _)| name == scene).unwrap();
    let settings = Settings { precision: Some(precision.into()), ..Settings::default() };
    Change { file: format!("{name}.toml"), text, settings, set: Default::default() }
}

fn session(scene: &str) -> Session {
    Session::open(asked(scene, "f64")).unwrap()
}

fn hash(session: &Session) -> u64 {
    session.instance().hash()
}

#[test]
fn every_scene_has_the_bits_of_a_plant_and_the_words_of_its_refusals() {
    let (mut stepped, mut refused) = (0, 0);
    for (scene, text) in scenes() {
        for precision in ["f64", "f32", "fixed"] {
            let asked = asked(&scene, precision);
            let blueprint = Blueprint::new(asked.file.clone(), text.as_str());
            match (Session::open(asked.clone()), Instance::new(blueprint, asked.settings)) {
                (Ok(mut session), Ok(mut plain)) => {
                    assert_eq!(session.advance(700) + session.advance(300), 1000, "{scene}");
                    session.frame();
                    plain.advance(1000).unwrap();
                    assert_eq!(hash(&session), plain.hash(), "{scene} {precision}");
                    stepped += 1;
                }
                (Err(ours), Err(theirs)) => {
                    assert_eq!(ours, Refused::from(theirs));
                    refused += 1;
                }
                (ours, theirs) => {
                    panic!("{scene} {precision}: {} {}", ours.is_ok(), theirs.is_ok())
                }
            }
        }
    }
    assert!(stepped > 60 && stepped + refused == 3 * scenes().len(), "{stepped} {refused}");
}

/// What was set by hand, as tables of the scene, makes the same run.
#[test]
fn inputs_that_were_set_are_tables_that_make_the_same_run() {
    let mut session = session("cart-pendulum");
    session.set_input(0, 3.5).unwrap();
    session.advance(10);
    session.set_input(0, -1.25).unwrap();
    session.set_input(0, -2.0).unwrap();
    session.advance(90);
    session.set_input(0, 0.0).unwrap();
    session.advance(50);
    let text = session.replay();
    assert!(text.contains("table = [[0.0, 3.5], [0.005, -2.0], [0.05, 0.0]]"), "{text}");
    let mut again = Session::open(Change { text, ..asked("cart-pendulum", "f64") }).unwrap();
    again.advance(150);
    let [ours, theirs] = [&session, &again].map(|of| of.instance().plant().state().bodies);
    assert_eq!(ours, theirs);
    // A second table in place of the first.
    session.reset();
    assert_eq!(session.replay(), asked("cart-pendulum", "f64").text);
}

#[test]
fn what_keeps_the_pose_changes_in_mid_run_and_nothing_else() {
    let mut session = session("four-bar");
    session.advance(1000);
    let (time, before) = (session.instance().time(), hash(&session));
    let mut asked = session.asked().clone();
    asked.set.insert("joint.*.stiffness".into(), 2e6);
    assert_eq!(session.change(asked.clone()).unwrap(), None);
    assert_eq!((session.instance().time(), hash(&session)), (time, before));
    session.advance(10);
    assert_ne!(hash(&session), {
        let mut other = self::session("four-bar");
        other.advance(1010);
        hash(&other)
    });
    // A step of half the size: the time stays.
    asked.settings.step = Some(1e-5);
    let time = session.instance().time();
    assert_eq!(session.change(asked.clone()).unwrap(), None);
    assert!((session.instance().time() - time).abs() < 1e-12);
    assert_eq!(session.instance().step_size(), 1e-5);
    for (scheme, precision) in [("pefrl", "f64"), ("leapfrog", "f32"), ("rk4", "f32")] {
        asked.settings.scheme = Some(scheme.into());
        asked.settings.precision = Some(precision.into());
        assert_eq!(session.change(asked.clone()).unwrap(), None, "{scheme}");
        assert_eq!(session.advance(100), 100);
    }
    // Another text with the same parts goes on, one with another pose does not.
    asked.text += "# the same\n";
    assert_eq!(session.change(asked.clone()).unwrap(), None);
    assert!(session.instance().time() > 0.02);
    let now = (session.instance().time(), hash(&session));
    for wrong in ["body.nobody.mass", "duration"] {
        let mut wrong_asked = asked.clone();
        wrong_asked.set.insert(wrong.into(), -1.0);
        let refused = session.change(wrong_asked).unwrap_err();
        assert_eq!((refused.line, refused.column), (None, None), "{refused:?}");
    }
    let broken = Change { text: asked.text.replace("duration =", "duratoin ="), ..asked.clone() };
    let refused = session.change(broken).unwrap_err();
    assert!(refused.line.is_some() && refused.column.is_some(), "{refused:?}");
    assert_eq!((session.instance().time(), hash(&session)), now);
    let other = self::asked("gripper", "f64");
    let why = session.change(other).unwrap().unwrap();
    assert_eq!((why.as_str(), session.instance().time()), ("it has other bodies or joints", 0.0));
}

#[test]
fn going_back_to_a_mark_goes_back_to_its_bits_and_settings() {
    let mut session = session("3ruu");
    let mut seen = Vec::new();
    for _ in 0..5 {
        session.mark();
        seen.push(hash(&session));
        session.advance(20);
    }
    let mut asked = session.asked().clone();
    asked.settings.precision = Some("f32".into());
    session.change(asked).unwrap();
    session.advance(20);
    let (marks, [first, last]) = session.mark();
    assert_eq!((marks, first), (6, 0.0));
    assert!(last > first);
    session.rewind(3).unwrap();
    assert_eq!(hash(&session), seen[3]);
    assert_eq!(session.asked().settings.precision.as_deref(), Some("f64"));
    session.advance(20);
    assert_eq!(hash(&session), seen[4]);
    session.rewind(9).unwrap_err();
    // The oldest make room.
    for _ in 0..700 {
        session.advance(1);
        session.mark();
    }
    let (marks, [first, _]) = session.mark();
    assert!(marks == 600 && first > 0.0);
}

#[test]
fn a_hand_pulls_a_body_to_it_and_its_work_is_counted() {
    for (scene, row) in [("3ruu", 2), ("four-bar", 1), ("gripper", 0)] {
        let mut session = session(scene);
        let start = session.instance().plant().state().bodies[row].position.to_f64();
        let target = [start[0] + 0.02, start[1] + 0.01, start[2] + 0.01];
        let grab = Grab { body: row, point: [0.0; 3], target, speed: 0.05 };
        session.grab(Some(grab)).unwrap();
        assert_eq!(session.advance(3000), 3000, "{scene}");
        session.grab(None).unwrap();
        let (energy, work) = {
            let frame = session.frame();
            (frame[5] - frame[8], frame[9])
        };
        assert!(work != 0.0, "{scene}");
        let kinetic = session.frame()[3];
        let scale = work.abs() + kinetic;
        let damped = session.instance().scene().model.dampers.iter().any(|c| *c > 0.0);
        assert!(damped || (energy - work).abs() < 0.02 * scale, "{scene}: {energy} J, {work} J");
    }
    let mut session = session("four-bar");
    let grab = Grab { body: 0, point: [0.0; 3], target: [f64::NAN; 3], speed: 1.0 };
    session.grab(Some(grab)).unwrap_err();
    session.grab(Some(Grab { body: 99, target: [0.0; 3], ..grab })).unwrap_err();
    session.grab(Some(Grab { speed: 0.0, target: [0.0; 3], ..grab })).unwrap_err();
    // However hard it is pulled, nothing breaks.
    session.grab(Some(Grab { target: [1e6; 3], speed: 1e-3, ..grab })).unwrap();
    session.advance(2000);
    session.frame();
}

/// In the words of `run`, with the step that it names; and a reset forgets it.
#[test]
fn a_run_that_fails_says_why_as_run_does() {
    let mut asked = asked("four-bar", "f64");
    asked.settings.step = Some(5e-4);
    let mut session = Session::open(asked.clone()).unwrap();
    assert!(session.diagnose().is_none());
    assert!(session.advance(10_000) < 10_000 && session.has_failed());
    assert_eq!(session.advance(1), 0);
    assert_eq!(session.frame()[2], 1.0);
    let (text, help) = session.diagnose().unwrap();
    // As `run` does it.
    let scene = session.instance().scene();
    let request = dbd_plant::plan::Request {
        step: dbd_plant::plan::StepRequest::Given(5e-4),
        duration: scene.duration,
        every: scene.every,
    };
    let plan = dbd_plant::plan::plan(&request).unwrap();
    let method = *session.instance().plant().method();
    let mut plain = plant(scene, &method, plan.step).unwrap();
    let mut monitor = Monitor::new(scene, plain.as_ref());
    let run_failure = loop {
        if let Err(run_failure) = monitor.check(&plain.state()) {
            break run_failure;
        }
        if let Err(failure) = plain.advance(plan.unseen()) {
            break dbd_plant::monitor::RunFailure::Step(failure.cause);
        }
    };
    let run =
        FailedRun::new(scene, &method, &plan, None, plain.steps(), run_failure, &mut |_, _| ());
    assert_eq!((text, help), (run.to_string(), run.advice()));
    assert!(run.to_string().starts_with("step too large"), "{run}");
    session.reset();
    assert!(!session.has_failed() && session.instance().time() == 0.0);
    asked.settings.step = Some(2e-5);
    session.change(asked).unwrap();
    assert_eq!(session.advance(1000), 1000);
}

#[test]
fn a_state_is_taken_up_elsewhere() {
    let mut session = session("3ruu");
    session.advance(123);
    let bytes = session.save().unwrap();
    let at = hash(&session);
    session.advance(50);
    let later = hash(&session);
    let asked = session.asked();
    let blueprint = Blueprint::new(asked.file.clone(), asked.text.as_str());
    let mut plain = Instance::new(blueprint, asked.settings.clone()).unwrap();
    plain.restore(&bytes).unwrap();
    assert_eq!(plain.hash(), at);
    plain.advance(50).unwrap();
    assert_eq!(plain.hash(), later);
    session.restore(&bytes).unwrap();
    assert_eq!(hash(&session), at);
    // Inputs of before are none of the restored run.
    let mut cart = self::session("cart-pendulum");
    let start = cart.save().unwrap();
    cart.set_input(0, 1.0).unwrap();
    cart.restore(&start).unwrap();
    assert_eq!(cart.replay(), self::asked("cart-pendulum", "f64").text);
    let mut damaged = bytes.clone();
    damaged[40] ^= 1;
    session.restore(&damaged).unwrap_err();
    assert_eq!(hash(&session), at);
}

#[test]
fn requests_are_answered_in_json_and_what_is_none_is_refused() {
    let mut desk = Desk::default();
    let mut ask = |request: Value| -> Value {
        serde_json::from_str(&desk.ask(&request.to_string())).unwrap()
    };
    let message =
        |answer: &Value| answer["error"]["message"].as_str().unwrap_or_default().to_owned();
    assert_eq!(message(&ask(json!({ "do": "reset" }))), "no scene is open");
    let text = asked("gripper", "f64").text;
    let opened = ask(json!({ "do": "open", "file": "gripper.toml", "text": text }));
    let layout = &opened["layout"];
    assert_eq!((&layout["poses"], &opened["restarted"]), (&json!(STATUS), &json!(true)));
    assert!(opened["run"]["mechanism"]["bodies"].as_array().unwrap().len() > 3);
    assert!(opened["numbers"].as_array().unwrap().len() > 20);
    let wrong = ask(json!({ "do": "change", "text": text.replace("[[body]]", "[[bodi]]") }));
    assert!(wrong["error"]["line"].as_u64().is_some() && !message(&wrong).is_empty(), "{wrong}");
    for wrong in [
        json!({ "do": "fly" }),
        json!({ "do": "input", "row": 9, "value": 1.0 }),
        json!({ "do": "watch", "rows": [100_000] }),
        json!({ "do": "restore", "base64": "%%" }),
        json!({ "do": "change", "settings": { "step": -1.0 } }),
        json!({ "do": "change", "settings": { "scheme": "none" } }),
        json!({ "do": "change", "set": { "no.such": 1.0 } }),
        json!("reset"),
    ] {
        assert!(!message(&ask(wrong.clone())).is_empty(), "{wrong}");
    }
    let row = ask(json!({ "do": "row" }));
    assert_eq!(
        row["values"].as_array().unwrap().len(),
        opened["outputs"].as_array().unwrap().len()
    );
    for request in ["release", "mark", "save", "table", "scene", "diagnose", "reset"] {
        assert!(ask(json!({ "do": request })).get("error").is_none(), "{request}");
    }
    let long = "#".repeat(MAX_TEXT + 1);
    let answer = ask(json!({ "do": "open", "file": "long.toml", "text": long }));
    assert!(message(&answer).contains("too long for the page"));
}
