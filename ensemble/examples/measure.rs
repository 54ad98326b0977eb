//! Times ensembles against their instances by themselves and writes `docs/results/ensembles.csv`, from which
//! the table of `docs/ensembles.md` is rendered: `cargo run --release -p dbd-ensemble --example measure`.

use std::fmt::Write as _;
use std::num::NonZeroUsize;
use std::path::Path;

use dbd_ensemble::{Course, InstructionSet, Number, pace};
use dbd_kernel::{F64, Leapfrog};
use dbd_scene::{Scene, SceneModel};

const SCENES: [&str; 4] = ["hexagon", "six-bar", "3ruu", "double-wishbone"];
const ROUNDS: usize = 15;
/// Steps of an instance in a round times its bodies.
const WORK: u64 = 24_000;

fn rows<R: Number>(name: &str, model: &SceneModel<F64>, step: f64, table: &mut String) {
    let model = model.convert();
    let steps = WORK / model.bodies.len() as u64;
    for set in InstructionSet::ALL.into_iter().filter(|set| set.is_there()) {
        for threads in [1, 2] {
            let [threads, rounds] = [threads, ROUNDS].map(|n| NonZeroUsize::new(n).unwrap());
            let course = Course { set, threads, steps, rounds };
            let pace = pace::<R, _>(&model, Leapfrog, step, course).unwrap();
            let lanes = pace.instances / threads;
            let (ratio, best) = (pace.ratio(), pace.best_ratio());
            let row = format!(
                "{name},leapfrog,{},{},{lanes},{threads},{ratio:.2},{best:.2}",
                R::NAME,
                set.name()
            );
            println!("{row}");
            let _ = writeln!(table, "{row}");
        }
    }
}

fn main() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let mut table = String::from(
        "# Steps per second of an ensemble over those of its instances one after the other on one thread, \
         both in one\n# process in turn: the median of 15 rounds' ratios, and the ratio of the fastest \
         rounds. The table of docs/ensembles.md\n# is rendered from here; written by `cargo run --release \
         -p dbd-ensemble --example measure` on two cores that did other\n# work beside, which two threads \
         feel most.\nscene,scheme,precision,instructions,lanes,threads,ratio,best_ratio\n",
    );
    for name in SCENES {
        let path = root.join("scenes").join(name).with_extension("toml");
        let text = std::fs::read_to_string(&path).unwrap();
        let scene = Scene::parse(&text, name).unwrap();
        let step = scene.step.unwrap();
        rows::<f32>(name, &scene.model, step, &mut table);
        rows::<f64>(name, &scene.model, step, &mut table);
    }
    std::fs::write(root.join("docs/results/ensembles.csv"), table).unwrap();
}
