//! Advice beside what comes of it: stability far beyond the scene's duration, the share of the stable step, and the error
//! against another truth at other times.

use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use dbd_plant::monitor::Monitor;
use dbd_plant::{DampingName, Frequencies, Method, Named as _, PrecisionName, SchemeName, plant};
use dbd_scene::Scene;
use dbd_study::recommend::{Ends, FURTHER, Limit, Mcu, Recommendation, Request, recommend};
use dbd_study::reference::State;
use dbd_study::reference::fine::states;
use dbd_study::reference::reference_solution::Integrator;
use dbd_study::variants::distance;
use dbd_tests::mechanisms::{JOINTS, Kind, mechanism};
use dbd_tests::{results, scene, scene_names};

/// Of so many steps at most.
const MAX_STEPS: u64 = 2_000_000;

/// \[s\] the accuracy is judged over so much of a scene at most.
const WINDOW: f64 = 0.25;

/// Samples of the other truth, at most.
const SAMPLES: u64 = 31;

/// Mechanisms at random: their seeds are 1, 2, ….
const RANDOM: u64 = 100;

/// What is kept of them.
const FILE: &str = "docs/results/advice.csv";

/// Its columns.
const HEAD: &str = "scene,model,scheme,damping,precision,step_s,share_of_stable,limit,accuracy_m,error_m,\
                    error_elsewhere_m,steps,stable,ends_s,load_168mhz,instructions\n";

const KIND: Kind =
    Kind { planar: false, joints: JOINTS, damping: [0.0, 0.2], driven: true, approximate: false };

/// What an advice came to.
struct Held {
    advice: Recommendation,
    /// Steps that went well, and whether all did.
    steps: u64,
    stable: bool,
    /// Whether the scene comes to the end that it is said to have.
    ends: bool,
    /// \[m\] the error against the other truth; of nothing where there is none.
    elsewhere: Option<f64>,
}

fn advised(scene: &Scene, window: Option<f64>) -> Result<Recommendation, String> {
    let mcu = Mcu::of_name("cortex-m4f").unwrap();
    let shipped = Some(scene.clone());
    let request = Request { mcu, clock: mcu.clock, rate: None, accuracy: None, window, shipped };
    recommend(scene, &request, &mut |_| ()).map_err(|why| format!("{}: {why}", scene.name))
}

/// The advised model and method.
fn taken(scene: &Scene, advice: &Recommendation) -> (Scene, Method) {
    let way = &advice.way;
    let changes = advice.set.iter();
    let model = changes.fold(scene.clone(), |scene, change| scene.with(change).unwrap());
    let scheme = SchemeName::of_name(way.scheme).unwrap();
    let precision = PrecisionName::of_name(way.precision).unwrap();
    let mut method = Method::new(scheme, way.newton, precision).unwrap();
    if let Some(damping) = way.damping {
        method = method.with_damping(DampingName::of_name(damping).unwrap()).unwrap();
    }
    (model, method)
}

fn held(scene: &Scene, window: Option<f64>) -> Result<Held, String> {
    let advice = advised(scene, window)?;
    let (model, method) = taken(scene, &advice);
    let step = advice.way.step;
    let mut plant = plant(&model, &method, step).unwrap();
    let over = if advice.ends.is_some() { 1.0 } else { FURTHER };
    let all = ((over * scene.duration / step).round() as u64).min(MAX_STEPS);
    let mut monitor = Monitor::new(&model, plant.as_ref());
    let mut stable = true;
    while stable && plant.steps() < all {
        let some = (all / 500).max(1).min(all - plant.steps());
        stable = plant.advance(some).is_ok() && monitor.check(&plant.state()).is_ok();
    }
    let ends = advice.ends.as_ref().is_none_or(|ends| comes_apart(scene, ends));
    Ok(Held { steps: plant.steps(), stable, ends, elsewhere: elsewhere(scene, &advice), advice })
}

/// Whether a scene fails or comes apart within ten times its duration by another scheme in still shorter steps.
fn comes_apart(scene: &Scene, ends: &Ends) -> bool {
    let method = Method::new(SchemeName::SemiImplicitEuler, None, PrecisionName::F64).unwrap();
    let step = Frequencies::of(scene).default_limit(&Method::default(), scene.duration) / 24.0;
    let mut plant = plant(scene, &method, step).unwrap();
    let mut monitor = Monitor::new(scene, plant.as_ref());
    while plant.time() < FURTHER * scene.duration {
        if plant.advance(50).is_err() || monitor.check(&plant.state()).is_err() {
            return true;
        }
        let open = |joint: &String| {
            let row = scene.joints.iter().position(|other| other.name == *joint).unwrap();
            let opening = &monitor.openings()[row];
            opening.extension > opening.free_length
        };
        if ends.joint.as_ref().is_some_and(open) {
            return true;
        }
    }
    false
}

