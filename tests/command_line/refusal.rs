//! Bad input and runs that fail: what is said, and what is left.

use std::fs;

use host_sim::terminal::Exit;
use serde_json::Value;

use crate::{Folder, PENDULUM, call, times_in};

#[test]
fn bad_input_ends_with_2_and_writes_nothing() {
    let folder = Folder::new();
    let good = folder.scene(PENDULUM);
    let bad = folder.path("bad.toml");
    fs::write(&bad, PENDULUM.replace("mass = 0.5", "mass = -0.5")).unwrap();
    let bad = bad.to_str().unwrap();
    let cases: [(&str, &[&str], &str); 23] = [
        ("fuor-bar", &[], "did you mean four-bar?"),
        ("no-such-thing", &[], "four-bar"),
        ("no/such/file.toml", &[], "no/such/file.toml"),
        (bad, &[], "mass"),
        (&good, &["--step", "2e-5kg"], "20us"),
        (&good, &["--step", "0"], "positive"),
        (&good, &["--step", "fast"], "20us"),
        (&good, &["--step", "-1ms"], "positive"),
        (&good, &["--duration", "0s"], "positive"),
        (&good, &["--step", "1e-300s"], "--step"),
        (&good, &["--step", "1us", "--every", "1ns"], "--step"),
        (&good, &["--every", "1s"], "--every 0.5s"),
        (&good, &["--newton", "1"], "--scheme dbd"),
        (&good, &["--scheme", "dbd-p2", "--newton", "9"], "--newton 8"),
        (&good, &["--rho", "0.5"], "--scheme generalized-alpha"),
        (&good, &["--scheme", "generalized-alpha", "--rho", "0.9"], "0.8 (least)"),
        (&good, &["--scheme", "generalized-alpha", "--rho", "-0.1"], "not -0.1"),
        (&good, &["--scheme", "pefrl", "--damping", "explicit"], "leapfrog"),
        (&good, &["--scheme", "dbd", "--damping", "sweeps"], "--damping"),
        (&good, &["--scheme", "simplectic"], "leapfrog"),
        (&good, &["--precision", "f16"], "f32"),
        (&good, &["--precision", "fixed", "--orientation", "euler-321"], "quaternions"),
        (&good, &["--hurry"], "--hurry"),
    ];
    for (scene, options, named) in cases {
        let done = folder.run(scene, options);
        assert_eq!(done.exit, Exit::Refused, "{scene} {options:?}");
        assert!(done.err.contains(named), "{scene} {options:?}: {}", done.err);
        assert_eq!(done.out, "");
        assert!(!folder.path("out").exists(), "{scene} {options:?}");
    }
    let tiny = ["--precision", "f32", "--step", "1e-60s", "--duration", "1e-55s"];
    let done = folder.run(&good, &tiny);
    assert_eq!(done.exit, Exit::Refused);
    assert!(done.err.contains("--precision f64") && !folder.path("out").exists(), "{}", done.err);
}

/// Beyond what a matrix bears in single precision the longest step is named, and it runs.
#[test]
fn a_step_beyond_what_a_matrix_bears_is_refused_with_the_longest_one() {
    let folder = Folder::new();
    let stiff = ["--precision", "f32", "--set", "joint.*.stiffness=9e10", "--duration", "50ms"];
    let stiff = [&["--scheme", "generalized-alpha"], &stiff[..]].concat();
    let done = folder.run("four-bar", &[&stiff[..], &["--step", "1ms"]].concat());
    assert_eq!(done.exit, Exit::Refused, "{}", done.out);
    let (_, rest) = done.err.split_once("the longest step is ").unwrap();
    assert!(done.err.contains("too stiff for this step in f32"), "{}", done.err);
    let most = rest.lines().next().unwrap().trim_end();
    let named: f64 = most.strip_suffix("us").unwrap().parse().unwrap();
    assert!((250.0..300.0).contains(&named), "{named}");
    let done = folder.run("four-bar", &[&stiff[..], &["--step", "250us"]].concat());
    assert_eq!(done.exit, Exit::Done, "{}", done.err);
    let exported = call(&[&["export", "four-bar", "--step", "1ms"], &stiff[..6]].concat());
    assert!(exported.err.contains(&format!("the longest step is {most}")), "{}", exported.err);
    // Where no step is given, one that is borne is taken.
    let text = fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/../scenes/four-bar.toml"));
    let stepless = folder.scene(&text.unwrap().replace("\nstep = 2e-5", ""));
    let done = folder.run(&stepless, &stiff);
    assert_eq!(done.exit, Exit::Done, "{}", done.err);
}

