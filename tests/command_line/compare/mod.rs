//! `compare`: two recorded runs: verdicts, figures, what is refused, what is written.

mod refused;
mod report;

use std::path::Path;

use host_sim::terminal::Exit;
use serde_json::Value;

use crate::{Done, Folder, PENDULUM, Trace, call};

/// The pendulum with what shows where its bob is.
fn scene() -> String {
    format!(
        "{PENDULUM}name = \"spring\"\n\n[[readout]]\nname = \"tip\"\ntype = \"point\"\nbody = \"bob\"\npoint = [0, -0.1, 0]\n\
         \n[[readout]]\nname = \"pull\"\ntype = \"tsda_force\"\ntarget = \"spring\"\n"
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
    let reported = &json["differs"][0];
    assert_eq!(
        (&reported["what"], &reported["a"], &reported["b"]),
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
    let stiffer = bench.run("b", &["--set", "tsda.spring.stiffness=4e3"]);
    let (json, exit) = bench.json(&a, &stiffer, &[]);
    assert_eq!(exit, Exit::Failed);
    let reported = &json["differs"][0];
    assert_eq!(
        (&reported["what"], &reported["b"]),
        (&"set tsda.spring.stiffness".into(), &"4e3".into())
    );
    assert_eq!(reported["a"], "2e3");
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
        ("-1", "`-1` is not a valid band"),
        ("position=1", "no band for the orientation"),
        ("1,elbow=1", "a band is given for `elbow`"),
        (
            "position=1,orientation=1,velocity=1,angular-velocity=1,pull=1",
            "no band is given for `tip.x`",
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
    assert!(
        text.contains("different: only one run failed, or they failed at different times"),
        "{text}"
    );
    assert!(text.contains("B failed: "), "{text}");
}
