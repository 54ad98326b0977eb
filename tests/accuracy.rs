//! Accuracy at equal cost: the error of trajectory and energy of every scheme at the same number of
//! force evaluations per simulated second, on the paper's planar mechanisms and the crank-slider.
//!
//! The truth is Blanes & Moan's S6 at a step so short that halving it changes less than a
//! hundredth of the best error measured.

use dbd_kernel::energy::energy;
use dbd_kernel::{
    BlanesMoanS6, Dbd, DbdP1, F64, Leapfrog, Pefrl, Plant, Rk4, Scheme, SemiImplicitEuler, State,
};
use dbd_scene::SceneModel;
use dbd_tests::scene;
use host_sim::reference::Trajectory;
use nalgebra::Vector3;

/// A mechanism, its force evaluations per simulated second and the time looked at \[s\].
struct Race {
    model: SceneModel<F64>,
    rate: f64,
    time: f64,
    /// The truth at t = 0 and at the samples.
    truth: Trajectory,
}

/// Samples over the time.
const SAMPLES: u64 = 20;

impl Race {
    fn new(name: &str, rate: f64, time: f64) -> Self {
        let scene = scene(name);
        let truth = Trajectory::truth(&scene, time, SAMPLES as u32).unwrap();
        Self { model: scene.model.convert(), rate, time, truth }
    }

    /// The states at the samples, and the RMS of the energy's error over the steps if it is
    /// watched.
    fn samples<S: Scheme>(&self, scheme: S, watched: bool) -> (Vec<State<SceneModel<F64>>>, f64) {
        let evaluations = self.rate * self.time / SAMPLES as f64;
        let stride = (evaluations / f64::from(scheme.evaluations())).round() as u64;
        let h = self.time / (stride * SAMPLES) as f64;
        let mut plant = Plant::new(&self.model, scheme, h).unwrap();
        let start = energy(&self.model, plant.state(), h).total();
        let (mut states, mut square) = (Vec::new(), 0.0);
        for _ in 0..SAMPLES {
            for _ in 0..stride {
                plant.step().ok().unwrap();
                if watched {
                    let error = energy(&self.model, plant.state(), h).total() - start;
                    square += error * error;
                }
            }
            states.push(plant.state().clone());
        }
        (states, (square / (stride * SAMPLES) as f64).sqrt())
    }

    /// The largest distance \[m\] of a body from the truth over the samples.
    fn error(&self, states: &[State<SceneModel<F64>>]) -> f64 {
        let pairs = states.iter().zip(&self.truth.states[1..]);
        let errors = pairs.flat_map(|(run, truth)| {
            let bodies = run.bodies.iter().zip(truth.positions());
            bodies.map(|(body, at)| (Vector3::from(body.position.to_f64()) - at).norm())
        });
        errors.fold(0.0, f64::max)
    }
}

fn run(name: &str, rate: f64, time: f64) {
    let race = Race::new(name, rate, time);
    let doubt = race.truth.largest_uncertainty();
    // A load does work.
    let watched = race.model.loads.is_empty();
    println!("{name}, {rate:.2e} evaluations/s, first {time} s, truth known to {doubt:.1e} m");
    macro_rules! row {
        ($scheme:expr) => {{
            let (states, energy) = race.samples($scheme, watched);
            let (name, position) = (name_of($scheme), race.error(&states));
            let energy = if watched { format!("{energy:.1e} J") } else { "–".into() };
            println!("  {name:<20} {position:.1e} m  {energy}");
            position
        }};
    }
    let dbd = row!(Dbd::default());
    row!(DbdP1::default());
    row!(SemiImplicitEuler);
    let leapfrog = row!(Leapfrog);
    row!(Rk4);
    let pefrl = row!(Pefrl);
    let blanes_moan = row!(BlanesMoanS6);
    let best = pefrl.min(blanes_moan);
    let (gain, second) = (dbd / best, dbd / leapfrog);
    println!("  dbd's error: {gain:.0} times the best one's, {second:.1} times leapfrog's");
    assert!(doubt < 1e-2 * best, "{doubt:e} {best:e}");
    assert!(gain >= 1000.0 && second >= 5.0, "{name}: {gain} {second}");
}

fn name_of<S: Scheme>(_: S) -> &'static str {
    S::NAME
}

#[test]
fn four_bar() {
    run("four-bar", 1.05e5, 0.1);
}

#[test]
fn five_bar_b() {
    run("five-bar-b", 3.4e4, 0.1);
}

#[test]
fn six_bar() {
    run("six-bar", 3.6e4, 0.1);
}

#[test]
fn crank_slider() {
    run("crank-slider", 4.5e4, 0.1);
}
