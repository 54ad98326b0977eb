//! Paths that lead to something else than a file of a reasonable size.

use std::fs::{self, File};
use std::process::Command;
use std::sync::mpsc;
use std::thread;
use std::time::Duration;

use host_sim::terminal::Exit;

use crate::{Done, Folder, call};

/// A command with `PATH` for the path that it opens.
const COMMANDS: [&[&str]; 14] = [
    &["run", "PATH"],
    &["check", "PATH"],
    &["check", "PATH", "--svg", "OUT.svg"],
    &["export", "PATH"],
    &["fmu", "PATH"],
    &["trade", "PATH"],
    &["new", "scene", "OUT", "--from", "PATH"],
    &["new", "firmware", "OUT", "--scene", "PATH"],
    &["sweep", "PATH"],
    &["sweep", "SWEEP"],
    &["import", "PATH"],
    &["import", "INCLUDE"],
    &["run", "four-bar", "--golden", "PATH", "--duration", "1ms"],
    &["fmu", "four-bar", "--library", "PATH"],
];

/// What a command comes to, or `None` where it does not end.
fn ended(arguments: Vec<String>) -> Option<Done> {
    let (sender, receiver) = mpsc::channel();
    thread::spawn(move || {
        let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
        let _ = sender.send(call(&arguments));
    });
    receiver.recv_timeout(Duration::from_secs(30)).ok()
}

#[test]
fn what_is_no_regular_file_of_a_reasonable_size_is_refused() {
    let folder = Folder::new();
    let at = |name: &str| folder.path(name).display().to_string();
    fs::create_dir(folder.path("folder.toml")).unwrap();
    assert!(Command::new("mkfifo").arg(at("pipe.toml")).status().unwrap().success());
    File::create(folder.path("large.toml")).unwrap().set_len((1 << 30) + 1).unwrap();
    let paths = [
        (at("folder.toml"), "folder"),
        (at("pipe.toml"), "regular file"),
        ("/dev/zero".to_owned(), "regular file"),
        (at("large.toml"), "larger than"),
    ];
    for (path, said) in &paths {
        let spec = format!("scene = {path:?}\n[axes]\nduration = [1, 2]\n");
        fs::write(folder.path("sweep.toml"), spec).unwrap();
        let name = path.rsplit('/').next().unwrap();
        let model = format!("<mujoco>\n<include file='{name}'/>\n</mujoco>");
        fs::write(folder.path("include.xml"), model).unwrap();
        for command in COMMANDS {
            // What an include names lies in the model's folder.
            if command.contains(&"INCLUDE") && path.starts_with("/dev") {
                continue;
            }
            let filled = command.iter().map(|word| match *word {
                "PATH" => path.clone(),
                "SWEEP" => at("sweep.toml"),
                "INCLUDE" => at("include.xml"),
                "OUT" | "OUT.svg" => at(&word.to_lowercase()),
                word => word.to_owned(),
            });
            let Some(done) = ended(filled.collect()) else { panic!("{command:?} {path}: no end") };
            assert_eq!(done.exit, Exit::Refused, "{command:?} {path}: {}", done.err);
            assert!(done.err.contains(said), "{command:?} {path}: {}", done.err);
        }
        let compared = ended(vec!["compare".into(), path.clone(), path.clone()]);
        let compared = compared.unwrap_or_else(|| panic!("compare {path}: no end"));
        assert_eq!(compared.exit, Exit::Refused, "compare {path}: {}", compared.err);
    }
}
