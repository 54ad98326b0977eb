//! Reports as a browser shows them: the mechanism is seen and moves, the controls work, nothing is
//! logged or fetched, in light and dark, on a desktop and on a telephone.
//!
//! Needs Chromium, so a plain `cargo test` leaves it out and says so; `cargo xtask test` runs it.

mod animation;
mod chromium;
mod extras;
mod play;

use std::path::{Path, PathBuf};

use chromium::{Browser, Screen};
use host_sim::cli::main_with;
use host_sim::terminal::{Console, Exit};
use serde_json::Value;

/// Scenes, and how long they run [s].
const SCENES: [(&str, &str); 5] = [
    ("four-bar", "0.2"),
    ("3ruu", "0.2"),
    ("double-wishbone", "0.8"),
    ("crank-slider", "1"),
    ("delta-pick-and-place", "0.8"),
];
/// [bytes] the size of a page with everything in it.
const LARGEST: u64 = 1_500_000;

const DESK: Screen = Screen { width: 1280, height: 800, dark: false, calm: true };
/// What the README shows of a report; `DBD_BLESS=1` writes it anew.
const SHOWN: (&str, f64, &str) = ("double-wishbone", 0.7, "docs/pictures/report.png");
const PHONE: Screen = Screen { width: 390, height: 844, dark: false, calm: true };

/// What stands on the canvas: a hash of it, and the share of pixels that are not its background.
const CANVAS: &str = "(() => {
  const from = document.querySelector('#stage canvas');
  const to = Object.assign(document.createElement('canvas'), { width: 200, height: 150 });
  const context = to.getContext('2d');
  context.drawImage(from, 0, 0, 200, 150);
  const { data } = context.getImageData(0, 0, 200, 150);
  let [hash, seen, red, green, blue] = [0, 0, 0, 0, 0];
  for (let i = 0; i < data.length; i += 4) {
    hash = (hash * 31 + data[i] + 7 * data[i + 1] + 13 * data[i + 2]) % 4294967296;
    if (data[i + 3] > 128) { seen += 1; red += data[i]; green += data[i + 1]; blue += data[i + 2]; }
  }
  return { hash, share: seen / 30000, colour: [red / seen, green / seen, blue / seen] };
})()";
/// Two frames later everything that was asked for is drawn.
const DRAWN: &str =
    "new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => done(true))))";
/// Visible controls that overlap another or lie outside of the window, by their names.
const OVERLAPS: &str = "(() => {
  const all = [...document.querySelectorAll('button, select, summary, input, .legend, .axes, h1, h2, .legend-row')]
    .filter((e) => e.checkVisibility({ visibilityProperty: true, contentVisibilityAuto: true }) && e.getClientRects().length)
    .map((e) => [e, e.getBoundingClientRect()]);
  const name = (e) => e.getAttribute('aria-label') || e.textContent.trim() || e.className;
  const found = [];
  all.forEach(([a, p], i) => {
    if (p.left < -0.5 || p.right > innerWidth + 0.5) found.push(name(a) + ' leaves the window');
    all.slice(i + 1).forEach(([b, q]) => {
      const across = Math.min(p.right, q.right) - Math.max(p.left, q.left);
      const down = Math.min(p.bottom, q.bottom) - Math.max(p.top, q.top);
      if (across > 1 && down > 1 && !a.contains(b) && !b.contains(a)) found.push(name(a) + ' / ' + name(b));
    });
  });
  return found;
})()";

