//! Surveys that are killed, meet a full disk, share a folder, or find a damaged cache.

use std::fs;
use std::path::{Path, PathBuf};

use serde_json::Value;

use crate::{ball, call, delays, done, limited, names, program, text, with_ball};

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
        assert!(text(&all[busy].stderr).contains("another trade-off study of this scene"));
    }
    let found = accuracies(here.path());
    done(&call(here.path(), &SURVEY));
    let one = accuracies(here.path());
    done(&call(here.path(), &other));
    assert!(found == one || found == accuracies(here.path()));
}

/// The cache ends in the middle of a line, and is gone on with.
#[test]
fn a_survey_on_a_full_disk_goes_on_with_the_same_results() {
    let here = with_ball(0.3);
    let results = here.path().join("out/ball");
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
