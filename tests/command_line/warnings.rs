//! What is probably not meant is said wherever it is met: table, report, JSON; exit codes stay.

use std::fs;

use dbd_plant::Method;
use dbd_tests::{scene, scene_names, scene_text};
use host_sim::commands::run::{RunOptions, run};
use host_sim::terminal::Exit;
use serde_json::Value;

use crate::{Folder, PENDULUM, call};

fn warnings(summary: &Value) -> Vec<String> {
    let warnings = summary["warnings"].as_array().unwrap();
    warnings.iter().map(|warning| warning.as_str().unwrap().to_owned()).collect()
}

/// Each scene as it ships: nothing is said of it, before a run or in its first tenth.
#[test]
fn nothing_is_said_of_the_scenes_that_ship() {
    for name in scene_names() {
        let checked: Value = serde_json::from_str(&call(&["check", &name, "--json"]).out).unwrap();
        assert_eq!(warnings(&checked), [""; 0], "{name}");
        let scene = scene(&name);
        let options = RunOptions {
            duration: Some(0.1 * scene.duration),
            ..RunOptions::new(Method::default())
        };
        let outcome =
            run(&scene, &RunOptions { every: options.duration, ..options }, &mut |_, _, _| ());
        let summary = outcome.unwrap().summary;
        assert_eq!((summary.warnings, summary.status.as_str()), (Vec::new(), "ok"), "{name}");
    }
}

/// Stiffnesses of joints in N/mm, of one and of all: `check` says so, and a run bears it out.
#[test]
fn joints_that_are_too_soft_are_found_before_a_run() {
    let folder = Folder::new();
    for (name, joints) in
        [("four-bar", 1), ("four-bar", 4), ("crank-slider", 4), ("hanging-chain", 20)]
    {
        let mut text = String::new();
        let (mut table, mut changed) = (String::new(), 0);
        for line in scene_text(name).lines() {
            if line.starts_with("[[") {
                table = line.to_owned();
            }
            match line.strip_prefix("stiffness = ") {
                Some(stiffness) if table == "[[joint]]" && changed < joints => {
                    changed += 1;
                    text += &format!("stiffness = {stiffness}e-3\n")
                        .replace("e6e-3", "e3")
                        .replace("e5e-3", "e2");
                }
                _ => text += &format!("{line}\n"),
            }
        }
        let scene = folder.scene(&text);
        let checked: Value = serde_json::from_str(&call(&["check", &scene, "--json"]).out).unwrap();
        let said = warnings(&checked);
        let [soft] = &said[..] else { panic!("{name}: {said:#?}") };
        for part in ["deflects by ", "(line ", "stiffness in N/m"] {
            assert!(soft.contains(part), "{name}, {part}: {soft}");
        }
        let summary =
            folder.summary(&scene, &["--duration", "0.5s", "--step", "1ms", "--every", "0.25s"]);
        assert!(warnings(&summary).len() > 1, "{name}: {summary}");
    }
}

/// The gripper with its masses in grams: light inertias for heavy bodies, which fall out of their
/// joints.
#[test]
fn a_run_says_what_check_says_and_which_joint_opened_when_and_how_far() {
    let folder = Folder::new();
    let text = scene_text("gripper");
    let lines = text.lines().map(|line| match line.strip_prefix("mass = ") {
        Some(mass) => format!("mass = {}e3", mass.split_whitespace().next().unwrap()),
        None => line.to_owned(),
    });
    let scene = folder.scene(&lines.collect::<Vec<_>>().join("\n"));
    let checked: Value = serde_json::from_str(&call(&["check", &scene, "--json"]).out).unwrap();
    let expected = warnings(&checked);
    assert!(expected.len() >= 7, "{expected:#?}");

    let options = ["--duration", "60ms"];
    let done = folder.run(&scene, &options);
    assert_eq!(done.exit, Exit::Done);
    let summary = folder.summary(&scene, &options);
    assert_eq!(summary["status"], "ok");
    let said = warnings(&summary);
    let [opened] = &said.iter().filter(|text| !expected.contains(text)).collect::<Vec<_>>()[..]
    else {
        panic!("{said:#?}")
    };
    let widest = &summary["widest_joint"];
    let joint = widest["name"].as_str().unwrap();
    let [extension, length, time] =
        ["extension", "free_length", "time"].map(|key| widest[key].as_f64().unwrap());
    assert!(extension > 0.5 * length && time > 0.02 && time <= 0.06, "{widest}");
    for part in [&format!("joint `{joint}` opened by "), "% of its free length", "from t = 2"] {
        assert!(opened.contains(part), "{part}: {opened}");
    }
    let report = fs::read_to_string(folder.path("out/scene/report.html")).unwrap();
    for warning in &said {
        assert!(done.out.contains(warning), "{warning}: {}", done.out);
        assert!(report.contains(warning), "{warning}");
    }
    for warning in &expected {
        assert!(said.contains(warning), "{warning}");
    }
}

