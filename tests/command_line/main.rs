//! The command line as users and their scripts meet it: exit codes, files, numbers, messages.

mod advise;
mod balance;
mod bench;
mod check;
mod compare;
mod cookbook;
#[cfg(unix)]
mod files;
mod fmu;
mod gltf;
mod golden;
mod hil;
mod import;
mod interactions;
mod linearise;
mod manual;
mod mode_table;
mod modes;
mod new;
mod picture;
mod play;
mod recorded;
mod refusal;
mod rejects;
mod relax;
mod report;
mod results;
mod rounding;
mod run;
mod scene_texts;
mod schema;
mod set;
mod settle;
mod sweep;
mod tutorial;
mod warnings;
mod watch;

use std::fs;
use std::path::{Path, PathBuf};

use host_sim::cli::main_with;
use host_sim::terminal::Console;
use host_sim::terminal::Exit;
use serde_json::Value;
use tempfile::TempDir;

/// What a command came to.
struct Done {
    exit: Exit,
    out: String,
    err: String,
}

fn call(arguments: &[&str]) -> Done {
    let (mut out, mut err) = (Vec::new(), Vec::new());
    let mut console = Console::plain(&mut out, &mut err);
    let exit =
        main_with(std::iter::once("host-sim").chain(arguments.iter().copied()), &mut console);
    let text = |bytes| String::from_utf8(bytes).unwrap();
    Done { exit, out: text(out), err: text(err) }
}

/// A folder for results that is gone after the test.
struct Folder(TempDir);

impl Folder {
    fn new() -> Self {
        Self(tempfile::tempdir().unwrap())
    }

    fn path(&self, below: &str) -> PathBuf {
        self.0.path().join(below)
    }

    /// Runs a scene with its results below `out`, and with what else is given.
    fn run(&self, scene: &str, options: &[&str]) -> Done {
        let out = self.path("out");
        let mut arguments = vec!["run", scene, "--out", out.to_str().unwrap()];
        arguments.extend(options);
        call(&arguments)
    }

    /// The same, as the summary that is printed.
    fn summary(&self, scene: &str, options: &[&str]) -> Value {
        let done = self.run(scene, &[options, &["--json"]].concat());
        serde_json::from_str(&done.out).unwrap_or_else(|_| panic!("{} {}", done.out, done.err))
    }

    fn trace(&self, scene: &str) -> Trace {
        Trace::read(&self.path("out").join(scene).join("trace.csv"))
    }

    /// A scene file in this folder.
    fn scene(&self, text: &str) -> String {
        let path = self.path("scene.toml");
        fs::write(&path, text).unwrap();
        path.to_str().unwrap().into()
    }
}

/// A trace as texts.
struct Trace {
    header: Vec<String>,
    rows: Vec<Vec<String>>,
}

impl Trace {
    fn read(path: &Path) -> Self {
        let text = fs::read_to_string(path).unwrap();
        let mut lines = text.lines().map(|line| line.split(',').map(str::to_owned).collect());
        Self { header: lines.next().unwrap(), rows: lines.collect() }
    }

    fn times(&self) -> Vec<f64> {
        self.rows.iter().map(|row| row[0].parse().unwrap()).collect()
    }
}

/// Swings for half a second without springs that are stiff: quick to run in any build.
const PENDULUM: &str = r#"
name = "pendulum"
description = "A bob on one spring. It swings."
gravity = [0.0, -9.81, 0.0]
duration = 0.5

[[body]]
name = "bob"
mass = 0.5
inertia = [1e-3, 1e-3, 1e-3]
position = [0.6, 0.8, 0.0]

[[tsda]]
between = ["world", "bob"]
points = [[0, 0, 0], [0, 0, 0]]
stiffness = 2e3
free_length = 1.0
"#;

fn times_in(text: &str, option: &str) -> Vec<String> {
    let words: Vec<&str> = text.split_whitespace().collect();
    let pairs = words.windows(2).filter(|pair| pair[0] == option);
    pairs.map(|pair| pair[1].trim_end_matches([';', ',', ':']).to_owned()).collect()
}
