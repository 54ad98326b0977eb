//! `run --gltf`: the animation as a file, read by another program's library and by Khronos's validator.

use std::fs;
use std::path::Path;
use std::process::Command;

use gltf::Gltf;
use gltf::animation::util::ReadOutputs;
use host_sim::terminal::Exit;
use serde_json::Value;

use super::{Folder, PENDULUM, Trace};

/// Scenes of every kind of part: bars and plates, springs, universal joints, guides, a wheel.
const SCENES: [&str; 5] = ["four-bar", "double-wishbone", "3ruu", "crank-slider", "hanging-chain"];

/// A run of a scene as glTF, and the file.
fn animated(folder: &Folder, scene: &str, options: &[&str]) -> Vec<u8> {
    let done = folder.run(scene, &[&["--gltf", "--no-report"], options].concat());
    assert_eq!(done.exit, Exit::Done, "{}", done.err);
    let stem = Path::new(scene).file_stem().unwrap().to_str().unwrap();
    assert!(done.out.contains(&format!(",{stem}.glb}}")), "{}", done.out);
    fs::read(folder.path("out").join(stem).join(format!("{stem}.glb"))).unwrap()
}

/// Position and quaternion, scalar first, of each body in a row of a trace.
fn poses(trace: &Trace, row: usize, bodies: usize) -> Vec<[f32; 7]> {
    let row = &trace.rows[row];
    let body = |body: usize| {
        let at = 1 + 13 * body;
        std::array::from_fn(|column| row[at + column].parse::<f64>().unwrap() as f32)
    };
    (0..bodies).map(body).collect()
}

/// Equal as far as words of single precision can be; a quaternion and its opposite are one turn.
fn same(found: &[f32; 7], expected: &[f32; 7]) -> bool {
    let near = |a: f32, b: f32| (a - b).abs() <= 1e-6 * b.abs().max(1.0);
    let turned = |way: f32| (3..7).all(|i| near(found[i], way * expected[i]));
    (0..3).all(|i| near(found[i], expected[i])) && (turned(1.0) || turned(-1.0))
}

#[test]
fn the_animation_begins_and_ends_as_the_trace() {
    for scene in SCENES {
        let folder = Folder::new();
        let bytes = animated(&folder, scene, &["--duration", "0.1s"]);
        let Gltf { document, blob } = Gltf::from_slice(&bytes).unwrap();
        let blob = blob.unwrap();
        let trace = folder.trace(scene);
        let names: Vec<&str> =
            trace.header.iter().filter_map(|column| column.strip_suffix(".qw")).collect();
        let [first, last] = [0, trace.rows.len() - 1].map(|row| poses(&trace, row, names.len()));
        let mut channels: Vec<_> = document.animations().next().unwrap().channels().collect();
        channels.retain(|channel| names.contains(&channel.target().node().name().unwrap()));
        assert_eq!(channels.len(), 2 * names.len(), "{scene}");
        for (row, name) in names.iter().enumerate() {
            let node = document.nodes().find(|node| node.name() == Some(name)).unwrap();
            let mut ends = [[0.0_f32; 7]; 2];
            for channel in
                channels.iter().filter(|channel| channel.target().node().name() == Some(name))
            {
                let reader = channel.reader(|_| Some(&blob));
                let times: Vec<f32> = reader.read_inputs().unwrap().collect();
                assert_eq!((times[0], times[times.len() - 1]), (0.0, 0.1), "{scene}");
                match reader.read_outputs().unwrap() {
                    ReadOutputs::Translations(all) => {
                        let all: Vec<_> = all.collect();
                        for (end, at) in ends.iter_mut().zip([all[0], all[all.len() - 1]]) {
                            end[..3].copy_from_slice(&at);
                        }
                    }
                    ReadOutputs::Rotations(all) => {
                        let all: Vec<[f32; 4]> = all.into_f32().collect();
                        for (end, [x, y, z, w]) in ends.iter_mut().zip([all[0], all[all.len() - 1]])
                        {
                            end[3..].copy_from_slice(&[w, x, y, z]);
                        }
                    }
                    _ => panic!("{scene} {name}"),
                }
            }
            assert!(same(&ends[0], &first[row]), "{scene} {name} {:?} {:?}", ends[0], first[row]);
            assert!(same(&ends[1], &last[row]), "{scene} {name} {:?} {:?}", ends[1], last[row]);
            // A program that plays nothing shows the beginning.
            let (at, [x, y, z, w], _) = node.transform().decomposed();
            assert!(same(&[at[0], at[1], at[2], w, x, y, z], &first[row]), "{scene} {name}");
        }
        let moved = |row: usize| !same(&first[row], &last[row]);
        assert!((0..names.len()).any(moved), "{scene}");
        // z is up in these scenes where gravity is along it; y in the file.
        let top = document.scenes().next().unwrap().nodes().next().unwrap();
        assert_eq!(top.children().count(), document.nodes().count() - 1, "{scene}");
        assert!(document.meshes().count() > 1, "{scene}");
    }
}

