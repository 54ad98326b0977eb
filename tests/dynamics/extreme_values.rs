//! Every scene that ships with some of its values at nothing, the least and the largest.
//!
//! `scene, path, value => check, a few steps`: an error or a result, never a panic. Some paths lead to all of a kind at
//! once, for a list without an entry or a mechanism without any size is what a single number does not make; the others
//! are a sample with a fixed seed.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::time::{Duration, Instant};

use dbd_plant::{Frequencies, Method, plant};
use dbd_scene::Scene;
use dbd_tests::results::path;
use dbd_tests::scene_names;
use host_sim::cli::main_with;
use host_sim::commands::run::{RunOptions, plan_of};
use host_sim::terminal::{Console, Exit};

/// Nothing, the least and the largest.
const EDGES: [&str; 6] = [
    "0",
    "-0.0",
    "5e-324",
    "1.7976931348623157e308",
    "-1.7976931348623157e308",
    "2.2250738585072014e-308",
];

/// All of a kind.
const PATTERNS: [&str; 9] = [
    "joint.*.stiffness",
    "joint.*.damping",
    "joint.*.span",
    "tsda.*.stiffness",
    "tsda.*.free_length",
    "point_on_line.*.stiffness",
    "torsion_spring.*.stiffness",
    "body.*.mass",
    "load.*.from",
];

/// Paths of each scene that are drawn from all that it has.
const DRAWN: usize = 12;

/// Bodies above which a scene's own paths are not drawn: its kinds of values are those of a smaller one.
const MAX_BODIES: usize = 8;

/// The next of a sequence (SplitMix64).
fn next(state: &mut u64) -> u64 {
    *state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let mut z = *state;
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

/// Checks a scene with changes as the command does, and steps it where it is taken.
fn tried(name: &str, text: &str, changes: &[String]) -> Exit {
    let mut arguments = vec!["host-sim", "check", name];
    for change in changes {
        arguments.extend(["--set", change]);
    }
    let (mut out, mut err) = (Vec::new(), Vec::new());
    let exit = main_with(arguments, &mut Console::plain(&mut out, &mut err));
    if exit == Exit::Refused {
        assert!(!err.is_empty(), "refused without a word");
        return exit;
    }
    let Ok(scene) = Scene::parse_with(text, name, changes) else { return exit };
    let method = Method::default();
    let frequencies = Frequencies::of(&scene);
    if let Ok(plan) = plan_of(&scene, &RunOptions::new(method), &frequencies)
        && let Ok(mut plant) = plant(&scene, &method, plan.step)
    {
        let _ = plant.advance(plan.steps.min(3));
    }
    exit
}

#[test]
fn no_value_at_its_edge_makes_a_panic() {
    let began = Instant::now();
    let mut seed = 5043;
    let (mut cases, mut taken, mut slowest) = (0, 0, (Duration::ZERO, String::new()));
    let mut failed = Vec::new();
    for name in scene_names() {
        let text = std::fs::read_to_string(path(&format!("scenes/{name}.toml"))).unwrap();
        let scene = Scene::parse(&text, &name).unwrap();
        let numbers = scene.numbers().unwrap();
        let kinds: Vec<&str> = PATTERNS
            .into_iter()
            .filter(|pattern| {
                let [kind, key] = [pattern.split('.').next(), pattern.rsplit('.').next()];
                numbers.iter().any(|number| {
                    number.path.split(['.', '[']).next() == kind
                        && key.is_some_and(|key| number.path.ends_with(key))
                })
            })
            .collect();
        let mut paths: Vec<String> = kinds
            .iter()
            .enumerate()
            // Without stiffness always, the others in turn.
            .filter(|(row, _)| *row == 0 || next(&mut seed).is_multiple_of(3))
            .map(|(_, pattern)| (*pattern).to_owned())
            .collect();
        if scene.body_names.len() <= MAX_BODIES {
            let drawn = (0..DRAWN).map(|_| next(&mut seed) as usize % numbers.len());
            paths.extend(drawn.map(|row| numbers[row].path.clone()));
        }
        for (row, path) in paths.iter().enumerate() {
            let edge = if row == 0 { "0" } else { EDGES[next(&mut seed) as usize % EDGES.len()] };
            let changes = [format!("{path}={edge}")];
            let start = Instant::now();
            match catch_unwind(AssertUnwindSafe(|| tried(&name, &text, &changes))) {
                Ok(exit) => taken += usize::from(exit == Exit::Done),
                Err(_) => failed.push(format!("{name} --set {}", changes[0])),
            }
            cases += 1;
            if start.elapsed() > slowest.0 {
                slowest = (start.elapsed(), format!("{name} --set {}", changes[0]));
            }
        }
    }
    eprintln!("{cases} cases, {taken} taken, {:?}; slowest {slowest:?}", began.elapsed());
    assert!(failed.is_empty(), "panic: {failed:#?}");
    // Neither all refused, which would try nothing, nor none.
    assert!(taken * 10 > cases && taken < cases, "{taken} of {cases}");
}
