//! Faults of the machine: the program is killed, the disk is full, a folder is read-only or shared by
//! two, a cache is damaged. Nothing that is not whole is ever taken for whole.
#![cfg(unix)]

mod surveys;
mod sweeps;

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::process::{Command, Output, Stdio};

use serde_json::Value;

const PROGRAM: &str = env!("CARGO_BIN_EXE_host-sim");

/// The program in a folder.
fn program(folder: &Path, arguments: &[&str]) -> Command {
    let mut command = Command::new(PROGRAM);
    command.current_dir(folder).args(arguments).stdin(Stdio::null());
    command.stdout(Stdio::piped()).stderr(Stdio::piped());
    command
}

fn call(folder: &Path, arguments: &[&str]) -> Output {
    program(folder, arguments).output().unwrap()
}

fn text(bytes: &[u8]) -> &str {
    std::str::from_utf8(bytes).unwrap()
}

fn done(output: &Output) {
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
}

/// Names in alphabetical order; none where there is no such folder.
fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).into_iter().flatten();
    let mut names: Vec<String> =
        entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

const RESULTS: [&str; 3] = ["report.html", "summary.json", "trace.csv"];

/// A ball on a spring, for so long.
fn ball(duration: f64) -> String {
    format!(
        "name = \"ball\"\nduration = {duration}\nstep = 1e-3\n[[body]]\nname = \"b\"\nmass = 1\n\
         inertia = [1, 1, 1]\nposition = [0, 0, 0]\nvelocity = [0.3, 0.2, 0.1]\n[[tsda]]\n\
         between = [\"world\", \"b\"]\npoints = [[1, 0, 0], [0, 0, 0]]\nstiffness = 1e3\n\
         free_length = 1\n"
    )
}

/// A folder with a scene in it.
fn with_ball(duration: f64) -> tempfile::TempDir {
    let here = tempfile::tempdir().unwrap();
    fs::write(here.path().join("ball.toml"), ball(duration)).unwrap();
    here
}

/// Two runs of one scene that differ in every number, a row per step.
const RUNS: [[&str; 6]; 2] = [
    ["run", "ball.toml", "--precision", "f64", "--every", "1ms"],
    ["run", "ball.toml", "--precision", "f32", "--every", "1ms"],
];

/// The traces of both, undisturbed, by precision.
fn traces(scene: &str) -> BTreeMap<String, Vec<u8>> {
    let here = tempfile::tempdir().unwrap();
    fs::write(here.path().join("ball.toml"), scene).unwrap();
    let trace = |run: &[&str; 6]| {
        done(&call(here.path(), run));
        (run[3].to_owned(), fs::read(here.path().join("out/ball/trace.csv")).unwrap())
    };
    RUNS.iter().map(trace).collect()
}

/// Whether a folder holds a whole run; what lies there beside a summary must be of the same one.
fn holds_whole_run(results: &Path, traces: &BTreeMap<String, Vec<u8>>) -> bool {
    let Ok(summary) = fs::read_to_string(results.join("summary.json")) else { return false };
    let summary: Value = serde_json::from_str(&summary).unwrap();
    assert_eq!(summary["status"], "ok");
    let trace = fs::read(results.join("trace.csv")).unwrap();
    assert!(trace == traces[summary["precision"].as_str().unwrap()], "another run's trace");
    let page = fs::read_to_string(results.join("report.html")).unwrap();
    assert!(page.contains(summary["state_hash"].as_str().unwrap()), "another run's page");
    assert!(page.trim_end().ends_with("</html>"));
    true
}

/// Delays that go through all of 0 to 1 evenly, in no order.
fn delays(count: u32) -> impl Iterator<Item = f64> {
    (1..=count).map(|i| (f64::from(i) * 0.618_033_988_75).fract())
}

#[test]
fn a_run_that_is_killed_leaves_all_or_nothing() {
    let here = with_ball(0.3);
    let results = here.path().join("out/ball");
    let traces = traces(&ball(0.3));
    let begun = std::time::Instant::now();
    done(&call(here.path(), &RUNS[0]));
    let whole = begun.elapsed();
    let mut left = 0;
    for (i, delay) in delays(120).enumerate() {
        let mut child = program(here.path(), &RUNS[i % 2]).spawn().unwrap();
        std::thread::sleep(whole.mul_f64(1.2 * delay));
        // One that is done by now cannot be killed.
        let _ = child.kill();
        child.wait().unwrap();
        let whole = holds_whole_run(&results, &traces);
        let named = names(&results).into_iter().filter(|name| !name.starts_with('.'));
        let named: Vec<String> = named.collect();
        assert!(!whole || named == RESULTS, "{named:?}");
        left += names(&results).len() - named.len();
    }
    // The next one removes what those left.
    done(&call(here.path(), &RUNS[1]));
    assert!(holds_whole_run(&results, &traces));
    assert_eq!(names(&results), RESULTS, "{left} were left");
}

/// No file may grow beyond so many units of 512 bytes: to a program that is as a full disk.
fn limited(folder: &Path, units: u32, arguments: &[&str]) -> Output {
    let mut shell = Command::new("sh");
    let script = "trap '' XFSZ; ulimit -f $0; exec \"$@\"";
    shell.current_dir(folder).args(["-c", script, &units.to_string(), PROGRAM]);
    shell.args(arguments).stdin(Stdio::null()).output().unwrap()
}

