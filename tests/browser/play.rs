//! Live views as a browser shows them: the bits of `run`, sliders, a hand at a body, the editor, failures, telephones.
//!
//! The kernel in WebAssembly is `target/play/dbd_play.wasm`, which `cargo xtask playground` and `cargo xtask test` build.

use std::path::{Path, PathBuf};

use host_sim::cli::main_with;
use host_sim::terminal::{Console, Exit};
use serde_json::{Value, json};

use crate::chromium::{Browser, Screen};
use crate::{DESK, DRAWN, OVERLAPS, PHONE, quiet};

/// Steps after which states are compared.
const STEPS: u64 = 1000;
/// Tables of golden bits: scene, scheme, precision, step, steps, hash.
const GOLDEN: [&str; 5] = ["hashes", "fixed", "generalized-alpha", "joint-wise", PLANAR];
/// That of scenes in their plane.
const PLANAR: &str = "planar";
/// \[bytes\] a module compressed as pages hold it, in base64.
const LARGEST: u64 = 6_000_000;
/// Name, file and text of the scenes of a page.
const SCENES: &str = "dbd.play.page.data.scenes.map(({ name, file, text }) => [name, file, text])";
/// What the README shows first; `DBD_BLESS=1` writes it anew.
const SHOWN: &str = "docs/pictures/play.png";

fn module() -> PathBuf {
    let target = std::env::var_os("CARGO_TARGET_DIR").map(PathBuf::from);
    let target = target.unwrap_or_else(|| Path::new(env!("CARGO_MANIFEST_DIR")).join("../target"));
    target.join("play/dbd_play.wasm")
}

fn call(arguments: &[&str]) {
    let (mut out, mut err) = (Vec::new(), Vec::new());
    let mut console = Console::plain(&mut out, &mut err);
    let exit =
        main_with(std::iter::once("host-sim").chain(arguments.iter().copied()), &mut console);
    assert_eq!(exit, Exit::Done, "{arguments:?}: {}", String::from_utf8_lossy(&err));
}

/// Writes the page of scenes.
fn page(folder: &Path, name: &str, arguments: &[&str]) -> PathBuf {
    let file = folder.join(format!("{name}.html"));
    let module = module();
    let usual = ["--out", file.to_str().unwrap(), "--module", module.to_str().unwrap()];
    call(&[&["play", "--no-open"][..], &usual, arguments].concat());
    file
}

fn ask(browser: &mut Browser, request: &Value) -> Value {
    browser.run(&format!("dbd.play.ask({request})"))
}

fn frame(browser: &mut Browser) -> Value {
    browser.run("dbd.play.frame()")
}

fn time(browser: &mut Browser) -> f64 {
    frame(browser)["time"].as_f64().unwrap()
}

fn text(browser: &mut Browser, selector: &str) -> String {
    let text = browser.run(&format!("document.querySelector('{selector}').textContent"));
    text.as_str().unwrap_or_default().to_owned()
}

#[test]
#[ignore = "needs Chromium and the module: `cargo xtask test` runs it"]
fn live_views() {
    let folder = tempfile::tempdir().unwrap();
    let mut browser = Browser::start();
    let file = page(folder.path(), "cart-pendulum", &["cart-pendulum"]);
    let size = file.metadata().unwrap().len();
    assert!(size < LARGEST, "{size} bytes");
    browser.open(&file, Screen { calm: false, ..DESK });
    browser.wait("dbd.play.state.playing", "it plays by itself");
    let now = time(&mut browser);
    browser.wait(&format!("dbd.play.frame().then((f) => f.time > {now})"), "time passes");
    browser.open(&file, DESK);
    assert_eq!(browser.run("dbd.play.state.playing"), false, "little motion is respected");
    assert_eq!(browser.run(OVERLAPS), json!([]), "nothing overlaps");
    sliders(&mut browser);
    quiet(&mut browser, "sliders");
    editor(&mut browser);
    quiet(&mut browser, "editor");
    failure(&mut browser);
    quiet(&mut browser, "failure");
    let file = page(folder.path(), "four-bar", &["four-bar"]);
    browser.open(&file, DESK);
    hand(&mut browser);
    back(&mut browser);
    quiet(&mut browser, "hand");
    if dbd_tests::page::is_blessed() {
        browser.run("dbd.play.ask({ do: 'reset' })");
        browser.run("dbd.play.advance(9000)");
        browser.run(DRAWN);
        let place = Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(SHOWN);
        std::fs::write(place, browser.picture()).unwrap();
    }
    in_the_dark(&mut browser);
    on_a_telephone(&mut browser);
    quiet(&mut browser, "dark, telephone");
    without_webgl(&mut browser, &file);
    quiet(&mut browser, "without WebGL");
    large(&mut browser, folder.path());
    quiet(&mut browser, "large");
}

