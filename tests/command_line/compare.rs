//! `compare`: two recorded runs: verdicts, figures, what is refused, what is written.

use std::fs;
use std::path::{Path, PathBuf};

use dbd_golden::{Recording, same};
use dbd_plant::{Method, PrecisionName, SchemeName};
use dbd_scene::Scene;
use host_sim::terminal::Exit;
use serde_json::Value;

use crate::{Done, Folder, PENDULUM, Trace, call};

/// The pendulum with what shows where its bob is.
fn scene() -> String {
    format!(
        "{PENDULUM}\n[[readout]]\nname = \"tip\"\ntype = \"point\"\nbody = \"bob\"\npoint = [0, -0.1, 0]\n\
         \n[[readout]]\nname = \"pull\"\ntype = \"tsda_force\"\ntarget = 1\n"
    )
}

const OPTIONS: [&str; 6] = ["--step", "1ms", "--every", "10ms", "--duration", "0.2s"];

/// Runs below folders of their own, and compares them.
struct Bench {
    folder: Folder,
    scene: String,
}

impl Bench {
    fn new() -> Self {
        let folder = Folder::new();
        let scene = folder.scene(&scene());
        Self { folder, scene }
    }

    /// Runs the scene; the folder of its results.
    fn run(&self, name: &str, options: &[&str]) -> String {
        let own = OPTIONS.chunks(2).filter(|pair| !options.contains(&pair[0])).flatten().copied();
        let options: Vec<&str> = own.chain(options.iter().copied()).collect();
        self.run_as_it_is(name, &options)
    }

    fn run_as_it_is(&self, name: &str, options: &[&str]) -> String {
        let out = self.folder.path(name);
        let line = ["run", &self.scene, "--quiet", "--out", out.to_str().unwrap()];
        let done = call(&[&line[..], options].concat());
        assert_eq!(done.exit, Exit::Done, "{}", done.err);
        out.join("scene").to_str().unwrap().to_owned()
    }

    fn compare(&self, a: &str, b: &str, options: &[&str]) -> Done {
        let out = self.folder.path("reports");
        call(&[&["compare", a, b, "--out", out.to_str().unwrap()][..], options].concat())
    }

    /// The comparison as JSON, and how it ended.
    fn json(&self, a: &str, b: &str, options: &[&str]) -> (Value, Exit) {
        let done = self.compare(a, b, &[options, &["--json", "--no-report"]].concat());
        let json = serde_json::from_str(&done.out);
        (json.unwrap_or_else(|_| panic!("{} {}", done.out, done.err)), done.exit)
    }
}

fn row<'v>(json: &'v Value, name: &str) -> &'v Value {
    let rows = json["quantities"].as_array().unwrap();
    rows.iter().find(|row| row["name"] == name).unwrap_or_else(|| panic!("{name}: {json}"))
}

#[test]
fn a_run_is_equal_to_its_repetition() {
    let bench = Bench::new();
    let (a, b) = (bench.run("a", &[]), bench.run("b", &[]));
    let done = bench.compare(&a, &b, &[]);
    assert_eq!((done.exit, done.err.as_str()), (Exit::Done, ""));
    for part in
        ["bits      equal, bit for bit, in all 21 common samples", "leapfrog, f64, step 1ms"]
    {
        assert!(done.out.contains(part), "{part}: {}", done.out);
    }
    let (json, exit) = bench.json(&a, &b, &[]);
    assert_eq!((&json["verdict"], exit), (&"equal".into(), Exit::Done));
    assert_eq!(
        (&json["first_difference"], &json["differs"]),
        (&Value::Null, &Value::Array(vec![]))
    );
    assert_eq!(json["common"]["samples"], 21);
    let rows = json["quantities"].as_array().unwrap();
    assert!(rows.iter().all(|row| row["rms"] == 0.0 && row["largest"] == 0.0), "{json}");
    // A file of the run stands for the run, and quiet is quiet.
    let done = bench.compare(&format!("{a}/trace.csv"), &format!("{b}/summary.json"), &["--quiet"]);
    assert_eq!((done.exit, done.out.as_str(), done.err.as_str()), (Exit::Done, "", ""));
}

