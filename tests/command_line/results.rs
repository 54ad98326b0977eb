//! Where results lie, and whose they are.

use std::fs;

use host_sim::terminal::Exit;
use serde_json::Value;

use crate::{Folder, PENDULUM};

#[test]
fn results_lie_under_the_files_name() {
    let folder = Folder::new();
    // The name of a scene is free text; no folder could have this one.
    let scene = folder.scene(&PENDULUM.replace("\"pendulum\"", "\"a/b: pendulum\""));
    let summary = folder.summary(&scene, &[]);
    assert_eq!(summary["scene"], "a/b: pendulum");
    assert!(folder.path("out/scene/trace.csv").is_file());
    assert_eq!(fs::read_dir(folder.path("out")).unwrap().count(), 1);
}

#[test]
fn two_files_of_one_name_do_not_replace_each_others_results() {
    let folder = Folder::new();
    // One scene's name in two files: two folders.
    for file in ["short.toml", "long.toml"] {
        fs::write(folder.path(file), PENDULUM).unwrap();
        assert_eq!(folder.run(folder.path(file).to_str().unwrap(), &[]).exit, Exit::Done);
    }
    assert!(folder.path("out/short").is_dir() && folder.path("out/long").is_dir());

    // One file's name in two folders: the second is refused, whatever it is called inside.
    let mut files = Vec::new();
    for (place, duration) in [("first", "0.25"), ("second", "0.125")] {
        fs::create_dir(folder.path(place)).unwrap();
        let file = folder.path(place).join("arm.toml");
        fs::write(&file, PENDULUM.replace("duration = 0.5", &format!("duration = {duration}")))
            .unwrap();
        files.push(file.to_str().unwrap().to_owned());
    }
    let summary = || -> Value {
        let text = fs::read_to_string(folder.path("out/arm/summary.json")).unwrap();
        serde_json::from_str(&text).unwrap()
    };
    assert_eq!(folder.run(&files[0], &[]).exit, Exit::Done);
    let first = summary();
    let whole = fs::canonicalize(&files[0]).unwrap();
    assert_eq!(first["scene_file"].as_str().map(Into::into), Some(whole));
    let refused = folder.run(&files[1], &[]);
    assert_eq!(refused.exit, Exit::Refused);
    for part in [files[0].as_str(), "out/arm", "--out DIR", "--overwrite"] {
        assert!(refused.err.contains(part), "{part}: {}", refused.err);
    }
    assert_eq!(summary(), first);
    // The same file again, changed or not, replaces its own.
    fs::write(&files[0], PENDULUM.replace("duration = 0.5", "duration = 0.375")).unwrap();
    assert_eq!(folder.run(&files[0], &[]).exit, Exit::Done);
    assert_eq!(summary()["duration"], 0.375);
    assert_ne!(summary()["scene_hash"], first["scene_hash"]);
    // The other one does where that is asked for, and leaves nothing of the first.
    let survey = folder.path("out/arm/trade.csv");
    fs::write(&survey, "of the first").unwrap();
    assert_eq!(folder.run(&files[1], &["--overwrite"]).exit, Exit::Done);
    assert_eq!(summary()["duration"], 0.125);
    assert!(!survey.exists());
    assert_eq!(folder.run(&files[0], &[]).exit, Exit::Refused);
}

/// What a survey leaves names its scene, too.
#[test]
fn a_survey_and_a_run_share_a_folder_of_one_scene() {
    let folder = Folder::new();
    let scene = folder.scene(PENDULUM);
    let of_another = "{\"scene\": \"other\", \"scene_file\": \"built in\", \"scene_hash\": \"0\"}";
    fs::create_dir_all(folder.path("out/scene")).unwrap();
    fs::write(folder.path("out/scene/trade.json"), of_another).unwrap();
    assert_eq!(folder.run(&scene, &[]).exit, Exit::Refused);
    assert!(!folder.path("out/scene/summary.json").exists());
    fs::remove_file(folder.path("out/scene/trade.json")).unwrap();
    assert_eq!(folder.run(&scene, &[]).exit, Exit::Done);
    let out = folder.path("out");
    let trade = ["trade", &scene, "--window", "1ms", "--json", "--out", out.to_str().unwrap()];
    let done = crate::call(&trade);
    assert_eq!(done.exit, Exit::Done, "{}", done.err);
    let survey = fs::read_to_string(folder.path("out/scene/trade.json")).unwrap();
    assert_eq!(survey, done.out);
    let [survey, run] =
        [survey, fs::read_to_string(folder.path("out/scene/summary.json")).unwrap()]
            .map(|text| serde_json::from_str::<Value>(&text).unwrap());
    for key in ["scene", "scene_file", "scene_hash"] {
        assert_eq!(survey[key], run[key], "{key}");
    }
    // The page of a run shows the survey of the same text and the same values.
    let page = |options: &[&str]| {
        assert_eq!(folder.run(&scene, options).exit, Exit::Done);
        fs::read_to_string(folder.path("out/scene/report.html")).unwrap()
    };
    let shown = page(&[]);
    assert!(shown.contains("<h2>Speed against accuracy</h2>") && shown.contains("trade.html"));
    assert!(shown.contains("aria-label=\"pendulum: accuracy against speed on this PC\""));
    let advice = survey["advice"].as_array().unwrap();
    assert!(advice.iter().all(|one| shown.contains(one["sentence"].as_str().unwrap())));
    assert!(!page(&["--set", "body.bob.mass=0.6"]).contains("Speed against accuracy"));
    folder.scene(&format!("{PENDULUM}\n# changed"));
    assert!(!page(&[]).contains("Speed against accuracy"));
}

