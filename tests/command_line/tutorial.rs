//! The tutorial, followed step by step: every command of the page is run, and what it prints stands
//! there.

use std::fs;

use dbd_golden::Blessing;
use dbd_plant::Method;
use dbd_scene::Scene;
use dbd_tests::page::block;
use dbd_tests::results::path;
use host_sim::commands::golden::GoldenOptions;
use host_sim::commands::run::{RunOptions, run};
use host_sim::terminal::Exit;

use crate::{Done, Folder, call};

const PAGE: &str = "docs/tutorial.md";
const SCENE: &str = "docs/examples/wiper/wiper.toml";
/// What the page writes; it lies in the test's folder.
const FILES: [&str; 4] = ["wiper.toml", "wiper.svg", "wiper.golden", "wiper-plant"];
/// The commands that are to fail: what they say is what the page shows.
const TOO_LARGE: &str = "host-sim run wiper.toml --step 500us";
const CHANGED: &str = "host-sim run wiper.toml --golden wiper.golden --set points.C[0]=0.150001";
/// What `cargo xtask project` does with a new project.
const OF_A_PROJECT: [&str; 3] = ["cargo test", "cargo qemu", "cargo cost"];

/// Something that the page tells the reader to do.
#[derive(Debug, PartialEq)]
enum Deed {
    Command(String),
    /// A line for the scene, to stand below `every`.
    Line(String),
}

/// What the page tells to do, in its order; scenes and tables that tests wrote are none.
fn deeds() -> Vec<Deed> {
    let text = fs::read_to_string(path(PAGE)).unwrap();
    let (mut fence, mut written, mut deeds) = (None, false, Vec::new());
    for line in text.lines() {
        match line {
            _ if line.starts_with("<!-- table ") => written = true,
            "<!-- end -->" => written = false,
            "```" => fence = None,
            _ if line.starts_with("```") => fence = Some(&line[3..]),
            _ if written => {}
            _ => match fence {
                Some("sh") => {
                    let command = line.split('#').next().unwrap_or_default().trim();
                    deeds.push(Deed::Command(command.to_owned()));
                }
                Some("toml") => deeds.push(Deed::Line(line.to_owned())),
                _ => {}
            },
        }
    }
    deeds
}

/// A folder as the reader's, with the scene in it.
struct Reader(Folder);

impl Reader {
    fn file(&self, name: &str) -> String {
        self.0.path(name).to_str().unwrap().to_owned()
    }

    fn call(&self, command: &str) -> Done {
        let words = command.split_whitespace().skip(1);
        let mut words: Vec<String> = words
            .map(|word| if FILES.contains(&word) { self.file(word) } else { word.to_owned() })
            .collect();
        if ["run", "trade"].contains(&words[0].as_str()) {
            words.extend(["--out".to_owned(), self.file("out")]);
        }
        let done = call(&words.iter().map(String::as_str).collect::<Vec<_>>());
        let here = self.file("");
        let [out, err] = [done.out, done.err].map(|text| shown(&text.replace(&here, "")));
        Done { out, err, ..done }
    }

    /// What `DBD_BLESS=golden` in the environment does, in this process.
    fn bless(&self) {
        let scene = Scene::load(self.file("wiper.toml")).unwrap();
        let file = self.file("wiper.golden").into();
        let golden = GoldenOptions { file, bands: None, blessing: Blessing::Yes };
        let options = RunOptions {
            step: scene.step,
            every: scene.every,
            golden: Some(golden),
            ..RunOptions::new(Method::default())
        };
        run(&scene, &options, &mut |_, _, _| ()).unwrap();
    }

    /// Writes a line into the scene, below `every`.
    fn write(&self, line: &str) {
        let file = self.file("wiper.toml");
        let text = fs::read_to_string(&file).unwrap();
        let (before, after) = text.split_once("\npoints.O").unwrap();
        fs::write(&file, format!("{before}\n{line}\npoints.O{after}")).unwrap();
    }
}

/// Without what a clock says.
fn shown(text: &str) -> String {
    let line = |line: &str| match line.find(|letter: char| letter.is_ascii_digit()) {
        Some(figure) if line.starts_with("wall time") => format!("{}…", &line[..figure]),
        _ => line.trim_end().to_owned(),
    };
    text.lines().map(line).collect::<Vec<_>>().join("\n")
}

fn fenced(kind: &str, text: &str) -> String {
    format!("```{kind}\n{}\n```", text.trim_end())
}

#[test]
fn the_tutorial_does_what_it_says() {
    let reader = Reader(Folder::new());
    let scene = fs::read_to_string(path(SCENE)).unwrap();
    fs::write(reader.file("wiper.toml"), &scene).unwrap();
    block(PAGE, "scene", &fenced("toml", &scene));

    let text = |name: &str, text: &str| block(PAGE, name, &fenced("text", text));
    let deeds = deeds();
    assert!(deeds.len() > 9, "{deeds:?}");
    for deed in deeds {
        let command = match deed {
            Deed::Line(line) => {
                reader.write(&line);
                continue;
            }
            Deed::Command(command) if OF_A_PROJECT.contains(&command.as_str()) => continue,
            Deed::Command(command) if command.starts_with("DBD_BLESS=golden host-sim ") => {
                reader.bless();
                continue;
            }
            Deed::Command(command) => command,
        };
        assert!(command.starts_with("host-sim "), "{command}");
        let done = reader.call(&command);
        let expected = match command.as_str() {
            TOO_LARGE => Exit::Failed,
            CHANGED => Exit::Refused,
            _ => Exit::Done,
        };
        assert_eq!(done.exit, expected, "{command}: {} {}", done.out, done.err);
        match command.as_str() {
            "host-sim check wiper.toml" => text("check", &done.out),
            "host-sim run wiper.toml" => text("run", &done.out),
            TOO_LARGE => text("too large", &done.err),
            CHANGED => text("changed", &done.err),
            "host-sim run wiper.toml --golden wiper.golden" => {
                let reported: Vec<_> =
                    done.out.lines().filter(|line| line.contains("golden")).collect();
                text("golden", &reported.join("\n"));
            }
            _ => {}
        }
    }
    for file in ["wiper.svg", "out/wiper/report.html", "out/wiper/trade.html"] {
        assert!(reader.0.path(file).is_file(), "{file}");
    }
    let drawn = fs::read_to_string(reader.file("wiper.svg")).unwrap();
    let command = "cargo test -p dbd-tests --test command_line tutorial";
    dbd_tests::page::file("docs/pictures/wiper.svg", &drawn, command);
    assert!(reader.0.path("wiper-plant/scenes/wiper.toml").is_file());
}
