//! What only some pages have: modes that swing, a second run.
//!
//! `page of a run => page with more data in it => what is seen`.

use std::path::{Path, PathBuf};

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use serde_json::{Value, json};

use super::chromium::Browser;
use super::{CANVAS, DESK, DRAWN};

/// A chosen mode swings on the stage; the run comes back.
pub fn modes(browser: &mut Browser, page: &Path) {
    let page = changed(page, "modes.html", |data| {
        let bodies = data["runs"][0]["mechanism"]["bodies"].as_array().unwrap().len();
        // All bodies shift along x and turn about their z.
        let shape: Vec<u8> = (0..bodies)
            .flat_map(|_| [1.0_f32, 0.0, 0.0, 0.0, 0.0, 0.5])
            .flat_map(f32::to_le_bytes)
            .collect();
        data["modes"] = json!([
            { "frequency": 2.5, "shape": STANDARD.encode(&shape) },
            { "frequency": -0.5, "shape": STANDARD.encode(&shape) },
        ]);
    });
    browser.open(&page, DESK);
    let listed = browser.run("document.querySelector('#modes').innerText");
    let listed = listed.as_str().unwrap();
    assert!(listed.contains("2.5\u{a0}Hz") && listed.contains("grows, 500\u{a0}mHz"), "{listed}");
    let at_rest = seen(browser);
    browser.run("document.querySelectorAll('#modes button')[0].click()");
    let hash = at_rest["hash"].as_f64().unwrap();
    browser.wait(&format!("{CANVAS}.hash !== {hash}"), "the mode swings");
    browser.run("document.querySelector('.banner').click()");
    assert_eq!(seen(browser)["hash"], at_rest["hash"], "back to the run");
}

/// Two runs stand on one stage and in one chart; the second can be hidden.
pub fn comparison(browser: &mut Browser, page: &Path) {
    let page = changed(page, "comparison.html", |data| {
        data["kind"] = json!("compare");
        let mut second = data["runs"][0].clone();
        data["runs"][0]["label"] = json!("A: slow");
        second["label"] = json!("B: fast");
        // The second goes on from where the first is half way.
        let film = &mut second["film"];
        let times = STANDARD.decode(film["times"].as_str().unwrap()).unwrap().len() / 8;
        let mut poses = STANDARD.decode(film["poses"].as_str().unwrap()).unwrap();
        let frame = poses.len() / times;
        poses.rotate_left(frame * (times / 2));
        film["poses"] = json!(STANDARD.encode(poses));
        let energy = |chart: &&Value| chart["section"] == "energy";
        let chart = data["runs"][0]["charts"].as_array().unwrap().iter().find(energy).cloned();
        data["differences"] = json!([chart]);
        data["differenceTimes"] = data["runs"][0]["times"].clone();
        data["firstDifference"] =
            json!({ "time": 0.001, "step": 5, "text": "crank.x is 1.0 m in A" });
        data["runs"].as_array_mut().unwrap().push(second);
    });
    browser.open(&page, DESK);
    let both = seen(browser);
    browser.run("[...document.querySelectorAll('.toggle')].find((e) => e.textContent === 'Second run').click()");
    assert_ne!(seen(browser)["hash"], both["hash"], "the second mechanism is hidden");
    let drawn = "document.querySelector('#differences .u-over') !== null";
    browser.wait(drawn, "differences are drawn");
    let said = browser.run("document.querySelector('#differences').innerText");
    assert!(
        said.as_str()
            .unwrap()
            .contains("They first differ at t = 0.001 s, step 5: crank.x is 1.0 m in A."),
        "{said}"
    );
    browser.run("document.querySelector('#energy').scrollIntoView()");
    browser.wait("document.querySelector('#energy .u-over') !== null", "both are drawn");
    let dashed = "document.querySelectorAll('#energy .chart:not([data-waiting]) .dashed').length";
    assert!(browser.run(dashed).as_u64().unwrap() > 0, "the second run's lines are dashed");
}

fn seen(browser: &mut Browser) -> Value {
    browser.run(DRAWN);
    browser.run(CANVAS)
}

/// A page beside another, with other data in it.
fn changed(page: &Path, name: &str, change: impl FnOnce(&mut Value)) -> PathBuf {
    const START: &str = "id=\"report\">";
    let text = std::fs::read_to_string(page).unwrap();
    let start = text.find(START).unwrap() + START.len();
    let end = start + text[start..].find("</script>").unwrap();
    let mut data = serde_json::from_str(&text[start..end]).unwrap();
    change(&mut data);
    let data = data.to_string().replace('<', "\\u003c");
    let path = page.with_file_name(name);
    std::fs::write(&path, format!("{}{data}{}", &text[..start], &text[end..])).unwrap();
    path
}
