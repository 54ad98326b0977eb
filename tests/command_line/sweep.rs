//! `sweep`: many values of a scene, a row per case.

use std::fs;
use std::path::PathBuf;

use host_sim::terminal::Exit;
use serde_json::Value;

use crate::{Done, Folder, PENDULUM, call};

/// A few milliseconds of the pendulum.
const FIXED: &str =
    "scene = \"scene.toml\"\nduration = \"10ms\"\nstep = \"1ms\"\nevery = \"1ms\"\n";

impl Folder {
    /// A sweep's file beside the pendulum's.
    fn sweep(&self, text: &str) -> String {
        self.scene(PENDULUM);
        let path = self.path("s.toml");
        fs::write(&path, text).unwrap();
        path.to_str().unwrap().into()
    }

    /// Sweeps with results below `out`.
    fn swept(&self, spec: &str, options: &[&str]) -> Done {
        self.swept_to("out", spec, options)
    }

    fn swept_to(&self, out: &str, spec: &str, options: &[&str]) -> Done {
        let out = self.path(out);
        call(&[&["sweep", spec, "--out", out.to_str().unwrap()], options].concat())
    }

    /// The table, its header first.
    fn table(&self, out: &str) -> Vec<Vec<String>> {
        let text = fs::read_to_string(self.path(out).join("s/sweep.csv")).unwrap();
        let cells = |line: &str| {
            // Commas within quotes are no ends of cells.
            let parts = line.split('"').enumerate();
            let parts = parts
                .map(|(i, part)| if i % 2 == 1 { part.replace(',', ";") } else { part.into() });
            parts.collect::<String>().split(',').map(str::to_owned).collect()
        };
        text.lines().map(cells).collect()
    }

    fn column(&self, name: &str) -> Vec<String> {
        let table = self.table("out");
        let place = table[0].iter().position(|header| header == name);
        let place = place.unwrap_or_else(|| panic!("{name}: {:?}", table[0]));
        table[1..].iter().map(|row| row[place].clone()).collect()
    }
}

fn ran(done: &Done) -> &str {
    assert_eq!(done.exit, Exit::Done, "{}", done.err);
    done.out.lines().find(|line| line.starts_with("cases")).unwrap()
}

#[test]
fn a_row_is_what_a_run_with_its_values_comes_to() {
    let folder = Folder::new();
    let axes = "[axes]\nscheme = [\"rk4\", \"leapfrog\"]\ntsda.1.stiffness = { from = 1e3, to = 1e5, \
                count = 3, scale = \"logarithmic\" }\n";
    let spec = folder.sweep(&format!("{FIXED}columns = [\"bob.?\", \"energy.total\"]\n{axes}"));
    let done = folder.swept(&spec, &[]);
    assert!(ran(&done).ends_with("6: 6 run now, 0 known"), "{}", done.out);
    // The last axis varies fastest.
    assert_eq!(folder.column("case"), ["1", "2", "3", "4", "5", "6"]);
    assert_eq!(folder.column("scheme")[2..4], ["rk4", "leapfrog"]);
    assert_eq!(folder.column("tsda.1.stiffness")[..4], ["1000.0", "10000.0", "100000.0", "1000.0"]);
    assert_eq!(folder.column("status"), ["ok"; 6]);
    let options = ["--step", "1ms", "--duration", "10ms", "--every", "1ms"];
    let set = ["--set", "tsda.1.stiffness=1e4", "--scheme", "leapfrog"];
    let summary = folder.summary(&folder.scene(PENDULUM), &[&options[..], &set].concat());
    assert_eq!(summary["state_hash"], folder.column("state_hash")[4].as_str());
    assert_eq!(summary["steps"].to_string(), folder.column("steps")[4]);
    let number = |name: &str| folder.column(name)[4].parse::<f64>().unwrap();
    assert_eq!(summary["energy_final"], number("energy.total.final"));
    assert_eq!(summary["energy_drift_rate"], number("energy_drift_rate"));
    // The figures are those of the trace's column.
    let trace = folder.trace("scene");
    let place = trace.header.iter().position(|name| name == "bob.y").unwrap();
    let ys: Vec<f64> = trace.rows.iter().map(|row| row[place].parse().unwrap()).collect();
    let most = ys.iter().copied().fold(f64::MIN, f64::max);
    let at = ys.iter().position(|y| *y == most).unwrap();
    let rms = (ys.iter().map(|y| y * y).sum::<f64>() / ys.len() as f64).sqrt();
    let figures = [most, ys[10], rms, trace.times()[at]];
    let names = ["max", "final", "rms", "time_of_max"].map(|name| format!("bob.y.{name}"));
    assert_eq!(names.map(|name| number(&name)), figures);
}