/// Every figure once more, from the texts of the two traces.
#[test]
fn figures_are_those_of_the_traces() {
    let bench = Bench::new();
    let (a, b) = (bench.run("a", &[]), bench.run("b", &["--scheme", "pefrl"]));
    let (json, exit) = bench.json(&a, &b, &[]);
    assert_eq!((&json["verdict"], exit), (&"different".into(), Exit::Failed));
    let [of_a, of_b] = [&a, &b].map(|run| Trace::read(&Path::new(run).join("trace.csv")));
    let number = |trace: &Trace, row: usize, column: usize| -> f64 {
        trace.rows[row][column].parse().unwrap()
    };
    let columns = of_a.header.len();
    let differs =
        |row: usize| (0..columns).find(|column| of_a.rows[row][*column] != of_b.rows[row][*column]);
    let (at, column) = (0..21).find_map(|row| Some((row, differs(row)?))).unwrap();
    let first = &json["first_difference"];
    assert_eq!(first["time"], number(&of_a, at, 0));
    assert_eq!(first["steps"], serde_json::json!([10 * at, 10 * at]));
    assert_eq!(first["component"], of_a.header[column]);
    assert_eq!(first["body"], "bob");
    let values = [number(&of_a, at, column), number(&of_b, at, column)];
    assert_eq!(first["values"], serde_json::json!(values));
    let ulps = values[0].to_bits().abs_diff(values[1].to_bits());
    assert_eq!(first["ulps"], ulps);
    for (name, columns) in [
        ("position", 1..4),
        ("velocity", 8..11),
        ("energy.total", 16..17),
        ("tip.y", 18..19),
        ("pull", 20..21),
    ] {
        let apart = |row: usize| {
            let squares = columns
                .clone()
                .map(|column| (number(&of_a, row, column) - number(&of_b, row, column)).powi(2));
            squares.sum::<f64>().sqrt()
        };
        let largest = (0..21).map(apart).fold(0.0, f64::max);
        let rms = ((0..21).map(|row| apart(row).powi(2)).sum::<f64>() / 21.0).sqrt();
        let row = row(&json, name);
        let near = |value: &Value, of: f64| (value.as_f64().unwrap() - of).abs() <= 1e-12 * of;
        assert!(
            near(&row["rms"], rms) && near(&row["largest"], largest),
            "{name}: {row} {rms} {largest}"
        );
        assert!(largest > 0.0, "{name}");
    }
    assert_eq!(
        (&row(&json, "pull")["unit"], &row(&json, "tip.x")["unit"]),
        (&"N".into(), &"m".into())
    );
    let told = &json["differs"][0];
    assert_eq!(
        (&told["what"], &told["a"], &told["b"]),
        (&"scheme".into(), &"leapfrog".into(), &"pefrl".into())
    );
    let text = bench.compare(&a, &b, &["--no-report"]).out;
    for part in
        ["differs   scheme: leapfrog in A, pefrl in B", "first     t = 10ms, step 10: bob.", "ULP"]
    {
        assert!(text.contains(part), "{part}: {text}");
    }
}

#[test]
fn two_stiffnesses_and_two_precisions_are_told() {
    let bench = Bench::new();
    let a = bench.run("a", &[]);
    let stiffer = bench.run("b", &["--set", "tsda.1.stiffness=4e3"]);
    let (json, exit) = bench.json(&a, &stiffer, &[]);
    assert_eq!(exit, Exit::Failed);
    let told = &json["differs"][0];
    assert_eq!((&told["what"], &told["b"]), (&"set tsda.1.stiffness".into(), &"4e3".into()));
    assert_eq!(told["a"], "2e3");
    let single = bench.run("c", &["--precision", "f32"]);
    let (json, exit) = bench.json(&a, &single, &[]);
    assert_eq!(exit, Exit::Failed);
    // 0.6 is another number in single precision: no number of that precision lies between.
    let first = &json["first_difference"];
    assert_eq!(
        (&first["component"], &first["ulps"], &first["time"]),
        (&"bob.x".into(), &0.into(), &0.0.into())
    );
    assert!(row(&json, "position")["largest"].as_f64().unwrap() < 1e-4);
    // Both in single precision: bits again.
    let again = bench.run("d", &["--precision", "f32"]);
    assert_eq!(bench.json(&single, &again, &[]).1, Exit::Done);
}