#[test]
#[ignore = "needs Chromium: `cargo xtask test` runs it"]
fn reports_live() {
    let folder = tempfile::tempdir().unwrap();
    let mut browser = Browser::start();
    for (scene, duration) in SCENES {
        println!("{scene}");
        let page = report(folder.path(), scene, duration);
        let size = page.metadata().unwrap().len();
        assert!(size < LARGEST, "{scene}: {size} bytes");
        browser.open(&page, DESK);
        it_moves(&mut browser);
        if scene == SHOWN.0 && dbd_tests::page::is_blessed() {
            at(&mut browser, SHOWN.1);
            let place = Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(SHOWN.2);
            std::fs::write(place, browser.picture()).unwrap();
        }
        in_the_dark(&mut browser);
        on_a_telephone(&mut browser);
        quiet(&mut browser, scene);
    }
    let file = |(scene, _): (&str, _)| folder.path().join(scene).join(format!("{scene}.glb"));
    let files = SCENES.map(file);
    animation::animations(&mut browser, &files.each_ref().map(|file| file.as_path()));
    let page = folder.path().join("four-bar/report.html");
    browser.open(&page, DESK);
    buttons(&mut browser);
    keys(&mut browser);
    charts(&mut browser);
    browser.open(&page, Screen { calm: false, ..DESK });
    assert_eq!(browser.run("dbd.clock.playing"), true, "it plays by itself");
    quiet(&mut browser, "four-bar, operated");
    without_webgl(&mut browser, &page);
    quiet(&mut browser, "four-bar without WebGL");
    extras::modes(&mut browser, &page);
    extras::comparison(&mut browser, &page);
    quiet(&mut browser, "four-bar with modes and beside another");
}

/// Runs a scene and returns its page.
fn report(folder: &Path, scene: &str, duration: &str) -> PathBuf {
    let (mut out, mut err) = (Vec::new(), Vec::new());
    let mut console = Console::plain(&mut out, &mut err);
    let to = folder.to_str().unwrap();
    let arguments = ["host-sim", "run", scene, "--duration", duration, "--out", to, "--gltf"];
    let exit = main_with(arguments, &mut console);
    assert_eq!(exit, Exit::Done, "{}", String::from_utf8_lossy(&err));
    folder.join(scene).join("report.html")
}

/// Sets the time to a share of the run and returns what is seen then.
fn at(browser: &mut Browser, share: f64) -> Value {
    browser.run(&format!(
        "dbd.clock.set(dbd.clock.start + {share} * (dbd.clock.end - dbd.clock.start))"
    ));
    browser.run(DRAWN);
    browser.run(CANVAS)
}

fn it_moves(browser: &mut Browser) {
    let [first, later, again] = [0.0, 0.4, 0.0].map(|share| at(browser, share));
    let share = first["share"].as_f64().unwrap();
    assert!((0.004..0.7).contains(&share), "the mechanism fills {share} of the canvas");
    assert_ne!(first["hash"], later["hash"], "the mechanism moves");
    assert_eq!(first["hash"], again["hash"], "the same time looks the same");
}

fn in_the_dark(browser: &mut Browser) {
    let colours = "[document.body, document.querySelector('h1'), document.querySelector('.view')]
        .map((e) => { const s = getComputedStyle(e); return s.color + s.backgroundColor + s.backgroundImage; })";
    let light = (browser.run(colours), at(browser, 0.4));
    browser.show(Screen { dark: true, ..DESK });
    let dark = (browser.run(colours), at(browser, 0.4));
    for i in 0..3 {
        assert_ne!(light.0[i], dark.0[i], "page and stage turn dark");
    }
    assert_ne!(light.1["colour"], dark.1["colour"], "so does the mechanism");
    browser.run("document.querySelector('.theme-toggle').click()");
    assert_eq!(browser.run(colours), light.0, "the button overrules the screen");
    browser.run("localStorage.clear(); delete document.documentElement.dataset.theme");
    browser.show(DESK);
}

fn on_a_telephone(browser: &mut Browser) {
    browser.show(PHONE);
    for top in [0, 1200] {
        browser.run(&format!("scrollTo(0, {top})"));
        browser.run(DRAWN);
        browser.run(DRAWN);
        let wide = browser.run("document.documentElement.scrollWidth").as_f64().unwrap();
        assert!(wide <= f64::from(PHONE.width), "{wide} pixels are scrolled sideways");
        if top == 0 {
            assert_eq!(browser.run(OVERLAPS), serde_json::json!([]), "nothing overlaps");
        }
    }
    let small = "(() => { const box = document.querySelector('.view').getBoundingClientRect();
        return document.documentElement.classList.contains('mini') && box.top === 0 && box.height < 300; })()";
    browser.wait(small, "a small picture stays in sight");
    browser.run("scrollTo(0, 0)");
    browser.show(DESK);
}

