//! The page of a comparison, its folder, and runs that were recorded elsewhere.

use std::fs;
use std::path::PathBuf;

use dbd_golden::Recording;
use dbd_plant::{Method, PrecisionName, SchemeName};
use dbd_scene::Scene;
use host_sim::terminal::Exit;
use serde_json::Value;

use crate::compare::{Bench, row, scene};

/// What a chip leaves: the kernel's plant in single precision, its record within what a console showed.
fn recorded(text: &str, steps: u64, nudge: Option<u64>) -> String {
    let scene = Scene::parse(text, "scene.toml").unwrap();
    let method = Method::new(SchemeName::Leapfrog, None, PrecisionName::F32).unwrap();
    let mut plant = dbd_plant::plant(&scene, &method, 1e-3).unwrap();
    let mut recording = Recording::of_scene(&scene, plant.as_ref(), 10, &["pull"]).unwrap();
    while plant.steps() <= steps {
        if nudge == Some(plant.steps()) {
            let mut state = plant.state();
            state.bodies[0].velocity.y += 1e-3;
            plant.set_state(&state).unwrap();
        }
        recording.look(plant.as_ref()).unwrap();
        plant.advance(10).unwrap();
    }
    recording.text()
}

#[test]
fn a_run_on_the_pc_is_compared_with_one_that_was_recorded_elsewhere() {
    let bench = Bench::new();
    let a = bench.run("a", &["--precision", "f32"]);
    let file = bench.folder.path("chip.txt");
    let chip = file.to_str().unwrap();
    let golden = recorded(&scene(), 200, None);
    for text in [golden.clone(), format!("boot\r\n{}bye\r\n", golden.replace('\n', "\r\n"))] {
        fs::write(&file, text).unwrap();
        let (json, exit) = bench.json(&a, chip, &[]);
        assert_eq!((exit, &json["verdict"]), (Exit::Done, &"equal".into()));
        assert_eq!(
            (&json["b"]["kind"], &json["only_a"]["readouts"]),
            (&"golden".into(), &serde_json::json!(["tip.x", "tip.y", "tip.z"]))
        );
        assert_eq!(row(&json, "pull")["unit"], "N");
    }
    // Its scene is that of the run, so that both are seen.
    assert_eq!(bench.compare(&a, chip, &[]).exit, Exit::Done);
    let page = page(&bench, 2);
    assert!(
        page["runs"].as_array().unwrap().iter().all(|run| !run["film"].is_null()),
        "{}",
        page["runs"]
    );
    fs::write(&file, recorded(&scene(), 200, Some(100))).unwrap();
    let (json, exit) = bench.json(&a, chip, &[]);
    assert_eq!(exit, Exit::Failed);
    let first = &json["first_difference"];
    assert_eq!(
        (&first["component"], &first["steps"][0], &first["equal_steps"][0]),
        (&"bob.vy".into(), &100.into(), &90.into())
    );
    assert!(
        json["notes"]
            .to_string()
            .contains("one of 91 to 100; run both again with --every 1ms --duration 0.1s"),
        "{json}"
    );
    // Two records, one of them shorter.
    let short = bench.folder.path("short.golden");
    fs::write(&short, recorded(&scene(), 100, None)).unwrap();
    fs::write(&file, recorded(&scene(), 200, None)).unwrap();
    assert_eq!(bench.json(short.to_str().unwrap(), chip, &[]).1, Exit::Done);
    // Their scene lies beside them: by its own name, or by that of the record.
    fs::remove_dir_all(bench.folder.path("reports")).unwrap();
    for name in [Scene::parse(&scene(), "s").unwrap().name, "short".into()] {
        let beside = bench.folder.path(&format!("{name}.toml"));
        fs::write(&beside, scene()).unwrap();
        assert_eq!(bench.compare(short.to_str().unwrap(), chip, &[]).exit, Exit::Done);
        let page = self::page(&bench, 2);
        assert!(
            page["runs"].as_array().unwrap().iter().all(|run| !run["film"].is_null()),
            "{name}"
        );
        fs::remove_file(beside).unwrap();
        fs::remove_dir_all(bench.folder.path("reports")).unwrap();
    }
}