/// What fixed point does not hold is named with the numbers, and with what would be right.
#[test]
fn what_fixed_point_does_not_hold_is_refused() {
    let folder = Folder::new();
    let scene = folder.scene(PENDULUM);
    let fixed = ["--precision", "fixed"];
    for (change, said) in [
        ("body.bob.position=[0, 30, 0]", "`bob` lies 30 m from the origin along an axis"),
        ("planar=true", "planar scenes do not support fixed"),
    ] {
        let done = folder.run(&scene, &[&fixed[..], &["--set", change]].concat());
        assert_eq!(done.exit, Exit::Refused, "{change}: {}", done.out);
        for part in [said, "--precision f64"] {
            assert!(done.err.contains(part), "{change}: {}", done.err);
        }
        assert!(!folder.path("out").exists(), "{change}");
    }
    let done = folder.run(&scene, &fixed);
    assert_eq!((done.exit, done.err.as_str()), (Exit::Done, ""));
}

#[test]
fn a_refused_scene_is_shown_with_file_line_and_column() {
    let folder = Folder::new();
    let scene = folder.scene(&PENDULUM.replace("mass = 0.5", "mass = -0.5"));
    for command in ["run", "check"] {
        let done = call(&[command, &scene]);
        assert_eq!(done.exit, Exit::Refused);
        assert!(done.err.contains("scene.toml:9:8"), "{}", done.err);
    }
}

/// A setting of the scene that cannot be planned is shown where it stands; one that was asked for
/// has no place there.
#[test]
fn a_setting_that_cannot_be_planned_is_shown_at_its_line() {
    let folder = Folder::new();
    for (given, named) in [
        ("duration = 0.5\nevery = 1e-20", "scene.toml:6:9"),
        ("duration = 0.5\nevery = 1e-150", "scene.toml:6:9"),
        ("duration = 0.5\nevery = 7", "scene.toml:6:9"),
        ("duration = 0.5\nevery = 1.2347e-3", "scene.toml:6:9"),
        ("duration = 0.5\nstep = 1e-300", "scene.toml:6:8"),
        ("duration = 0.5\nstep = 3e-5", "scene.toml:6:8"),
        ("duration = 1e300", "scene.toml:5:12"),
        ("duration = 1e-320", "scene.toml:5:12"),
    ] {
        let done = folder.run(&folder.scene(&PENDULUM.replace("duration = 0.5", given)), &[]);
        assert_eq!(done.exit, Exit::Refused, "{given}");
        assert!(done.err.contains(named) && done.err.contains("help"), "{given}: {}", done.err);
        assert!(!folder.path("out").exists(), "{given}");
    }
    let done = folder.run(&folder.scene(PENDULUM), &["--every", "1e-20s"]);
    assert_eq!(done.exit, Exit::Refused);
    let every = times_in(&done.err, "--every");
    assert!(done.err.contains("samples") && every.len() == 1, "{}", done.err);
    assert!(!done.err.contains("scene.toml"), "{}", done.err);
    assert_eq!(folder.summary(&folder.scene(PENDULUM), &["--every", &every[0]])["status"], "ok");
}

#[test]
fn a_step_that_does_not_fit_names_two_that_do() {
    let folder = Folder::new();
    let cases: [&[&str]; 3] =
        [&["--step", "0.3ms"], &["--step", "0.3ms", "--every", "1ms"], &["--step", "0.7s"]];
    // Soft enough for any step.
    let scene = folder.scene(&PENDULUM.replace("stiffness = 2e3", "stiffness = 1e-6"));
    for options in cases {
        let done = folder.run(&scene, options);
        assert_eq!(done.exit, Exit::Refused);
        let steps = times_in(&done.err, "--step");
        assert_eq!(steps.len(), 2, "{}", done.err);
        for step in steps {
            let summary = folder.summary(&scene, &[&["--step", &step], &options[2..]].concat());
            assert_eq!(summary["status"], "ok", "{step}");
            assert_eq!(summary["duration"], 0.5);
        }
    }
}