fn buttons(browser: &mut Browser) {
    at(browser, 0.2);
    let time = |browser: &mut Browser| browser.run("dbd.clock.time").as_f64().unwrap();
    let click = |browser: &mut Browser, name: &str| {
        browser.run(&format!("document.querySelector('#stage [aria-label^=\"{name}\"]').click()"));
    };
    let before = time(browser);
    click(browser, "Play");
    browser.wait(&format!("dbd.clock.time > {before}"), "play moves the time");
    click(browser, "Pause");
    let held = time(browser);
    browser.run(DRAWN);
    assert_eq!(time(browser), held, "pause holds it");
    click(browser, "One frame on");
    let next = time(browser);
    assert!(next > held, "a frame on");
    click(browser, "One frame back");
    assert!(time(browser) < next, "and back");
    let scrub = "(() => { const scrub = document.querySelector('.scrub'); scrub.value = 0.75 * scrub.max;
        scrub.dispatchEvent(new Event('input')); return Math.abs(dbd.clock.time - 0.75 * dbd.clock.end); })()";
    assert!(browser.run(scrub).as_f64().unwrap() < 1e-9, "the slider sets the time");
    let hash = |browser: &mut Browser| {
        browser.run(DRAWN);
        browser.run(CANVAS)["hash"].clone()
    };
    let started = hash(browser);
    for view in ["Top", "Side", "Iso"] {
        let before = hash(browser);
        click(browser, view);
        assert_ne!(hash(browser), before, "{view} looks from elsewhere");
    }
    click(browser, "Show everything");
    assert_eq!(hash(browser), started, "reset looks from where it began");
    let names =
        "[...document.querySelectorAll('.labels span:not([hidden])')].map((e) => e.textContent)";
    browser.run("document.querySelector('.options input').click()");
    browser.run(DRAWN);
    assert!(browser.run(names).as_array().unwrap().contains(&"coupler".into()), "names are shown");
    browser.run("document.querySelector('.options input').click()");
}

fn keys(browser: &mut Browser) {
    browser.run("document.querySelector('.view').focus()");
    let time =
        |browser: &mut Browser| browser.run("dbd.clock.time / dbd.clock.end").as_f64().unwrap();
    browser.press("End");
    assert_eq!(time(browser), 1.0, "End");
    browser.press("Home");
    assert_eq!(time(browser), 0.0, "Home");
    browser.press("ArrowRight");
    let frame = time(browser);
    assert!(frame > 0.0 && frame < 0.1, "right arrow: {frame}");
    browser.press("ArrowLeft");
    assert_eq!(time(browser), 0.0, "left arrow");
    browser.press(" ");
    assert_eq!(browser.run("dbd.clock.playing"), true, "space plays");
    browser.press(" ");
    assert_eq!(browser.run("dbd.clock.playing"), false, "space pauses");
    let speed = browser.run("dbd.clock.speed").as_f64().unwrap();
    browser.press("+");
    assert!(browser.run("dbd.clock.speed").as_f64().unwrap() > speed, "plus is faster");
    browser.press("-");
    assert_eq!(browser.run("dbd.clock.speed"), speed, "minus is slower");
    let from = browser.run("dbd.page.stage.camera.camera.position.toArray()");
    browser.press("3");
    assert_ne!(
        browser.run("dbd.page.stage.camera.camera.position.toArray()"),
        from,
        "3 looks from the top"
    );
    browser.press("0");
    assert_eq!(
        browser.run("dbd.page.stage.camera.camera.position.toArray()"),
        from,
        "0 looks as at first"
    );
    browser.press("?");
    assert_eq!(browser.run("document.querySelector('dialog.keys').open"), true, "? lists the keys");
    browser.run("document.querySelector('dialog.keys').close()");
}