#[test]
fn the_table_does_not_depend_on_threads_shares_or_what_was_known() {
    let folder = Folder::new();
    let axes = "[axes]\n\"body.bob.mass\" = { from = 0.1, to = 2, count = 13 }\nstep = [\"1ms\", \"2ms\"]\n";
    let fixed = FIXED.replace("step = \"1ms\"\n", "").replace("every = \"1ms\"\n", "");
    let spec = folder.sweep(&format!("{fixed}{axes}"));
    ran(&folder.swept_to("serial", &spec, &["--jobs", "1"]));
    for share in ["1/3", "3/3"] {
        ran(&folder.swept(&spec, &["--shard", share, "--jobs", "3"]));
        assert!(!folder.path("out/s/sweep.csv").exists());
    }
    let merged = folder.swept(&spec, &["--merge"]);
    assert_eq!(merged.exit, Exit::Failed);
    for part in ["9 of 26 cases are not finished: cases 2, 5, 8", "--merge --partial"] {
        assert!(merged.err.contains(part), "{}", merged.err);
    }
    let partial = folder.swept(&spec, &["--merge", "--partial"]);
    assert!(ran(&partial).contains("0 run now, 17 known") && partial.out.contains("missing  9"));
    assert_eq!(folder.table("out").len(), 18);
    // What is left, whoever ran the rest.
    assert!(ran(&folder.swept(&spec, &[])).contains("9 run now, 17 known"));
    let csv = |out: &str| fs::read(folder.path(out).join("s/sweep.csv")).unwrap();
    assert_eq!(csv("out"), csv("serial"));
    let page = |out: &str| fs::read(folder.path(out).join("s/sweep.html")).unwrap();
    assert_eq!(page("out"), page("serial"));
    ran(&folder.swept(&spec, &["--merge"]));
    assert_eq!(csv("out"), csv("serial"));
    // More values: these alone run.
    let longer = folder.sweep(&format!("{fixed}{}", axes.replace("\"2ms\"", "\"2ms\", \"5ms\"")));
    assert!(ran(&folder.swept(&longer, &[])).contains("39: 13 run now, 26 known"));
    // Another scene: all of them.
    let other = PENDULUM.replace("It swings.", "It swings on.");
    fs::write(folder.path("scene.toml"), other).unwrap();
    assert!(ran(&folder.swept(&longer, &[])).contains("39 run now"));
}

#[test]
fn a_case_that_fails_is_a_row() {
    let folder = Folder::new();
    let axes = "[axes]\ntsda.1.stiffness = [2e3, 1e9]\n\"tsda.1.free_length\" = [1.0, 0.5]\n";
    let spec = folder.sweep(&format!("{FIXED}{axes}"));
    let done = folder.swept(&spec, &[]);
    assert!(done.out.contains("not ok   2, the first case 3: the run failed: "), "{}", done.out);
    let status = folder.column("status");
    assert_eq!((status[0].as_str(), status[1].as_str()), ("ok", "ok"));
    assert!(status[2].contains("with the step size 1ms"), "{}", status[2]);
    // What only goes wrong where two values meet.
    let until = "[[load]]\nbody = \"bob\"\nforce = [1, 0, 0]\nfrom = 0\nuntil = 1\n";
    let spec =
        folder.sweep(&format!("{FIXED}[axes]\nload.1.from = [0, 2]\nload.1.until = [3, 1]\n"));
    fs::write(folder.path("scene.toml"), format!("{PENDULUM}{until}")).unwrap();
    let done = folder.swept(&spec, &["--json"]);
    let said: Value = serde_json::from_str(&done.out).unwrap();
    assert_eq!((&said["cases"], &said["ok"]), (&4.into(), &3.into()));
    let text = fs::read_to_string(folder.path("out/s/sweep.csv")).unwrap();
    let last = text.lines().last().unwrap();
    assert!(last.contains("refused: `until` of load 1 is 1, not after `from` = 2"), "{last}");
}

