//! What `run` computes, prints and writes.

use std::fs;

use dbd_kernel::words::{Fnv1a, Word, WordVisitor};
use host_sim::terminal::Exit;
use serde_json::Value;

use crate::{Folder, PENDULUM};

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
    for step in ["20us", "20µs", "0.02ms", "2e-5s", "20000ns", "2e-5", "0.00002"] {
        assert_eq!(hash(&["--step", step]), of_the_scene, "{step}");
    }
}

/// A number is seconds and a text has a unit, in scenes and on the command line alike.
#[test]
fn times_have_two_spellings_everywhere() {
    let folder = Folder::new();
    let timed = |step: &str, every: &str, duration: &str| {
        let drive =
            "[[input]]\nname = \"gust\"\ntype = \"force\"\nbody = \"bob\"\naxis = [1, 0, 0]\n";
        let text = PENDULUM.replace(
            "duration = 0.5",
            &format!("duration = {duration}\nstep = {step}\nevery = {every}"),
        );
        format!(
            "{text}{drive}table = [[0, 1], [{every}, 2]]\n[[load]]\nbody = \"bob\"\nforce = [1, 0, 0]\nuntil = {every}\n"
        )
    };
    let summary = |text: &str, options: &[&str]| {
        let mut summary = folder.summary(&folder.scene(text), options);
        // What differs by the clock and by the text.
        for key in ["wall_seconds", "srt", "scene_hash"] {
            summary.as_object_mut().unwrap().remove(key);
        }
        summary
    };
    let numbers = summary(&timed("8e-5", "0.01", "0.24"), &[]);
    assert_eq!(numbers["step"].as_f64().map(f64::to_bits), Some(8e-5_f64.to_bits()));
    assert_eq!(summary(&timed("\"80us\"", "\"10ms\"", "\"0.24s\""), &[]), numbers);
    let other = timed("1e-3", "0.01", "1");
    for [step, every, duration] in [["80us", "10ms", "0.24s"], ["8e-5", "1e-2", "0.24"]] {
        let options = ["--step", step, "--every", every, "--duration", duration];
        assert_eq!(summary(&other, &options), numbers, "{options:?}");
    }
    let checked = crate::call(&["check", &folder.scene(&timed("\"80us\"", "1", "2")), "--json"]);
    assert!(
        checked.out.contains("\"step\": 8e-5") || checked.out.contains("0.00008"),
        "{}",
        checked.out
    );
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
        "samples",
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
        "turns",
        "trace_hash",
        "status",
        "version",
        "trace_format",
        "scene_file",
        "scene_hash",
        "widest_joint",
        "warnings",
        "readouts",
    ];
    let found: Vec<&str> = done
        .out
        .lines()
        .filter_map(|line| line.trim().strip_prefix('"')?.split_once("\":").map(|(key, _)| key))
        .collect();
    assert_eq!(found, keys);
    let written = fs::read_to_string(folder.path("out/scene/summary.json")).unwrap();
    assert_eq!(written, done.out);
    let summary: Value = serde_json::from_str(&done.out).unwrap();
    assert_eq!(summary["scheme"], "leapfrog");
    assert_eq!(summary["newton"], Value::Null);
    assert!(summary["energy_rms_error"].as_f64().unwrap() > 0.0);
    // ω² = k/m = 4000: the estimate meets it, the bound is not below it.
    let omega = 4e3_f64.sqrt() / std::f64::consts::TAU;
    assert!((summary["frequency_estimate_hz"].as_f64().unwrap() / omega - 1.0).abs() < 1e-3);
    assert!(summary["frequency_bound_hz"].as_f64().unwrap() >= omega);
    let report = fs::read_to_string(folder.path("out/scene/report.html")).unwrap();
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
        folder.trace("scene").times()
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
    let trace = folder.trace("scene");
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
        ("generalized-alpha", 500),
        ("generalized-alpha-3", 1500),
    ];
    for (scheme, evaluations) in counts {
        let summary = folder.summary(&scene, &["--scheme", scheme, "--step", "1ms"]);
        assert_eq!(summary["scheme"], scheme);
        assert_eq!((&summary["steps"], &summary["status"]), (&500.into(), &"ok".into()));
        assert_eq!(summary["force_evaluations"], evaluations, "{scheme}");
        assert_eq!(summary["newton"].is_number(), scheme.starts_with("dbd"));
    }
}

/// What `--ideal` chooses it says as options, and these alone do the same.
#[test]
fn ideal_joints_are_chosen_and_said() {
    let folder = Folder::new();
    let whole = folder.run("four-bar", &["--ideal", "0.1mm", "--json"]);
    assert!(whole.out.contains("\"status\": \"ok\""), "{} {}", whole.out, whole.err);
    let often = ["--ideal", "1mm", "--duration", "0.09s", "--every", "0.3ms", "--json"];
    let often = folder.run("four-bar", &often);
    assert!(often.out.contains("\"status\": \"ok\""), "{} {}", often.out, often.err);
    let chosen = folder.run("four-bar", &["--ideal", "0.1mm", "--duration", "0.1s", "--json"]);
    let note = chosen.err.lines().find(|line| line.contains("ideal joints, error")).unwrap();
    let (_, options) = note.split_once("): ").unwrap();
    let words: Vec<&str> = options.split_whitespace().collect();
    assert!(words.contains(&"--scheme") && words.contains(&"--step"), "{note}");
    let hash = |json: &str| {
        let summary: serde_json::Value = serde_json::from_str(json).unwrap();
        assert_eq!(summary["status"], "ok");
        summary["state_hash"].clone()
    };
    let words = [&words[..], &["--duration", "0.1s", "--json"]].concat();
    let again = folder.run("four-bar", &words);
    assert_eq!(hash(&chosen.out), hash(&again.out), "{}", again.err);
}