#[test]
fn the_widest_joint_is_that_of_the_trace() {
    let folder = Folder::new();
    let summary = folder.summary("four-bar", &["--duration", "20ms", "--every", "20us"]);
    let widest = &summary["widest_joint"];
    // Every step is a sample, there is no clearance, and all four are of one size: the widest is the
    // one that stretches most.
    assert_eq!(widest["extension"], summary["max_joint_extension"]);
    assert!((widest["free_length"].as_f64().unwrap() - 0.03_f64.sqrt()).abs() < 1e-12);
    assert_eq!(warnings(&summary), [""; 0]);
    let scene = folder.scene(PENDULUM);
    assert_eq!(folder.summary(&scene, &[])["widest_joint"], Value::Null);
    // Bushings have no free length of which they could open a share.
    let bushings = ["--set", "realisation=bushing", "--duration", "20ms"];
    let summary = folder.summary("four-bar", &bushings);
    assert_eq!((&summary["widest_joint"], warnings(&summary)), (&Value::Null, vec![]));
}

#[test]
fn a_step_beyond_the_limit_is_warned_of_by_run_and_check() {
    let folder = Folder::new();
    // ω² = k/m = 4000 1/s²: leapfrog bears 2/ω = 31.6 ms, rk4 44.7 ms.
    let run = |options: &[&str]| {
        let summary = folder.summary(&folder.scene(PENDULUM), options);
        let mut warnings = warnings(&summary);
        assert!(warnings.len() < 2, "{warnings:#?}");
        warnings.pop()
    };
    let beyond = ["--step", "50ms", "--duration", "0.1s"];
    let said = run(&beyond).unwrap();
    for part in
        ["the step of 50ms exceeds the stability limit of leapfrog", "ω·h = 3.16", "the limit is 2"]
    {
        assert!(said.contains(part), "{part}: {said}");
    }
    assert!(run(&[&beyond[..], &["--scheme", "rk4"]].concat()).unwrap().contains("2.828"));
    for within in
        [&["--step", "31.25ms"][..], &["--scheme", "rk4", "--step", "41.6666666666666667ms"]]
    {
        assert_eq!(run(&[within, &["--duration", "0.125s"]].concat()), None, "{within:?}");
    }
    let scene = folder.scene(&PENDULUM.replace("duration = 0.5", "duration = 0.5\nstep = 0.05"));
    let checked = call(&["check", &scene]).out;
    assert!(
        checked.contains("the scene's step of 50ms exceeds the stability limit of leapfrog"),
        "{checked}"
    );
}

#[test]
fn a_step_too_short_for_single_precision_is_warned_of() {
    let folder = Folder::new();
    let said = |scheme: &str, precision: &str, step: &str| {
        let options = ["--scheme", scheme, "--precision", precision, "--step", step];
        let summary = folder.summary("hexagon", &[&options[..], &["--duration", "1ms"]].concat());
        warnings(&summary)
    };
    for (scheme, precision, step, warned) in [
        ("pefrl", "f32", "4us", true),
        ("pefrl", "f32", "10us", false),
        ("pefrl", "f64", "4us", false),
        ("leapfrog", "f32", "10us", false),
        ("leapfrog", "f32", "1us", true),
        ("rk4", "f32", "1us", true),
        ("semi-implicit-euler", "f32", "1us", false),
        ("semi-implicit-euler", "f32", "200ns", true),
        ("dbd", "f32", "200ns", true),
        ("dbd", "f64", "200ns", false),
    ] {
        let said = said(scheme, precision, step);
        assert_eq!(said.len(), usize::from(warned), "{scheme}, {precision}, {step}: {said:#?}");
        assert!(said.iter().all(|text| text.contains("is short for")), "{said:#?}");
    }
}