/// An input and a number of the scene by their sliders.
fn sliders(browser: &mut Browser) {
    browser.run("dbd.play.advance(200)");
    let state = frame(browser)["hash"].clone();
    let slide = |panel: &str, share: f64| {
        format!(
            "(() => {{ const slider = document.querySelector('#{panel} input[type=range]');
            const [low, high] = [Number(slider.min), Number(slider.max)];
            slider.value = low + {share} * (high - low);
            slider.dispatchEvent(new Event('input', {{ bubbles: true }})); return slider.getAttribute('aria-label'); }})()"
        )
    };
    let name = browser.run(&slide("inputs", 0.9));
    assert!(name.as_str().unwrap().contains("drive"), "{name}");
    browser.run(DRAWN);
    let scene = browser.run("dbd.play.advance(100).then(() => dbd.play.ask({ do: 'table' }))");
    assert!(scene["toml"].as_str().unwrap().contains("table = [[0.0, 0.0], [0.1, "), "{scene}");
    assert_ne!(frame(browser)["hash"], state);
    let before = time(browser);
    let name = browser.run(&slide("parameters", 0.8));
    assert!(name.as_str().is_some_and(|name| !name.is_empty()));
    browser.wait("Object.keys(dbd.play.state.opened.set).length === 1", "a number is changed");
    let after = time(browser);
    assert!((before - after).abs() < 1e-9 || after == 0.0, "it goes on, or begins anew");
}

/// A mistake is named at its place and mended; the run goes on meanwhile.
fn editor(browser: &mut Browser) {
    browser.run("dbd.play.ask({ do: 'change', set: {} })");
    let now = time(browser);
    let typed = |text: &str| format!("dbd.play.page.editor.put({text}, true)");
    browser.run("window.before = dbd.play.page.editor.text");
    browser.run(&typed("window.before.replace('duration', 'duratoin')"));
    browser.wait("Boolean(dbd.play.state.error)", "the mistake is found");
    let error = browser.run("dbd.play.state.error");
    assert!(error["line"].as_u64().is_some_and(|line| line > 1), "{error}");
    let said = text(browser, "#text");
    assert!(said.contains("duratoin") && said.contains("did you mean `duration`"), "{said}");
    browser.wait(
        "document.querySelector('#text .cm-lintRange, #text .cm-lint-marker') !== null",
        "it is marked",
    );
    assert_eq!(time(browser), now, "the old scene stays");
    browser.run(&typed("window.before"));
    browser.wait("!dbd.play.state.error", "it is mended");
    assert_eq!(time(browser), now, "and goes on");
}

/// A step far too long: why, in the words of `run`; a reset recovers.
fn failure(browser: &mut Browser) {
    let changed = ask(browser, &json!({ "do": "change", "settings": { "step": 2e-3 } }));
    assert!(changed["error"].is_null(), "{changed}");
    browser.run("dbd.play.ask({ do: 'reset' }).then(() => dbd.play.advance(200000))");
    browser.wait("dbd.play.state.failed", "it fails");
    browser.wait(
        "document.querySelector('#failure').textContent.includes('step too large')",
        "it is said why",
    );
    let said = text(browser, "#failure");
    assert!(said.contains("ω·h") && said.contains("--step"), "{said}");
    browser.run(
        "dbd.play.ask({ do: 'change', settings: {} }).then(() => dbd.play.ask({ do: 'reset' }))",
    );
    browser.run("dbd.play.advance(100)");
    browser
        .wait("!dbd.play.state.failed && document.querySelector('#failure').hidden", "it recovers");
}