#[test]
fn bands_accept_what_stays_within() {
    let bench = Bench::new();
    let (a, b) = (bench.run("a", &[]), bench.run("b", &["--precision", "f32"]));
    let (json, exit) = bench.json(&a, &b, &["--band", "1e-2"]);
    assert_eq!(
        (&json["verdict"], exit, &json["beyond"]),
        (&"within".into(), Exit::Done, &Value::Null)
    );
    assert_eq!(row(&json, "position")["band"], 1e-2);
    assert_eq!(row(&json, "energy.total")["band"], Value::Null);
    let list = "position=1e-12,orientation=1,velocity=1,angular-velocity=1,tip=1,pull=100,energy=1";
    let (json, exit) = bench.json(&a, &b, &["--band", list]);
    assert_eq!((&json["verdict"], exit), (&"different".into(), Exit::Failed));
    let beyond = &json["beyond"];
    assert_eq!(
        (&beyond["quantity"], &beyond["body"], &beyond["band"]),
        (&"position".into(), &"bob".into(), &1e-12.into())
    );
    assert_eq!(row(&json, "energy.total")["band"], 1.0);
    assert!(
        bench
            .compare(&a, &b, &["--band", list])
            .out
            .contains("first beyond its band at t = 0s, step 0: position of bob")
    );
    for (band, part) in [
        ("-1", "`-1` is no band"),
        ("position=1", "the orientation has no band"),
        ("1,elbow=1", "a band is stated for `elbow`"),
        (
            "position=1,orientation=1,velocity=1,angular-velocity=1,pull=1",
            "no band is stated for `tip.x`",
        ),
    ] {
        let done = bench.compare(&a, &b, &["--band", band]);
        assert_eq!(done.exit, Exit::Refused);
        assert!(done.err.contains(part), "{part}: {}", done.err);
    }
}

#[test]
fn samples_are_compared_at_the_times_that_both_have() {
    let bench = Bench::new();
    let a = bench.run("a", &[]);
    let (json, exit) = bench.json(&a, &bench.run("coarse", &["--every", "20ms"]), &[]);
    assert_eq!((exit, &json["common"]["samples"]), (Exit::Done, &11.into()));
    // Another step: other bits, the same times.
    let fine = bench.run("fine", &["--step", "0.5ms"]);
    let (json, exit) = bench.json(&a, &fine, &[]);
    assert_eq!((exit, &json["common"]["samples"]), (Exit::Failed, &21.into()));
    let first = &json["first_difference"];
    assert_eq!(
        (&first["steps"], &first["equal_steps"]),
        (&serde_json::json!([10, 20]), &serde_json::json!([0, 0]))
    );
    // A shorter run: the common part, and it is said.
    let short = bench.run("short", &["--duration", "0.1s"]);
    let (json, exit) = bench.json(&a, &short, &[]);
    assert_eq!((exit, &json["common"]["until"]), (Exit::Done, &0.1.into()));
    assert!(json["notes"][0].as_str().unwrap().starts_with("B ends at 0.1s, A at 0.2s"), "{json}");
    let odd = bench.run("odd", &["--every", "70ms", "--duration", "0.07s"]);
    let done = bench.compare(&a, &odd, &[]);
    assert_eq!(done.exit, Exit::Done, "{}", done.err);
    let apart =
        bench.run("apart", &["--step", "0.7ms", "--every", "7.7ms", "--duration", "69.3ms"]);
    let done = bench.compare(&a, &apart, &[]);
    assert_eq!(done.exit, Exit::Refused);
    for part in [
        "no sample at the same time but t = 0",
        "A has one every 10ms from 0s to 0.2s",
        "B has one every 7.7ms from 0s to 69.3ms",
        "--every",
    ] {
        assert!(done.err.contains(part), "{part}: {}", done.err);
    }
}

