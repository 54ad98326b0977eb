//! The command as users and their scripts meet it.

use std::fs;
use std::path::Path;

use host_sim::cli::main_with;
use host_sim::terminal::{Console, Exit};

use crate::caches;

/// Calls the command line.
fn call(arguments: &[&str]) -> (Exit, String, String) {
    let (mut out, mut err) = (Vec::new(), Vec::new());
    let mut console = Console::plain(&mut out, &mut err);
    let exit = main_with(["host-sim"].iter().chain(arguments), &mut console);
    let text = |bytes| String::from_utf8(bytes).unwrap();
    (exit, text(out), text(err))
}

/// The columns of accuracy of a `trade.csv`: the first twelve.
fn accuracy_columns(folder: &Path) -> Vec<String> {
    let text = fs::read_to_string(folder.join("trade.csv")).unwrap();
    text.lines().map(|line| line.split(',').take(12).collect::<Vec<_>>().join(",")).collect()
}

#[test]
fn the_command_leaves_its_files_and_says_how_to_run_what_it_chose() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().to_str().unwrap();
    let (exit, said, errors) = call(&["trade", "spring-ball", "--window", "0.1s", "--out", out]);
    assert_eq!(exit, Exit::Done);
    // Not a terminal: a line for each part of the work.
    let parts = [
        "chaotic",
        "reference solution",
        "second",
        "stable steps",
        "0 % of",
        "measuring times",
        "alternative models",
    ];
    assert_eq!(errors.lines().count(), parts.len(), "{errors}");
    for (line, part) in errors.lines().zip(parts) {
        assert!(line.contains(part), "{errors}");
    }
    let results = folder.path().join("spring-ball");
    let table = fs::read_to_string(results.join("trade.csv")).unwrap();
    let columns: Vec<&str> = table.lines().next().unwrap().split(',').collect();
    assert_eq!(columns, dbd_study::files::COLUMNS);
    assert_eq!((columns.len(), *columns.last().unwrap()), (24, "stable_step_in_space"));
    for file in ["trade.svg", "trade-cortex-m4f.svg", "trade.html"] {
        assert!(results.join(file).is_file(), "{file}");
    }
    assert_eq!(caches(&results).len(), 1);

    // Every command that is printed is one, and runs without a complaint.
    let lines: Vec<&str> =
        said.lines().filter_map(|line| line.trim().strip_prefix("host-sim ")).collect();
    assert!(lines.len() >= 4, "{said}");
    let page = fs::read_to_string(results.join("trade.html")).unwrap();
    for line in &lines {
        assert!(line.starts_with("run spring-ball --scheme "), "{line}");
        assert!(page.contains(&format!("<code>host-sim {line}</code>")), "{line}");
    }
    for line in &lines {
        let words = line.split(' ').chain(["--out", out, "--duration", "0.1s"]);
        let (exit, said, errors) = call(&words.collect::<Vec<_>>());
        assert_eq!((exit, errors.as_str()), (Exit::Done, ""), "{line}");
        assert!(!said.contains("warning"), "{line}: {said}");
    }

    // The second call reads, for programs.
    let (exit, said, _) =
        call(&["trade", "spring-ball", "--window", "0.1s", "--out", out, "--json"]);
    assert_eq!(exit, Exit::Done);
    let json: serde_json::Value = serde_json::from_str(&said).unwrap();
    assert_eq!(json["scene"], "spring-ball");
    assert!((json["window"].as_f64().unwrap() - 0.1).abs() < 1e-12);
    assert!(json["growth"].is_f64() && json["uncertainty"].is_f64());
    let points = json["points"].as_array().unwrap();
    assert_eq!(points.len(), table.lines().count() - 1);
    assert!(points.iter().all(|point| point["lost"].is_boolean()));
    assert_eq!(fs::read_to_string(results.join("trade.csv")).unwrap(), table);
    let (exit, said, _) =
        call(&["trade", "spring-ball", "--window", "0.1s", "--out", out, "--quiet"]);
    assert_eq!((exit, said.as_str()), (Exit::Done, ""));
}

#[test]
fn a_window_that_is_none_is_refused_and_leaves_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().to_str().unwrap();
    for (window, message) in [
        ("1e-300s", "too short"),
        ("100s", "exceeds the scene's duration of 5s"),
        ("0s", "a time must be positive"),
        ("-1s", "a time must be positive"),
        ("6", "exceeds the scene's duration of 5s"),
        ("1kg", "a number with a unit"),
        ("1min", "exceeds the scene's duration of 5s"),
    ] {
        let window = format!("--window={window}");
        let (exit, said, errors) = call(&["trade", "spring-ball", &window, "--out", out]);
        assert_eq!((exit, said.as_str()), (Exit::Refused, ""), "{window}");
        assert!(errors.contains(message), "{window}: {errors}");
    }
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
}

