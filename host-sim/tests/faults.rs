//! Faults of the machine: the program is killed, the disk is full, a folder is read-only or shared by
//! two, a cache is damaged. Nothing that is not whole is ever taken for whole.
#![cfg(unix)]

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
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

const SURVEY: [&str; 5] = ["trade", "ball.toml", "--window", "10ms", "--quiet"];

/// What a survey computes, the same on every run: the first twelve columns, and whose it is.
fn accuracies(folder: &Path) -> Vec<String> {
    let results = folder.join("out/ball");
    let json = fs::read_to_string(results.join("trade.json")).unwrap();
    let json: Value = serde_json::from_str(&json).unwrap();
    let table = fs::read_to_string(results.join("trade.csv")).unwrap();
    let rows = table.lines().map(|line| line.split(',').take(12).collect::<Vec<_>>().join(","));
    let rows: Vec<String> = rows.collect();
    assert_eq!(json["points"].as_array().unwrap().len(), rows.len() - 1);
    rows
}

fn cache(folder: &Path) -> PathBuf {
    let results = folder.join("out/ball");
    let found = names(&results).into_iter().find(|name| name.ends_with(".cache"));
    results.join(found.unwrap())
}

#[test]
fn a_survey_that_is_killed_goes_on_with_the_same_results() {
    let here = with_ball(1.0);
    let begun = std::time::Instant::now();
    done(&call(here.path(), &SURVEY));
    let whole = begun.elapsed();
    let undisturbed = accuracies(here.path());
    let there = with_ball(1.0);
    for delay in delays(6) {
        let mut child = program(there.path(), &SURVEY).spawn().unwrap();
        std::thread::sleep(whole.mul_f64(0.3 * delay));
        let _ = child.kill();
        child.wait().unwrap();
        if there.path().join("out/ball/trade.json").exists() {
            assert_eq!(accuracies(there.path()), undisturbed);
        }
    }
    done(&call(there.path(), &SURVEY));
    assert_eq!(accuracies(there.path()), undisturbed);
    let hidden = names(&there.path().join("out/ball"));
    assert!(!hidden.iter().any(|name| name.starts_with('.')), "{hidden:?}");
}

#[test]
fn a_damaged_cache_is_not_believed() {
    let here = with_ball(1.0);
    done(&call(here.path(), &SURVEY));
    let undisturbed = accuracies(here.path());
    let file = cache(here.path());
    let whole = fs::read(&file).unwrap();
    let text = String::from_utf8(whole.clone()).unwrap();
    // A way's error, a digit of it.
    let row = text.rfind("\"error\":").unwrap() + "\"error\":".len();
    let mut flipped = whole.clone();
    flipped[row] ^= 1;
    // The same ball, twice as heavy, by its own survey.
    let other = with_ball(1.0);
    let heavy = ball(1.0).replace("mass = 1", "mass = 2");
    fs::write(other.path().join("ball.toml"), heavy).unwrap();
    done(&call(other.path(), &SURVEY));
    let others = fs::read(cache(other.path())).unwrap();
    assert_ne!(accuracies(other.path()), undisturbed);
    let cut = whole[..whole.len() * 2 / 3].to_vec();
    for (what, damaged) in [("a bit", flipped), ("an end", cut), ("a scene", others)] {
        assert_ne!(damaged, whole, "{what}");
        fs::write(&file, &damaged).unwrap();
        done(&call(here.path(), &SURVEY));
        assert_eq!(accuracies(here.path()), undisturbed, "{what}");
    }
}

const SWEEP: [&str; 4] = ["sweep", "ball.sweep.toml", "--jobs", "2"];

/// A folder with a ball and a sweep of it, of 120 cases.
fn with_sweep() -> tempfile::TempDir {
    let here = with_ball(0.3);
    let sweep = "scene = \"ball.toml\"\nstatistics = [\"rms\"]\n[axes]\nscheme = [\"rk4\", \"pefrl\"]\n\
                 body.b.mass = { from = 1, to = 2, count = 60 }\n";
    fs::write(here.path().join("ball.sweep.toml"), sweep).unwrap();
    here
}

/// A sweep's table.
fn table(folder: &Path) -> Vec<u8> {
    fs::read(folder.join("out/ball.sweep/sweep.csv")).unwrap()
}

/// The file of finished cases.
fn rows(folder: &Path) -> PathBuf {
    folder.join("out/ball.sweep/cases/1-of-1.rows")
}

/// How many cases a sweep says that it ran.
fn ran(output: &Output) -> usize {
    done(output);
    let said = text(&output.stdout);
    let words = said.split_once(": ").unwrap().1.split_once(" run now").unwrap().0;
    words.rsplit(' ').next().unwrap().parse().unwrap()
}

