//! Which command lines are short: a simulation of a day is no hang.
//!
//! `arguments => whether steps, samples and bodies are few`. All that looks like a scene or a time is
//! taken for one: what is refused anyway may be left out, what is long may not be let in.

use dbd_plant::time::Time;
use dbd_plant::{Frequencies, Method};
use dbd_scene::Scene;
use dbd_study::sweep::Spec;
use dbd_study::sweep::axis::Axis;
use host_sim::commands::run::{RunOptions, plan_of};
use host_sim::terminal::Catalogue;

use super::folder::SCENE;
use super::words::{Arguments, SHORT_SWEEP, SWEEP};
use crate::scene::fnv;

/// Steps times bodies of a run.
const WORK: f64 = 40_000.0;

/// Rows of its trace times bodies.
const ROWS: f64 = 4_000.0;

/// One in so many surveys of a single body is made: it takes a second or some.
const SURVEYS: u64 = 64;

/// One in so many searches for a stable step is made: it takes as long.
const SEARCHES: u64 = 8;

/// Bodies of a scene whose stability is looked for.
const FEW: usize = 2;

/// Cases of a sweep.
const CASES: u128 = 50;

/// Whether a command line is done within a second or so.
pub fn is_short(arguments: &Arguments) -> bool {
    let words: Vec<String> =
        arguments.words.iter().map(|word| word.to_string_lossy().into_owned()).collect();
    let has = |what: &str| words.iter().any(|word| word == what);
    let (run, trade, stability) = (has("run"), has("trade"), has("--stability"));
    if has(SWEEP) && !sweep_is_short(&arguments.scene) {
        return false;
    }
    if !(run || trade || stability) {
        return true;
    }
    let scenes: Vec<Scene> = words.iter().filter_map(|w| scene(w, &arguments.scene)).collect();
    let one_in = |many| fnv(&arguments.bytes()).is_multiple_of(many);
    if trade {
        // Of more than a body on a spring a survey takes seconds.
        let single = |scene: &Scene| {
            let model = &scene.model;
            model.bodies.len() == 1 && model.groups.len() <= 1 && model.torsions.is_empty()
        };
        let refused = !times(&words, "--window").iter().all(Option::is_some);
        return refused || scenes.iter().all(|scene| one_in(SURVEYS) && single(scene));
    }
    let few = |scene: &Scene| scene.model.bodies.len() <= FEW;
    if stability && !scenes.iter().all(|scene| one_in(SEARCHES) && few(scene)) {
        return false;
    }
    !run || scenes.iter().all(|scene| run_is_short(scene, &words))
}

/// Whether a sweep's file has few cases of few steps, or is refused.
fn sweep_is_short(text: &[u8]) -> bool {
    let Ok(text) = std::str::from_utf8(text) else { return true };
    let Ok(spec) = Spec::parse(text, SCENE) else { return true };
    let timed = spec.axes.iter().any(|axis| Axis::is_time(&axis.path));
    let set = spec.set.iter().any(|change| !change.text.starts_with(['g', 'b', '=', 'a']));
    spec.count() <= CASES && text.starts_with(SHORT_SWEEP) && !timed && !set
}

/// Whether a command line names no file outside of the folder that is watched, but devices.
pub fn stays(arguments: &Arguments) -> bool {
    arguments.words.iter().all(|word| {
        let word = word.to_string_lossy();
        let path = word.split_once('=').map_or(&*word, |(_, value)| value);
        let inside = !path.starts_with('/') && path.matches("..").count() < 2;
        inside || path.starts_with("/dev/null") || path.starts_with("/proc/none")
    })
}

/// The scene that a word names, if it does.
fn scene(word: &str, beside: &[u8]) -> Option<Scene> {
    if word == "-" || word.ends_with(SCENE) {
        return Scene::parse(std::str::from_utf8(beside).ok()?, SCENE).ok();
    }
    let is_name = !word.is_empty() && !word.contains(['/', '\\', '.', '-', '=']);
    let dashed = word.contains('-') && !word.starts_with('-') && !word.contains(['/', '.']);
    if is_name || dashed { Some(Catalogue::default().load(word).ok()?.scene) } else { None }
}

/// The values that follow an option; `None` for what is no time.
fn times(words: &[String], option: &str) -> Vec<Option<f64>> {
    let apart = words.windows(2).filter(|pair| pair[0] == option).map(|pair| pair[1].as_str());
    let joined = words.iter().filter_map(|word| word.strip_prefix(option)?.strip_prefix('='));
    let seconds = |text: &str| text.parse::<Time>().ok().map(Time::seconds);
    apart.chain(joined).map(seconds).collect()
}

fn run_is_short(scene: &Scene, words: &[String]) -> bool {
    let given = |option: &str| match times(words, option).as_slice() {
        [] => Some(None),
        [Some(time)] => Some(Some(*time)),
        // Twice, or no time: refused.
        _ => None,
    };
    let (Some(step), Some(duration), Some(every)) =
        (given("--step"), given("--duration"), given("--every"))
    else {
        return true;
    };
    let options = RunOptions { step, duration, every, ..RunOptions::new(Method::default()) };
    match plan_of(scene, &options, &Frequencies::of(scene)) {
        Err(_) => true,
        Ok(plan) => {
            let bodies = scene.model.bodies.len() as f64;
            plan.steps as f64 * bodies <= WORK && plan.samples() as f64 * bodies <= ROWS
        }
    }
}
