//! `run --gltf`: the animation as a file, read by another program's library. Khronos's validator reads it in
//! `tests/browser/animation.rs`.

use std::fs;
use std::path::Path;

use gltf::Gltf;
use gltf::animation::util::ReadOutputs;
use host_sim::terminal::Exit;

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

/// Where a mesh of a scene that is drawn by its geometry lies [m], by the name of the material.
fn bounds(document: &gltf::Document, material: &str) -> Vec<gltf::mesh::BoundingBox> {
    let primitives = document.meshes().flat_map(|mesh| mesh.primitives().collect::<Vec<_>>());
    let named = primitives.filter(|part| part.material().name() == Some(material));
    named.map(|part| part.bounding_box()).collect()
}

/// A block that is turned, a wheel, something on the ground: in their places, in their colours.
#[test]
fn geometry_is_drawn_in_place_of_bars() {
    let folder = Folder::new();
    let shapes = "
        [[geometry]]
        body = \"bob\"
        shape = \"box\"
        at = [0.0, 0.0, 0.5]
        size = [0.2, 0.4, 0.6]
        orientation = { axis = [0, 0, 1], angle = \"90 deg\" }
        colour = \"#ff0000\"

        [[geometry]]
        body = \"world\"
        shape = \"cylinder\"
        from = [0, 0, -1]
        to = [0, 0, 1]
        radius = 0.25
        colour = \"#0000ff\"
    ";
    let plain = folder.scene(PENDULUM);
    let without = Gltf::from_slice(&animated(&folder, &plain, &["--duration", "1ms"])).unwrap();
    assert_eq!(bounds(&without, "geometry").len(), 0);
    let scene = folder.scene(&format!("{PENDULUM}{shapes}"));
    let with = Gltf::from_slice(&animated(&folder, &scene, &["--duration", "1ms"])).unwrap();
    let found = bounds(&with, "geometry");
    let near = |found: [f32; 3], expected: [f32; 3]| {
        found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 0.01)
    };
    let has = |low, high| found.iter().any(|found| near(found.min, low) && near(found.max, high));
    assert!(has([-0.2, -0.1, 0.2], [0.2, 0.1, 0.8]), "{found:?}");
    assert!(has([-0.25, -0.25, -1.0], [0.25, 0.25, 1.0]), "{found:?}");
    assert_eq!((found.len(), bounds(&with, "body").len()), (2, 0));
}
