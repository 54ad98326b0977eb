//! `run --watch-energy`: what is watched, where a run ends, what is left of it.

use host_sim::terminal::Exit;
use serde_json::Value;

use crate::{Folder, PENDULUM};

const DAMPED: [&str; 2] = ["free_length = 1.0", "free_length = 1.0\ndamping = 5"];

/// The summary of a run with its exit code, and the total energy of every row of its trace.
fn watched(folder: &Folder, text: &str, options: &[&str]) -> (Exit, Value, String, Vec<f64>) {
    let scene = folder.scene(text);
    let done =
        folder.run(&scene, &[options, &["--json", "--step", "1ms", "--every", "10ms"]].concat());
    let summary = serde_json::from_str(&done.out).unwrap_or_else(|_| panic!("{}", done.err));
    let trace = folder.trace("scene");
    let column = trace.header.iter().position(|name| name == "energy.total").unwrap();
    let totals = trace.rows.iter().map(|row| row[column].parse().unwrap()).collect();
    (done.exit, summary, done.err, totals)
}

/// The error of a coarse run, found in the trace of one that is not watched.
#[test]
fn a_run_ends_at_the_first_sample_beyond() {
    let folder = Folder::new();
    let (exit, summary, _, totals) = watched(&folder, PENDULUM, &[]);
    assert_eq!((exit, summary.get("watch_energy")), (Exit::Done, None));
    let changes: Vec<f64> = totals.iter().map(|total| (total - totals[0]).abs()).collect();
    let most = changes.iter().copied().fold(0.0, f64::max);
    assert!(most > 1e-9, "{most}");
    let limit = 0.5 * most;
    let first = changes.iter().position(|change| *change > limit).unwrap();
    let time = first as f64 * 0.01;

    let asked = ["--watch-energy", &limit.to_string()];
    let (exit, summary, said, seen) = watched(&folder, PENDULUM, &asked);
    assert_eq!(exit, Exit::Failed);
    assert_eq!(seen, totals[..=first]);
    let watch = &summary["watch_energy"];
    assert_eq!((&watch["limit"], &watch["watched"]), (&limit.into(), &"change".into()));
    assert_eq!(watch["largest"].as_f64(), Some(changes[first]));
    for of in [&watch["stopped_at"], &summary["duration"]] {
        assert!((of.as_f64().unwrap() - time).abs() < 1e-12, "{summary}");
    }
    assert_eq!(summary["steps"].as_u64(), Some(10 * first as u64));
    assert_eq!(summary["energy_final"].as_f64(), Some(totals[first]));
    let status = summary["status"].as_str().unwrap();
    let figure = dbd_plant::digits::significant(changes[first], 4);
    for text in [status, &said] {
        assert!(text.contains(&format!("t = {}", dbd_plant::time::display(time))), "{text}");
        assert!(text.contains(&figure), "{figure}: {text}");
    }
    let page = std::fs::read_to_string(folder.path("out/scene/report.html")).unwrap();
    assert!(page.contains("Failed") && page.contains(&figure));

    let (exit, summary, _, seen) =
        watched(&folder, PENDULUM, &["--watch-energy", &format!("{} J", 1.01 * most)]);
    assert_eq!((exit, &summary["status"]), (Exit::Done, &"ok".into()));
    assert_eq!((seen.len(), summary["watch_energy"]["largest"].as_f64()), (51, Some(most)));
    assert_eq!(summary["watch_energy"]["stopped_at"], Value::Null);
}

/// What a damper takes is no error; what it seems to give is one.
#[test]
fn dampers_may_take_and_not_give() {
    let folder = Folder::new();
    let damped = PENDULUM.replace(DAMPED[0], DAMPED[1]);
    let limit = ["--watch-energy", "1e-3"];
    let (exit, summary, _, totals) = watched(&folder, &damped, &limit);
    assert_eq!((exit, &summary["watch_energy"]["watched"]), (Exit::Done, &"rise".into()));
    assert!(totals[0] - totals[50] > 2e-3, "{totals:?}");
    // Beyond what an explicit damper bears.
    let stiff = PENDULUM.replace(DAMPED[0], "free_length = 1.0\ndamping = 2030");
    let (exit, summary, said, totals) =
        watched(&folder, &stiff, &[&limit[..], &["--damping", "explicit"]].concat());
    assert_eq!(exit, Exit::Failed, "{summary}");
    assert!(said.contains("above the previous minimum"), "{said}");
    let least = totals.iter().copied().fold(f64::INFINITY, f64::min);
    assert!(totals[totals.len() - 1] - least > 1e-3);
}

/// What loads and inputs give is no error, however much; what the balance does not explain is one.
#[test]
fn the_work_of_loads_is_no_error() {
    let folder = Folder::new();
    let load = "[[load]]\nbody = \"bob\"\nforce = [5, 0, 0]\nfrom = 0.2\n";
    let input =
        "[[input]]\nname = \"t\"\ntype = \"force\"\nbody = \"bob\"\naxis = [1, 0, 0]\nvalue = 5\n";
    for driven in [load, input] {
        let pushed = format!("{PENDULUM}{driven}");
        let (exit, summary, said, totals) = watched(&folder, &pushed, &["--watch-energy", "1e-2"]);
        assert_eq!((exit, said.as_str()), (Exit::Done, ""));
        assert_eq!(summary["watch_energy"]["watched"], "balance");
        assert!((totals[totals.len() - 1] - totals[0]).abs() > 0.3, "{totals:?}");
        let remains = summary["energy_balance"]["remains"].as_f64().unwrap().abs();
        let largest = summary["watch_energy"]["largest"].as_f64().unwrap();
        assert!(remains <= largest && largest < 1e-2, "{summary}");
        let limit = format!("{}", 0.5 * largest);
        let (exit, _, said, seen) = watched(&folder, &pushed, &["--watch-energy", &limit]);
        assert!(seen.len() < totals.len() && exit == Exit::Failed);
        assert!(
            said.contains("unexplained at the sample") && said.contains("shorter step"),
            "{said}"
        );
    }
}

#[test]
fn a_limit_that_is_none_is_refused() {
    let folder = Folder::new();
    let scene = folder.scene(PENDULUM);
    for limit in ["", "0", "-1", "nan", "inf", "1e999", "1mJ", "much", "1e-3 1e-4"] {
        let done = folder.run(&scene, &["--watch-energy", limit]);
        assert_eq!(done.exit, Exit::Refused, "{limit}");
        assert!(done.err.contains("number of joules"), "{limit}: {}", done.err);
        assert!(!folder.path("out").exists(), "{limit}");
    }
    assert_eq!(folder.run(&scene, &["--watch-energy"]).exit, Exit::Refused);
}
