//! `run --golden`: what is compared, what is refused, what is written.

use std::fs;
use std::path::PathBuf;

use dbd_golden::{Blessing, Recording};
use dbd_plant::Method;
use dbd_scene::Scene;
use host_sim::commands::golden::GoldenOptions;
use host_sim::commands::run::{Outcome, RunOptions, run};
use host_sim::terminal::Exit;

use crate::{Done, Folder, PENDULUM};

const STEP: f64 = 1e-3;
const OPTIONS: [&str; 6] = ["--step", "1ms", "--every", "50ms", "--duration", "0.5s"];

/// A run of the pendulum that blesses the file, in this process.
pub fn bless(file: &str, step: f64) -> Outcome {
    let scene = Scene::parse(PENDULUM, "scene.toml").unwrap();
    let golden = GoldenOptions { file: file.into(), bands: None, blessing: Blessing::Yes };
    let options = RunOptions {
        step: Some(step),
        every: Some(50.0 * STEP),
        golden: Some(golden),
        ..RunOptions::new(Method::default())
    };
    run(&scene, &options, &mut |_, _, _| ()).unwrap()
}

/// A folder with the scene's and the golden file's paths.
fn prepared() -> (Folder, String, String) {
    let folder = Folder::new();
    let (scene, file) = (folder.scene(PENDULUM), folder.path("a.golden"));
    let file = file.to_str().unwrap().to_owned();
    let outcome = bless(&file, STEP);
    assert_eq!(outcome.summary.golden.unwrap().verdict, "blessed");
    (folder, scene, file)
}

fn compared(folder: &Folder, scene: &str, file: &str, more: &[&str]) -> Done {
    folder.run(scene, &[&OPTIONS, &["--golden", file][..], more].concat())
}

#[test]
fn an_equal_run_says_so() {
    let (folder, scene, file) = prepared();
    let done = compared(&folder, &scene, &file, &[]);
    assert_eq!((done.exit, done.err.as_str()), (Exit::Done, ""));
    assert!(done.out.contains("a.golden: 11 samples equal, bit for bit"), "{}", done.out);
    let summary = folder.summary(&scene, &[&OPTIONS, &["--golden", &file][..]].concat());
    assert_eq!(
        (&summary["golden"]["verdict"], &summary["status"]),
        (&"equal".into(), &"ok".into())
    );
    // Without the option there is no key.
    assert_eq!(folder.summary(&scene, &OPTIONS).get("golden"), None);
}

#[test]
fn a_difference_is_an_error_with_step_body_and_component() {
    let (folder, scene, file) = prepared();
    // The golden run, nudged at step 200: a file that a run of these options does not give.
    let of = Scene::load(&scene).unwrap();
    let mut plant = dbd_plant::plant(&of, &Method::default(), STEP).unwrap();
    let mut recording = Recording::of_scene(&of, plant.as_ref(), 50, &[]).unwrap();
    while plant.steps() <= 500 {
        if plant.steps() == 200 {
            let mut state = plant.state();
            state.bodies[0].velocity.y += 0.5;
            plant.set_state(&state).unwrap();
        }
        recording.look(plant.as_ref()).unwrap();
        plant.advance(50).unwrap();
    }
    fs::write(&file, recording.text()).unwrap();
    let done = compared(&folder, &scene, &file, &[]);
    assert_eq!(done.exit, Exit::Failed);
    for part in [
        "a.golden: step 200 is different, step 150 was still equal: bob.vy is ",
        "ULP)",
        "1 of 13 numbers differ",
        "velocity          5.000e-1 m/s at most, bob",
        "a.golden.new",
        "help: the first step that differs is one of 151 to 200",
        "--every 1ms --duration 0.2s --golden",
    ] {
        assert!(done.err.contains(part), "{part}: {}", done.err);
    }
    // How the very step is found is told with the changes that the run has.
    let set = compared(&folder, &scene, &file, &["--set", "description=as it was"]);
    assert!(
        set.err.contains("scene.toml --set 'description=as it was' … --every 1ms"),
        "{}",
        set.err
    );
    // The run's own record lies beside, its results where they always lie.
    let new = PathBuf::from(format!("{file}.new"));
    assert!(fs::read_to_string(&new).unwrap().starts_with("# dbd golden 1\n"));
    let summary = fs::read_to_string(folder.path("out/scene/summary.json")).unwrap();
    assert!(summary.contains("\"verdict\": \"different\""), "{summary}");
    // Quiet is about results, not about errors.
    let quiet = compared(&folder, &scene, &file, &["--quiet"]);
    assert_eq!((quiet.exit, quiet.out.as_str()), (Exit::Failed, ""));
    assert!(quiet.err.contains("bob.vy"));
    // An equal run takes away what the last one left.
    bless(&file, STEP);
    assert_eq!(compared(&folder, &scene, &file, &[]).exit, Exit::Done);
    assert!(!new.exists());
}

