//! The command line as users and their scripts meet it: exit codes, files, numbers, messages.

use std::fs;
use std::path::{Path, PathBuf};

use dbd_kernel::words::{Fnv1a, Word, WordVisitor};
use host_sim::cli::main_with;
use host_sim::console::Console;
use host_sim::error::Exit;
use serde_json::Value;
use tempfile::TempDir;

/// What a command came to.
struct Done {
    exit: Exit,
    out: String,
    err: String,
}

fn call(arguments: &[&str]) -> Done {
    let (mut out, mut err) = (Vec::new(), Vec::new());
    let mut console = Console { out: &mut out, err: &mut err, terminal: false };
    let exit =
        main_with(std::iter::once("host-sim").chain(arguments.iter().copied()), &mut console);
    let text = |bytes| String::from_utf8(bytes).unwrap();
    Done { exit, out: text(out), err: text(err) }
}

/// A folder for results that is gone after the test.
struct Folder(TempDir);

impl Folder {
    fn new() -> Self {
        Self(tempfile::tempdir().unwrap())
    }

    fn path(&self, below: &str) -> PathBuf {
        self.0.path().join(below)
    }

    /// Runs a scene with its results below `out`, and with what else is given.
    fn run(&self, scene: &str, options: &[&str]) -> Done {
        let out = self.path("out");
        let mut arguments = vec!["run", scene, "--out", out.to_str().unwrap()];
        arguments.extend(options);
        call(&arguments)
    }

    /// The same, as the summary that is printed.
    fn summary(&self, scene: &str, options: &[&str]) -> Value {
        let done = self.run(scene, &[options, &["--json"]].concat());
        serde_json::from_str(&done.out).unwrap_or_else(|_| panic!("{} {}", done.out, done.err))
    }

    fn trace(&self, scene: &str) -> Trace {
        Trace::read(&self.path("out").join(scene).join("trace.csv"))
    }

    /// A scene file in this folder.
    fn scene(&self, text: &str) -> String {
        let path = self.path("scene.toml");
        fs::write(&path, text).unwrap();
        path.to_str().unwrap().into()
    }
}

/// A trace as texts.
struct Trace {
    header: Vec<String>,
    rows: Vec<Vec<String>>,
}

impl Trace {
    fn read(path: &Path) -> Self {
        let text = fs::read_to_string(path).unwrap();
        let mut lines = text.lines().map(|line| line.split(',').map(str::to_owned).collect());
        Self { header: lines.next().unwrap(), rows: lines.collect() }
    }

    fn times(&self) -> Vec<f64> {
        self.rows.iter().map(|row| row[0].parse().unwrap()).collect()
    }
}

/// Swings for half a second without springs that are stiff: quick to run in any build.
const PENDULUM: &str = r#"
name = "pendulum"
description = "A bob on one spring. It swings."
gravity = [0.0, -9.81, 0.0]
duration = 0.5

[[body]]
name = "bob"
mass = 0.5
inertia = [1e-3, 1e-3, 1e-3]
position = [0.6, 0.8, 0.0]

[[tsda]]
between = ["world", "bob"]
points = [[0, 0, 0], [0, 0, 0]]
stiffness = 2e3
free_length = 1.0
"#;

fn times_in(text: &str, option: &str) -> Vec<String> {
    let words: Vec<&str> = text.split_whitespace().collect();
    let pairs = words.windows(2).filter(|pair| pair[0] == option);
    pairs.map(|pair| pair[1].trim_end_matches([';', ',', ':']).to_owned()).collect()
}

#[test]
fn one_step_has_one_hash_however_it_is_written() {
    let folder = Folder::new();
    let hash = |options: &[&str]| {
        let summary = folder.summary("four-bar", &[&["--duration", "20ms"], options].concat());
        assert_eq!(summary["status"], "ok");
        assert_eq!(summary["step"].as_f64().map(f64::to_bits), Some(2e-5_f64.to_bits()));
        summary["state_hash"].as_str().unwrap().to_owned()
    };
    // The scene's own step is 2e-5.
    let of_the_scene = hash(&[]);
    assert_eq!(of_the_scene.len(), 16);
    for step in ["20us", "20µs", "0.02ms", "2e-5s", "20000ns"] {
        assert_eq!(hash(&["--step", step]), of_the_scene, "{step}");
    }
}