/// Strong dampers: a composition is warned of any, the others of those that cross. The step that is
/// named brings the warning to an end, and `check` says what `run` says.
#[test]
fn dampers_too_strong_for_a_step_are_warned_of() {
    let folder = Folder::new();
    let scene = |mount: &str| {
        folder.scene(&format!(
            "name = \"creep\"\nduration = 0.1\nstep = 1e-3\n[[body]]\nname = \"b\"\nmass = 1\n\
             inertia = [0.01, 0.01, 0.01]\nposition = [0, 0, 0]\n{mount}"
        ))
    };
    let strong = |summary: &Value| -> Vec<String> {
        let all = warnings(summary);
        all.into_iter().filter(|warning| warning.contains("h·c/μ")).collect()
    };
    let said = |scene: &str, scheme: &str, step: &str| {
        strong(&folder.summary(scene, &["--scheme", scheme, "--step", step]))
    };
    let tsda = scene(
        "[[tsda]]\nname = \"dashpot\"\nbetween = [\"world\", \"b\"]\npoints = [[0, 0, 1], [0, 0, 0]]\n\
         stiffness = 1e3\ndamping = 1e4\nfree_length = 1\n",
    );
    for scheme in ["leapfrog", "semi-implicit-euler"] {
        assert_eq!(said(&tsda, scheme, "1ms"), [""; 0], "{scheme}");
    }
    for scheme in ["pefrl", "blanes-moan-s6"] {
        let [warning] = &said(&tsda, scheme, "1ms")[..] else { panic!("{scheme}") };
        assert!(warning.starts_with("the step of 1ms is long for the dampers of "), "{warning}");
        assert!(
            warning.contains("dashpot") && warning.contains("(line 9): h·c/μ = 10;"),
            "{warning}"
        );
        assert!(
            warning.ends_with(&format!("with {scheme}: use leapfrog, or a step of at most 30us"))
        );
        assert_eq!(said(&tsda, scheme, "20us"), [""; 0], "{scheme}");
    }
    let revolute = scene(
        "[[joint]]\nname = \"hinge\"\ntype = \"revolute\"\nbetween = [\"world\", \"b\"]\n\
         at = [0, 0, 0]\naxis = [0, 0, 1]\nspan = 0.1\nstiffness = 1e5\ndamping = 1e4\n",
    );
    let [warning] = &said(&revolute, "leapfrog", "1ms")[..] else { panic!() };
    assert!(warning.contains("joint `hinge` (line 9)"), "{warning}");
    let (_, advice) = warning.split_once("if dampers interact: use a step of at most ").unwrap();
    let advised: f64 = advice.strip_suffix("us, or generalized-alpha").unwrap().parse().unwrap();
    assert!((100.0..200.0).contains(&advised), "{advice}");
    assert_eq!(said(&revolute, "leapfrog", "100us"), [""; 0]);
    assert_eq!(said(&revolute, "leapfrog", "200us").len(), 1);
    // Joint by joint nothing crosses in a joint, nor do its two dampers in the plane.
    let options = ["--damping", "joint-wise", "--step", "1ms"];
    assert_eq!(strong(&folder.summary(&revolute, &options)), [""; 0]);
    let options = ["--set", "planar=true", "--step", "1ms"];
    assert_eq!(strong(&folder.summary(&revolute, &options)), [""; 0]);
    let checked: Value = serde_json::from_str(&call(&["check", &revolute, "--json"]).out).unwrap();
    let checked = warnings(&checked);
    let theirs = warning.strip_prefix("the step").unwrap();
    assert!(checked.iter().any(|ours| ours.ends_with(theirs)), "{checked:?} {warning}");
    // A damper that leans against the joint's crosses its levers, in space and in the plane.
    let leaning = scene(
        "[[joint]]\nname = \"hinge\"\ntype = \"revolute\"\nbetween = [\"world\", \"b\"]\n\
         at = [0, 0, 0]\naxis = [0, 0, 1]\nspan = 0.1\nstiffness = 1e5\ndamping = 1e4\n\
         [[tsda]]\nname = \"dashpot\"\nbetween = [\"world\", \"b\"]\n\
         points = [[1, 2, 0], [0.1, 0, 0]]\nstiffness = 1e3\ndamping = 1e4\nfree_length = 1\n",
    );
    for plane in ["planar=false", "planar=true"] {
        let options = ["--damping", "joint-wise", "--step", "1ms", "--set", plane];
        let [warning] = &strong(&folder.summary(&leaning, &options))[..] else { panic!("{plane}") };
        let both = warning.contains("joint `hinge`") && warning.contains("dashpot");
        assert!(both && warning.contains("if dampers interact"), "{warning}");
    }
}