/// The keys of a table `| key | … |` of a page.
fn documented(page: &str, heading: &str) -> Vec<String> {
    let section = page.split(heading).nth(1).unwrap_or_else(|| panic!("no {heading}"));
    let rows = section.lines().skip_while(|line| !line.starts_with("|---")).skip(1);
    rows.take_while(|line| line.starts_with("| "))
        .flat_map(|line| {
            let cell = line.trim_start_matches("| ").split(" |").next().unwrap().to_owned();
            let keys = cell.split(", ").map(|key| key.trim_matches('`').to_owned());
            keys.collect::<Vec<_>>()
        })
        .collect()
}

#[test]
fn every_key_of_a_summary_is_in_the_reference() {
    let folder = Folder::new();
    let page = concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/command-line.md");
    let documented = documented(&fs::read_to_string(page).unwrap(), "## `summary.json`");
    let scene =
        folder.scene(&PENDULUM.replace("free_length = 1.0", "free_length = 1.0\ndamping = 5"));
    // Of a run in the scheme's own way and in another, of one that fails and one that is warned of.
    let runs: [&[&str]; 6] = [
        &[],
        &["--modes", "1"],
        &["--damping", "explicit"],
        &["--step", "0.25s"],
        &["--scheme", "dbd"],
        &["--watch-energy", "1", "--set", "body.bob.mass=0.6"],
    ];
    let mut written = Vec::new();
    for options in runs {
        let done = folder.run(&scene, &[options, &["--json"]].concat());
        let summary: Value = serde_json::from_str(&done.out).unwrap();
        written.extend(summary.as_object().unwrap().keys().cloned());
    }
    // And of one beside a golden run.
    let golden = crate::golden::bless(folder.path("a.golden").to_str().unwrap(), 1e-3);
    let summary: Value = serde_json::from_str(&golden.summary.json()).unwrap();
    written.extend(summary.as_object().unwrap().keys().cloned());
    // And of one in its plane.
    let done = folder.run(&scene, &["--planar", "--json"]);
    let summary: Value = serde_json::from_str(&done.out).unwrap();
    written.extend(summary.as_object().unwrap().keys().cloned());
    // And of one that is assembled.
    let open = PENDULUM.replace("[[body]]", "settle = true\n[assemble]\n[[body]]");
    let done = folder.run(&folder.scene(&open), &["--json"]);
    let summary: Value = serde_json::from_str(&done.out).unwrap();
    written.extend(summary.as_object().unwrap().keys().cloned());
    // And of one that a load drives, and that a stop, of next to no stiffness, holds.
    let loaded =
        PENDULUM.replacen("[[body]]", "[[load]]\nbody = \"bob\"\nforce = [1, 0, 0]\n[[body]]", 1);
    let loaded = loaded
        + "[[interaction]]\nlaw = \"end-stop\"\nbetween = [\"world\", \"bob\"]\nnormal = [0, 1, 0]\n\
           points = [[0, 10, 0], [0, 0, 0]]\nstiffness = 1e-3\ndissipation = 0\n";
    let done = folder.run(&folder.scene(&loaded), &["--json"]);
    let summary: Value = serde_json::from_str(&done.out).unwrap();
    written.extend(summary.as_object().unwrap().keys().cloned());
    for key in &written {
        assert!(documented.contains(key), "`{key}` is in no line of the reference");
    }
    for key in &documented {
        assert!(written.contains(key), "`{key}` is in the reference and in no summary");
    }
}