/// The mouse takes hold of a body and pulls it.
fn hand(browser: &mut Browser) {
    let found = "(() => { const box = document.querySelector('.view canvas').getBoundingClientRect();
        const { stage } = dbd.play.page.view;
        for (let y = 10; y < box.height; y += 6) for (let x = 10; x < box.width; x += 6) {
            const hit = stage.hit(x, y, ({ what }) => what === 'body');
            if (hit && document.elementFromPoint(box.left + x, box.top + y) === stage.canvas) return [box.left + x, box.top + y];
        } return null; })()";
    let at = browser.run(found);
    let [x, y] =
        [0, 1].map(|row| at[row].as_f64().unwrap_or_else(|| panic!("no body is seen: {at}")));
    browser.mouse("mouseMoved", x, y, false);
    browser.mouse("mousePressed", x, y, true);
    browser.mouse("mouseMoved", x + 30.0, y + 40.0, true);
    browser.run(DRAWN);
    browser.run("dbd.play.advance(2000)");
    let work = frame(browser)["work"].as_f64().unwrap();
    assert!(work != 0.0 && work.is_finite(), "the hand did {work} J");
    assert_eq!(browser.run("dbd.play.page.grab.held !== null"), true, "it holds");
    browser.mouse("mouseReleased", x + 30.0, y + 40.0, false);
    let nothing =
        "(async () => { const { work } = await dbd.play.frame(); await dbd.play.advance(100);
        return dbd.play.page.grab.held === null && (await dbd.play.frame()).work === work; })()";
    browser.wait(nothing, "released, it does nothing");
}

/// Back to a state of before; its steps again are the same.
fn back(browser: &mut Browser) {
    browser.run("dbd.play.ask({ do: 'reset' }).then(() => dbd.play.ask({ do: 'mark' }))");
    let mut seen = Vec::new();
    for _ in 0..3 {
        browser.run("dbd.play.advance(500).then(() => dbd.play.ask({ do: 'mark' }))");
        seen.push(frame(browser)["hash"].clone());
    }
    let answer = ask(browser, &json!({ "do": "rewind", "mark": 1 }));
    assert!(answer["error"].is_null(), "{answer}");
    assert_eq!(frame(browser)["hash"], seen[0]);
    browser.run("dbd.play.advance(1000)");
    assert_eq!(frame(browser)["hash"], seen[2]);
}

fn in_the_dark(browser: &mut Browser) {
    let colours = "[document.body, document.querySelector('.view'), document.querySelector('#curves')]
        .map((e) => { const s = getComputedStyle(e); return s.color + s.backgroundColor + s.backgroundImage; })";
    let light = browser.run(colours);
    browser.show(Screen { dark: true, ..DESK });
    browser.run(DRAWN);
    assert_ne!(browser.run(colours), light, "the page turns dark");
    browser.show(DESK);
}

fn on_a_telephone(browser: &mut Browser) {
    browser.show(PHONE);
    browser.run(DRAWN);
    browser.run(DRAWN);
    let wide = browser.run("document.documentElement.scrollWidth").as_f64().unwrap();
    assert!(wide <= f64::from(PHONE.width), "{wide} pixels are scrolled sideways");
    assert_eq!(browser.run(OVERLAPS), json!([]), "nothing overlaps");
    let nameless = browser.run(
        "[...document.querySelectorAll('button, input, select')].filter((e) => !e.getAttribute('aria-label')
        && !e.textContent.trim() && !(e.labels && e.labels.length) && !e.title).map((e) => e.outerHTML)",
    );
    assert_eq!(nameless, json!([]), "every control has a name");
    browser.show(DESK);
}