#[test]
fn a_file_of_another_run_is_refused_before_anything_is_written() {
    let (folder, scene, file) = prepared();
    let text = fs::read_to_string(&file).unwrap();
    let refused = |more: &[&str], part: &str| {
        let options = [&["--golden", &file][..], more].concat();
        let done = folder.run(&scene, &options);
        assert_eq!(done.exit, Exit::Refused, "{part}: {}", done.err);
        assert!(done.err.contains(part) && done.err.contains("a.golden"), "{part}: {}", done.err);
        assert!(!folder.path("out").exists(), "{part}");
    };
    let with = |more: &[&'static str]| [&OPTIONS[..], more].concat();
    refused(&with(&["--scheme", "pefrl"]), "another scheme: leapfrog (sweeps, 1 per step)");
    refused(&with(&["--precision", "f32"]), "another precision: f64 (quaternion)");
    refused(&["--step", "0.5ms", "--every", "50ms"], "another step: 0.001 s");
    refused(&["--step", "1ms", "--every", "10ms"], "another sampling interval: every 50 steps");
    let other = [
        (text.replacen("golden 1", "golden 9", 1), "format version 9; expected 1"),
        (text.replacen("0.5", "0.6", 1), "line "),
        (text[..text.len() / 2].to_owned(), "truncated"),
        ("x = 1\n".to_owned(), "line 1: not a golden file"),
    ];
    for (damaged, part) in other {
        fs::write(&file, damaged).unwrap();
        refused(&with(&[]), part);
    }
    fs::write(&file, &text).unwrap();
    folder.scene(&PENDULUM.replace("mass = 0.5", "mass = 0.51"));
    refused(&with(&[]), "another model of the scene");
    folder.scene(&PENDULUM.replace("\"pendulum\"", "\"bell\""));
    refused(&with(&[]), "another scene: `pendulum`; the run is of `bell`");
    folder.scene(&PENDULUM.replace("\"bob\"", "\"ball\""));
    refused(&with(&[]), "`bob.x`; the run has `ball.x`");
    fs::remove_file(&file).unwrap();
    refused(&with(&[]), "DBD_BLESS=golden");
}

#[test]
fn bands_are_for_other_methods() {
    let (folder, scene, file) = prepared();
    let single = ["--precision", "f32", "--golden-band"];
    let with = |band: &str| compared(&folder, &scene, &file, &[&single[..], &[band]].concat());
    let done = with("1e-2");
    assert_eq!((done.exit, done.err.as_str()), (Exit::Done, ""));
    assert!(done.out.contains("11 samples within their bands"), "{}", done.out);
    let list = "position=1e-9,orientation=1,velocity=1,angular-velocity=1";
    let done = with(list);
    assert_eq!(done.exit, Exit::Failed);
    assert!(
        done.err.contains("the position is off by ") && done.err.contains("its band is 1e-9 m")
    );
    assert!(folder.path("a.golden.leapfrog-f32.new").exists());
    assert!(!done.err.contains("help:") && done.out.contains("a.golden: the run differs\n"));
    for (band, part) in [
        ("-1", "`-1` is not a valid band"),
        ("position=1", "no band for the orientation"),
        ("1,elbow=1", "a band is given for `elbow`, which is not recorded"),
    ] {
        let done = with(band);
        assert_eq!(done.exit, Exit::Refused);
        assert!(done.err.contains(part), "{part}: {}", done.err);
    }
    let alone = folder.run(&scene, &["--golden-band", "1"]);
    assert_eq!(alone.exit, Exit::Refused);
    assert!(alone.err.contains("--golden"));
}

/// A run that did not come to its end is no golden one.
#[test]
fn a_failed_run_is_neither_compared_nor_blessed() {
    let (folder, scene, file) = prepared();
    let text = fs::read_to_string(&file).unwrap();
    let outcome = bless(&file, 50.0 * STEP);
    assert!(outcome.failure.is_some() && outcome.summary.golden.is_none());
    assert_eq!(fs::read_to_string(&file).unwrap(), text);
    let done = compared(&folder, &scene, &file, &["--watch-energy", "1e-12"]);
    assert_eq!(done.exit, Exit::Failed);
    assert!(!done.err.contains("golden"), "{}", done.err);
}