#[test]
fn the_summary_has_its_keys_in_order_and_is_the_file() {
    let folder = Folder::new();
    let scene = folder.scene(PENDULUM);
    let done = folder.run(&scene, &["--json"]);
    assert_eq!((done.exit, done.err.as_str()), (Exit::Done, ""));
    let keys = [
        "scene",
        "scheme",
        "newton",
        "precision",
        "orientation",
        "step",
        "steps",
        "duration",
        "force_evaluations",
        "wall_seconds",
        "srt",
        "energy_initial",
        "energy_final",
        "energy_drift_rate",
        "energy_rms_error",
        "max_joint_extension",
        "frequency_bound_hz",
        "frequency_estimate_hz",
        "advised_step",
        "state_hash",
        "status",
    ];
    let found: Vec<&str> = done
        .out
        .lines()
        .filter_map(|line| line.trim().strip_prefix('"')?.split_once("\":").map(|(key, _)| key))
        .collect();
    assert_eq!(found, keys);
    let written = fs::read_to_string(folder.path("out/pendulum/summary.json")).unwrap();
    assert_eq!(written, done.out);
    let summary: Value = serde_json::from_str(&done.out).unwrap();
    assert_eq!(summary["scheme"], "leapfrog");
    assert_eq!(summary["newton"], Value::Null);
    assert!(summary["energy_rms_error"].as_f64().unwrap() > 0.0);
    // ω² = k/m = 4000: the estimate meets it, the bound is not below it.
    let omega = 4e3_f64.sqrt() / std::f64::consts::TAU;
    assert!((summary["frequency_estimate_hz"].as_f64().unwrap() / omega - 1.0).abs() < 1e-3);
    assert!(summary["frequency_bound_hz"].as_f64().unwrap() >= omega);
    let report = fs::read_to_string(folder.path("out/pendulum/report.html")).unwrap();
    assert!(report.contains(summary["state_hash"].as_str().unwrap()));
}

#[test]
fn dampers_and_loads_leave_no_energy_error() {
    let folder = Folder::new();
    let damped = PENDULUM.replace("free_length = 1.0", "free_length = 1.0\ndamping = 0.1");
    let loaded = format!("{PENDULUM}\n[[load]]\nbody = \"bob\"\nforce = [0, 1, 0]\n");
    for text in [damped, loaded] {
        let summary = folder.summary(&folder.scene(&text), &[]);
        assert_eq!(
            (&summary["status"], &summary["energy_rms_error"]),
            (&"ok".into(), &Value::Null)
        );
    }
}