#[test]
fn a_run_that_diverges_says_where_and_which_step_works() {
    let folder = Folder::new();
    let done = folder.run("four-bar", &["--step", "200us"]);
    assert_eq!(done.exit, Exit::Failed);
    for part in ["body `crank`", "t = 800us", "step 4 of 2500", "200us"] {
        assert!(done.err.contains(part), "{}", done.err);
    }
    let files = ["trace.csv", "summary.json", "report.html"];
    for file in files {
        assert!(folder.path("out/four-bar").join(file).is_file(), "{file}");
    }
    assert_eq!(fs::read_dir(folder.path("out/four-bar")).unwrap().count(), files.len());
    let trace = folder.trace("four-bar");
    assert_eq!(trace.times(), [0.0]);
    for row in &trace.rows {
        assert!(row.iter().all(|text| text.parse::<f64>().unwrap().is_finite()));
    }
    let written = fs::read_to_string(folder.path("out/four-bar/summary.json")).unwrap();
    let summary: Value = serde_json::from_str(&written).unwrap();
    assert_eq!((&summary["steps"], &summary["duration"]), (&4.into(), &8e-4.into()));
    let steps = times_in(&done.err, "--step");
    let [step] = steps.as_slice() else { panic!("{}", done.err) };
    let status = summary["status"].as_str().unwrap();
    assert!(status.contains("crank") && status.contains(step), "{status}");

    let summary = folder.summary("four-bar", &["--step", step]);
    assert_eq!((&summary["status"], &summary["duration"]), (&"ok".into(), &0.5.into()));
    assert_eq!(folder.trace("four-bar").times().len(), 501);
}

/// Where not even the start can be judged there is no state to speak of.
#[test]
fn a_run_without_a_sample_has_no_hash() {
    let folder = Folder::new();
    let heavy = PENDULUM.replace("mass = 0.5", "mass = 50").replace("-9.81", "-1e308");
    let scene = folder.scene(&heavy);
    let done = folder.run(&scene, &["--json", "--step", "1ms"]);
    assert_eq!(done.exit, Exit::Failed);
    let summary: Value = serde_json::from_str(&done.out).unwrap();
    for key in ["state_hash", "energy_initial", "energy_final"] {
        assert_eq!(summary[key], Value::Null, "{key}");
    }
}

#[test]
fn a_step_is_named_only_after_it_was_tried() {
    let folder = Folder::new();
    // An explicit damper of c/m = 1000/s needs h < 2 ms, of which the frequency knows nothing.
    let text = PENDULUM.replace("free_length = 1.0", "free_length = 1.0\ndamping = 500.0");
    let scene = folder.scene(&text);
    let advised = folder.summary(&folder.scene(PENDULUM), &[])["advised_step"].as_f64().unwrap();
    assert!(advised > 8e-3);
    folder.scene(&text);
    // It ends long before anything is infinite.
    let done = folder.run(&scene, &["--scheme", "dbd"]);
    assert_eq!(done.exit, Exit::Failed, "{}", done.out);
    assert!(done.err.contains("body `bob`"), "{}", done.err);
    let steps = times_in(&done.err, "--step");
    let [step] = steps.as_slice() else { panic!("{}", done.err) };
    let summary = folder.summary(&scene, &["--scheme", "dbd", "--step", step]);
    assert_eq!(summary["status"], "ok");
    assert!(summary["step"].as_f64().unwrap() < advised / 3.0, "{step}");
}

#[test]
fn an_input_beyond_the_precision_is_refused_by_name() {
    let folder = Folder::new();
    let input = "[[input]]\nname = \"gust\"\ntype = \"force\"\nbody = \"bob\"\naxis = [1, 0, 0]\n";
    for drive in ["value = 1e300", "table = [[0, 0], [1e-30, 1e10]]\ninterpolate = \"linear\""] {
        let scene = folder.scene(&format!("{PENDULUM}{input}{drive}\n"));
        let done = folder.run(&scene, &["--precision", "f32"]);
        assert_eq!(done.exit, Exit::Refused, "{}", done.err);
        for part in ["input `gust` (line 18)", "out of the range of f32", "--precision f64"] {
            assert!(done.err.contains(part), "{part}: {}", done.err);
        }
        assert!(!folder.path("out").exists());
        assert_eq!(call(&["export", &scene, "--precision", "f32"]).exit, Exit::Refused);
        assert_eq!(call(&["export", &scene, "--precision", "f64"]).exit, Exit::Done);
    }
}
