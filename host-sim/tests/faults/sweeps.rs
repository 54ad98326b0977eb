//! Sweeps that are killed, meet a full disk, share a folder, or find damaged rows.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Output;

use crate::{call, done, limited, names, program, text, with_ball};

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
        while finished().len() < before.len() + 900 && child.try_wait().unwrap().is_none() {
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
    for part in ["1-of-1.rows is damaged in 2 lines", "renamed to", "1-of-1.rows.damaged"] {
        assert!(said.contains(part), "{said}");
    }
    assert_eq!(ran(&output), 3);
    assert!(table(here.path()) == undisturbed);
    assert_eq!(fs::read(file.with_extension("rows.damaged")).unwrap(), bytes);
    assert_eq!(text(&call(here.path(), &SWEEP).stderr), "");
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