#[test]
fn ideal_joints_are_refused_where_there_are_none_or_the_method_is_given() {
    let folder = Folder::new();
    for (scene, words, said) in [
        ("spring-ball", &["--ideal", "0.1mm"][..], "no joint that could be made ideal"),
        ("four-bar", &["--ideal", "soon"], "--ideal: invalid value `soon`"),
        ("four-bar", &["--ideal", "0"], "--ideal: invalid value `0`"),
        ("four-bar", &["--ideal", "0.1mm", "--step", "1ms"], "cannot be used with"),
        ("four-bar", &["--ideal", "1e-15", "--duration", "0.05s"], "is not reachable"),
    ] {
        let refused = folder.run(scene, words);
        assert!(refused.err.contains(said), "{words:?}: {}", refused.err);
    }
}

/// A reused evaluation is stale where ground moves between two steps: the table says so. A table of forces costs none.
#[test]
fn more_evaluations_than_the_schemes_are_explained() {
    let folder = Folder::new();
    let gust = "[[input]]\nname = \"gust\"\ntype = \"force\"\nbody = \"bob\"\naxis = [1, 0, 0]\n\
                table = [[0, 1], [0.1, 2], [0.2, 3]]\n";
    let load = "[[load]]\nbody = \"bob\"\nforce = [1, 0, 0]\nfrom = 0.1\nuntil = 0.2\n";
    let scene = folder.scene(&format!("{PENDULUM}{gust}{load}"));
    let of = |options: &[&str]| {
        let count = |key: &str| folder.summary(&scene, options)[key].as_u64().unwrap();
        let text = folder.run(&scene, options).out;
        let line = text.lines().find(|line| line.starts_with("force evaluations")).unwrap();
        (count("force_evaluations"), count("steps"), line.to_owned())
    };
    let (evaluations, steps, line) = of(&["--step", "1ms"]);
    let anew = evaluations - steps - 1;
    assert!(anew >= 2, "{anew}");
    let said =
        format!("{evaluations} (1 per step, {anew} repeated after changes of a table or a load)");
    assert!(line.ends_with(&said), "{line}");
    let (evaluations, steps, line) = of(&["--step", "1ms", "--scheme", "pefrl"]);
    assert_eq!(evaluations, 4 * steps);
    assert!(line.ends_with(&format!("{evaluations} (4 per step)")), "{line}");
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
    for orientation in ["quaternion", "euler-321"] {
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
    assert_eq!(hashes.len(), 4);
}

#[test]
fn without_a_report_there_is_none_of_an_earlier_run_either() {
    let folder = Folder::new();
    let scene = folder.scene(PENDULUM);
    let page = folder.path("out/scene/report.html");
    let done = folder.run(&scene, &["--no-report"]);
    assert!(done.out.contains("{trace.csv,summary.json}"), "{}", done.out);
    assert!(!page.exists() && folder.path("out/scene/summary.json").exists());
    let trace = folder.trace("scene").rows;
    folder.run(&scene, &[]);
    assert!(page.exists() && folder.trace("scene").rows == trace);
    folder.run(&scene, &["--no-report"]);
    assert!(!page.exists() && folder.trace("scene").rows == trace);
}

/// The figures of a read-out are those of its column in the trace.
#[test]
fn the_summary_says_what_read_outs_showed() {
    let folder = Folder::new();
    let readouts = "[[readout]]\nname = \"tip\"\ntype = \"point\"\nbody = \"bob\"\npoint = [0, 0.1, 0]\n\
                    [[readout]]\nname = \"drop\"\ntype = \"point_velocity\"\nbody = \"bob\"\npoint = [0, 0, 0]\n";
    let scene = folder.scene(&format!("{PENDULUM}{readouts}"));
    let summary = folder.summary(&scene, &["--every", "10ms"]);
    let figures = summary["readouts"].as_array().unwrap();
    let names: Vec<_> = figures.iter().map(|one| one["name"].as_str().unwrap()).collect();
    assert_eq!(names, ["tip.x", "tip.y", "tip.z", "drop.x", "drop.y", "drop.z"]);
    assert_eq!((&figures[0]["unit"], &figures[5]["unit"]), (&"m".into(), &"m/s".into()));
    let trace = folder.trace("scene");
    for (figures, name) in figures.iter().zip(names) {
        let place = trace.header.iter().position(|header| header == name).unwrap();
        let values: Vec<f64> = trace.rows.iter().map(|row| row[place].parse().unwrap()).collect();
        let most = values.iter().copied().fold(f64::MIN, f64::max);
        let least = values.iter().copied().fold(f64::MAX, f64::min);
        let rms = (values.iter().map(|v| v * v).sum::<f64>() / values.len() as f64).sqrt();
        let at = trace.times()[values.iter().position(|value| *value == most).unwrap()];
        let of =
            ["min", "max", "rms", "final", "time_of_max"].map(|key| figures[key].as_f64().unwrap());
        assert_eq!(of, [least, most, rms, values[values.len() - 1], at], "{name}");
    }
    let table = folder.run(&scene, &["--every", "10ms"]).out;
    assert!(
        table.contains("read-out ") && table.contains("`drop.z`: 0 to 0 m/s, RMS 0, at the end 0"),
        "{table}"
    );
}
