//! The target `scene`: the reader and the assembly of scenes, then a planned run and a few of its
//! steps.
//!
//! `bytes => text => scene or refusal`. A refusal names a place within the text, what is wrong and
//! what would be right. Of the scenes that are taken, one in some is looked at and stepped.

use dbd_kernel::State;
use dbd_kernel::words::{Word, WordVisitor, Words};
use dbd_plant::monitor::Monitor;
use dbd_plant::{
    AnyPlant, DampingName, Frequencies, Method, Named, PrecisionName, SchemeName, plant,
};
use dbd_scene::{Scene, SceneError};
use fastrand::Rng;
use host_sim::commands::planar::PlaneCheck;
use host_sim::commands::run::{RunOptions, plan_of};
use host_sim::commands::warnings::of_scene;
use miette::Diagnostic as _;

use crate::corpus::{SHIPPED, SMALL};
use crate::mutation::{changed, soup};
use crate::target::{Finding, Reach, Target};

/// Scenes with more bodies are read, but not run: an execution is to be short.
const MAX_BODIES: usize = 40;

/// One in so many of the scenes that are taken is planned and stepped: reading is what is sought.
const STEPPED: u64 = 16;

/// The reader and the assembly of scenes.
pub struct SceneTarget;

impl Target for SceneTarget {
    fn name(&self) -> &'static str {
        "scene"
    }

    fn share(&self) -> f64 {
        0.6
    }

    fn block(&self) -> u64 {
        4000
    }

    fn input(&self, random: &mut Rng) -> Vec<u8> {
        text(random)
    }

    fn execute(&self, input: &[u8]) -> Result<Reach, Finding> {
        let text = String::from_utf8_lossy(input);
        match Scene::parse(&text, FILE) {
            Err(error) => refusal(&text, &error).map(|()| Reach::Refused),
            Ok(scene) => {
                let choice = fnv(input);
                if choice.is_multiple_of(STEPPED) && scene.body_names.len() <= MAX_BODIES {
                    run(&scene, &mut Rng::with_seed(choice))?;
                }
                Ok(Reach::Taken)
            }
        }
    }
}

/// What messages call the text.
const FILE: &str = "random.toml";

/// A text: seven of eight begin as a valid scene, most of them a small one.
pub fn text(random: &mut Rng) -> Vec<u8> {
    let mut one = || {
        let list = if random.u8(..16) > 0 { &SMALL } else { &SHIPPED };
        &list[random.usize(..list.len())]
    };
    let (base, other) = (one(), one());
    if random.u8(..8) == 0 { soup(random) } else { changed(base, other, random) }
}

/// FNV-1a 64.
#[must_use]
pub fn fnv(bytes: &[u8]) -> u64 {
    bytes.iter().fold(0xcbf2_9ce4_8422_2325, |hash, byte| {
        (hash ^ u64::from(*byte)).wrapping_mul(0x0000_0100_0000_01b3)
    })
}

/// What every refusal keeps.
fn refusal(text: &str, error: &SceneError) -> Result<(), Finding> {
    let (line, column) = error.line().zip(error.column()).unwrap_or_default();
    let width = line.checked_sub(1).and_then(|row| text.split('\n').nth(row));
    let width = width.map(|line| line.chars().count());
    Finding::unless(
        width.is_some_and(|width| column <= width + 1),
        "a refusal's place lies within the text",
        || format!("{line}:{column}"),
    )?;
    Finding::unless(
        !error.message().is_empty() && !error.help().is_empty(),
        "a refusal says what is wrong and what would be right",
        || error.message(),
    )?;
    let label = error.labels().and_then(|mut labels| labels.next()).map(|label| *label.inner());
    let marked = label.and_then(|span| text.get(span.offset()..span.offset() + span.len()));
    Finding::unless(marked.is_some(), "a refusal marks whole characters", || format!("{label:?}"))
}

/// Any method of this build.
pub fn method(random: &mut Rng) -> Method {
    let scheme = SchemeName::ALL[random.usize(..SchemeName::ALL.len())];
    let precision = if random.bool() { PrecisionName::F64 } else { PrecisionName::F32 };
    let newton = random.bool().then(|| random.u32(..=8));
    let plain = || Method::new(scheme, None, precision);
    let method = Method::new(scheme, newton, precision).or_else(|_| plain()).unwrap_or_default();
    let damping = DampingName::ALL[random.usize(..DampingName::ALL.len())];
    method.with_damping(damping).unwrap_or(method)
}

/// Plans and begins a run by a random method.
fn run(scene: &Scene, random: &mut Rng) -> Result<(), Finding> {
    let method = method(random);
    let frequencies = Frequencies::of(scene);
    let _ = of_scene(scene);
    let _ = PlaneCheck::of(scene);
    let _ = dbd_scene::facts(scene);
    let Ok(plan) = plan_of(scene, &RunOptions::new(method), &frequencies) else { return Ok(()) };
    Finding::unless(
        plan.steps > 0 && plan.stride > 0 && plan.step > 0.0 && plan.step.is_finite(),
        "a plan has steps",
        || format!("{plan:?}"),
    )?;
    let Ok(mut plant) = plant(scene, &method, plan.step) else { return Ok(()) };
    let mut monitor = Monitor::new(scene, plant.as_ref());
    for _ in 0..plan.steps.min(4) {
        let status = plant.step();
        let state = plant.state();
        running_is_finite(plant.as_ref(), status.is_ok(), &state)?;
        for readout in &scene.readouts {
            let _ = plant.read(&readout.readout);
        }
        if status.is_err() || monitor.check(&state).is_err() {
            break;
        }
    }
    Ok(())
}

/// [`RUNNING_IS_FINITE`].
///
/// # Errors
/// Where it is not so.
pub fn running_is_finite(
    plant: &dyn AnyPlant,
    running: bool,
    state: &State<dbd_scene::SceneModel<dbd_kernel::F64>>,
) -> Result<(), Finding> {
    Finding::unless(!running || is_finite(state), RUNNING_IS_FINITE, || {
        format!("{:?}, step {}, {:?}", plant.method(), state.step, state.bodies)
    })
}

/// What a status promises.
pub const RUNNING_IS_FINITE: &str = "a plant that runs has a finite state";

/// Whether every number of some words is finite.
pub fn is_finite(words: &impl Words) -> bool {
    struct Finite(bool);
    impl WordVisitor for Finite {
        fn word(&mut self, word: Word) {
            self.0 &= match word {
                Word::F32(x) => x.is_finite(),
                Word::F64(x) => x.is_finite(),
                Word::I32(_) | Word::U64(_) => true,
            };
        }
    }
    let mut finite = Finite(true);
    words.visit(&mut finite);
    finite.0
}
