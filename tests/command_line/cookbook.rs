//! The cookbook: its commands are run in order, but for those of [`ELSEWHERE`], and the page shows what they print.

use std::fs;
use std::process::Command;

use dbd_golden::Blessing;
use dbd_plant::Method;
use dbd_scene::Scene;
use dbd_tests::page::block;
use dbd_tests::results::path;
use host_sim::commands::golden::GoldenOptions;
use host_sim::commands::run::{RunOptions, run};
use host_sim::terminal::Exit;

use crate::{Folder, call};

const PAGE: &str = "docs/cookbook.md";

/// What is shown of a task: its block, and the beginnings of the lines.
const SHOWN: [(&str, &[&str]); 11] = [
    ("motor", &["read-out  ", "engaged", "energy, balance"]),
    ("suspension", &["read-out                  `tyre", "tyre_force", "car_speed.z"]),
    ("crane", &["read-out                  `trolley_speed.x", "read-out                  `motor"]),
    (
        "gripper",
        &["read-out                  `right_grip.x", "read-out                  `left_grip.x"],
    ),
    ("balance", &["scene", "states", "inputs", "outputs"]),
    (
        "robot",
        &[
            "read-out                  `pitch`",
            "engaged                   interaction `front",
            "states",
            "inputs",
            "robot: ",
        ],
    ),
    ("laws", &["my-laws"]),
    ("golden", &["golden"]),
    ("firmware", &["gate-"]),
    (
        "flight",
        &["read-out                  `imu.az", "read-out                  `rope", "quadrotor: "],
    ),
    ("fmu", &["pendulum.fmu"]),
];

/// Pictures of the page, and their scenes.
const PICTURES: [(&str, &str); 5] = [
    ("docs/pictures/gate-opener.svg", "docs/examples/gate-opener/gate-opener.toml"),
    ("docs/pictures/quarter-car.svg", "docs/examples/quarter-car/quarter-car.toml"),
    ("docs/pictures/crane.svg", "docs/examples/crane/crane.toml"),
    ("docs/pictures/quadrotor.svg", "docs/examples/quadrotor/quadrotor.toml"),
    ("docs/pictures/balance-robot.svg", "docs/examples/balance-robot/balance-robot.toml"),
];

/// What commands write beside `out`.
const FILES: [&str; 10] = [
    "four-bar.golden",
    "gate-c",
    "gate-rust",
    "my-laws",
    "out/quarter-car",
    "pendulum.fmu",
    "pendulum.json",
    "quadrotor",
    "robot",
    "stiffer",
];

/// Commands that other tests run: of other programs, of two that meet, or that take long.
const ELSEWHERE: [(&str, &str); 11] = [
    ("cargo run --release --example balance", "tests/dynamics/controllers.rs"),
    ("cargo run --release --example balance_robot", "tests/dynamics/controllers.rs"),
    ("python python/examples/identify.py", "python/tests/test_examples.py"),
    (
        "host-sim advise cart-pendulum --mcu cortex-m4f --clock 168MHz --rate 1kHz",
        "tests/command_line/advise.rs",
    ),
    (
        "host-sim sweep docs/examples/sweeps/stiffness.toml --shard 1/2",
        "tests/command_line/sweep.rs",
    ),
    (
        "host-sim sweep docs/examples/sweeps/stiffness.toml --shard 2/2",
        "tests/command_line/sweep.rs",
    ),
    ("host-sim sweep docs/examples/sweeps/stiffness.toml --merge", "tests/command_line/sweep.rs"),
    ("make -C gate-c test", "xtask/src/chip/c_project.rs"),
    ("make -C gate-c qemu", "xtask/src/chip/c_project.rs"),
    (
        "host-sim hil cart-pendulum --port tcp-listen:127.0.0.1:5555 --serve",
        "tests/command_line/hil.rs",
    ),
    (
        "host-sim hil cart-pendulum --port tcp:127.0.0.1:5555 --steps 2 --controller noise:0.5",
        "tests/command_line/hil.rs",
    ),
];

/// A task of the page: its heading, its commands, and the block that shows what they print.
#[derive(Debug, Default)]
struct Task {
    heading: String,
    commands: Vec<String>,
    block: Option<String>,
}

fn tasks() -> Vec<Task> {
    let text = fs::read_to_string(path(PAGE)).unwrap();
    let (mut tasks, mut is_command): (Vec<Task>, bool) = (Vec::new(), false);
    for line in text.lines() {
        if let Some(heading) = line.strip_prefix("## ") {
            tasks.push(Task { heading: heading.to_owned(), ..Task::default() });
        }
        let Some(task) = tasks.last_mut() else { continue };
        match line {
            "```sh" => is_command = true,
            "```" => is_command = false,
            _ if is_command => task.commands.push(line.to_owned()),
            _ => {
                let name = line.strip_prefix("<!-- table ").and_then(|rest| rest.split_once(": "));
                task.block = name.map(|(name, _)| name.to_owned()).or(task.block.take());
            }
        }
    }
    tasks
}

/// A folder as the reader's, beside a checkout.
struct Reader(Folder);