fn without_webgl(browser: &mut Browser, page: &Path) {
    browser.open_after(
        "HTMLCanvasElement.prototype.getContext = ((own) => function (kind, ...rest) {
        return kind.startsWith('webgl') ? null : own.call(this, kind, ...rest); })(
        HTMLCanvasElement.prototype.getContext)",
        page,
        DESK,
    );
    assert!(text(browser, "#stage").contains("WebGL"), "it is said why nothing is seen");
    browser.run("dbd.play.advance(100)");
    assert_eq!(frame(browser)["steps"], 100);
    browser.wait("document.querySelector('#curves .u-over') !== null", "curves are drawn");
}

/// What is too large is told in words, and the page answers meanwhile.
fn large(browser: &mut Browser, folder: &Path) {
    let file = page(folder, "gripper", &["gripper"]);
    browser.open(&file, DESK);
    let refused =
        browser.run("dbd.play.open('#'.repeat(10000001)).then(() => dbd.play.state.error)");
    assert!(refused["message"].as_str().unwrap().contains("more than"), "{refused}");
    let body = "(i) => `[[body]]\\nname = \"b${i}\"\\nmass = 1.0\\ninertia = [1.0, 1.0, 1.0]\\nposition = [${i}.0, 0.0, 0.0]\\n`";
    let many = format!(
        "dbd.play.open('name = \"many\"\\nduration = 1.0\\nstep = \"1 ms\"\\n' + Array.from({{ length: 10000 }}, (_, i) => ({body})(i)).join(''))"
    );
    browser.run(&many);
    let count = "dbd.play.state.opened && dbd.play.state.opened.name === 'many'";
    browser.wait(count, "10,000 bodies are opened");
    browser.run("dbd.play.advance(20)");
    assert_eq!(frame(browser)["steps"], 20);
    // While the worker steps for long, the page hears a key.
    browser.run(
        "window.done = false; void dbd.play.advance(100000).then(() => { window.done = true; })",
    );
    let heard = "new Promise((heard) => { addEventListener('keydown', () => heard(!window.done), { once: true });
        dispatchEvent(new KeyboardEvent('keydown', { key: 'Shift' })); })";
    assert_eq!(browser.run(heard), true, "the page answers meanwhile");
    assert!(frame(browser)["steps"].as_f64().unwrap() < 1e5, "and so does the worker");
}

#[test]
#[ignore = "needs Chromium and the module: `cargo xtask test` runs it"]
fn bits_in_webassembly() {
    let folder = tempfile::tempdir().unwrap();
    let mut browser = Browser::start();
    let file = page(folder.path(), "playground", &["--all"]);
    browser.open(&file, DESK);
    let scenes = browser.run(SCENES);
    let scenes = scenes.as_array().unwrap();
    let mut compared = 0;
    for scene in scenes {
        let [name, file, text] = [0, 1, 2].map(|row| scene[row].as_str().unwrap());
        for precision in ["f64", "f32", "fixed"] {
            let settings = json!({ "precision": precision });
            let request = json!({ "do": "open", "file": file, "text": text, "settings": settings });
            let opened = ask(&mut browser, &request);
            if !opened["error"].is_null() {
                assert_eq!(precision, "fixed", "{name}: {}", opened["error"]);
                continue;
            }
            let step = opened["step"].as_f64().unwrap();
            browser.run(&format!("dbd.play.advance({STEPS})"));
            let there = frame(&mut browser)["hash"].clone();
            assert_eq!(there, run_here(folder.path(), name, precision, step), "{name} {precision}");
            compared += 1;
        }
    }
    println!("{compared} states equal those of run after {STEPS} steps");
    assert!(compared > 2 * scenes.len());
    quiet(&mut browser, "bits");
}

#[test]
#[ignore = "takes minutes: `cargo xtask bits wasm32` runs it"]
fn golden_hashes_in_webassembly() {
    let folder = tempfile::tempdir().unwrap();
    let mut browser = Browser::start();
    browser.open(&page(folder.path(), "playground", &["--all"]), DESK);
    let scenes = browser.run(SCENES);
    let rows = golden(&mut browser, scenes.as_array().unwrap());
    println!("{rows} golden hashes equal");
}