#[test]
fn a_failure_begins_with_its_cause_where_that_is_known() {
    let folder = Folder::new();
    let status = |scene: &str, options: &[&str]| {
        let done = folder.run(scene, options);
        assert_eq!(done.exit, Exit::Failed, "{}", done.out);
        let title = done.err.lines().next().unwrap().to_owned();
        let summary = folder.summary(scene, options);
        let status = summary["status"].as_str().unwrap().to_owned();
        let title = title.strip_prefix("error: ").unwrap();
        assert!(status.starts_with(title), "{status}\n{title}");
        status
    };
    let beyond = status("four-bar", &["--step", "200us"]);
    let start = "step too large: ω·h = 4.18 at t = 0, the limit of leapfrog is 2; then ";
    assert!(beyond.starts_with(start), "{beyond}");
    // A damper of c/m = 1000/s that acts explicitly needs a step below 2 ms, and 1/ω is 16 ms.
    let damped = PENDULUM.replace("free_length = 1.0", "free_length = 1.0\ndamping = 500.0");
    let within = status(&folder.scene(&damped), &["--scheme", "dbd"]);
    let start = "step too large: a shorter one works (ω·h ≤ ";
    assert!(within.starts_with(start) && within.contains("; then "), "{within}");
    // Half a turn about an axis across the spring's: no step helps, and none is blamed.
    let turning = PENDULUM
        .replace("position = [0.6", "angular_velocity = [9, 0, 0]\nposition = [0.6")
        + "\n[[torsion_spring]]\nbetween = [\"world\", \"bob\"]\naxis = [0, 0, 1]\nstiffness = 1e-9\n";
    let twisted = status(&folder.scene(&turning), &["--step", "0.1ms"]);
    assert!(
        twisted.starts_with("the run failed: the torsion angle of torsion_spring 1"),
        "{twisted}"
    );
}

#[test]
fn a_survey_says_what_check_says_of_the_scene() {
    let folder = Folder::new();
    let odd = PENDULUM.replace("inertia = [1e-3, 1e-3, 1e-3]", "inertia = [1e-9, 1e-9, 1e-9]");
    let scene = folder.scene(
        &odd.replace("points = [[0, 0, 0], [0, 0, 0]]", "points = [[0, 0, 0], [0.1, 0, 0]]"),
    );
    let out = folder.path("out");
    let survey = ["trade", &scene, "--window", "1ms", "--out", out.to_str().unwrap()];
    let done = call(&survey);
    assert_eq!(done.exit, Exit::Done, "{}", done.err);
    let checked: Value = serde_json::from_str(&call(&["check", &scene, "--json"]).out).unwrap();
    let expected = warnings(&checked);
    assert_eq!(expected.len(), 1);
    assert!(done.err.contains(&format!("warning: {}", expected[0])), "{}", done.err);
    assert_eq!(call(&[&survey[..], &["--quiet"]].concat()).err, "");
}