/// \[m\] distance of the advised method from the second solution, at other times than the choice used.
fn elsewhere(scene: &Scene, advice: &Recommendation) -> Option<f64> {
    let (model, method) = taken(scene, advice);
    let step = advice.way.step;
    let steps = (advice.window / step).round() as u64;
    let stride = steps.div_ceil(SAMPLES);
    if stride == 0 {
        return None;
    }
    let times: Vec<f64> = (0..=steps / stride).map(|row| (row * stride) as f64 * step).collect();
    let reference_solution = states(Integrator::Verner98, scene, false, &times).unwrap();
    let mut plant = plant(&model, &method, step).unwrap();
    let mut run = vec![State::of(&plant.state())];
    while run.len() < times.len() {
        plant.advance(stride).unwrap();
        run.push(State::of(&plant.state()));
    }
    Some(distance((scene, &reference_solution), (&model, &run)))
}

impl Held {
    /// The step over the largest stable one.
    fn share(&self) -> Option<f64> {
        Some(self.advice.way.step / self.advice.stable_step?)
    }

    fn limit(&self) -> &'static str {
        match self.advice.limit {
            Limit::Vibration { .. } => "vibration",
            Limit::Spin { .. } => "spin",
            Limit::Motion { .. } => "motion",
            Limit::Accuracy => "accuracy",
            Limit::Period => "period",
        }
    }

    /// The error as told over that against the other truth; errors of rounding count as none.
    fn ratio(&self) -> Option<f64> {
        let floor = 1e-9 + 10.0 * self.advice.uncertainty;
        Some((self.advice.way.error + floor) / (self.elsewhere? + floor))
    }

    /// What does not hold.
    fn faults(&self) -> Vec<String> {
        let Self { advice, steps, stable, ends, elsewhere } = self;
        let mut faults = Vec::new();
        let mut holds = |good: bool, what: String| {
            if !good {
                faults.push(format!("{}: {what}", advice.scene));
            }
        };
        holds(*stable, format!("fails after {steps} steps"));
        holds(*ends, format!("goes beyond its end, {:?}", advice.ends));
        let error = advice.way.error;
        holds(!advice.meets || error <= advice.accuracy, format!("off by {error:e} m"));
        if let Some(share) = self.share() {
            let decides = matches!(advice.limit, Limit::Vibration { .. });
            let least = if decides { 0.75 } else { 0.0 };
            holds((least..=1.0).contains(&share), format!("{share} of the stable step"));
        }
        if let Some(ratio) = self.ratio() {
            holds((0.5..=2.0).contains(&ratio), format!("off by {error:e}, not {elsewhere:?} m"));
        }
        faults
    }

    fn row(&self) -> String {
        let Self { advice, steps, stable, elsewhere, .. } = self;
        let way = &advice.way;
        let text = |number: Option<f64>| number.map_or_else(String::new, |n| format!("{n:.3e}"));
        format!(
            "{},{},{},{},{},{:?},{},{},{:.3e},{:.3e},{},{},{},{},{:.4},{}\n",
            advice.scene,
            way.model,
            way.scheme,
            way.damping.unwrap_or(""),
            way.precision,
            way.step,
            text(self.share()),
            self.limit(),
            advice.accuracy,
            way.error,
            text(*elsewhere),
            steps,
            if *stable { "yes" } else { "no" },
            text(advice.ends.as_ref().map(|ends| ends.time)),
            way.load,
            if way.counted { "counted" } else { "estimated" },
        )
    }
}

/// A few scenes, and a few mechanisms at random.
#[test]
fn advice_holds() {
    for name in ["hexagon", "cart-pendulum", "spring-ball"] {
        assert_eq!(held(&scene(name), Some(0.1)).unwrap().faults(), [""; 0]);
    }
    for seed in 1..=4 {
        let scene = Scene::parse(&mechanism(seed, KIND), "random.toml").unwrap();
        assert_eq!(held(&scene, Some(0.1)).unwrap().faults(), [""; 0]);
    }
}

/// All of them, into a file: takes some ten minutes. `cargo test --release -p dbd-tests --test trade advice_of_all --
/// --ignored`.
#[test]
#[ignore = "takes ten minutes; writes docs/results/advice.csv"]
fn advice_of_all() {
    let shipped = scene_names().into_iter().map(|name| scene(&name));
    let random =
        (1..=RANDOM).map(|seed| Scene::parse(&mechanism(seed, KIND), "random.toml").unwrap());
    let scenes: Vec<Scene> = shipped.chain(random).collect();
    let next = AtomicUsize::new(0);
    let rows = Mutex::new(vec![String::new(); scenes.len()]);
    let faults = Mutex::new(Vec::new());
    std::thread::scope(|scope| {
        for _ in 0..std::thread::available_parallelism().map_or(1, usize::from) {
            scope.spawn(|| {
                loop {
                    let row = next.fetch_add(1, Ordering::Relaxed);
                    let Some(scene) = scenes.get(row) else { break };
                    let begun = std::time::Instant::now();
                    let found = held(scene, Some(WINDOW));
                    eprintln!("{} {}: {:.0?}", row, scene.name, begun.elapsed());
                    let mut wrong = faults.lock().unwrap();
                    match found {
                        Ok(held) => {
                            wrong.extend(held.faults());
                            let mut rows = rows.lock().unwrap();
                            rows[row] = held.row();
                            // Each as it comes: one that takes long costs no other.
                            std::fs::write(results::path(FILE), HEAD.to_owned() + &rows.concat())
                                .unwrap();
                        }
                        Err(why) => wrong.push(why),
                    }
                }
            });
        }
    });
    let faults = faults.lock().unwrap();
    assert!(faults.is_empty(), "{faults:#?}");
}