/// Pointing at a chart moves the mechanism, and its value is shown; dragging shows a part in all charts.
fn charts(browser: &mut Browser) {
    at(browser, 0.0);
    browser.run("document.querySelector('#energy').scrollIntoView()");
    browser.wait(
        "document.querySelector('#energy .u-over') !== null",
        "a chart is made when it is seen",
    );
    let still = browser.run(CANVAS)["hash"].clone();
    let place = browser.run(
        "(() => { const b = document.querySelector('#energy .u-over').getBoundingClientRect();
        return [b.left, b.top + b.height / 2, b.width]; })()",
    );
    let [left, middle, width] = [0, 1, 2].map(|i| place[i].as_f64().unwrap());
    let said = "document.querySelector('#energy .legend-row').textContent";
    let before = browser.run(said);
    for share in [0.3, 0.5] {
        browser.mouse("mouseMoved", left + share * width, middle, false);
    }
    browser.run(DRAWN);
    let time = browser.run("dbd.clock.time / dbd.clock.end").as_f64().unwrap();
    assert!((time - 0.5).abs() < 0.01, "the chart sets the time: {time}");
    assert_ne!(browser.run(CANVAS)["hash"], still, "the mechanism stands at that time");
    assert_ne!(browser.run(said), before, "the values of that time are shown");
    // What has left the chart leaves the time.
    browser.mouse("mouseMoved", 3.0, 3.0, false);
    let cursors =
        "[...dbd.chart.charts].map((c) => c.uplot.cursor.left / c.uplot.over.clientWidth)";
    let cursors = browser.run(cursors);
    let cursors = cursors.as_array().unwrap();
    assert!(
        cursors.len() > 1 && cursors.iter().all(|at| (at.as_f64().unwrap() - 0.5).abs() < 0.02),
        "{cursors:?}"
    );
    browser.mouse("mousePressed", left + 0.25 * width, middle, true);
    browser.mouse("mouseMoved", left + 0.5 * width, middle, true);
    browser.mouse("mouseMoved", left + 0.75 * width, middle, true);
    browser.mouse("mouseReleased", left + 0.75 * width, middle, true);
    let shown = "[...dbd.chart.charts].map((c) => (c.uplot.scales.x.max - c.uplot.scales.x.min) / dbd.clock.end)";
    let part = browser.run(shown);
    let part = part.as_array().unwrap();
    assert!(
        part.iter().all(|share| (share.as_f64().unwrap() - 0.5).abs() < 0.02),
        "dragging shows a part: {part:?}"
    );
    browser.run("document.querySelector('#energy .u-over').dispatchEvent(new MouseEvent('dblclick', { bubbles: true }))");
    let whole = browser.run(shown);
    assert!(
        whole.as_array().unwrap().iter().all(|share| share.as_f64().unwrap() > 0.99),
        "all again: {whole}"
    );
}

/// The still picture is shown and said to be one; the charts are drawn all the same.
fn without_webgl(browser: &mut Browser, page: &Path) {
    browser.open_after(
        "HTMLCanvasElement.prototype.getContext = ((own) => function (kind, ...rest) {
        return kind.startsWith('webgl') ? null : own.call(this, kind, ...rest); })(
        HTMLCanvasElement.prototype.getContext)",
        page,
        DESK,
    );
    let picture =
        "document.querySelector('#stage .still svg').getBoundingClientRect().height > 100";
    assert_eq!(browser.run(picture), true, "the still picture is shown");
    let said = browser.run("document.querySelector('#stage').textContent.includes('no WebGL')");
    assert_eq!(said, true, "it is said that it stands still");
    browser.run("document.querySelector('#energy').scrollIntoView()");
    browser.wait(
        "document.querySelector('#energy .u-over') !== null",
        "charts are drawn without WebGL",
    );
}

fn quiet(browser: &mut Browser, scene: &str) {
    browser.run(DRAWN);
    assert!(browser.complaints.is_empty(), "{scene}: {:#?}", browser.complaints);
}
