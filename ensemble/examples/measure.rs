//! Times ensembles against their instances one after the other on one thread, both in one process in turn, and
//! prints the ratios of steps per second as CSV: `cargo run --release -p dbd-ensemble --example measure`.

use std::num::NonZeroUsize;
use std::path::Path;

use dbd_ensemble::{Course, InstructionSet, Number, pace};
use dbd_kernel::{F64, Leapfrog};
use dbd_scene::{Scene, SceneModel};

const SCENES: [&str; 4] = ["hexagon", "six-bar", "3ruu", "double-wishbone"];
const ROUNDS: usize = 101;
/// Steps of an instance in a round times its bodies.
const WORK: u64 = 1_536;

fn rows<R: Number>(name: &str, model: &SceneModel<F64>, step: f64) {
    let model = model.convert();
    let steps = WORK / model.bodies.len() as u64;
    for set in InstructionSet::ALL.into_iter().filter(|set| set.is_there()) {
        for threads in [1, 2] {
            let [threads, rounds] = [threads, ROUNDS].map(|n| NonZeroUsize::new(n).unwrap());
            let course = Course { set, threads, steps, rounds };
            let pace = pace::<R, _>(&model, Leapfrog, step, course).unwrap();
            let lanes = pace.instances / threads;
            let (ratio, best, set) = (pace.ratio(), pace.best_ratio(), set.name());
            println!("{name},leapfrog,{},{set},{lanes},{threads},{ratio:.2},{best:.2}", R::NAME);
        }
    }
}

fn main() {
    println!("scene,scheme,precision,instructions,lanes,threads,median_ratio,best_ratio");
    for name in SCENES {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes").join(name);
        let text = std::fs::read_to_string(path.with_extension("toml")).unwrap();
        let scene = Scene::parse(&text, name).unwrap();
        let step = scene.step.unwrap();
        rows::<f32>(name, &scene.model, step);
        rows::<f64>(name, &scene.model, step);
    }
}
