//! `prove [roots] [arctangents] [long-runs]`: what tests try with a sample, tried over all inputs.
//!
//! `names, or none for all => table of comma-separated values on standard output, what is wrong on
//! standard error`.
//! `cargo xtask prove` keeps them in docs/results/proof.csv. Ends with 1 where something is wrong.

mod arctangent;
mod long_runs;
mod square_root;

use std::process::ExitCode;
use std::time::Instant;

use arctangent::{SECTORS, Worst};
use dbd_kernel::{F32, F64};
use long_runs::{Drift, ENERGY, ENERGY_MEAN, LENGTH, MOMENTUM, swinging, tumbling};
use square_root::{DOUBLE, SINGLE, hard_f64, wrong_f32, wrong_f64};

/// Numbers in double precision of each root, a quarter of them of each kind.
const ROOTS_F64: u64 = 100_000_000;
/// Points of each sector in double precision, whose truth takes its time.
const ANGLES_F64: u64 = 100_000;

/// Steps of a long run.
const STEPS: u64 = 100_000_000;

/// What can be proved alone.
const NAMES: [&str; 3] = ["roots", "arctangents", "long-runs"];

/// What is proved by name, with its columns.
const HEADER: &str = "proof,of,precision,inputs,figure,value,thread_seconds";

fn main() -> ExitCode {
    let names: Vec<String> = std::env::args().skip(1).collect();
    if let Some(name) = names.iter().find(|name| !NAMES.contains(&name.as_str())) {
        eprintln!("error: there is no proof `{name}`; there are: {}", NAMES.join(", "));
        return ExitCode::FAILURE;
    }
    let wanted = |name: &str| names.is_empty() || names.iter().any(|other| other == name);
    let threads = std::thread::available_parallelism().map_or(1, |count| count.get() as u64);
    println!("{HEADER}");
    let wrong = if wanted("roots") { roots(threads) } else { 0 };
    if wanted("arctangents") {
        arctangents(threads);
    }
    if wanted("long-runs") {
        long_runs();
    }
    if wrong == 0 { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

/// The shares of the threads, in order, and the seconds they took together.
fn shared<T: Send>(threads: u64, work: impl Fn(u64) -> T + Sync) -> (Vec<T>, f64) {
    let timed = |thread| {
        let start = Instant::now();
        (work(thread), start.elapsed().as_secs_f64())
    };
    let timed = &timed;
    let done: Vec<_> = std::thread::scope(|scope| {
        let threads: Vec<_> = (0..threads).map(|i| scope.spawn(move || timed(i))).collect();
        threads.into_iter().map(|thread| thread.join().expect("no work panics")).collect()
    });
    let seconds = done.iter().map(|(_, seconds)| seconds).sum();
    (done.into_iter().map(|(part, _)| part).collect(), seconds)
}

/// All roots in single precision, many in double precision; how many are wrong.
fn roots(threads: u64) -> u64 {
    let mut all = 0;
    let mut tell = |name, precision, inputs, (parts, seconds): (Vec<(u64, Option<f64>)>, f64)| {
        let wrong: u64 = parts.iter().map(|(wrong, _)| wrong).sum();
        println!("square root,{name},{precision},{inputs},wrong,{wrong},{seconds:.0}");
        if let Some(first) = parts.iter().find_map(|(_, first)| *first) {
            eprintln!("error: {name}, {precision}: the root of {first:e} is wrong");
        }
        all += wrong;
    };
    for root in SINGLE {
        let parts = shared(threads, |thread| {
            let bits = (thread..1 << 32).step_by(threads as usize).map(|bits| bits as u32);
            let (wrong, first) = wrong_f32(root.of, bits);
            (wrong, first.map(f64::from))
        });
        tell(root.name, "f32", 1_u64 << 32, parts);
    }
    for root in DOUBLE {
        let inputs = hard_f64(ROOTS_F64 / 4).count() as u64;
        let parts = shared(threads, |thread| {
            let mine = hard_f64(ROOTS_F64 / 4).skip(thread as usize).step_by(threads as usize);
            wrong_f64(root.of, mine)
        });
        tell(root.name, "f64", inputs, parts);
    }
    all
}

/// Every quotient in single precision, many in double precision.
fn arctangents(threads: u64) {
    for sector in SECTORS {
        let tell = |precision, inputs, (parts, seconds): (Vec<Worst>, f64)| {
            let Worst { angle, places } = parts.into_iter().fold(Worst::default(), Worst::or);
            let name = sector.name;
            for (figure, value) in
                [("rad", format!("{angle:.3e}")), ("ulp", format!("{places:.2}"))]
            {
                println!("arctangent,{name},{precision},{inputs},{figure},{value},{seconds:.0}");
            }
        };
        let parts = shared(threads, |thread| sector.every_f32(thread as u32, threads as u32));
        tell("f32", sector.count_f32(), parts);
        let parts = shared(threads, |thread| {
            let [from, to] = [thread, thread + 1].map(|i| ANGLES_F64 * i / threads);
            sector.even_f64(from, to, ANGLES_F64)
        });
        tell("f64", ANGLES_F64, parts);
    }
}

/// Runs of many steps, one after the other.
fn long_runs() {
    type Run = fn(u64) -> Drift;
    let runs: [(&str, &str, Run); 4] = [
        ("free body", "f64", tumbling::<F64>),
        ("free body", "f32", tumbling::<F32>),
        ("pendulum", "f64", swinging::<F64>),
        ("pendulum", "f32", swinging::<F32>),
    ];
    for (name, precision, run) in runs {
        let (drifts, seconds) = shared(1, |_| run(STEPS));
        for Drift { length, momentum, energy, energy_mean } in drifts {
            let figures = [
                (LENGTH, Some(length)),
                (MOMENTUM, momentum),
                (ENERGY, Some(energy)),
                (ENERGY_MEAN, Some(energy_mean)),
            ];
            for (figure, value) in figures {
                if let Some(value) = value {
                    println!(
                        "long run,{name},{precision},{STEPS},{figure},{value:.3e},{seconds:.0}"
                    );
                }
            }
        }
    }
}
