//! Times ensembles against their instances one after the other on one thread, both in one process in turn, and
//! prints the ratios of steps per second as CSV: `cargo run --release -p dbd-ensemble --example measure [SCENE…]`.
//! `cargo xtask bench` keeps them.

use std::num::NonZeroUsize;
use std::path::Path;

use dbd_ensemble::{Course, InstructionSet, Number, pace};
use dbd_kernel::{F64, Leapfrog};
use dbd_scene::{Scene, SceneModel};

const SCENES: [&str; 4] = ["hexagon", "six-bar", "3ruu", "double-wishbone"];
/// Threads, rounds, and the steps of an instance in a round times its bodies: a round of two threads is long beside
/// their start.
const COURSES: [(usize, usize, u64); 2] = [(1, 101, 6_000), (2, 31, 30_000)];

/// A row per instruction set and number of threads.
fn rows<R: Number>(name: &str, model: &SceneModel<F64>, step: f64) {
    let model = model.convert();
    for set in InstructionSet::ALL.into_iter().filter(|set| set.is_there()) {
        for (threads, rounds, work) in COURSES {
            let [threads, rounds] = [threads, rounds].map(|n| NonZeroUsize::new(n).unwrap());
            let steps = work.div_ceil(model.bodies.len() as u64);
            let course = Course { set, threads, steps, rounds };
            let pace = pace::<R, _>(&model, Leapfrog, step, course).unwrap();
            let lanes = pace.instances / threads;
            println!(
                "{name},leapfrog,{},{},{lanes},{threads},{:.2},{:.3},{:.2},{:.2},{:.2}",
                R::NAME,
                set.name(),
                pace.ratio(),
                pace.spread(),
                pace.best_ratio(),
                pace.over_one_thread().unwrap_or(1.0),
                pace.alone_over_one_thread().unwrap_or(1.0)
            );
        }
    }
}

fn main() {
    let named: Vec<String> = std::env::args().skip(1).collect();
    let scenes = if named.is_empty() { SCENES.map(String::from).to_vec() } else { named };
    println!(
        "scene,scheme,precision,instructions,lanes,threads,median_ratio,spread,best_ratio,over_one_thread,alone_over_one_thread"
    );
    for name in scenes {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes").join(&name);
        let text = std::fs::read_to_string(path.with_extension("toml")).unwrap();
        let scene = Scene::parse(&text, &name).unwrap();
        let step = scene.step.unwrap();
        rows::<f32>(&name, &scene.model, step);
        rows::<f64>(&name, &scene.model, step);
    }
}
