//! MJCF becomes a scene: beside MuJoCo's own trajectory, and what is refused.
//!
//! `tests/import/*.xml => scenes`. `two-loops.csv` is what MuJoCo makes of `two-loops.xml`;
//! `tests/import/judge.py` writes it, and compares other files.

mod parts;
mod refusals;

use std::path::Path;

use dbd_import::{Imported, Kind, Options, import, import_text};
use dbd_plant::{Frequencies, Method, plant};
use dbd_scene::Scene;
use dbd_tests::page::{block, figure, table};
use dbd_tests::results::{path, rows};

/// A scene that was made of a file of this folder.
fn imported(file: &str, options: &Options) -> Imported {
    import(&path("tests/import").join(file), options).unwrap_or_else(|error| panic!("{error}"))
}

/// One that was made of a text.
fn of(text: &str, options: &Options) -> Imported {
    import_text(text, "test.xml", Path::new(""), options).unwrap_or_else(|error| panic!("{error}"))
}

fn loaded(imported: &Imported) -> Scene {
    let text = &imported.scene;
    Scene::parse(text, "imported").unwrap_or_else(|error| panic!("{error}\n{text}"))
}

/// \[m\] the largest distance of each body's centre of mass from where a table has it.
fn distances(scene: &Scene, file: &str) -> Vec<f64> {
    let rows = rows(file);
    let interval = rows[1].number("time");
    let limit = Frequencies::of(scene).default_limit(&Method::default(), scene.duration);
    let steps = (interval / limit).ceil();
    let mut plant = plant(scene, &Method::default(), interval / steps).unwrap();
    let mut largest = vec![0.0_f64; scene.body_names.len()];
    for row in &rows {
        for (body, name) in scene.body_names.iter().enumerate() {
            let place = plant.state().bodies[body].position;
            let there = ["x", "y", "z"].map(|axis| row.number(&format!("{name}.{axis}")));
            let gaps = [place.x - there[0], place.y - there[1], place.z - there[2]];
            let square: f64 = gaps.iter().map(|gap| gap * gap).sum();
            largest[body] = largest[body].max(square.sqrt());
        }
        plant.advance(steps as u64).ok().unwrap();
    }
    largest
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
        let distances = distances(&scene, "tests/import/two-loops.csv");
        let worst = distances.iter().copied().fold(0.0, f64::max);
        // A tenth for ten times the stiffness, with a margin.
        assert!(worst < last / 5.0, "{stiffness}: {worst:e} after {last:e} m");
        assert!(stiffness != 1e7 || worst < 1e-3, "{worst:e} m");
        last = worst;
        names.clone_from(&scene.body_names);
        let mut row = vec![format!("{stiffness:e}")];
        row.extend(distances.iter().map(|distance| figure(distance * 1e3, 2)));
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
    let first = &rows("tests/import/two-loops.csv")[0];
    for (name, state) in scene.body_names.iter().zip(&scene.model.initial) {
        let place = [state.position.x, state.position.y, state.position.z];
        for (axis, value) in ["x", "y", "z"].iter().zip(place) {
            let there = first.number(&format!("{name}.{axis}"));
            assert!((value - there).abs() < 1e-8, "{name}.{axis}: {value} {there}");
        }
    }
}
