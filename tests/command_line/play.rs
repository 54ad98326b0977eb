//! `play`: the page that is written, what is refused, and what is served to whom. What the page does is for `browser`.

use std::fs;
use std::io::{Read as _, Write};
use std::net::TcpStream;
use std::path::Path;
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

use host_sim::cli::main_with;
use host_sim::terminal::{Console, Exit};
use serde_json::Value;

use crate::{Folder, call};

/// A file that begins as a module does.
const MODULE: &[u8] = b"\0asm\x01\0\0\0";

/// The data of a page.
fn data(page: &str) -> Value {
    let start = "<script type=\"application/json\" id=\"play\">";
    let text = page.split(start).nth(1).unwrap().split("</script>").next().unwrap();
    serde_json::from_str(text).unwrap()
}

#[test]
fn a_page_holds_its_scenes_and_what_was_chosen() {
    let folder = Folder::new();
    let [file, module] = [folder.path("deep/play.html"), folder.path("m.wasm")];
    fs::write(&module, MODULE).unwrap();
    let [file, module] = [&file, &module].map(|path| path.to_str().unwrap());
    let chosen = ["--set", "joint.*.stiffness=1e6", "--precision", "f32", "--speed", "0.1"];
    let play = |scenes: &[&str], more: &[&str]| {
        call(&[&["play", "--module", module, "--out", file][..], scenes, more].concat())
    };
    for _ in 0..2 {
        let done = play(&["four-bar"], &chosen);
        assert_eq!((done.exit, done.out), (Exit::Done, format!("{file}\n")), "{}", done.err);
    }
    let page = fs::read_to_string(file).unwrap();
    let reported = data(&page);
    assert_eq!(reported["scenes"][0]["file"], "four-bar.toml");
    let text = reported["scenes"][0]["text"].as_str().unwrap();
    assert!(text.contains("[[body]]") && reported["reload"].is_null());
    assert_eq!(
        (&reported["settings"]["precision"], &reported["speed"]),
        (&"f32".into(), &0.1.into())
    );
    assert_eq!(reported["set"]["joint.*.stiffness"], 1e6);
    for fetch in ["src=\"http", "href=\"http", "@import", "url(http"] {
        assert!(!page.contains(fetch), "{fetch}");
    }
    assert_eq!(play(&["four-bar", "gripper"], &[]).exit, Exit::Done);
    let reported = data(&fs::read_to_string(file).unwrap());
    assert_eq!(reported["scenes"][1]["name"], "gripper");
    assert_eq!(play(&["--all"], &[]).exit, Exit::Done);
    let reported = data(&fs::read_to_string(file).unwrap());
    let listed: Value = serde_json::from_str(&call(&["list", "--json"]).out).unwrap();
    assert_eq!(reported["scenes"].as_array().unwrap().len(), listed.as_array().unwrap().len());
}

#[test]
fn no_page_is_written_where_something_is_wrong() {
    let folder = Folder::new();
    let [file, module, text] = ["p.html", "m.wasm", "notes.txt"].map(|name| folder.path(name));
    fs::write(&module, MODULE).unwrap();
    fs::write(&text, "mine").unwrap();
    let broken = folder.path("broken.toml");
    fs::write(&broken, "name = \"x\"\nduratoin = 1\n").unwrap();
    let long = folder.path("long.toml");
    let scene = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes/four-bar.toml");
    let scene = fs::read_to_string(scene).unwrap();
    fs::write(&long, scene + &"#\n".repeat(5_000_000)).unwrap();
    let path = |path: &std::path::PathBuf| path.to_str().unwrap().to_owned();
    let [file_text, module_text, text_text] = [&file, &module, &text].map(path);
    let refused = |arguments: &[&str], exit: Exit, words: &str| {
        let done = call(&[&["play"][..], arguments].concat());
        assert_eq!(done.exit, exit, "{arguments:?}: {}", done.err);
        assert!(done.err.contains(words), "{arguments:?}: {}", done.err);
        assert!(!file.exists(), "{arguments:?}");
    };
    let with = |more: &[&str], exit: Exit, words: &str| {
        let usual = ["--module", &module_text, "--out", &file_text];
        refused(&[more, &usual].concat(), exit, words);
    };
    let no = Exit::Refused;
    with(&["no-such-scene"], no, "no-such-scene");
    with(&[&path(&broken)], no, "duratoin");
    with(&["four-bar", "--set", "joint.nobody.stiffness=1"], no, "nobody");
    with(&["four-bar", "--set", "joint.*.stiffness=soft"], no, "soft");
    with(&["four-bar", "--step", "-1us"], no, "step");
    with(&["four-bar", "--damping", "implicit"], no, "implicit");
    for speed in ["0", "-1", "NaN", "inf"] {
        with(&["four-bar", "--speed", speed], no, "speed");
    }
    with(&[], no, "SCENES");
    with(&[&path(&long)], no, "bytes");
    refused(
        &["four-bar", "--out", &file_text, "--module", "nowhere.wasm"],
        no,
        "cargo xtask playground",
    );
    refused(&["four-bar", "--out", &file_text, "--module", &text_text], no, "WebAssembly");
    refused(
        &["four-bar", "--out", &text_text, "--module", &module_text],
        no,
        "is not a page of host-sim",
    );
    assert_eq!(fs::read_to_string(&text).unwrap(), "mine");
    refused(&["four-bar", "--serve", "--module", &module_text, "--port", "99999"], no, "99999");
}