#[test]
fn bad_input_ends_with_2_and_writes_nothing() {
    let folder = Folder::new();
    let good = folder.scene(PENDULUM);
    let bad = folder.path("bad.toml");
    fs::write(&bad, PENDULUM.replace("mass = 0.5", "mass = -0.5")).unwrap();
    let bad = bad.to_str().unwrap();
    let cases: [(&str, &[&str], &str); 18] = [
        ("fuor-bar", &[], "did you mean four-bar?"),
        ("no-such-thing", &[], "four-bar"),
        ("no/such/file.toml", &[], "no/such/file.toml"),
        (bad, &[], "mass"),
        (&good, &["--step", "2e-5"], "2e-5us"),
        (&good, &["--step", "fast"], "20us"),
        (&good, &["--step", "-1ms"], "positive"),
        (&good, &["--duration", "0s"], "positive"),
        (&good, &["--step", "1e-300s"], "--step"),
        (&good, &["--step", "1us", "--every", "1ns"], "--step"),
        (&good, &["--every", "1s"], "--every 0.5s"),
        (&good, &["--newton", "1"], "--scheme dbd"),
        (&good, &["--scheme", "dbd-p2", "--newton", "9"], "--newton 8"),
        (&good, &["--scheme", "pefrl", "--damping", "explicit"], "leapfrog"),
        (&good, &["--scheme", "dbd", "--damping", "sweeps"], "--damping"),
        (&good, &["--scheme", "simplectic"], "leapfrog"),
        (&good, &["--precision", "f16"], "f32"),
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
fn our_step_is_half_the_limit_shortened_to_fit() {
    let folder = Folder::new();
    let scene = folder.scene(PENDULUM);
    for options in [&["--every", "1ms"][..], &["--every", "7ms"], &[]] {
        let summary = folder.summary(&scene, options);
        let step = summary["step"].as_f64().unwrap();
        let advised = summary["advised_step"].as_f64().unwrap();
        assert!(step <= advised * (1.0 + 1e-15), "{step}");
        let end = summary["steps"].as_f64().unwrap() * step;
        assert!((end - 0.5).abs() < 1e-12);
    }
    // The step is a function of the scene, not of the precision.
    let step = |precision| folder.summary(&scene, &["--precision", precision])["step"].clone();
    assert_eq!(step("f64"), step("f32"));
}

#[test]
fn rows_are_multiples_of_the_step_from_0_to_the_duration() {
    let folder = Folder::new();
    let scene = folder.scene(PENDULUM);
    let rows = |options: &[&str]| {
        assert_eq!(folder.summary(&scene, options)["status"], "ok");
        folder.trace("pendulum").times()
    };
    let times = rows(&["--step", "0.1ms", "--every", "1ms"]);
    assert_eq!(times.len(), 501);
    for (row, time) in times.iter().enumerate() {
        assert_eq!(time.to_bits(), ((10 * row) as f64 * 1e-4).to_bits());
    }
    // The last interval is shorter where `every` does not divide the duration.
    let times = rows(&["--step", "1ms", "--every", "150ms"]);
    assert_eq!(times, [0.0, 150.0 * 1e-3, 300.0 * 1e-3, 450.0 * 1e-3, 0.5]);
    // About 500 without it.
    let samples = rows(&["--step", "10us"]).len();
    assert_eq!(samples, 501);
    assert_eq!(rows(&["--step", "1ms", "--every", "0.5s"]), [0.0, 0.5]);
}

#[test]
fn the_last_row_of_a_trace_reads_back_to_the_bits_of_the_hash() {
    let folder = Folder::new();
    for precision in ["f64", "f32"] {
        let options = ["--duration", "20ms", "--precision", precision];
        let summary = folder.summary("four-bar", &options);
        let trace = folder.trace("four-bar");
        let last = trace.rows.last().unwrap();
        let bodies = 3;
        assert_eq!(trace.header.len(), 1 + 13 * bodies + 3);
        assert_eq!(trace.header[..5], ["time", "crank.x", "crank.y", "crank.z", "crank.qw"]);
        assert_eq!(
            trace.header[13 * bodies + 1..],
            ["energy.kinetic", "energy.potential", "energy.total"]
        );
        let mut hash = Fnv1a::new();
        for text in &last[1..=13 * bodies] {
            hash.word(match precision {
                "f64" => Word::F64(text.parse().unwrap()),
                _ => Word::F32(text.parse().unwrap()),
            });
        }
        // Two torsion springs that have not turned, then the step counter.
        for word in [Word::I32(0), Word::I32(0), Word::U64(1000)] {
            hash.word(word);
        }
        let hash = format!("{:016x}", hash.finish());
        assert_eq!(summary["state_hash"], Value::String(hash), "{precision}");
    }
}

#[test]
fn energies_of_a_trace_are_those_of_the_summary() {
    let folder = Folder::new();
    let scene = folder.scene(PENDULUM);
    let summary = folder.summary(&scene, &["--precision", "f32"]);
    let trace = folder.trace("pendulum");
    let energies: Vec<f64> =
        trace.rows.iter().map(|row| row.last().unwrap().parse().unwrap()).collect();
    let number = |key: &str| summary[key].as_f64().unwrap();
    assert_eq!(energies[0].to_bits(), number("energy_initial").to_bits());
    assert_eq!(energies.last().unwrap().to_bits(), number("energy_final").to_bits());
    let squares: f64 = energies.iter().map(|e| (e - energies[0]) * (e - energies[0])).sum();
    let rms = (squares / energies.len() as f64).sqrt();
    assert!((number("energy_rms_error") / rms - 1.0).abs() < 1e-12);
    for row in &trace.rows {
        let [kinetic, potential, total] =
            [3, 2, 1].map(|back| row[row.len() - back].parse::<f64>().unwrap());
        assert_eq!((kinetic + potential).to_bits(), total.to_bits());
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
fn quiet_prints_nothing_and_the_table_has_units() {
    let folder = Folder::new();
    let scene = folder.scene(PENDULUM);
    let done = folder.run(&scene, &["--quiet"]);
    assert_eq!((done.exit, done.out.as_str(), done.err.as_str()), (Exit::Done, "", ""));
    let done = folder.run(&scene, &[]);
    for part in ["pendulum", "leapfrog, f64", " J\n", " W\n", " Hz", "state hash", "trace.csv"] {
        assert!(done.out.contains(part), "{part}: {}", done.out);
    }
}

#[test]
fn newton_iterations_count_as_evaluations() {
    let folder = Folder::new();
    let scene = folder.scene(PENDULUM);
    let options = ["--scheme", "dbd", "--newton", "2", "--step", "1ms"];
    let summary = folder.summary(&scene, &options);
    assert_eq!((&summary["newton"], &summary["steps"]), (&2.into(), &500.into()));
    assert_eq!(summary["force_evaluations"], 2500);
    assert_eq!(folder.summary(&scene, &options[..2])["newton"], 0);
}

#[test]
fn every_scheme_counts_its_evaluations() {
    let folder = Folder::new();
    let scene = folder.scene(PENDULUM);
    let counts = [
        ("dbd", 1500),
        ("dbd-p1", 1000),
        ("dbd-p2", 1500),
        ("semi-implicit-euler", 500),
        // The first step begins with one.
        ("leapfrog", 501),
        ("pefrl", 2000),
        ("blanes-moan-s6", 3000),
        ("rk4", 2000),
    ];
    for (scheme, evaluations) in counts {
        let summary = folder.summary(&scene, &["--scheme", scheme, "--step", "1ms"]);
        assert_eq!(summary["scheme"], scheme);
        assert_eq!((&summary["steps"], &summary["status"]), (&500.into(), &"ok".into()));
        assert_eq!(summary["force_evaluations"], evaluations, "{scheme}");
        assert_eq!(summary["newton"].is_number(), scheme.starts_with("dbd"));
    }
}

#[test]
fn dampers_are_explicit_on_demand() {
    let folder = Folder::new();
    let text = PENDULUM.replace("free_length = 1.0", "free_length = 1.0\ndamping = 5.0");
    let scene = folder.scene(&text);
    let own = folder.summary(&scene, &["--step", "1ms"]);
    assert!(own.get("damping").is_none());
    let explicit = folder.summary(&scene, &["--step", "1ms", "--damping", "explicit"]);
    assert_eq!((&explicit["scheme"], &explicit["damping"]), (&own["scheme"], &"explicit".into()));
    assert_eq!(explicit["force_evaluations"], 1000);
    assert_ne!(explicit["state_hash"], own["state_hash"]);
    let sweeps = folder.summary(&scene, &["--step", "1ms", "--damping", "sweeps"]);
    assert_eq!(sweeps["state_hash"], own["state_hash"]);
}

#[test]
fn orientations_are_stored_as_asked() {
    let folder = Folder::new();
    let scene = folder.scene(PENDULUM);
    let mut hashes = Vec::new();
    for orientation in ["quaternion", "euler-321", "euler-321-single"] {
        for precision in ["f64", "f32"] {
            let options = ["--orientation", orientation, "--precision", precision];
            let summary = folder.summary(&scene, &options);
            assert_eq!(
                (&summary["orientation"], &summary["precision"], &summary["status"]),
                (&orientation.into(), &precision.into(), &"ok".into())
            );
            hashes.push(summary["state_hash"].clone());
        }
    }
    assert_eq!(folder.summary(&scene, &[])["state_hash"], hashes[0]);
    hashes.sort_by_key(ToString::to_string);
    hashes.dedup();
    assert_eq!(hashes.len(), 6);
}

#[test]
fn list_shows_every_scene_on_a_line() {
    let done = call(&["list"]);
    assert_eq!((done.exit, done.err.as_str()), (Exit::Done, ""));
    let line = done.out.lines().find(|line| line.starts_with("four-bar ")).unwrap();
    for part in ["3 bodies", "24 TSDAs", "Four-bar linkage"] {
        assert!(line.contains(part), "{line}");
    }
    let done = call(&["list", "--json"]);
    let scenes: Vec<Value> = serde_json::from_str(&done.out).unwrap();
    let four_bar = scenes.iter().find(|scene| scene["name"] == "four-bar").unwrap();
    assert_eq!((&four_bar["bodies"], &four_bar["tsdas"]), (&3.into(), &24.into()));
}

#[test]
fn check_counts_and_warns_without_running() {
    let done = call(&["check", "four-bar", "--json"]);
    assert_eq!((done.exit, done.err.as_str()), (Exit::Done, ""));
    let check: Value = serde_json::from_str(&done.out).unwrap();
    assert_eq!((&check["bodies"], &check["tsdas"]), (&3.into(), &24.into()));
    // Four revolutes of five each: a planar loop counts its out-of-plane freedoms too often.
    assert_eq!((&check["degrees_of_freedom"], &check["equations"]), (&(-2).into(), &18.into()));
    assert_eq!(check["joints"].as_array().unwrap().len(), 4);
    assert_eq!(check["warnings"].as_array().unwrap().len(), 0);
    assert!(check["assembly_error"].as_f64().unwrap() < 1e-12);

    let folder = Folder::new();
    let text = PENDULUM.replace("duration = 0.5", "duration = 0.5\nstep = 0.05")
        + "\n[[body]]\nname = \"stone\"\nmass = 1\ninertia = [1, 1, 1]\nposition = [0, 5, 0]\n";
    let scene = folder.scene(&text);
    let done = call(&["check", &scene]);
    assert_eq!(done.exit, Exit::Done);
    for part in
        ["body `stone` (line ", "no element holds it", "the scene's step of 50ms", "12; 12 with"]
    {
        assert!(done.out.contains(part), "{part}: {}", done.out);
    }
}

#[test]
fn check_finds_the_largest_stable_step_on_demand() {
    let arguments = ["check", "spring-ball", "--stability", "--scheme", "dbd", "--newton", "1"];
    let done = call(&[&arguments[..], &["--json"]].concat());
    let check: Value = serde_json::from_str(&done.out).unwrap();
    let stability = &check["stability"];
    let step = stability["largest_step"].as_f64().unwrap();
    assert!((step * 1e3_f64.sqrt() - 1.0).abs() < 0.02, "{stability}");
    assert_eq!((&stability["scheme"], &stability["newton"]), (&"dbd".into(), &1.into()));
    assert!(call(&arguments).out.contains("largest stable step"));
    let without = call(&["check", "spring-ball", "--json"]).out;
    assert!(!without.contains("stability"));
    let refused = call(&["check", "spring-ball", "--scheme", "dbd"]);
    assert!(refused.err.contains("--stability") && refused.out.is_empty());
}

#[test]
fn check_says_what_the_initial_velocities_do_to_the_joints() {
    let folder = Folder::new();
    let text = r#"
name = "kicked"
duration = 0.1

[[body]]
name = "arm"
mass = 1
inertia = [0.1, 0.1, 0.1]
position = [1, 0, 0]
velocity = [0.5, 0, 0]

[[joint]]
name = "hinge"
type = "spherical"
between = ["world", "arm"]
at = [0, 0, 0]
stiffness = 1e5
arm = 0.03
"#;
    let done = call(&["check", &folder.scene(text), "--json"]);
    let check: Value = serde_json::from_str(&done.out).unwrap();
    let rate = check["joints"][0]["stretching_rate"].as_f64().unwrap();
    // At most the whole velocity, along the spring most nearly parallel to it.
    assert!(rate > 0.2 && rate <= 0.5, "{rate}");
    assert!(check["notes"][0].as_str().unwrap().contains("hinge"));
    let turning = text
        .replace("velocity = [0.5, 0, 0]", "velocity = [0, 2, 0]\nangular_velocity = [0, 0, 2]");
    let done = call(&["check", &folder.scene(&turning), "--json"]);
    let check: Value = serde_json::from_str(&done.out).unwrap();
    assert!(check["joints"][0]["stretching_rate"].as_f64().unwrap() < 1e-12);
}

#[test]
fn export_writes_the_bits_of_the_model() {
    let done = call(&["export", "four-bar", "--precision", "f32"]);
    assert_eq!(done.exit, Exit::Done);
    // 9 MN/m and the crank's mass of 1 kg in single precision.
    for part in [
        "pub type FourBarF32 = Model<F32, 3, 4, 20, 24,",
        "pub const FOUR_BAR_STEP: f64 = f64::from_bits(0x3ef4f8b588e368f1)",
        "stiffness: f32::from_bits(0x4b095440)",
        "mass: f32::from_bits(0x3f800000)",
    ] {
        assert!(done.out.contains(part), "{part}: {}", &done.out[..600]);
    }
    assert!(!done.out.contains("FOUR_BAR_F64"));
    assert!(call(&["export", "four-bar"]).out.contains("FOUR_BAR_F64"));
}

#[test]
fn an_input_beyond_the_precision_is_refused_by_name() {
    let folder = Folder::new();
    let input = "[[input]]\nname = \"gust\"\ntype = \"force\"\nbody = \"bob\"\naxis = [1, 0, 0]\n";
    for drive in ["value = 1e300", "table = [[0, 0], [1e-30, 1e10]]\ninterpolate = \"linear\""] {
        let scene = folder.scene(&format!("{PENDULUM}{input}{drive}\n"));
        let done = folder.run(&scene, &["--precision", "f32"]);
        assert_eq!(done.exit, Exit::Refused, "{}", done.err);
        for part in ["input `gust` (line 18)", "f32 cannot hold", "--precision f64"] {
            assert!(done.err.contains(part), "{part}: {}", done.err);
        }
        assert!(!folder.path("out").exists());
        assert_eq!(call(&["export", &scene, "--precision", "f32"]).exit, Exit::Refused);
        assert_eq!(call(&["export", &scene, "--precision", "f64"]).exit, Exit::Done);
    }
}