#[test]
fn every_step_divides_the_period_that_is_asked_for() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().to_str().unwrap();
    let ask = |period: &str| {
        call(&[
            "trade",
            "spring-ball",
            "--window",
            "0.1s",
            "--period",
            period,
            "--out",
            out,
            "--json",
        ])
    };
    // However it is written: the second call reads what the first has kept.
    for period in ["3000us", "3ms"] {
        let (exit, said, errors) = ask(period);
        assert_eq!(exit, Exit::Done, "{errors}");
        let json: serde_json::Value = serde_json::from_str(&said).unwrap();
        assert_eq!(json["period"].as_f64(), Some(3e-3));
        let points = json["points"].as_array().unwrap();
        for point in points {
            let step = point["step"].as_f64().unwrap();
            for time in [3e-3, 5.0] {
                let parts: f64 = time / step;
                assert!((parts - parts.round()).abs() < 1e-9 * parts, "{step} {time}");
            }
        }
        let advisable = |point: &&serde_json::Value| point["advisable"] == true;
        assert!(points.iter().filter(advisable).count() > 20);
    }
    assert_eq!(caches(&folder.path().join("spring-ball")).len(), 1);
    let (exit, said, errors) = ask("3.14159265ms");
    assert_eq!((exit, said.as_str()), (Exit::Refused, ""));
    assert!(errors.contains("no step divides both the period 3.14159265ms"), "{errors}");
}

/// A scene file with one change.
fn file(folder: &Path, changes: [&str; 2]) -> String {
    let text = fs::read_to_string(
        Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes/spring-ball.toml"),
    );
    let changed = text.unwrap().replace(changes[0], changes[1]);
    assert!(changed.contains(changes[1]));
    let path = folder.join("scene.toml");
    fs::write(&path, changed).unwrap();
    path.to_str().unwrap().into()
}

#[test]
fn what_would_take_hours_or_has_no_folder_is_refused_at_once() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    let out = out.to_str().unwrap();
    let path = file(folder.path(), ["stiffness = 1e3", "stiffness = 1e3"]);
    let unfit = folder.path().join("a:b.toml");
    fs::rename(path, &unfit).unwrap();
    let (exit, _, errors) = call(&["trade", unfit.to_str().unwrap(), "--out", out]);
    assert_eq!(exit, Exit::Refused);
    assert!(errors.contains("it contains ':'") && errors.contains("the scene's file"), "{errors}");
    let path = file(folder.path(), ["stiffness = 1e3", "stiffness = 1e40"]);
    let (exit, _, errors) = call(&["trade", &path, "--out", out]);
    assert_eq!(exit, Exit::Refused);
    assert!(errors.contains("would take hours") && errors.contains("--window"), "{errors}");
}

/// The other half of the test below: surveys until it is killed.
#[test]
#[ignore = "called by the test of a kill"]
fn survey_until_killed() {
    let Ok(out) = std::env::var("DBD_TRADE_KILLED") else { return };
    call(&["trade", "spring-ball", "--window", "0.5s", "--out", &out]);
}

#[test]
fn a_survey_that_is_killed_is_gone_on_with() {
    let folder = tempfile::tempdir().unwrap();
    let [killed, whole] = ["killed", "whole"].map(|name| folder.path().join(name));
    let results = killed.join("spring-ball");
    let kept = || {
        let caches = if results.is_dir() { caches(&results) } else { Vec::new() };
        let read = |file| fs::read_to_string(file).unwrap_or_default();
        caches.first().map_or(0, |file| read(file).lines().count())
    };
    // Killed when some results are kept. On a busy machine it may be done by then: once more.
    let killed_in_time = || {
        _ = fs::remove_dir_all(&killed);
        let mut child = std::process::Command::new(std::env::current_exe().unwrap())
            .args(["--ignored", "--exact", "command::survey_until_killed"])
            .env("DBD_TRADE_KILLED", &killed)
            .stdout(std::process::Stdio::null())
            .spawn()
            .unwrap();
        while kept() < 20 && child.try_wait().unwrap().is_none() {
            std::thread::sleep(std::time::Duration::from_millis(1));
        }
        child.kill().unwrap();
        child.wait().unwrap();
        kept() >= 20 && !results.join("trade.csv").exists()
    };
    assert!((0..10).any(|_| killed_in_time()), "it was never killed in time");
    let before = kept();
    for out in [&killed, &whole] {
        let out = out.to_str().unwrap();
        let (exit, ..) =
            call(&["trade", "spring-ball", "--window", "0.5s", "--quiet", "--out", out]);
        assert_eq!(exit, Exit::Done);
    }
    assert!(kept() > before);
    assert_eq!(accuracy_columns(&results), accuracy_columns(&whole.join("spring-ball")));
}

#[test]
fn two_surveys_do_not_write_to_one_file() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().to_str().unwrap();
    let arguments = ["trade", "spring-ball", "--window", "0.1s", "--quiet", "--out", out];
    assert_eq!(call(&arguments).0, Exit::Done);
    let path = caches(&folder.path().join("spring-ball")).remove(0);
    let (file, before) = (fs::File::open(&path).unwrap(), fs::read(&path).unwrap());
    file.try_lock().unwrap();
    let (exit, _, errors) = call(&arguments);
    assert_eq!(exit, Exit::Failed);
    assert!(
        errors.contains("another trade-off study of this scene") && errors.contains("--out"),
        "{errors}"
    );
    assert_eq!(fs::read(&path).unwrap(), before);
    drop(file);
    assert_eq!(call(&arguments).0, Exit::Done);
}
