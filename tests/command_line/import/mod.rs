//! MJCF becomes a scene: beside MuJoCo's own trajectory, and what is refused.
//!
//! `tests/import/*.xml => scenes`. `two-loops.csv` is what MuJoCo makes of `two-loops.xml`;
//! `tests/command_line/import/monitor.py` writes it, and compares other files.

mod actuators;
mod chains;
mod meshes;
mod parts;
mod refusals;
mod robots;
mod sums;
mod urdf;

use std::path::Path;

use dbd_import::{Imported, Kind, Options, import, import_text};
use dbd_kernel::readouts::Reading;
use dbd_plant::{Frequencies, Method, plant};
use dbd_scene::Scene;
use dbd_tests::page::{block, figure, table};
use dbd_tests::results::{path, rows};

/// A scene that was made of a file of this folder.
fn imported(file: &str, options: &Options) -> Imported {
    import(&path("tests/command_line/import").join(file), options)
        .unwrap_or_else(|error| panic!("{error}"))
}

/// One that was made of a text.
fn of(text: &str, options: &Options) -> Imported {
    import_text(text, "test.xml", Path::new(""), options).unwrap_or_else(|error| panic!("{error}"))
}

fn loaded(imported: &Imported) -> Scene {
    let text = &imported.scene;
    Scene::parse(text, "imported").unwrap_or_else(|error| panic!("{error}\n{text}"))
}

/// \[m\] the largest distance of each body's centre of mass from where a table has it, by the columns of
/// that. A body that gives mass to a carrier has a read-out of the centre that it had before.
fn distances(scene: &Scene, file: &str) -> Vec<(String, f64)> {
    let rows = rows(file);
    let interval = rows[1].number("time");
    let limit = Frequencies::of(scene).default_limit(&Method::default(), scene.duration);
    let steps = (interval / limit).ceil();
    let mut plant = plant(scene, &Method::default(), interval / steps).unwrap();
    let columns = rows[0].names();
    let names = columns.filter_map(|column| column.strip_suffix(".x"));
    let mut largest: Vec<(String, f64)> = names.map(|name| (name.to_owned(), 0.0)).collect();
    let body = |name: &str| scene.body_names.iter().position(|body| body == name).unwrap();
    for row in &rows {
        for (name, largest) in &mut largest {
            let centre = scene.readout(&format!("{name}-centre"));
            let place = match centre.map(|centre| plant.read(&centre)) {
                Ok(Some(Reading::Vector(place))) => place,
                Ok(other) => panic!("{other:?}"),
                Err(_) => plant.state().bodies[body(name)].position,
            };
            let there = ["x", "y", "z"].map(|axis| row.number(&format!("{name}.{axis}")));
            let gaps = [place.x - there[0], place.y - there[1], place.z - there[2]];
            let square: f64 = gaps.iter().map(|gap| gap * gap).sum();
            *largest = largest.max(square.sqrt());
        }
        plant.advance(steps as u64).unwrap();
    }
    largest
}

/// \[m\] the largest of them.
fn worst(distances: &[(String, f64)]) -> f64 {
    distances.iter().map(|(_, distance)| *distance).fold(0.0, f64::max)
}

/// Joints of a stiffness k are off by something that falls as 1/k; below 1 mm at 1e7 N/m.
#[test]
fn two_loops_come_to_mujocos_motion_as_joints_get_stiffer() {
    let mut rows = Vec::new();
    let mut last = f64::INFINITY;
    let mut names = Vec::new();
    for stiffness in [1e5, 1e6, 1e7, 1e8] {
        let ignored = vec![Kind::Limit];
        let options = Options { stiffness, duration: 0.5, ignored, ..Options::default() };
        let scene = loaded(&imported("two-loops.xml", &options));
        let distances = distances(&scene, "tests/command_line/import/two-loops.csv");
        let worst = worst(&distances);
        // A tenth for ten times the stiffness, with a margin.
        assert!(worst < last / 5.0, "{stiffness}: {worst:e} after {last:e} m");
        assert!(stiffness != 1e7 || worst < 1e-3, "{worst:e} m");
        last = worst;
        names = distances.iter().map(|(name, _)| name.clone()).collect();
        let mut row = vec![format!("{stiffness:e}")];
        row.extend(distances.iter().map(|(_, distance)| figure(distance * 1e3, 2)));
        rows.push(row);
    }
    let head: Vec<&str> =
        std::iter::once("k [N/m]").chain(names.iter().map(String::as_str)).collect();
    block("docs/import.md", "distance", &table(&head, &rows));
}

/// The scene begins where MuJoCo has the bodies: frames, classes, included files, sequences of angles,
/// inertia of geoms, welded bodies.
#[test]
fn the_scene_begins_where_mujoco_does() {
    let options = Options { ignored: vec![Kind::Limit], ..Options::default() };
    let scene = loaded(&imported("two-loops.xml", &options));
    let first = &rows("tests/command_line/import/two-loops.csv")[0];
    for (name, state) in scene.body_names.iter().zip(&scene.model.initial) {
        let place = [state.position.x, state.position.y, state.position.z];
        for (axis, value) in ["x", "y", "z"].iter().zip(place) {
            let there = first.number(&format!("{name}.{axis}"));
            assert!((value - there).abs() < 1e-8, "{name}.{axis}: {value} {there}");
        }
    }
}

/// Rotors, servos and a motor at the end of its range, from a keyframe: off by what joints and gears give, as 1/k.
#[test]
fn rotors_and_servos_come_to_mujocos_motion() {
    let mut last = f64::INFINITY;
    for stiffness in [1e5, 1e6, 1e7] {
        let keyframe = Some("start".to_owned());
        let options = Options { stiffness, duration: 0.5, keyframe, ..Options::default() };
        let scene = loaded(&imported("driven.xml", &options));
        let worst = worst(&distances(&scene, "tests/command_line/import/driven.csv"));
        assert!(worst < last / 5.0, "{stiffness}: {worst:e} after {last:e} m");
        last = worst;
    }
    assert!(last < 2e-5, "{last:e} m");
}
