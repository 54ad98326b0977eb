//! `--set`: values of a scene changed by their paths.

use host_sim::terminal::Exit;

use crate::{Folder, PENDULUM, call};

#[test]
fn a_changed_value_runs_as_a_changed_file_does() {
    let folder = Folder::new();
    let scene = folder.scene(PENDULUM);
    let set = folder.summary(&scene, &["--set", "body.bob.mass=0.75", "--set", "tsda.1.damping=2"]);
    let changed: Vec<_> = set["set"].as_array().unwrap().iter().collect();
    assert_eq!(changed.len(), 2);
    assert_eq!(
        (&changed[0]["path"], &changed[0]["before"]),
        (&"body.bob.mass".into(), &"0.5".into())
    );
    assert_eq!((&changed[1]["now"], &changed[1]["before"]), (&"2".into(), &().into()));
    let plain = folder.summary(&scene, &[]);
    assert!(plain["set"].is_null() && plain["state_hash"] != set["state_hash"]);
    let text = PENDULUM.replace("mass = 0.5", "mass = 0.75");
    let edited = folder.scene(&text.replace("stiffness = 2e3", "stiffness = 2e3\ndamping = 2"));
    assert_eq!(folder.summary(&edited, &[])["state_hash"], set["state_hash"]);
}

#[test]
fn the_report_gives_the_command_with_its_changes() {
    let folder = Folder::new();
    let scene = folder.scene(PENDULUM);
    let done = folder.run(&scene, &["--set", "tsda.*.stiffness=3e3"]);
    assert_eq!(done.exit, Exit::Done, "{}", done.err);
    assert!(done.out.contains("tsda.1.stiffness = 3e3 (in the file: 2e3)"), "{}", done.out);
    let report = std::fs::read_to_string(folder.path("out/scene/report.html")).unwrap();
    assert!(
        report.contains("--set &#39;tsda.*.stiffness=3e3&#39;")
            || report.contains("--set 'tsda.*.stiffness=3e3'")
    );
}

#[test]
fn every_command_takes_changes_and_refuses_wrong_ones_in_their_own_words() {
    for command in ["check", "export"] {
        let done = call(&[command, "four-bar", "--set", "body.crank.mass=3"]);
        assert_eq!(done.exit, Exit::Done, "{}", done.err);
        assert_ne!(done.out, call(&[command, "four-bar"]).out);
    }
    for command in ["run", "check", "trade", "export"] {
        let done = call(&[command, "four-bar", "--set", "body.crnk.mass=3"]);
        assert_eq!(done.exit, Exit::Refused, "{command}");
        for part in ["--set:1:6", "no body `crnk`", "did you mean `crank`?"] {
            assert!(done.err.contains(part), "{command}: {}", done.err);
        }
    }
}

/// A parameter is changed as any value is: the summary says so, and a fault is marked in its text.
#[test]
fn parameters_are_changed_and_told_with_their_units() {
    let folder = Folder::new();
    let text = format!("parameters = {{ m_bob = \"500 g\", unused = 1 }}\n{PENDULUM}");
    let scene = folder.scene(&text.replace("mass = 0.5", "mass = \"m_bob\""));
    let set = folder.summary(&scene, &["--set", "parameters.m_bob=0.75"]);
    let change = &set["set"][0];
    assert_eq!((&change["path"], &change["now"]), (&"parameters.m_bob".into(), &"0.75".into()));
    assert_eq!(change["before"], "\"500 g\"");
    let warnings = set["warnings"].to_string();
    assert!(warnings.contains("parameter `unused` (line 1): no value"), "{warnings}");
    let plain = folder.scene(PENDULUM);
    let same = folder.summary(&plain, &["--set", "body.bob.mass=3/4 * kg"]);
    assert_eq!(same["state_hash"], set["state_hash"]);
    let done = call(&["check", &scene, "--set", "body.bob.mass=2 * m_bop"]);
    assert_eq!(done.exit, Exit::Refused);
    for part in ["--set:1:20", "`m_bop` is neither a unit nor", "did you mean `m_bob`?"] {
        assert!(done.err.contains(part), "{part}: {}", done.err);
    }
    // A step on the command line is a time as in a scene.
    let step = folder.summary(&plain, &["--step", "0.5 ms * 2", "--duration", "0.1 min / 60"]);
    assert_eq!((&step["step"], &step["duration"]), (&1e-3.into(), &0.1.into()));
}
