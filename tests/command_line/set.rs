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

/// The header is the first line, and the summary says what was set.
#[test]
fn a_trace_is_plain_csv_whatever_was_set() {
    let folder = Folder::new();
    let scene = folder.scene(PENDULUM);
    for options in [&[][..], &["--set", "tsda.*.stiffness=3e3", "--set", "step=1ms"], &["--planar"]]
    {
        assert_eq!(folder.run(&scene, options).exit, Exit::Done, "{options:?}");
        let trace = std::fs::read_to_string(folder.path("out/scene/trace.csv")).unwrap();
        assert!(trace.starts_with("time,bob.x,") && !trace.contains('#'), "{options:?}");
        let columns = |line: &str| line.split(',').count();
        let mut lines = trace.lines();
        let header = columns(lines.next().unwrap());
        assert!(lines.all(|line| columns(line) == header), "{options:?}");
    }
}

#[test]
fn every_command_takes_changes_and_refuses_wrong_ones_in_their_own_words() {
    for command in ["check", "export"] {
        let done = call(&[command, "four-bar", "--set", "body.crank.mass=3"]);
        assert_eq!(done.exit, Exit::Done, "{}", done.err);
        assert_ne!(done.out, call(&[command, "four-bar"]).out);
    }
    for command in ["run", "check", "trade", "export", "fmu"] {
        let done = call(&[command, "four-bar", "--set", "body.crnk.mass=3"]);
        assert_eq!(done.exit, Exit::Refused, "{command}");
        for part in ["--set:1:6", "no body `crnk`", "did you mean `crank`?"] {
            assert!(done.err.contains(part), "{command}: {}", done.err);
        }
    }
}

/// The line with which a report is made again has all that was chosen; it comes to the same hash.
#[test]
fn a_report_says_how_to_run_it_again() {
    let folder = Folder::new();
    let scene = folder.scene(PENDULUM);
    let options = [
        "--set",
        "tsda.*.stiffness=3e3",
        "--damping",
        "explicit",
        "--orientation",
        "euler-321",
        "--precision",
        "f32",
        "--step",
        "1ms",
        "--duration",
        "20ms",
    ];
    let hash = folder.summary(&scene, &options)["state_hash"].clone();
    let page = std::fs::read_to_string(folder.path("out/scene/report.html")).unwrap();
    let line = page.split("<pre>host-sim run ").nth(1).unwrap().split("</pre>").next().unwrap();
    let words: Vec<String> =
        line.replace("&#39;", "'").split(' ').map(|word| word.trim_matches('\'').into()).collect();
    let again: Vec<&str> = words.iter().skip(1).map(String::as_str).collect();
    for option in ["--damping", "--orientation", "--set"] {
        assert!(again.contains(&option), "{line}");
    }
    assert_eq!(folder.summary(&scene, &again)["state_hash"], hash, "{line}");
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
    assert!(warnings.contains("parameter `unused` (line 1): is unused"), "{warnings}");
    let done = call(&["check", &scene, "--set", "body.bob.mass=2 * m_bop"]);
    assert_eq!(done.exit, Exit::Refused);
    for part in ["--set:1:20", "`m_bop` is neither a unit nor", "did you mean `m_bob`?"] {
        assert!(done.err.contains(part), "{part}: {}", done.err);
    }
    let done = call(&["check", &scene, "--set", "m_bob=0.75"]);
    assert!(done.err.contains("did you mean `parameters.m_bob`?"), "{}", done.err);
    let plain = folder.scene(PENDULUM);
    let same = folder.summary(&plain, &["--set", "body.bob.mass=3/4 * kg"]);
    assert_eq!(same["state_hash"], set["state_hash"]);
    // A step on the command line is a time as in a scene.
    let step = folder.summary(&plain, &["--step", "0.5 ms * 2", "--duration", "0.1 min / 60"]);
    assert_eq!((&step["step"], &step["duration"]), (&1e-3.into(), &0.1.into()));
}