/// The hash that `run` ends with.
fn run_here(folder: &Path, scene: &str, precision: &str, step: f64) -> String {
    let duration = format!("{}s", step * STEPS as f64);
    let (step, out) = (format!("{step}s"), folder.join(precision));
    let method = ["--precision", precision, "--step", &step, "--duration", &duration];
    let quick = ["--every", &duration, "--no-report", "--quiet", "--out", out.to_str().unwrap()];
    call(&[&["run", scene][..], &method, &quick].concat());
    let summary = std::fs::read_to_string(out.join(scene).join("summary.json")).unwrap();
    let summary: Value = serde_json::from_str(&summary).unwrap();
    summary["state_hash"].as_str().unwrap().to_owned()
}

/// Compares the golden hashes of the shipped scenes; how many.
fn golden(browser: &mut Browser, scenes: &[Value]) -> usize {
    let mut compared = 0;
    for table in GOLDEN {
        let file = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("bits/{table}.csv"));
        for row in std::fs::read_to_string(file).unwrap().lines().skip(1) {
            let cells: Vec<&str> = row.split(',').collect();
            let [scene, scheme, precision, step, steps, hash] = cells[..] else { panic!("{row}") };
            let Some(found) = scenes.iter().find(|known| known[0] == scene) else { continue };
            let damping = ["joint-wise", "explicit"].into_iter().find(|way| scheme.ends_with(way));
            let damped = damping.and_then(|way| scheme.strip_suffix(way)?.strip_suffix('-'));
            let solved = scheme.split_once("-newton-");
            let name = solved.map_or(damped.unwrap_or(scheme), |(name, _)| name);
            let settings = json!({
                "scheme": name,
                "damping": damping,
                "newton": solved.map(|(_, count)| count.parse::<u32>().unwrap()),
                "precision": precision,
                "step": step.parse::<f64>().unwrap(),
            });
            let text = found[2].as_str().unwrap();
            let text = if table == PLANAR { format!("planar = true\n{text}") } else { text.into() };
            let request =
                json!({ "do": "open", "file": found[1], "text": text, "settings": settings });
            let opened = ask(browser, &request);
            assert!(opened["error"].is_null(), "{row}: {}", opened["error"]);
            browser.run(&format!("dbd.play.advance({steps})"));
            assert_eq!(frame(browser)["hash"], hash, "{row}");
            compared += 1;
        }
    }
    compared
}

/// Prints a row per scene: steps, \[µs\] per step of host-sim as released, which `cargo xtask playground --measure` names,
/// and in the browser.
#[test]
#[ignore = "`cargo xtask playground --measure` runs it"]
fn speed_beside_host_sim() {
    let Some(host_sim) = std::env::var_os("DBD_HOST_SIM") else { return };
    let folder = tempfile::tempdir().unwrap();
    let mut browser = Browser::start();
    for (scene, duration) in [("four-bar", 10.0), ("3ruu", 10.0)] {
        let file = page(folder.path(), scene, &[scene]);
        browser.open(&file, DESK);
        let step = browser.run("dbd.play.state.opened.step").as_f64().unwrap();
        let steps = (duration / step).round();
        let (mut native, mut there) = (f64::INFINITY, f64::INFINITY);
        for _ in 0..3 {
            let run = std::process::Command::new(&host_sim)
                .args(["run", scene, "--no-report", "--quiet", "--out"])
                .arg(folder.path())
                .args(["--duration", &format!("{duration}s"), "--every", &format!("{duration}s")])
                .status();
            assert!(run.unwrap().success());
            let summary = std::fs::read_to_string(folder.path().join(scene).join("summary.json"));
            let summary: Value = serde_json::from_str(&summary.unwrap()).unwrap();
            native = native.min(summary["wall_seconds"].as_f64().unwrap() / steps);
            let script = format!(
                "(async () => {{ await dbd.play.ask({{ do: 'reset' }}); const start = performance.now();
                await dbd.play.advance({steps}); return performance.now() - start; }})()"
            );
            there = there.min(1e-3 * browser.run(&script).as_f64().unwrap() / steps);
        }
        println!("measured,{scene},{steps},{:.4},{:.4}", 1e6 * native, 1e6 * there);
    }
}