#[test]
fn a_full_disk_leaves_what_was_there() {
    let here = with_ball(0.3);
    let results = here.path().join("out/ball");
    let traces = traces(&ball(0.3));
    let sizes = |folder: &Path| RESULTS.map(|name| fs::metadata(folder.join(name)).unwrap().len());
    // At the first, a later and the last part of the trace; and at the page alone.
    for units in [0, 1, 20, 60] {
        let full = limited(here.path(), units, &RUNS[0]);
        let said = text(&full.stderr);
        assert_eq!(full.status.code(), Some(1), "{units}: {said}");
        assert!(said.contains("cannot write the results: File too large"), "{said}");
        assert_eq!(names(&results), [""; 0], "{units}");
    }
    done(&call(here.path(), &RUNS[1]));
    let before = sizes(&results);
    assert!(before.iter().any(|size| *size > 60 * 512), "{before:?}");
    for units in [1, 20, 60] {
        assert_eq!(limited(here.path(), units, &RUNS[0]).status.code(), Some(1), "{units}");
        assert!(holds_whole_run(&results, &traces) && names(&results) == RESULTS);
        assert_eq!(sizes(&results), before);
    }
}

/// A script with a file system of its own in `out`, mounted with `options`; `None`, with the reason
/// printed, where that is not permitted.
fn mounted(folder: &Path, options: &str, script: &str) -> Option<Output> {
    fs::create_dir_all(folder.join("out")).unwrap();
    let run = |script: &str| {
        let script = format!("mount -t tmpfs -o {options} tmpfs out || exit 99; {script}");
        let mut shell = Command::new("unshare");
        shell.current_dir(folder).args(["-rm", "sh", "-c", &script, PROGRAM]).output()
    };
    match run("true") {
        Ok(output) if output.status.success() => Some(run(script).unwrap()),
        Ok(output) => {
            println!("skipped, no mount: {}", text(&output.stderr));
            None
        }
        Err(error) => {
            println!("skipped, no unshare: {error}");
            None
        }
    }
}

#[test]
fn a_small_disk_is_a_full_disk() {
    let here = with_ball(0.3);
    let script = "\"$0\" run ball.toml --quiet --every 0.1s; echo $?; \
                  \"$0\" run ball.toml --quiet --every 1ms; echo $?; \
                  ls -A out/ball; cat out/ball/trace.csv | wc -l";
    let Some(done) = mounted(here.path(), "size=1m", script) else { return };
    let words: Vec<&str> = text(&done.stdout).split_whitespace().collect();
    assert_eq!(words, [&["0", "1"][..], &RESULTS, &["5"]].concat(), "{}", text(&done.stderr));
    assert!(text(&done.stderr).contains("cannot write the results: No space left"));
}

#[test]
fn a_read_only_folder_is_refused_before_the_run() {
    let here = with_ball(1e6);
    // The superuser may write to any folder, but not to a file system that is read-only.
    let script = "\"$0\" run ball.toml; echo $?; \"$0\" trade ball.toml --window 10ms; echo $?";
    let Some(done) = mounted(here.path(), "ro", script) else { return };
    assert_eq!(text(&done.stdout).split_whitespace().collect::<Vec<_>>(), ["2", "2"]);
    let said = text(&done.stderr);
    assert!(said.contains("cannot write to out/ball: Read-only file system"), "{said}");
    assert!(said.contains("choose another folder with --out DIR"), "{said}");
}

#[test]
fn two_runs_in_one_folder_do_not_mix() {
    let here = with_ball(0.3);
    let traces = traces(&ball(0.3));
    let results = here.path().join("out/ball");
    for _ in 0..10 {
        let both = RUNS.each_ref().map(|run| program(here.path(), run).spawn().unwrap());
        both.into_iter().for_each(|child| done(&child.wait_with_output().unwrap()));
        assert!(holds_whole_run(&results, &traces));
        assert_eq!(names(&results), RESULTS);
    }
}

/// Of two files of one name only one has the folder, whoever looked first.
#[test]
fn two_scenes_at_once_do_not_replace_each_others_results() {
    for _ in 0..5 {
        let here = tempfile::tempdir().unwrap();
        let begin = |place: &str, duration: f64| {
            fs::create_dir(here.path().join(place)).unwrap();
            let file = here.path().join(place).join("ball.toml");
            fs::write(&file, ball(duration)).unwrap();
            (program(here.path(), &["run", file.to_str().unwrap()]).spawn().unwrap(), duration)
        };
        let both = [begin("first", 0.3), begin("second", 0.2)];
        let both = both.map(|(child, duration)| (child.wait_with_output().unwrap(), duration));
        let summary = fs::read_to_string(here.path().join("out/ball/summary.json")).unwrap();
        let summary: Value = serde_json::from_str(&summary).unwrap();
        let mut codes = Vec::new();
        for (output, duration) in &both {
            let code = output.status.code();
            let is_there = summary["duration"].as_f64() == Some(*duration);
            assert_eq!(code == Some(0), is_there, "{code:?} {}", text(&output.stderr));
            assert!(is_there || text(&output.stderr).contains("the results of another scene"));
            codes.push(code);
        }
        codes.sort();
        assert_eq!(codes, [Some(0), Some(2)]);
    }
}