#[test]
fn a_sample_has_as_many_cases_and_the_same_on_every_machine() {
    let folder = Folder::new();
    let sample =
        |kind: &str| format!("{FIXED}sample = {{ kind = \"{kind}\", count = 4, seed = 7 }}\n");
    let axes = "[axes]\nbody.bob.mass = { from = 0.5, to = 1.5 }\nscheme = [\"rk4\", \"pefrl\"]\n";
    let spec = folder.sweep(&(sample("latin-hypercube") + axes));
    ran(&folder.swept(&spec, &[]));
    let quarters = |masses: Vec<String>| {
        let quarter = |mass: &String| ((mass.parse::<f64>().unwrap() - 0.5) * 4.0) as usize;
        let mut quarters: Vec<usize> = masses.iter().map(quarter).collect();
        quarters.sort_unstable();
        quarters
    };
    assert_eq!(quarters(folder.column("body.bob.mass")), [0, 1, 2, 3]);
    let mut schemes = folder.column("scheme");
    schemes.sort();
    assert_eq!(schemes, ["pefrl", "pefrl", "rk4", "rk4"]);
    let spec = folder.sweep(&(sample("random") + axes));
    ran(&folder.swept(&spec, &[]));
    let expected = MASSES.map(str::to_owned);
    assert_eq!(folder.column("body.bob.mass"), expected);
}

/// Whoever changes these changes what a seed means.
const MASSES: [&str; 4] = ["1.42603897857", "1.33120549205", "0.627372936874", "1.28417967553"];

#[test]
fn what_goes_along_is_no_axis_of_its_own_and_equal_cases_run_once() {
    let folder = Folder::new();
    let pairs = "paired = [[\"scheme\", \"newton\", \"body.bob.mass\"]]\n[axes]\nscheme = [\"rk4\", \
                 \"dbd\", \"dbd\"]\nnewton = [\"own\", 2, 0]\nbody.bob.mass = [1, 2, 3]\n\
                 gravity = [[0, -9.81, 0], [0, -1.62, 0], [0.0, -9.81, 0]]\n";
    let spec = folder.sweep(&format!("{FIXED}{pairs}"));
    assert!(ran(&folder.swept(&spec, &[])).contains("9: 9 run now"));
    assert_eq!(folder.column("newton"), ["own", "own", "own", "2", "2", "2", "0", "0", "0"]);
    // Numbers in two notations are one case.
    let spec = folder.sweep(&format!("{FIXED}[axes]\nbody.bob.mass = [1e0, 1.0, 2]\n"));
    assert!(ran(&folder.swept(&spec, &[])).contains("3: 2 run now"));
    let hashes = folder.column("state_hash");
    assert!(hashes[0] == hashes[1] && hashes[1] != hashes[2]);
}

/// Whatever unit a file has: whoever reads the table computes with numbers.
#[test]
fn values_with_units_are_numbers_in_si_and_their_column_names_the_unit() {
    let folder = Folder::new();
    let axes = "[axes]\ntsda.1.free_length = { from = \"900 mm\", to = \"1000 mm\", count = 3 }\n\
                duration = [\"10 ms\", 0.02]\nbody.bob.mass = [1, 2]\n";
    let spec = folder.sweep(&format!("{}{axes}", FIXED.replace("duration = \"10ms\"\n", "")));
    let done = folder.swept(&spec, &["--json"]);
    let outcome: serde_json::Value = serde_json::from_str(&done.out).expect(&done.err);
    assert_eq!(outcome["axes"][0]["unit"], "m");
    assert!(outcome["axes"][2]["unit"].is_null());
    let lengths = folder.column("tsda.1.free_length [m]");
    assert_eq!([&lengths[0], &lengths[4], &lengths[8]], ["0.9", "0.95", "1.0"]);
    assert_eq!(folder.column("duration [s]")[1..4], ["0.01", "0.02", "0.02"]);
    assert_eq!(folder.column("body.bob.mass")[..2], ["1", "2"]);
    let options = ["--step", "1ms", "--duration", "10ms", "--every", "1ms"];
    let set = ["--set", "tsda.1.free_length=0.95", "--set", "body.bob.mass=1"];
    let summary = folder.summary(&folder.scene(PENDULUM), &[&options[..], &set].concat());
    assert_eq!(summary["state_hash"], folder.column("state_hash")[4].as_str());
    let page = fs::read_to_string(folder.path("out/s/sweep.html")).unwrap();
    assert!(page.contains("free_length [m]"), "{page}");
}