impl Reader {
    fn file(&self, name: &str) -> String {
        self.0.path(name).to_str().unwrap().to_owned()
    }

    /// A word of a command, its path that of a file of the checkout or of the reader's folder.
    fn word(&self, word: &str) -> String {
        match word {
            _ if word.starts_with("docs/") => path(word).to_str().unwrap().to_owned(),
            _ if FILES
                .iter()
                .any(|file| word.split('/').next() == Some(*file) || word == *file) =>
            {
                self.file(word)
            }
            _ => word.to_owned(),
        }
    }

    /// The lines that a command prints, without the folder's path.
    fn run(&self, command: &str) -> String {
        let mut words: Vec<String> =
            command.split_whitespace().skip(1).map(|word| self.word(word)).collect();
        if words[0] == "fmu" {
            // What importers take is made by a build of its own; here is what such a file begins with.
            fs::write(self.0.path("library.so"), crate::fmu::library()).unwrap();
            words.extend(["--library".to_owned(), self.file("library.so")]);
        }
        let writes = ["run", "compare"].contains(&words[0].as_str());
        if writes && !words.iter().any(|word| word == "--out") {
            words.extend(["--out".to_owned(), self.file("out")]);
        }
        let done = call(&words.iter().map(String::as_str).collect::<Vec<_>>());
        // As `diff`, `compare` ends with 1 where there is a difference.
        let expected = if words[0] == "compare" { Exit::Failed } else { Exit::Done };
        assert_eq!(done.exit, expected, "{command}: {} {}", done.out, done.err);
        let checkout = path("").canonicalize().unwrap();
        done.out.replace(&self.file(""), "").replace(checkout.to_str().unwrap(), "the checkout")
    }

    /// What `DBD_BLESS=golden` in the environment does, in this process.
    fn bless(&self) {
        let scene = Scene::load(path("scenes/four-bar.toml")).unwrap();
        let golden = GoldenOptions {
            file: self.0.path("four-bar.golden"),
            bands: None,
            blessing: Blessing::Yes,
        };
        let options = RunOptions {
            step: scene.step,
            every: scene.every,
            golden: Some(golden),
            ..RunOptions::new(Method::default())
        };
        run(&scene, &options, &mut |_, _, _| ()).unwrap();
    }
}

#[test]
fn the_cookbook_does_what_it_says() {
    let reader = Reader(Folder::new());
    let tasks = tasks();
    assert_eq!(tasks.len(), 15);
    let mut elsewhere = 0;
    for task in &tasks {
        assert!(!task.commands.is_empty(), "{task:?}");
        let mut printed = String::new();
        for command in &task.commands {
            if let Some((_, test)) = ELSEWHERE.iter().find(|(other, _)| command == other) {
                assert!(path(test).is_file(), "{test}");
                elsewhere += 1;
            } else if command.starts_with("DBD_BLESS=golden host-sim ") {
                reader.bless();
            } else {
                assert!(command.starts_with("host-sim "), "{command}");
                printed += &reader.run(command);
            }
        }
        let Some(name) = &task.block else { continue };
        let shown = SHOWN.iter().find(|(known, _)| known == name);
        let (_, begins) = shown.unwrap_or_else(|| panic!("{}: {name}", task.heading));
        let lines =
            printed.lines().filter(|line| begins.iter().any(|begin| line.starts_with(begin)));
        let lines: Vec<&str> = lines.map(str::trim_end).collect();
        assert!(!lines.is_empty(), "{}: {printed}", task.heading);
        block(PAGE, name, &format!("```text\n{}\n```", lines.join("\n")));
    }
    assert_eq!(elsewhere, ELSEWHERE.len());
    assert_eq!(tasks.iter().filter(|task| task.block.is_some()).count(), SHOWN.len());
    for (picture, scene) in PICTURES {
        let file = reader.file("picture.svg");
        let done = call(&["check", path(scene).to_str().unwrap(), "--svg", &file]);
        assert_eq!(done.exit, Exit::Done, "{scene}: {}", done.err);
        let command = "cargo test -p dbd-tests --test command_line cookbook";
        dbd_tests::page::file(picture, &fs::read_to_string(&file).unwrap(), command);
        fs::remove_file(&file).unwrap();
    }
}

/// The page's C, by a compiler, against the header that the page's command writes.
#[test]
fn the_cookbook_s_c_compiles() {
    let text = fs::read_to_string(path(PAGE)).unwrap();
    let code = text.split("```c\n").nth(1).unwrap().split("```").next().unwrap();
    let reader = Reader(Folder::new());
    reader.run("host-sim new c quadrotor --scene docs/examples/quadrotor/quadrotor.toml");
    fs::write(reader.0.path("module.c"), code).unwrap();
    let done = Command::new("cc")
        .args(["-std=c99", "-Wall", "-Wextra", "-Wpedantic", "-Werror", "-fsyntax-only"])
        .args(["-I", &reader.file("quadrotor/include"), &reader.file("module.c")])
        .output()
        .unwrap();
    assert!(done.status.success(), "{}", String::from_utf8_lossy(&done.stderr));
}
