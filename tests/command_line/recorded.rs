//! `host-sim report`: recorded runs of one's own loop and of `run`, as pages.

use std::fs;

use dbd_golden::Recording;
use dbd_plant::{Method, plant};
use dbd_tests::{scene, scene_text};
use host_sim::terminal::Exit;
use serde_json::Value;

use crate::{Folder, call};

const SCENE: &str = "cart-pendulum";

/// The golden file of a loop: a proportional-integral controller of the cart's pendulum.
fn recorded(name: &str) -> String {
    let mut scene = scene(SCENE);
    name.clone_into(&mut scene.name);
    let mut plant = plant(&scene, &Method::default(), scene.step.unwrap()).unwrap();
    let names = ["angle", "drive"];
    let mut run =
        Recording::of_controlled(&scene, plant.as_ref(), 20, &names, &["integral"]).unwrap();
    let (drive, mut integral) = (scene.input("drive").unwrap(), 0.0);
    let angle = scene.readout("angle").unwrap().to_owned();
    while plant.steps() <= 400 {
        run.look_with(plant.as_ref(), &[integral]).unwrap();
        let reading = plant.read(&angle).unwrap().scalar().unwrap();
        integral += 1e-3 * reading;
        plant.set(drive, -8.0 * reading - integral, 0.0).unwrap();
        plant.advance(2).unwrap();
    }
    run.text()
}

fn data(page: &str) -> Value {
    let data = page.split("id=\"report\">").nth(1).unwrap().split("</script>").next().unwrap();
    serde_json::from_str(data).unwrap()
}

fn chart<'d>(data: &'d Value, section: &str, title: &str) -> &'d Value {
    let charts = data["runs"][0]["charts"].as_array().unwrap();
    let named = |chart: &&Value| chart["section"] == section && chart["title"] == title;
    charts.iter().find(named).unwrap_or_else(|| panic!("no chart {title} in {section}"))
}

#[test]
fn a_loop_of_ones_own_is_shown() {
    let folder = Folder::new();
    let file = folder.path("pendulum.golden");
    // As a console prints it, with other lines around.
    fs::write(&file, format!("boot\n{}bye\n", recorded(SCENE))).unwrap();
    let file = file.to_str().unwrap();
    for options in [&["--scene", SCENE][..], &[]] {
        let done = call(&[&["report", file], options].concat());
        assert_eq!((done.exit, done.err.as_str()), (Exit::Done, ""));
        let page = fs::read_to_string(folder.path("pendulum.html")).unwrap();
        let data = data(&page);
        assert!(data["runs"][0]["film"].is_object(), "it is animated");
        for (section, title) in
            [("readouts", "angle"), ("inputs", "drive"), ("readouts", "integral")]
        {
            let line = &chart(&data, section, title)["lines"][0];
            let [low, high] = ["low", "high"].map(|end| line[end].as_f64().unwrap());
            assert!(high > low, "{title} moves: {line}");
        }
        assert!(page.contains("host-sim report"), "the page names its command");
    }
}

#[test]
fn a_run_of_the_command_line_is_shown_again() {
    let folder = Folder::new();
    let done = folder.run(SCENE, &["--duration", "0.2s"]);
    assert_eq!(done.exit, Exit::Done, "{}", done.err);
    let of_run = fs::read_to_string(folder.path("out/cart-pendulum/report.html")).unwrap();
    let out = folder.path("out/cart-pendulum");
    let done = call(&["report", out.to_str().unwrap()]);
    assert_eq!((done.exit, done.err.as_str()), (Exit::Done, ""));
    let again = fs::read_to_string(out.join("trace.html")).unwrap();
    let [of_run, again] = [data(&of_run), data(&again)];
    assert_eq!(of_run["runs"][0]["film"]["poses"], again["runs"][0]["film"]["poses"]);
    let angles = [&of_run, &again].map(|data| chart(data, "readouts", "angle")["lines"].clone());
    assert_eq!(angles[0], angles[1]);
}

#[test]
fn a_scene_with_other_numbers_is_noted() {
    let folder = Folder::new();
    let file = folder.path("pendulum.golden");
    fs::write(&file, recorded(SCENE)).unwrap();
    let other = folder.scene(&scene_text(SCENE).replace("-9.81", "-1.62"));
    let done = call(&["report", file.to_str().unwrap(), "--scene", &other]);
    assert_eq!(done.exit, Exit::Done, "{}", done.err);
    assert!(done.err.contains("has other numbers than the recorded model"), "{}", done.err);
}