/// The data of the only page of these that was written, of so many runs.
fn page(bench: &Bench, runs: usize) -> Value {
    let folders = fs::read_dir(bench.folder.path("reports/compare")).unwrap();
    let folders: Vec<PathBuf> = folders.map(|folder| folder.unwrap().path()).collect();
    assert_eq!(folders.len(), 1, "{folders:?}");
    let page = fs::read_to_string(folders[0].join("report.html")).unwrap();
    assert!(folders[0].join("compare.json").exists());
    let data = page.split_once("id=\"report\">").unwrap().1.split_once("</script>").unwrap().0;
    let data: Value = serde_json::from_str(data).unwrap();
    assert_eq!((&data["kind"], data["runs"].as_array().unwrap().len()), (&"compare".into(), runs));
    data
}

#[test]
fn the_page_holds_both_runs_and_their_differences() {
    let bench = Bench::new();
    let (a, b) = (bench.run("a", &[]), bench.run("b", &["--set", "tsda.spring.stiffness=4e3"]));
    let done = bench.compare(&a, &b, &[]);
    assert!(done.out.contains("scene-a-and-b/{report.html,compare.json}"), "{}", done.out);
    let data = page(&bench, 2);
    let labels = data["runs"].as_array().unwrap().iter().map(|run| run["label"].clone());
    assert_eq!(
        labels.collect::<Vec<_>>(),
        ["A: tsda.spring.stiffness = 2e3", "B: tsda.spring.stiffness = 4e3"]
    );
    for run in data["runs"].as_array().unwrap() {
        assert!(run["mechanism"].is_object() && run["film"].is_object(), "{run}");
        let titles: Vec<&str> = run["charts"]
            .as_array()
            .unwrap()
            .iter()
            .map(|chart| chart["title"].as_str().unwrap())
            .collect();
        assert!(titles.contains(&"tip") && titles.contains(&"Energy"), "{titles:?}");
    }
    let charts = data["differences"].as_array().unwrap();
    let drawn = charts.iter().find(|chart| chart["title"] == "bob: position").unwrap();
    assert_eq!((&drawn["unit"], drawn["lines"].as_array().unwrap().len()), (&"m".into(), 3));
    assert!(drawn["lines"][1]["high"].as_f64().unwrap() > 0.0);
    // The bob keeps to its plane.
    assert_eq!(drawn["lines"][2]["still"], true);
    assert_eq!(data["firstDifference"]["step"], 10);
    // The scene has changed since: curves are left, and a sentence says why.
    bench.folder.scene(&(scene() + "# another\n"));
    assert_eq!(bench.compare(&a, &b, &[]).exit, Exit::Failed);
    let data = page(&bench, 2);
    assert!(
        data["runs"][0]["mechanism"].is_null()
            && !data["runs"][0]["charts"].as_array().unwrap().is_empty()
    );
    let text =
        fs::read_to_string(bench.folder.path("reports/compare/scene-a-and-b/report.html")).unwrap();
    assert!(text.contains("no animation for A: its scene, ") && text.contains("has changed since"));
}

#[test]
fn a_report_of_other_runs_is_not_replaced_unasked() {
    let bench = Bench::new();
    let (a, b) = (bench.run("x/a", &[]), bench.run("x/b", &[]));
    let (c, d) = (bench.run("y/a", &[]), bench.run("y/b", &[]));
    let report = bench.folder.path("reports/compare/scene-a-and-b/compare.json");
    assert_eq!(bench.compare(&a, &b, &[]).exit, Exit::Done);
    assert_eq!(bench.compare(&a, &b, &[]).exit, Exit::Done);
    let before = fs::read_to_string(&report).unwrap();
    let done = bench.compare(&c, &d, &[]);
    assert_eq!(done.exit, Exit::Refused);
    assert!(
        done.err.contains("contains the results of another") && done.err.contains("--overwrite"),
        "{}",
        done.err
    );
    assert_eq!(fs::read_to_string(&report).unwrap(), before);
    assert_eq!(bench.compare(&c, &d, &["--overwrite"]).exit, Exit::Done);
    assert_ne!(fs::read_to_string(&report).unwrap(), before);
    // Without a report nothing is written at all.
    fs::remove_dir_all(bench.folder.path("reports")).unwrap();
    assert_eq!(bench.compare(&a, &b, &["--no-report"]).exit, Exit::Done);
    assert!(!bench.folder.path("reports").exists());
    // What cannot be written is no difference.
    fs::write(bench.folder.path("reports"), "a file").unwrap();
    assert_eq!(bench.compare(&a, &b, &[]).exit, Exit::Refused);
}
