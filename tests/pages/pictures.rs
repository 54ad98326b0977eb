//! Pictures of mechanisms in the pages: what `host-sim check SCENE --svg` writes, and a mechanism in motion.

use dbd_kernel::{Leapfrog, Plant};
use dbd_report::picture::{Mechanism, Paper, Pose, motion};
use dbd_tests::page::file;
use dbd_tests::scene;
use host_sim::commands::picture::picture;

/// Those that pages show.
const SHOWN: [&str; 2] = ["3ruu", "double-wishbone"];
/// \[s\] between two poses of the picture in motion.
const BETWEEN: f64 = 0.065;

const COMMAND: &str = "cargo test -p dbd-tests --test pages pictures";

#[test]
fn pictures_of_the_pages_show_the_scenes() {
    for name in SHOWN {
        let drawn = picture(&scene(name), Paper::File);
        file(&format!("docs/pictures/{name}.svg"), &drawn, COMMAND);
    }
}

/// The delta robot over its whole cycle, which ends where it began.
#[test]
fn the_picture_of_the_readme_is_a_run() {
    let scene = scene("delta-pick-and-place");
    let step = scene.step.unwrap();
    let mut plant = Plant::new(&scene.model, Leapfrog, step).unwrap();
    let steps = (BETWEEN / step).round() as u64;
    let count = (scene.duration / BETWEEN).round() as usize;
    let mut poses: Vec<Pose> = Vec::new();
    for _ in 0..count {
        let bodies = &plant.state().bodies;
        let pose = bodies.iter().map(|body| (body.position.to_f64(), body.orientation.to_f64()));
        poses.push(pose.collect());
        plant.advance(steps).unwrap();
    }
    let head = |pose: &Pose| pose.last().unwrap().0;
    let way = |a: [f64; 3], b: [f64; 3]| (0..3).map(|i| (a[i] - b[i]).powi(2)).sum::<f64>().sqrt();
    let bodies = &plant.state().bodies;
    let (first, last) = (head(&poses[0]), bodies.last().unwrap().position.to_f64());
    assert!(way(first, last) < 0.02, "the cycle is closed within 20 mm: {first:?} {last:?}");
    assert!(poses.iter().any(|pose| way(head(pose), first) > 0.1), "it moves");
    let drawn = motion(&Mechanism::of(&scene), &poses, scene.duration);
    assert_eq!(drawn.matches("class=\"pose\"").count(), count);
    file("docs/pictures/delta-pick-and-place.svg", &drawn, COMMAND);
}
