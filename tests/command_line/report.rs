//! `report.html`: the data that its scripts draw from are those of the run.

use std::fs;

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use host_sim::terminal::Exit;
use serde_json::Value;

use super::{Folder, PENDULUM};

/// The page of the last run of a scene, and its data.
fn page(folder: &Folder, scene: &str) -> (String, Value) {
    let page = fs::read_to_string(folder.path("out").join(scene).join("report.html")).unwrap();
    let data = page.split("id=\"report\">").nth(1).unwrap().split("</script>").next().unwrap();
    let data = serde_json::from_str(data).unwrap();
    (page, data)
}

fn words<const BYTES: usize>(packed: &Value) -> Vec<[u8; BYTES]> {
    let bytes = STANDARD.decode(packed.as_str().unwrap()).unwrap();
    let (words, rest) = bytes.as_chunks();
    assert!(rest.is_empty());
    words.to_vec()
}

fn doubles(packed: &Value) -> Vec<f64> {
    words(packed).into_iter().map(f64::from_le_bytes).collect()
}

fn singles(packed: &Value) -> Vec<f32> {
    words(packed).into_iter().map(f32::from_le_bytes).collect()
}

/// The charts of a section by title and quantity.
fn charts<'d>(data: &'d Value, section: &str) -> Vec<(&'d str, &'d str, &'d Vec<Value>)> {
    let charts = data["runs"][0]["charts"].as_array().unwrap().iter();
    let charts = charts.filter(|chart| chart["section"] == section);
    let text = |value: &'d Value| value.as_str().unwrap();
    charts
        .map(|chart| {
            let lines = chart["lines"].as_array().unwrap();
            (text(&chart["title"]), text(&chart["quantity"]), lines)
        })
        .collect()
}

#[test]
fn film_and_curves_are_the_trace() {
    let folder = Folder::new();
    let done = folder.run("crank-slider", &["--duration", "0.1s", "--every", "1ms"]);
    assert_eq!(done.exit, Exit::Done, "{}", done.err);
    let trace = folder.trace("crank-slider");
    let column = |name: &str| -> Vec<f64> {
        let at = trace.header.iter().position(|column| column == name).unwrap();
        trace.rows.iter().map(|row| row[at].parse().unwrap()).collect()
    };
    let (_, data) = page(&folder, "crank-slider");
    let run = &data["runs"][0];
    assert_eq!(doubles(&run["times"]), trace.times());
    let film = &run["film"];
    assert_eq!(doubles(&film["times"]), trace.times());
    let poses: Vec<i16> = words(&film["poses"]).into_iter().map(i16::from_le_bytes).collect();
    let bodies = run["mechanism"]["bodies"].as_array().unwrap();
    assert_eq!(poses.len(), trace.rows.len() * bodies.len() * 7);
    for (row, body) in bodies.iter().enumerate() {
        let name = body["name"].as_str().unwrap();
        for (axis, axis_name) in ["x", "y", "z"].iter().enumerate() {
            let [low, high] = ["low", "high"].map(|end| film[end][axis].as_f64().unwrap());
            for (frame, exact) in column(&format!("{name}.{axis_name}")).iter().enumerate() {
                let word = poses[(frame * bodies.len() + row) * 7 + axis];
                let found = low + (f64::from(word) + 32767.0) / 65534.0 * (high - low);
                assert!((found - exact).abs() <= 0.51 * (high - low) / 65534.0, "{name} {frame}");
            }
        }
    }
    // Positions are drawn from where they begin: how far a slider goes can be seen.
    let motion = charts(&data, "motion");
    let (_, _, lines) =
        motion.iter().find(|chart| (chart.0, chart.1) == ("slider", "position")).unwrap();
    let exact = column("slider.x");
    assert_eq!(lines[0]["initial"].as_f64(), Some(exact[0]));
    for (found, exact) in
        singles(&lines[0]["values"]).iter().zip(exact.iter().map(|x| x - exact[0]))
    {
        assert_eq!(*found, exact as f32);
    }
    assert_eq!(lines[0]["deviation"], true);
    let change = charts(&data, "energy")[1].2;
    let total = column("energy.total");
    let exact: Vec<f32> = total.iter().map(|energy| (energy - total[0]) as f32).collect();
    assert_eq!(singles(&change[0]["values"]), exact);
}

/// What an input was set to is drawn; a joint is named with its extension and force.
#[test]
fn inputs_and_joints_have_charts() {
    let folder = Folder::new();
    let done = folder.run("delta-pick-and-place", &["--duration", "0.05s"]);
    assert_eq!(done.exit, Exit::Done, "{}", done.err);
    let (page, data) = page(&folder, "delta-pick-and-place");
    let scene = dbd_tests::scene("delta-pick-and-place");
    let inputs: Vec<&str> = charts(&data, "inputs").iter().map(|chart| chart.0).collect();
    let names: Vec<&str> = scene.inputs.iter().map(|input| input.name.as_str()).collect();
    assert_eq!(inputs, names);
    assert_eq!(charts(&data, "joints").len(), 2 * scene.joints.len());
    // The summary says which joint, and when.
    let summary: Value = serde_json::from_str(
        &fs::read_to_string(folder.path("out/delta-pick-and-place/summary.json")).unwrap(),
    )
    .unwrap();
    let row = page.split("joint extension, largest</th><td>").nth(1).unwrap();
    let row = row.split("</td>").next().unwrap();
    assert!(
        scene.joints.iter().any(|joint| row.contains(&format!("`{}` at t = ", joint.name))),
        "{row}"
    );
    let largest = summary["max_joint_extension"].as_f64().unwrap();
    assert!(row.starts_with(&dbd_plant::digits::significant(largest, 4)), "{row}");
    for part in [summary["version"].as_str().unwrap(), "trace format</th><td>1<"] {
        assert!(page.contains(part), "{part}");
    }
    assert_eq!(summary["samples"], doubles(&data["runs"][0]["times"]).len());
}

/// A run that fails at its first step, one of a name that is markup.
#[test]
fn a_page_of_little_is_whole() {
    let folder = Folder::new();
    let text = PENDULUM.replace("stiffness = 2e3", "stiffness = 1e300");
    let scene = folder.scene(&text.replace("A bob on", "</script><b>A bob</b> on"));
    assert_eq!(folder.run(&scene, &["--step", "1ms"]).exit, Exit::Failed);
    let (page, data) = page(&folder, "scene");
    assert!(page.contains("Failed:") && page.contains("&lt;/script&gt;&lt;b&gt;A bob"));
    let run = &data["runs"][0];
    let frames = if run["film"].is_null() { 0 } else { doubles(&run["film"]["times"]).len() };
    assert!(frames <= 1 && doubles(&run["times"]).len() == frames, "{frames}");
}