#[test]
fn the_animation_goes_with_its_run() {
    let folder = Folder::new();
    let scene = folder.scene(&PENDULUM.replace("\"bob\"", "\"böb \\\"</script>\""));
    let bytes = animated(&folder, &scene, &["--duration", "1ms", "--every", "1ms"]);
    let document = Gltf::from_slice(&bytes).unwrap().document;
    assert!(document.nodes().any(|node| node.name() == Some("böb \"</script>")));
    folder.run(&scene, &[]);
    assert!(!folder.path("out/scene/scene.glb").exists());
    // Of a run that fails at once there is one picture, and nothing moves.
    let torn = PENDULUM.replace("stiffness = 2e3", "stiffness = 1e300");
    folder.run(&folder.scene(&torn), &["--gltf", "--step", "1ms"]);
    let bytes = fs::read(folder.path("out/scene/scene.glb")).unwrap();
    let document = Gltf::from_slice(&bytes).unwrap().document;
    assert_eq!((document.animations().count(), document.meshes().count() > 0), (0, true));
}

/// Names of the program, the first that there is.
const BROWSERS: [&str; 4] = ["chromium", "chromium-browser", "google-chrome", "chrome"];

/// What the validator says of files: one report each.
fn validated(files: &[Vec<u8>]) -> Vec<Value> {
    let folder = tempfile::tempdir().unwrap();
    let validator = concat!(env!("CARGO_MANIFEST_DIR"), "/gltf_validator/gltf_validator.dart.js");
    let validator = fs::read_to_string(validator).unwrap();
    let page = format!(
        "<!doctype html><meta charset=\"utf-8\"><body><script>var exports = {{}};</script>\n\
         <script>{validator}</script>\n<script>\n\
         const files = {};\n\
         Promise.all(files.map((bytes) => exports.validateBytes(Uint8Array.from(bytes))))\n\
         .then((reports) => {{ document.body.textContent = JSON.stringify(reports); }});\n\
         </script></body>",
        serde_json::to_string(files).unwrap(),
    );
    let file = folder.path().join("page.html");
    fs::write(&file, page).unwrap();
    let shown = BROWSERS.iter().find_map(|program| {
        let mut command = Command::new(program);
        command.args(["--headless", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage"]);
        command.args(["--virtual-time-budget=60000", "--dump-dom"]);
        command.arg(format!("--user-data-dir={}", folder.path().join("profile").display()));
        command.arg(format!("file://{}", file.display())).output().ok()
    });
    let shown = shown.expect("no Chromium is installed: apt-get install chromium");
    let text = String::from_utf8(shown.stdout).unwrap();
    let reports = text.split("<body>").nth(1).and_then(|body| body.split("</body>").next());
    let reports = reports.unwrap_or_default();
    let reports = reports.replace("&lt;", "<").replace("&gt;", ">").replace("&amp;", "&");
    serde_json::from_str(&reports).unwrap_or_else(|error| panic!("{error}: {reports:.300}"))
}

/// Khronos's validator: no errors, no warnings; of a file with a planted fault it says which.
#[test]
fn the_validator_has_nothing_to_say() {
    let folder = Folder::new();
    let mut files: Vec<_> =
        SCENES.iter().map(|scene| animated(&folder, scene, &["--duration", "20ms"])).collect();
    let scene = folder.scene(PENDULUM);
    files.push(animated(&folder, &scene, &["--duration", "1ms", "--every", "1ms"]));
    // The largest time that an accessor states is not the largest that it has.
    let mut planted = files[0].clone();
    let stated = b"\"max\":[0.02";
    let at = planted.windows(stated.len()).position(|word| word == stated).unwrap();
    planted[at + stated.len() - 1] = b'7';
    files.push(planted);
    let reports = validated(&files);
    let (planted, good) = reports.split_last().unwrap();
    for (report, row) in good.iter().zip(0..) {
        let issues = &report["issues"];
        let counts = (&issues["numErrors"], &issues["numWarnings"]);
        assert_eq!(counts, (&0.into(), &0.into()), "{row}: {issues:#}");
        assert_eq!(report["info"]["version"], "2.0");
    }
    let messages = planted["issues"]["messages"].as_array().unwrap();
    assert!(
        messages.iter().any(|message| message["code"] == "ACCESSOR_MAX_MISMATCH"),
        "{planted:#}"
    );
}