/// A body that a load spins up: it turns by 0.1 rad in a step of 1 ms from 100 rad/s on, which is at 0.1 s.
#[test]
fn a_run_says_when_a_body_came_to_turn_too_far_in_a_step() {
    let folder = Folder::new();
    let rotor = "name = \"rotor\"\nduration = 0.3\nstep = 1e-3\n[[body]]\nname = \"disc\"\nmass = 1\n\
                 inertia = [1, 1, 2]\nposition = [0, 0, 0]\n[[load]]\nbody = \"disc\"\n\
                 torque = [0, 0, 2000]\n";
    let scene = folder.scene(rotor);
    // That nothing holds the body is said, too.
    let turns = |mut said: Vec<String>| {
        said.retain(|text| !text.contains("no element acts on it"));
        said
    };
    let said = |options: &[&str]| turns(warnings(&folder.summary(&scene, options)));
    let quaternion = said(&["--every", "1ms"]);
    let [turned] = &quaternion[..] else { panic!("{quaternion:#?}") };
    for part in ["body `disc` turned by 0.3 rad in a step at t = 0.3s", "from t = 0.101s on"] {
        assert!(turned.contains(part), "{part}: {turned}");
    }
    assert!(
        turned.ends_with("a step of at most 333.3us") && !turned.contains("momentum"),
        "{turned}"
    );
    let quiet = said(&["--duration", "0.09s"]);
    assert_eq!(quiet, [""; 0]);
    // One that turns so from the start is said of the step alone.
    let spun = rotor.replace("position", "angular_velocity = [0, 0, 500]\nposition");
    let spun = folder.scene(&spun.replace("torque = [0, 0, 2000]", "torque = [0, 0, 1]"));
    for (orientation, lost) in [("quaternion", false), ("euler-321", true)] {
        let said = turns(warnings(&folder.summary(&spun, &["--orientation", orientation])));
        let [step] = &said[..] else { panic!("{orientation}: {said:#?}") };
        assert!(step.contains("turns by 0.5 rad in a step of 1ms at t = 0"), "{step}");
        assert_eq!(step.contains("lose angular momentum"), lost, "{orientation}: {step}");
    }
    // Unless it came to turn much faster than that: from 0.15 rad to 0.45.
    let faster = rotor.replace("position", "angular_velocity = [0, 0, 150]\nposition");
    let said = turns(warnings(&folder.summary(&folder.scene(&faster), &["--every", "1ms"])));
    let [step, run] = &said[..] else { panic!("{said:#?}") };
    assert!(step.contains("turns by 0.15 rad in a step of 1ms at t = 0"), "{step}");
    assert!(run.contains("turned by 0.45 rad in a step at t = 0.3s"), "{run}");
}

/// A rope that goes slack in the motion pushes from then on, a stop that is left pulls.
#[test]
fn a_run_says_when_a_rope_pushed_and_a_stop_pulled() {
    let folder = Folder::new();
    let text = |name: &str, velocity: f64| {
        format!(
            "name = \"swing\"\nduration = 1\n[[body]]\nname = \"b\"\nmass = 1\ninertia = [1, 1, 1]\n\
             position = [1, 0, 0]\nvelocity = [{velocity}, 0, 0]\n[[tsda]]\nname = \"{name}\"\n\
             between = [\"world\", \"b\"]\npoints = [[0, 0, 0], [0, 0, 0]]\nstiffness = 100\nfree_length = 1\n"
        )
    };
    let said = |name: &str, velocity: f64| {
        let summary = folder.summary(&folder.scene(&text(name, velocity)), &["--step", "1ms"]);
        warnings(&summary)
    };
    // ω = 10 rad/s: slack from π/10 s on, at most v·√(k·m) = 5 N a quarter of the period later.
    let [rope] = &said("tow rope", 0.5)[..] else { panic!("one warning") };
    for part in [
        "tsda `tow rope` (world–b) (line 9): pushed from t = 0.315s on",
        "at most with 5 N at t = 0.471s",
        "no rope does",
    ] {
        assert!(rope.contains(part), "{rope}");
    }
    let [stop] = &said("end_stop", -0.5)[..] else { panic!("one warning") };
    assert!(stop.contains("`end_stop`") && stop.contains("pulled from t = 0.315s on"), "{stop}");
    assert_eq!(said("tow rope", 0.0), [""; 0]);
    assert_eq!(said("spring", 0.5), [""; 0]);
}