#[test]
fn what_cannot_be_shown_is_refused() {
    let folder = Folder::new();
    let file = folder.path("pendulum.golden");
    fs::write(&file, recorded(SCENE)).unwrap();
    let file = file.to_str().unwrap();
    let done = call(&["report", file, "--scene", "four-bar"]);
    assert_eq!(done.exit, Exit::Refused);
    assert!(done.err.contains("other bodies") && done.err.contains("--scene"), "{}", done.err);
    let taken = folder.path("notes.html");
    fs::write(&taken, "my notes").unwrap();
    let done = call(&["report", file, "--out", taken.to_str().unwrap()]);
    assert_eq!(done.exit, Exit::Refused);
    assert!(done.err.contains("not an HTML page"), "{}", done.err);
    assert_eq!(fs::read_to_string(&taken).unwrap(), "my notes");
    let done = call(&["report", "no-such-run"]);
    assert_eq!(done.exit, Exit::Refused);
    // Without its scene there are curves, and a note says so.
    fs::write(file, recorded("unknown")).unwrap();
    let done = call(&["report", file]);
    assert_eq!(done.exit, Exit::Done, "{}", done.err);
    assert!(done.err.contains("no animation") && done.err.contains("--scene"), "{}", done.err);
    let page = fs::read_to_string(folder.path("pendulum.html")).unwrap();
    assert!(data(&page)["runs"][0]["film"].is_null());
}

#[test]
fn a_run_is_a_log_for_robots_tools() {
    let folder = Folder::new();
    let (golden, file) = (folder.path("pendulum.golden"), folder.path("pendulum.mcap"));
    fs::write(&golden, recorded(SCENE)).unwrap();
    let [golden, file] = [golden.to_str().unwrap(), file.to_str().unwrap()];
    let done = call(&["report", golden, "--scene", SCENE, "--out", file]);
    assert_eq!((done.exit, done.err.as_str()), (Exit::Done, ""));
    let bytes = fs::read(file).unwrap();
    let summary = mcap::Summary::read(&bytes).unwrap().unwrap();
    let topics: Vec<_> = summary.channels.values().map(|channel| channel.topic.as_str()).collect();
    for topic in ["/tf", "/scene", "/energy", "/sensors", "/inputs", "/bodies", "/controller"] {
        assert!(topics.contains(&topic), "{topic} in {topics:?}");
    }
    let mut seen = std::collections::BTreeMap::new();
    for message in mcap::MessageStream::new(&bytes).unwrap() {
        let message = message.unwrap();
        let (topic, schema) = (&message.channel.topic, message.channel.schema.as_ref().unwrap());
        assert_eq!((&*message.channel.message_encoding, &*schema.encoding), ("json", "jsonschema"));
        let value: Value = serde_json::from_slice(&message.data).unwrap();
        let schema: Value = serde_json::from_slice(&schema.data).unwrap();
        if !value.to_string().contains("null") {
            jsonschema::validate(&schema, &value)
                .unwrap_or_else(|error| panic!("{topic}: {error}"));
        }
        seen.entry(topic.clone()).or_insert_with(Vec::new).push((message.log_time, value));
    }
    let times: Vec<_> = seen["/sensors"].iter().map(|(time, _)| *time).collect();
    assert_eq!((seen["/scene"].len(), seen["/tf"].len()), (1, times.len()));
    assert_eq!(times[..2], [0, 10_000_000], "a sample every 20 steps of 0.5 ms");
    // The values are those of the golden file.
    let page = fs::read_to_string(golden).unwrap();
    let last = &seen["/inputs"].last().unwrap().1["drive"];
    let angle = &seen["/sensors"].last().unwrap().1["angle"];
    for value in [last, angle] {
        let text = format!("{:?}", value.as_f64().unwrap());
        assert!(page.lines().last().unwrap().contains(&text) || page.contains(&text), "{text}");
    }
    let transforms = seen["/tf"][0].1["transforms"].as_array().unwrap();
    let children: Vec<_> = transforms.iter().map(|one| &one["child_frame_id"]).collect();
    assert_eq!(children, ["world", "cart", "pendulum"]);
    // Gravity is along -y of the world, which is turned so that z of the root is up.
    let turn = &transforms[0]["rotation"];
    let half = 0.5_f64.sqrt();
    let close = |name: &str, value: f64| (turn[name].as_f64().unwrap() - value).abs() < 1e-12;
    assert!(close("x", half) && close("y", 0.0) && close("z", 0.0) && close("w", half), "{turn}");
    let entities = seen["/scene"][0].1["entities"].as_array().unwrap();
    assert_eq!(entities.len(), 3);
    for entity in entities {
        for part in entity["triangles"].as_array().unwrap() {
            let points = part["points"].as_array().unwrap().len() as u64;
            let indices = part["indices"].as_array().unwrap();
            assert!(
                !indices.is_empty() && indices.iter().all(|row| row.as_u64().unwrap() < points)
            );
        }
    }

    // An earlier one is replaced, other files are kept.
    assert_eq!(call(&["report", golden, "--scene", SCENE, "--out", file]).exit, Exit::Done);
    fs::write(file, "mine").unwrap();
    let done = call(&["report", golden, "--scene", SCENE, "--out", file]);
    assert_eq!(done.exit, Exit::Refused);
    assert!(done.err.contains("is not an MCAP file"), "{}", done.err);
    let unknown = folder.path("other.golden");
    fs::write(&unknown, recorded("another")).unwrap();
    let done = call(&["report", unknown.to_str().unwrap(), "--out", file]);
    assert_eq!(done.exit, Exit::Refused);
    assert!(done.err.contains("no MCAP file:"), "{}", done.err);
}
