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
use dbd_study::reference::Trajectory;
use dbd_tests::page::{block, figure, table};
use dbd_tests::scene;
use nalgebra::Vector3;

/// A mechanism, its force evaluations per simulated second and the time looked at \[s\].
struct Race {
    model: SceneModel<F64>,
    rate: f64,
    time: f64,
    /// The truth at t = 0 and at the samples.
    reference_solution: Trajectory,
}

/// Samples over the time.
const SAMPLES: u64 = 20;

impl Race {
    fn new(name: &str, rate: f64, time: f64) -> Self {
        let scene = scene(name);
        let reference_solution =
            Trajectory::reference_solution(&scene, time, SAMPLES as u32).unwrap();
        Self { model: scene.model.convert(), rate, time, reference_solution }
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
                plant.step().unwrap();
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
        let pairs = states.iter().zip(&self.reference_solution.states[1..]);
        let errors = pairs.flat_map(|(run, reference_solution)| {
            let bodies = run.bodies.iter().zip(reference_solution.positions());
            bodies.map(|(body, at)| (Vector3::from(body.position.to_f64()) - at).norm())
        });
        errors.fold(0.0, f64::max)
    }
}

/// What a scheme is off by: the trajectory \[m\] and, where it is watched, the energy \[J\].
type Errors = (&'static str, f64, Option<f64>);

fn run(name: &str, rate: f64) -> Vec<Errors> {
    let race = Race::new(name, rate, 0.1);
    let doubt = race.reference_solution.largest_uncertainty();
    // A load does work.
    let watched = race.model.loads.is_empty();
    fn row<S: Scheme>(race: &Race, scheme: S, watched: bool) -> Errors {
        let (states, energy) = race.samples(scheme, watched);
        (S::NAME, race.error(&states), watched.then_some(energy))
    }
    let rows = vec![
        row(&race, DbdP1::default(), watched),
        row(&race, Dbd::default(), watched),
        row(&race, SemiImplicitEuler, watched),
        row(&race, Leapfrog, watched),
        row(&race, Rk4, watched),
        row(&race, Pefrl, watched),
        row(&race, BlanesMoanS6, watched),
    ];
    let error = |scheme: &str| rows.iter().find(|row| row.0 == scheme).unwrap().1;
    let best = error("pefrl").min(error("blanes-moan-s6"));
    let [gain, second] = [best, error("leapfrog")].map(|other| error("dbd") / other);
    assert!(doubt < 1e-2 * best, "{doubt:e} {best:e}");
    assert!(gain >= 1000.0 && second >= 5.0, "{name}: {gain} {second}");
    // Each is better than the one before it; the last two are about as good.
    for pair in rows[..6].windows(2) {
        assert!(pair[1].1 < pair[0].1, "{name}: {pair:?}");
    }
    assert!(error("blanes-moan-s6") < 2.0 * error("pefrl"), "{name}: {rows:?}");
    rows
}

const RACES: [(&str, f64, &str); 4] = [
    ("four-bar", 1.05e5, "1.05e5"),
    ("five-bar-b", 3.4e4, "3.4e4"),
    ("six-bar", 3.6e4, "3.6e4"),
    ("crank-slider", 4.5e4, "4.5e4"),
];

#[test]
fn at_equal_cost_the_schemes_differ_by_their_order() {
    let columns = std::thread::scope(|scope| {
        RACES
            .map(|(name, rate, _)| scope.spawn(move || run(name, rate)))
            .map(|race| race.join().unwrap())
    });
    let mut rows: Vec<Vec<String>> = Vec::new();
    for (i, (scheme, ..)) in columns[0].iter().enumerate() {
        let cells = columns.each_ref().map(|column| match column[i] {
            (_, error, Some(energy)) => format!("{error:.1e} / {}", figure(energy, 2)),
            (_, error, None) => format!("{error:.1e}"),
        });
        rows.push([format!("`{scheme}`")].into_iter().chain(cells).collect());
    }
    for other in ["pefrl", "leapfrog"] {
        let ratio = columns.each_ref().map(|column| {
            let of = |scheme: &str| column.iter().find(|row| row.0 == scheme).unwrap().1;
            figure(of("dbd") / of(other), 2)
        });
        let title = format!("dbd's error over {other}'s");
        rows.push([title].into_iter().chain(ratio).collect());
    }
    let head = RACES.map(|(name, _, rate)| format!("{name}, {rate} /s"));
    let head: Vec<&str> = [""].into_iter().chain(head.iter().map(String::as_str)).collect();
    block("docs/schemes-measured.md", "accuracy", &table(&head, &rows));
}