#[test]
fn other_scenes_are_compared_as_far_as_they_have_the_same_bodies() {
    let bench = Bench::new();
    let a = bench.run("a", &[]);
    let more = scene()
        + "\n[[body]]\nname = \"free\"\nmass = 1\ninertia = [1, 1, 1]\nposition = [0, 0, 3]\n";
    bench.folder.scene(&more);
    let b = bench.run("b", &[]);
    let (json, exit) = bench.json(&a, &b, &[]);
    // What both have is equal, and yet they are not one mechanism.
    assert_eq!((exit, &json["verdict"]), (Exit::Failed, &"different".into()));
    assert_eq!(
        (&json["only_b"]["bodies"], &json["only_a"]["bodies"]),
        (&serde_json::json!(["free"]), &serde_json::json!([]))
    );
    assert_eq!(row(&json, "position")["largest"], 0.0);
    bench.folder.scene(&scene().replace("\"bob\"", "\"ball\""));
    let other = bench.run("c", &[]);
    let done = bench.compare(&a, &other, &[]);
    assert_eq!(done.exit, Exit::Refused);
    assert!(done.err.contains("no body of the same name: bob; ball"), "{}", done.err);
}

/// A run that ended early is not equal to one that did not.
#[test]
fn a_failed_run_differs_though_its_part_is_equal() {
    let bench = Bench::new();
    let a = bench.run("a", &[]);
    let out = bench.folder.path("b");
    let line =
        ["run", &bench.scene, "--quiet", "--out", out.to_str().unwrap(), "--watch-energy", "1e-9"];
    assert_eq!(call(&[&line[..], &OPTIONS].concat()).exit, Exit::Failed);
    let b = out.join("scene");
    let (json, exit) = bench.json(&a, b.to_str().unwrap(), &[]);
    assert_eq!((exit, &json["first_difference"]), (Exit::Failed, &Value::Null));
    let text = bench.compare(&a, b.to_str().unwrap(), &[]).out;
    assert!(text.contains("different: one failed where the other did not"), "{text}");
    assert!(text.contains("B failed: "), "{text}");
}

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
        plant.advance(10).ok().unwrap();
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
    let (a, b) = (bench.run("a", &[]), bench.run("b", &["--set", "tsda.1.stiffness=4e3"]));
    let done = bench.compare(&a, &b, &[]);
    assert!(done.out.contains("scene-a-and-b/{report.html,compare.json}"), "{}", done.out);
    let data = page(&bench, 2);
    let labels = data["runs"].as_array().unwrap().iter().map(|run| run["label"].clone());
    assert_eq!(
        labels.collect::<Vec<_>>(),
        ["A: tsda.1.stiffness = 2e3", "B: tsda.1.stiffness = 4e3"]
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
    assert!(text.contains("no animation of A: its scene, ") && text.contains("has changed since"));
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
        done.err.contains("holds the results of another") && done.err.contains("--overwrite"),
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

/// Every way in which a trace may be damaged, planted one by one.
#[test]
fn what_is_damaged_is_refused_with_its_place() {
    let bench = Bench::new();
    let (a, b) = (bench.run("a", &[]), bench.run("b", &["--set", "description=it swings"]));
    let [trace, summary] = ["trace.csv", "summary.json"].map(|name| PathBuf::from(&b).join(name));
    let (text, keys) = (fs::read_to_string(&trace).unwrap(), fs::read_to_string(&summary).unwrap());
    assert_eq!(bench.compare(&a, &b, &[]).exit, Exit::Done);
    fs::remove_dir_all(bench.folder.path("reports")).unwrap();
    let refused = |bytes: &[u8], keys: &str, parts: &[&str]| {
        fs::write(&trace, bytes).unwrap();
        fs::write(&summary, keys).unwrap();
        for (one, two) in [(&a, &b), (&b, &a)] {
            let done = bench.compare(one, two, &[]);
            assert_eq!(done.exit, Exit::Refused, "{parts:?}: {}", done.out);
            for part in parts {
                assert!(done.err.contains(part), "{part}: {}", done.err);
            }
            assert_eq!(done.out, "");
            assert!(!bench.folder.path("reports").exists());
        }
    };
    let lines: Vec<&str> = text.lines().collect();
    let without = |row: usize| {
        let kept = lines
            .iter()
            .enumerate()
            .filter(|(of, _)| *of != row)
            .map(|(_, line)| format!("{line}\n"));
        kept.collect::<String>()
    };
    // Line 1 says what was set, line 2 has the names, line 3 is t = 0.
    let with = |row: usize, column: usize, value: &str| {
        let edited = lines.iter().enumerate().map(|(of, line)| {
            let fields = line.split(',').enumerate();
            let fields: Vec<&str> = fields
                .map(|(at, field)| if (of, at) == (row, column) { value } else { field })
                .collect();
            fields.join(",") + "\n"
        });
        edited.collect::<String>()
    };
    let cut = |bytes: usize| text[..bytes].as_bytes().to_vec();
    let middle = text.len() - lines[22].len() / 2 - 1;
    let ends = "trace.csv:22: the trace ends after 20 of 21 rows, at t = 0.19s";
    refused(
        &cut(middle),
        &keys,
        &["trace.csv:23: the file ends within this line", "run the scene again"],
    );
    refused(&cut(text.len() - 1), &keys, &["trace.csv:23: the file ends within this line"]);
    refused(without(22).as_bytes(), &keys, &[ends, "summary.json says that the run came to 0.2s"]);
    refused(
        without(10).as_bytes(),
        &keys,
        &["trace.csv:11: rows are missing before this one, t = 90ms: they come every 10ms"],
    );
    refused(without(2).as_bytes(), &keys, &["trace.csv:3: the first row is at t = 10ms, not at 0"]);
    refused(
        without(1).as_bytes(),
        &keys,
        &["trace.csv:2:1: column 1: `0.0` stands where a trace has `time`"],
    );
    refused(
        without(0).as_bytes(),
        &keys,
        &["trace.csv:1: the summary says that `description` was set"],
    );
    refused(
        text.replace("it swings", "it sings").as_bytes(),
        &keys,
        &["trace.csv:1: the summary does not say"],
    );
    let twice = text.clone() + lines[22] + "\n";
    refused(twice.as_bytes(), &keys, &["trace.csv:24: the time 0.2s does not come after"]);
    refused(b"", &keys, &["trace.csv: is empty"]);
    refused(
        cut(lines[0].len() + 1).as_slice(),
        &keys,
        &["trace.csv:1: the file ends before the names"],
    );
    refused(
        cut(lines[0].len() + lines[1].len() + 2).as_slice(),
        &keys,
        &["trace.csv:2: the trace has no rows"],
    );
    // Numbers.
    refused(
        with(5, 3, "0.25").as_bytes(),
        &keys,
        &["trace.csv: the text is not the one that was written", "trace_hash"],
    );
    refused(
        with(22, 3, "0.25").as_bytes(),
        &keys,
        &["trace.csv:23: the last row does not have the bits of `state_hash`"],
    );
    let place = |row: usize, column: usize| {
        let before: usize = lines[row].split(',').take(column).map(|field| field.len() + 1).sum();
        format!("trace.csv:{}:{}: ", row + 1, before + 1)
    };
    for (value, part) in [
        ("nan", "`nan` is no number that a trace has: column `bob.y`"),
        ("NaN", "`NaN` stands for `bob.y`, which is finite in every row"),
        ("-1.#IND", "`-1.#IND` is no number"),
        ("#REF!", "`#REF!` is no number"),
        ("", "`` is no number"),
        (" 1.0", "` 1.0` is no number"),
        ("1e400", "`1e400` is no number"),
    ] {
        refused(with(7, 2, value).as_bytes(), &keys, &[&(place(7, 2) + part)]);
    }
    refused(
        with(7, 2, "0,8").as_bytes(),
        &keys,
        &["trace.csv:8:", "the line has 22 columns, not 21"],
    );
    refused(
        with(7, 0, "0.0501").as_bytes(),
        &keys,
        &["trace.csv:8:1: the time 0.0501 s is no multiple of the step"],
    );
    refused(with(7, 0, "0.051").as_bytes(), &keys, &["trace.csv:8: rows are missing"]);
    // Columns.
    refused(
        with(1, 3, "bob.q").as_bytes(),
        &keys,
        &["trace.csv:2:18: column 4: `bob.q` stands where a trace has `bob.z`"],
    );
    let columns = |to: usize| lines[1].split(',').take(to).collect::<Vec<_>>().join(",");
    let shorter = text.replacen(lines[1], &columns(20), 1);
    refused(
        shorter.as_bytes(),
        &keys,
        &["trace.csv:2: the read-outs are tip.x, tip.y, tip.z, those of"],
    );
    let shorter = text.replacen(lines[1], &columns(16), 1);
    refused(shorter.as_bytes(), &keys, &["trace.csv:2:", "`energy.total` is missing"]);
    // Other encodings and separators.
    let semicolons =
        text.lines().skip(1).map(|line| line.replace(',', ";") + "\n").collect::<String>();
    let unset = keys.replace("\"set\"", "\"unset\"");
    refused(
        semicolons.as_bytes(),
        &unset,
        &["trace.csv:1:1: column 1: ", "separated by commas, not by semicolons"],
    );
    let wide: Vec<u8> =
        [0xfffe].into_iter().chain(text.encode_utf16()).flat_map(u16::to_be_bytes).collect();
    refused(&wide, &keys, &["trace.csv:1:1: it is UTF-16"]);
    refused(
        &[b"\xef\xbb\xbf", text.as_bytes()].concat(),
        &keys,
        &["trace.csv:1:1: it begins with a byte order mark"],
    );
    let latin = [&text.as_bytes()[..10], b"\xe9", &text.as_bytes()[10..]].concat();
    refused(&latin, &keys, &["trace.csv:1:11: the byte 0xe9 is not UTF-8"]);
    refused(&[0x1f, 0x8b, 8, 0], &keys, &["trace.csv:1:1: it is compressed (gzip)"]);
    let endless = text.replacen(lines[8], &"1".repeat(2_000_000), 1);
    refused(endless.as_bytes(), &keys, &["trace.csv:9: the line is longer than 672 bytes"]);
    // Another version, another run, no summary of a run.
    let later = keys.replacen('{', "{ \"trace_format\": 2, \"version\": \"9.0.0\",", 1);
    let later = later.replace(",\n  \"trace_format\": 1", "").replace(&version(&keys), "");
    refused(
        text.as_bytes(),
        &later,
        &["summary.json: its trace is of format 2, written by host-sim 9.0.0", "reads format 1"],
    );
    let other = fs::read_to_string(
        Path::new(&bench.run("c", &["--duration", "0.1s", "--set", "description=it swings"]))
            .join("summary.json"),
    );
    refused(text.as_bytes(), &other.unwrap(), &["the trace has 21 rows, to t = 0.2s, more than"]);
    refused(
        text.as_bytes(),
        "{\n \"scene\": 1",
        &["summary.json:2:11: is no summary of a run: invalid type"],
    );
    refused(
        text.as_bytes(),
        "{}",
        &["summary.json:1:2: is no summary of a run: missing field `scene`"],
    );
    refused(
        text.as_bytes(),
        &keys.replace("\"f64\"", "\"f16\""),
        &["the precision `f16` is not known"],
    );
    refused(
        text.as_bytes(),
        &keys.replace("\"step\": 0.001", "\"step\": 0.0"),
        &["`step` is 0, which is no step"],
    );
    // A file is missing.
    fs::write(&summary, &keys).unwrap();
    fs::remove_file(&trace).unwrap();
    let done = bench.compare(&a, &b, &[]);
    assert!(
        done.exit == Exit::Refused && done.err.contains("there is no trace.csv beside it"),
        "{}",
        done.err
    );
    fs::write(&trace, &text).unwrap();
    fs::remove_file(&summary).unwrap();
    for named in [&b, &format!("{b}/trace.csv")] {
        let done = bench.compare(&a, named, &[]);
        assert!(
            done.exit == Exit::Refused && done.err.contains("there is no summary.json beside it"),
            "{}",
            done.err
        );
    }
    for (named, part) in [
        (bench.folder.path("nowhere"), "there is no such file or folder"),
        (bench.folder.path("."), "holds no run: there is neither trace.csv nor summary.json"),
        (PathBuf::from(&bench.scene), "holds neither a run nor a golden file"),
    ] {
        let done = bench.compare(&a, named.to_str().unwrap(), &[]);
        assert!(done.exit == Exit::Refused && done.err.contains(part), "{part}: {}", done.err);
    }
    // Line ends of another system are no edit.
    fs::write(&summary, &keys).unwrap();
    fs::write(&trace, text.replace('\n', "\r\n")).unwrap();
    assert_eq!(bench.compare(&a, &b, &[]).exit, Exit::Done);
}

/// The key of the version with its comma, as a summary has it; nothing where it has none.
fn version(keys: &str) -> String {
    let line = keys.lines().find(|line| line.trim_start().starts_with("\"version\""));
    line.map(|line| format!("\n{line}")).unwrap_or_default()
}

/// Of earlier versions there is no hash of the trace: read, and said.
#[test]
fn a_summary_of_an_earlier_version_is_read() {
    let bench = Bench::new();
    let (a, b) = (bench.run("a", &[]), bench.run("b", &[]));
    let summary = PathBuf::from(&b).join("summary.json");
    let keys: Value = serde_json::from_str(&fs::read_to_string(&summary).unwrap()).unwrap();
    let Value::Object(mut keys) = keys else { panic!() };
    keys.retain(|key, _| {
        !["trace_hash", "version", "trace_format", "samples", "turns"].contains(&key.as_str())
    });
    fs::write(&summary, Value::Object(keys).to_string()).unwrap();
    let (json, exit) = bench.json(&a, &b, &[]);
    assert_eq!((exit, &json["verdict"]), (Exit::Done, &"equal".into()));
    assert!(json["notes"][0].as_str().unwrap().contains("has no hash of its trace"), "{json}");
    let trace = PathBuf::from(&b).join("trace.csv");
    let text = fs::read_to_string(&trace).unwrap();
    let shorter: String = text.lines().take(15).map(|line| format!("{line}\n")).collect();
    fs::write(&trace, shorter).unwrap();
    let done = bench.compare(&a, &b, &[]);
    assert!(done.exit == Exit::Refused && done.err.contains("rows are missing"), "{}", done.err);
}

/// Turn counts are in the hash and in no column; a read-out may be without a number.
#[test]
fn turned_springs_and_undefined_readouts_are_read_back() {
    let folder = Folder::new();
    let [a, b] = ["a", "b"].map(|name| {
        let out = folder.path(name);
        let line = [
            "run",
            "crank-slider",
            "--quiet",
            "--duration",
            "0.5s",
            "--step",
            "50us",
            "--out",
            out.to_str().unwrap(),
        ];
        let done = call(&line);
        assert_eq!(done.exit, Exit::Done, "{}", done.err);
        out.join("crank-slider").to_str().unwrap().to_owned()
    });
    let out = folder.path("reports");
    let done = call(&["compare", &a, &b, "--out", out.to_str().unwrap()]);
    assert_eq!(done.exit, Exit::Done, "{} {}", done.out, done.err);
    let trace = Trace::read(&Path::new(&a).join("trace.csv"));
    assert!(same(trace.times()[0], 0.0));
}