#[test]
fn a_sweep_that_is_killed_goes_on_and_runs_no_finished_case_again() {
    let here = with_sweep();
    assert_eq!(ran(&call(here.path(), &SWEEP)), 120);
    let undisturbed = table(here.path());
    let there = with_sweep();
    let finished = || fs::read(rows(there.path())).unwrap_or_default();
    let mut before = Vec::new();
    for _ in 0..6 {
        let mut child = program(there.path(), &SWEEP).spawn().unwrap();
        // Of some more cases, wherever in the next.
        let begun = std::time::Instant::now();
        while finished().len() < before.len() + 900 && begun.elapsed().as_secs() < 20 {
            std::thread::yield_now();
        }
        let _ = child.kill();
        child.wait().unwrap();
        let after = finished();
        let whole = before.iter().rposition(|byte| *byte == b'\n').map_or(0, |at| at + 1);
        assert!(after.starts_with(&before[..whole]), "what was finished stays");
        before = after;
    }
    let known = before.iter().filter(|byte| **byte == b'\n').count();
    assert!(known > 5, "{known}");
    assert_eq!(ran(&call(there.path(), &SWEEP)), 120 - known);
    assert!(table(there.path()) == undisturbed);
    // A line per case, none twice.
    let text = String::from_utf8(finished()).unwrap();
    let mut keys: Vec<&str> = text.lines().map(|line| line.split(' ').nth(1).unwrap()).collect();
    keys.sort_unstable();
    keys.dedup();
    assert_eq!((text.lines().count(), keys.len()), (120, 120));
    let mut left = names(&there.path().join("out/ball.sweep"));
    // With the feature there is the table in one format more.
    left.retain(|name| name != "sweep.parquet");
    assert_eq!(left, ["cases", "sweep.csv", "sweep.html", "sweep.json"]);
}

#[test]
fn a_damaged_file_of_finished_cases_is_named_and_set_aside() {
    let here = with_sweep();
    done(&call(here.path(), &SWEEP));
    let undisturbed = table(here.path());
    let file = rows(here.path());
    let mut bytes = fs::read(&file).unwrap();
    // A digit within two of the lines, and the end of the last.
    let (third, half) = (bytes.len() / 3, bytes.len() / 2);
    bytes[third] ^= 1;
    bytes[half] ^= 1;
    bytes.truncate(bytes.len() - 7);
    fs::write(&file, &bytes).unwrap();
    let output = call(here.path(), &SWEEP);
    let said = text(&output.stderr);
    for part in ["1-of-1.rows is damaged in 2 lines", "set aside as", "1-of-1.rows.damaged"] {
        assert!(said.contains(part), "{said}");
    }
    assert_eq!(ran(&output), 3);
    assert!(table(here.path()) == undisturbed);
    assert_eq!(fs::read(file.with_extension("rows.damaged")).unwrap(), bytes);
    assert_eq!(text(&call(here.path(), &SWEEP).stderr), "");
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
    // A survey's cache that ends in the middle of a line is gone on with.
    let full = limited(here.path(), 5, &SURVEY);
    let said = text(&full.stderr);
    assert_eq!(full.status.code(), Some(1), "{said}");
    assert!(said.contains("cannot write the results: File too large"), "{said}");
    assert_eq!(fs::metadata(cache(here.path())).unwrap().len(), 5 * 512);
    assert!(!results.join("trade.json").exists());
    done(&call(here.path(), &SURVEY));
    let there = with_ball(0.3);
    done(&call(there.path(), &SURVEY));
    assert_eq!(accuracies(here.path()), accuracies(there.path()));
}

#[test]
fn a_full_disk_keeps_the_cases_that_are_finished() {
    let here = with_sweep();
    let full = limited(here.path(), 6, &SWEEP);
    let said = text(&full.stderr);
    assert_eq!(full.status.code(), Some(1), "{said}");
    assert!(said.contains("cannot write the results: File too large"), "{said}");
    let kept = fs::read(rows(here.path())).unwrap();
    assert!(kept.len() <= 6 * 512 && kept.ends_with(b"\n"));
    let known = kept.iter().filter(|byte| **byte == b'\n').count();
    assert!(known > 3, "{known}");
    assert!(!here.path().join("out/ball.sweep/sweep.csv").exists());
    assert_eq!(ran(&call(here.path(), &SWEEP)), 120 - known);
    let there = with_sweep();
    done(&call(there.path(), &SWEEP));
    assert!(table(here.path()) == table(there.path()));
}

#[test]
fn two_programs_do_not_run_the_same_share() {
    let here = with_sweep();
    let both = [SWEEP, SWEEP].map(|sweep| program(here.path(), &sweep).spawn().unwrap());
    let both = both.map(|child| child.wait_with_output().unwrap());
    let codes = both.each_ref().map(|output| output.status.code());
    assert!(codes.contains(&Some(0)), "{codes:?}");
    if let Some(busy) = both.iter().find(|output| output.status.code() == Some(1)) {
        let said = text(&busy.stderr);
        assert!(
            said.contains("another sweep runs these cases") && said.contains("--shard"),
            "{said}"
        );
    }
    assert_eq!(fs::read_to_string(rows(here.path())).unwrap().lines().count(), 120);
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
    let Some(done) = mounted(here.path(), "size=48k", script) else { return };
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
    assert!(said.contains("name another folder with --out DIR"), "{said}");
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

#[test]
fn two_surveys_in_one_folder_do_not_mix() {
    let here = with_ball(1.0);
    // One of another window has another cache, and the same files.
    let other = ["trade", "ball.toml", "--window", "11ms", "--quiet"];
    let all = [SURVEY, SURVEY, other].map(|survey| program(here.path(), &survey).spawn().unwrap());
    let all = all.map(|child| child.wait_with_output().unwrap());
    let codes = all.each_ref().map(|output| output.status.code());
    assert_eq!(codes[2], Some(0), "{}", text(&all[2].stderr));
    let busy = codes[..2].iter().position(|code| *code == Some(1));
    assert!(codes[..2].contains(&Some(0)), "{codes:?}");
    if let Some(busy) = busy {
        assert!(text(&all[busy].stderr).contains("another survey of this scene"));
    }
    let found = accuracies(here.path());
    done(&call(here.path(), &SURVEY));
    let one = accuracies(here.path());
    done(&call(here.path(), &other));
    assert!(found == one || found == accuracies(here.path()));
}
