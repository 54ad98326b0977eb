//! Times chains of revolutes in lanes against their plants on one thread, both in one process in turn, and prints the ratios of
//! steps per second as CSV: `cargo run --release -p dbd-ensemble --example measure_large [BODIES…]`. `cargo xtask
//! bench` keeps them.
//!
//! `measure_large count BODIES f32|f64 plant|INSTRUCTIONS STEPS` takes steps for callgrind, which counts
//! [`counted_steps`] alone.

use std::num::NonZeroUsize;

use dbd_bench::chain::{self, Joints};
use dbd_ensemble::{Course, InstructionSet, Large, Number, PlantOf, pace_of_large};
use dbd_kernel::geometry::Float;
use dbd_kernel::{Leapfrog, Plant};
use dbd_scene::SceneModel;

const BODIES: [usize; 3] = [100, 1_000, 10_000];
const ROUNDS: usize = 41;
/// Steps of a round times bodies, in whole blocks of steps.
const WORK: usize = 400_000;
const BLOCK: u64 = 64;

fn model<R: Number>(bodies: usize) -> SceneModel<Float<R>> {
    chain::model(bodies, Joints::Revolute).unwrap().convert()
}

/// A row per instruction set and number of threads.
fn rows<R: Number>(bodies: usize) {
    let steps = (WORK / bodies) as u64;
    let steps = (steps / BLOCK).max(1) * BLOCK;
    for set in InstructionSet::ALL.into_iter().filter(|set| set.is_there()) {
        for threads in [1, 2] {
            let [of, rounds] = [threads, ROUNDS].map(|n| NonZeroUsize::new(n).unwrap());
            let course = Course { set, threads: of, steps, rounds };
            let pace = pace_of_large::<R>(&model(bodies), chain::STEP, course).unwrap();
            let (ratio, best, lanes) = (pace.ratio(), pace.best_ratio(), R::lanes(set));
            println!(
                "{bodies},{},{},{lanes},{threads},{ratio:.2},{:.3},{best:.2},{:.2}",
                R::NAME,
                set.name(),
                pace.spread(),
                pace.over_one_thread().unwrap_or(1.0)
            );
        }
    }
}

/// What is counted. Its name is what callgrind is told.
#[inline(never)]
fn counted_steps(step: &mut dyn FnMut(u64), steps: u64) {
    step(steps);
}

fn count<R: Number>(bodies: usize, way: &str, steps: u64) {
    let mut plant: PlantOf<R, Leapfrog> =
        Plant::new(Box::new(model(bodies)), Leapfrog, chain::STEP).unwrap();
    let hash = match InstructionSet::ALL.into_iter().find(|set| set.name() == way) {
        Some(set) => {
            let mut large = Large::with_instructions(plant, set).unwrap();
            counted_steps(&mut |steps| _ = large.advance(steps), steps);
            large.plant().hash()
        }
        None => {
            counted_steps(&mut |steps| _ = plant.advance(steps), steps);
            plant.hash()
        }
    };
    println!("{hash:016x}");
}

fn main() {
    let told: Vec<String> = std::env::args().skip(1).collect();
    if let [what, bodies, precision, way, steps] = &told[..]
        && what == "count"
    {
        let (bodies, steps) = (bodies.parse().unwrap(), steps.parse().unwrap());
        return match precision.as_str() {
            "f32" => count::<f32>(bodies, way, steps),
            _ => count::<f64>(bodies, way, steps),
        };
    }
    println!(
        "bodies,precision,instructions,lanes,threads,median_ratio,spread,best_ratio,over_one_thread"
    );
    let told: Vec<usize> = told.iter().map(|bodies| bodies.parse().unwrap()).collect();
    for &bodies in if told.is_empty() { &BODIES[..] } else { &told } {
        rows::<f32>(bodies);
        rows::<f64>(bodies);
    }
}