/// The file, its line and column, and words of the message and the help.
#[test]
fn what_is_wrong_is_shown_in_its_place_and_nothing_is_written() {
    let folder = Folder::new();
    let mut wrong = String::new();
    for (line, text, place, words) in [
        (5, "[axes]\nbody.bb.mass = [1]", "6:1", &["no body `bb`", "did you mean `bob`?"][..]),
        (5, "[axes]\nbody.bob.mas = [1]", "6:1", &["no key `mas`", "did you mean `mass`?"]),
        (5, "[axes]\nbody.bob.mass = [1, -1]", "6:21", &["`mass` of body `bob` is -1", "> 0"]),
        (5, "[axes]\nbody.bob.mass = [\"a\"]", "6:18", &["`mass`"]),
        (5, "[axes]\nbody.bob.mass = []", "6:17", &["has no values"]),
        (
            5,
            "[axes]\nbody.bob.mass = 3",
            "6:17",
            &["is an integer", "a list of values, or a range"],
        ),
        (5, "[axes]", "5:1", &["the table [axes] is empty"]),
        (5, "", "1:1", &["has no `axes`"]),
        (
            5,
            "[axes]\nscheme = [\"rk4\", \"rk5\"]",
            "6:18",
            &["no scheme `rk5`", "did you mean \"rk4\"?"],
        ),
        (5, "[axes]\nnewton = [1]", "6:11", &["leapfrog has no Newton iterations", "\"own\""]),
        (5, "[axes]\nbody.bob.mass = { from = 1, to = 2 }", "6:17", &["has no `count`"]),
        (5, "[axes]\nbody.bob.mass = { from = 1, too = 2 }", "6:29", &["no key `too`", "`to`"]),
        (
            5,
            "[axes]\nbody.bob.mass = { from = 1, to = 2, count = 1 }",
            "6:45",
            &["`count`", "is 1"],
        ),
        (5, "[axes]\nbody.bob.mass = { from = 0, to = 2, count = 3 }", "6:26", &["> 0"]),
        (
            5,
            "[axes]\nbody.bob.mass = { from = -1, to = 2, count = 3, scale = \"logarithmic\" }",
            "6:26",
            &["its scale is logarithmic"],
        ),
        (
            5,
            "[axes]\nbody.bob.mass = { from = 1, to = 2, count = 3000 }\n\"gravity[1]\" = { from = 1, to = 2, \
             count = 4000 }",
            "5:1",
            &["12000000 cases exceed the maximum of 1000000"],
        ),
        (
            5,
            "columns = [\"bob.z\", \"bop.x\"]\n[axes]\nbody.bob.mass = [1]",
            "5:21",
            &["did you mean `bob.x`?"],
        ),
        (
            5,
            "statistics = [\"mean\"]\n[axes]\nbody.bob.mass = [1]",
            "5:15",
            &["no statistic `mean`"],
        ),
        (5, "sampel = 3\n[axes]\nbody.bob.mass = [1]", "5:1", &["no key `sampel`", "`sample`"]),
        (5, "set = [\"body.bob.mas=1\"]\n[axes]\nbody.bob.mass = [1]", "5:8", &["no key `mas`"]),
        (5, "paired = [[\"a\"]]\n[axes]\nbody.bob.mass = [1]", "5:12", &["no axis `a`"]),
        (
            5,
            "paired = [[\"scheme\", \"body.bob.mass\"]]\n[axes]\nbody.bob.mass = [1]\nscheme = [\"rk4\", \"dbd\"]",
            "5:22",
            &["has 1 values, and `scheme` 2"],
        ),
        (
            5,
            "sample = { kind = \"sobol\", count = 3, seed = 1 }\n[axes]\nbody.bob.mass = [1]",
            "5:19",
            &["latin-hypercube"],
        ),
        (5, "[axes]\nstep = [\"1ms\"]", "6:1", &["is both an axis and a fixed value"]),
        (5, "[axes]\nduration = [\"10ms\"]\nevery = [\"3ms\"]", "", &["is both an axis and"]),
        (5, "a b\n", "5:3", &["toml.io"]),
    ] {
        assert_eq!(FIXED.lines().count() + 1, line);
        let spec = folder.sweep(&format!("{FIXED}{text}"));
        let done = folder.swept(&spec, &[]);
        let shown = words.iter().all(|word| done.err.contains(word));
        let placed = done.err.contains(&format!("s.toml:{place}"));
        if done.exit != Exit::Refused || !shown || !placed || folder.path("out").exists() {
            wrong += &format!("{text}, {place} {words:?}:\n{}{}", done.out, done.err);
        }
    }
    assert!(wrong.is_empty(), "{wrong}");
    // A step that does not fit, at its value.
    let every = FIXED.replace("step = \"1ms\"\n", "");
    let spec = folder.sweep(&format!("{every}[axes]\nstep = [\"1ms\", \"0.3ms\"]\n"));
    let done = folder.swept(&spec, &[]);
    assert!(
        done.err.contains("s.toml:5:16") && done.err.contains("not a whole multiple"),
        "{}",
        done.err
    );
    for (spec, word) in
        [("none.toml", "cannot read"), (&folder.sweep("scene = 3"), "`scene` is an integer")]
    {
        let done = folder.swept(spec, &[]);
        assert!(done.exit == Exit::Refused && done.err.contains(word), "{}", done.err);
    }
    let input = folder.sweep("scene = \"-\"\n[axes]\nstep = [1e-3]\n");
    assert!(folder.swept(&input, &[]).err.contains("cannot come from standard input"));
    let unknown = folder.sweep("scene = \"pendulun\"\n[axes]\nstep = [1e-3]\n");
    assert!(folder.swept(&unknown, &[]).err.contains("no scene named \"pendulun\""));
}