/// What others read of what is printed.
#[derive(Clone, Default)]
struct Shared(Arc<Mutex<Vec<u8>>>);

impl Write for Shared {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        self.0.lock().unwrap().extend(bytes);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> std::io::Result<()> {
        Ok(())
    }
}

/// The answer to a request.
fn get(port: &str, path: &str, host: &str) -> String {
    let mut stream = TcpStream::connect(format!("127.0.0.1:{port}")).unwrap();
    write!(stream, "GET {path} HTTP/1.1\r\nHost: {host}\r\nConnection: close\r\n\r\n").unwrap();
    let mut answer = String::new();
    stream.read_to_string(&mut answer).unwrap();
    answer
}

#[test]
fn a_served_scene_follows_its_file_for_who_knows_the_address() {
    let folder = Folder::new();
    let [scene, module] = [folder.path("mine.toml"), folder.path("m.wasm")];
    fs::write(&module, MODULE).unwrap();
    let text = call(&["new", "scene", scene.with_extension("").to_str().unwrap()]);
    assert_eq!(text.exit, Exit::Done, "{}", text.err);
    let said = Shared::default();
    let heard = said.clone();
    let [scene_text, module_text] = [&scene, &module].map(|path| path.to_str().unwrap().to_owned());
    // It serves until the program ends.
    std::thread::spawn(move || {
        let (mut out, mut err) = (said, Vec::new());
        let arguments = ["host-sim", "play", &scene_text, "--serve", "--module", &module_text];
        main_with(arguments, &mut Console::plain(&mut out, &mut err));
    });
    let start = Instant::now();
    let url = loop {
        let said = String::from_utf8(heard.0.lock().unwrap().clone()).unwrap();
        if let Some(url) = said.strip_suffix('\n') {
            break url.to_owned();
        }
        assert!(start.elapsed() < Duration::from_secs(60), "it says where it serves");
        std::thread::sleep(Duration::from_millis(20));
    };
    let rest = url.strip_prefix("http://127.0.0.1:").unwrap();
    let (port, path) = rest.split_once('/').unwrap();
    assert!(path.len() == 33 && path.ends_with('/'), "{url}");
    let own = format!("127.0.0.1:{port}");
    let page = get(port, &format!("/{path}"), &own);
    assert!(page.starts_with("HTTP/1.1 200") && page.contains("id=\"play\""));
    assert_eq!(data(&page)["reload"], format!("/{path}scene"));
    let scene_now = || {
        let answer = get(port, &format!("/{path}scene"), &own);
        serde_json::from_str::<Value>(answer.split("\r\n\r\n").nth(1).unwrap()).unwrap()
    };
    let first = scene_now();
    assert_eq!(first["text"], fs::read_to_string(&scene).unwrap());
    assert_eq!(scene_now(), first);
    fs::write(&scene, "name = \"another\"\n").unwrap();
    let second = scene_now();
    assert!(second["text"] == "name = \"another\"\n" && second["version"] != first["version"]);
    fs::remove_file(&scene).unwrap();
    assert!(scene_now()["error"].as_str().unwrap().contains("cannot read"));
    for (path, host) in [
        ("/", own.as_str()),
        ("/scene", &own),
        (&format!("/{}x/", &path[..31]), &own),
        (&format!("/{path}"), "example.org"),
        (&format!("/{path}"), "example.org:80"),
    ] {
        let answer = get(port, path, host);
        assert!(
            answer.starts_with("HTTP/1.1 403") && !answer.contains("[[body]]"),
            "{path} {host}"
        );
    }
    assert!(get(port, &format!("/{path}other"), &own).starts_with("HTTP/1.1 404"));
}