#[test]
fn reports_are_written_where_they_are_asked_for() {
    let folder = Folder::new();
    let spec = folder.sweep(&format!("{FIXED}[axes]\nbody.bob.mass = [1, 2]\n"));
    ran(&folder.swept(&spec, &[]));
    assert!(!folder.path("out/s/reports").exists());
    assert!(ran(&folder.swept(&spec, &["--reports"])).contains("0 run now, 2 known"));
    let hash = |case: &str| {
        let summary = folder.path("out/s/reports").join(case).join("summary.json");
        let summary: Value = serde_json::from_str(&fs::read_to_string(summary).unwrap()).unwrap();
        summary["state_hash"].as_str().unwrap().to_owned()
    };
    assert_eq!(["case-000001", "case-000002"].map(hash).to_vec(), folder.column("state_hash"));
    assert!(folder.path("out/s/reports/case-000002/report.html").exists());
    // Another file of the same name has another table.
    fs::create_dir(folder.path("other")).unwrap();
    fs::copy(folder.path("scene.toml"), folder.path("other/scene.toml")).unwrap();
    let other = folder.path("other/s.toml");
    fs::write(&other, format!("{FIXED}[axes]\nbody.bob.mass = [1, 3]\n")).unwrap();
    let other = other.to_str().unwrap();
    let done = folder.swept(other, &[]);
    assert!(done.exit == Exit::Refused && done.err.contains("--overwrite"), "{}", done.err);
    assert!(ran(&folder.swept(other, &["--overwrite"])).contains("1 run now, 1 known"));
}

/// The example of the page is the one of the file, and is accepted.
#[test]
fn the_example_of_the_page_runs() {
    let root = PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/.."));
    let page = fs::read_to_string(root.join("docs/sweeps.md")).unwrap();
    let example = fs::read_to_string(root.join("docs/examples/sweeps/stiffness.toml")).unwrap();
    let lines = |text: &str| -> Vec<String> {
        text.lines().filter(|line| !line.starts_with('#')).map(str::to_owned).collect()
    };
    let shown = page.split("```toml\n").nth(1).unwrap().split("```").next().unwrap();
    assert_eq!(lines(shown), lines(&example));
    // A thousandth of its time, with the same values.
    let folder = Folder::new();
    let spec = folder.sweep(&format!("duration = \"200us\"\nevery = \"20us\"\n{example}"));
    let done = folder.swept(&spec, &[]);
    assert!(ran(&done).contains("50: 50 run now"));
    let page = fs::read_to_string(folder.path("out/s/sweep.html")).unwrap();
    assert_eq!(page.matches("<svg").count(), 2);
    assert!(!page.contains("NaN"));
    let page = page.replace("<link rel=\"icon\" href=\"data:,\">", "");
    for file in ["src=", "href=", "url(h"] {
        assert!(!page.contains(file), "{file}");
    }
}
