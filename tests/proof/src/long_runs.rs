//! What drifts in a long run: the length of a quaternion, angular momentum, energy.
//!
//! `(steps, precision) => the largest changes`. A free body that tumbles with h·ω = 0.1, and a pendulum on
//! springs whose fastest vibration has ω·h = 0.3; leapfrog, which keeps the first's momentum and a
//! bounded error of the second's energy.

use dbd_kernel::builder::{ModelBuilder, Triples};
use dbd_kernel::energy::energy;
use dbd_kernel::{BodyIndex, BodyState, F64, Geometry, Leapfrog, Plant, State, Vec3};

/// The figures of a run, by name.
pub const LENGTH: &str = "quaternion's length";
pub const MOMENTUM: &str = "angular momentum";
pub const ENERGY: &str = "energy";
pub const ENERGY_MEAN: &str = "mean energy";

/// Samples of a run.
const SAMPLES: u64 = 1_000;

type Small<P> = ModelBuilder<P, 1, 1, 5, 6>;

/// The largest changes within a run.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Drift {
    /// Of a quaternion's length from 1.
    pub length: f64,
    /// Of angular momentum, world, in parts of it; of the pendulum none.
    pub momentum: Option<f64>,
    /// Of energy, in parts of the largest kinetic.
    pub energy: f64,
    /// Of the energy's mean from the first hundredth of the run to the last, in the same parts.
    pub energy_mean: f64,
}

/// The inertias of the free body.
const INERTIA: [f64; 3] = [0.5, 0.7, 1.1];

/// A free body with three different inertias that tumbles.
#[must_use]
pub fn tumbling<P: Geometry>(steps: u64) -> Drift {
    fn model<P: Geometry>() -> Small<P> {
        let mut model = Small::new();
        let rate = [1.3, -0.9, 2.1];
        let state = BodyState::from_f64([0.0; 3], [1.0, 0.0, 0.0, 0.0], [0.0; 3], rate);
        model.add_body(1.0, INERTIA, state).expect("there is room");
        model
    }
    let momentum = |body: &BodyState<F64>| {
        let spin = Vec3::from_f64(INERTIA).scale(body.angular_velocity);
        body.orientation.rotation().to_world(spin)
    };
    drift(model::<P>, model, 0.038, steps, Some(&momentum))
}

/// A pendulum on a spherical joint of springs that swings and turns.
#[must_use]
pub fn swinging<P: Geometry>(steps: u64) -> Drift {
    fn model<P: Geometry>() -> Small<P> {
        let mut model = Small::new();
        model.set_gravity([0.0, 0.0, -9.81]).expect("it is finite");
        let unturned = [1.0, 0.0, 0.0, 0.0];
        let state =
            BodyState::from_f64([0.5, 0.0, 0.0], unturned, [0.0, 0.4, 0.0], [1.0, 0.0, 0.8]);
        let body = model.add_body(1.0, [0.02, 0.05, 0.06], state).expect("there is room");
        let triples = Triples {
            between: [BodyIndex::WORLD, body],
            centres: &[[0.0; 3]],
            arms: &[[-0.3, 0.0, 0.1], [-0.6, 0.17, 0.1], [-0.6, -0.17, 0.1]],
            stiffness: 2_000.0,
            damping: 0.0,
            free_length: 0.22,
            clearance: 0.0,
        };
        model.add_triples(triples).expect("there is room");
        model
    }
    drift(model::<P>, model, 1e-3, steps, None)
}

type Momentum<'m> = &'m dyn Fn(&BodyState<F64>) -> Vec3<f64>;

/// `exact` is the same model in double precision, which tells the energy of a state in single.
fn drift<P: Geometry>(
    model: fn() -> Small<P>,
    exact: fn() -> Small<F64>,
    h: f64,
    steps: u64,
    momentum: Option<Momentum<'_>>,
) -> Drift {
    let (model, exact) = (model(), exact());
    let mut plant = Plant::new(&model, Leapfrog, h).expect("the step is one");
    let seen = |plant: &Plant<&Small<P>, Leapfrog>| {
        let mut state = State::initial(&exact);
        for (to, from) in state.bodies.iter_mut().zip(&plant.state().bodies) {
            *to = from.convert();
        }
        let all = energy(&exact, &state, h);
        (state.bodies.first().copied().unwrap_or_default(), all.kinetic, all.total())
    };
    let size = |v: Vec3<f64>| libm::sqrt(v.dot(v));
    let (body, mut kinetic, start) = seen(&plant);
    let first = momentum.map(|momentum| momentum(&body));
    let mut drift = Drift { momentum: first.map(|_| 0.0), ..Drift::default() };
    // Windows of the same length at both ends, each of samples at every step or nearly.
    let window = (steps / 100).clamp(1, 10_000);
    let mean = |plant: &mut Plant<&Small<P>, Leapfrog>| {
        let sum: f64 = (0..window)
            .map(|_| {
                let _ = plant.advance(1);
                seen(plant).2 - start
            })
            .sum();
        sum / window as f64
    };
    let early = mean(&mut plant);
    let between = steps - 2 * window;
    for n in 0..SAMPLES {
        let _ = plant.advance(between * (n + 1) / SAMPLES - between * n / SAMPLES);
        let (body, now_kinetic, total) = seen(&plant);
        let length = libm::sqrt(body.orientation.to_f64().iter().map(|c| c * c).sum());
        drift.length = drift.length.max((length - 1.0).abs());
        drift.energy = drift.energy.max((total - start).abs());
        kinetic = kinetic.max(now_kinetic);
        if let (Some(momentum), Some(first)) = (momentum, first) {
            let change = size(momentum(&body) - first) / size(first);
            drift.momentum = drift.momentum.map(|worst| worst.max(change));
        }
    }
    let late = mean(&mut plant);
    assert_eq!(plant.state().step, steps, "a step failed");
    drift.energy /= kinetic;
    drift.energy_mean = (late - early).abs() / kinetic;
    drift
}

#[cfg(test)]
mod tests {
    use super::*;
    use dbd_kernel::F32;
    use dbd_tests::page::{block, figure, table};
    use dbd_tests::results::rows;

    fn cells(name: &str, steps: &str, drift: Drift) -> Vec<String> {
        let digit = |value: f64| figure(value, 1);
        let momentum = drift.momentum.map_or_else(String::new, digit);
        let figures =
            [digit(drift.length), momentum, digit(drift.energy), digit(drift.energy_mean)];
        [name.to_owned(), steps.to_owned()].into_iter().chain(figures).collect()
    }

    #[test]
    fn long_runs_drift_as_written_in_the_page() {
        let mut lines = Vec::new();
        for (name, run, momentum, energy) in [
            ("free body, f64", tumbling::<F64> as fn(u64) -> Drift, 1e-12, 1e-3),
            ("free body, f32", tumbling::<F32>, 3e-4, 1e-3),
            ("pendulum, f64", swinging::<F64>, 0.0, 0.1),
            ("pendulum, f32", swinging::<F32>, 0.0, 0.1),
        ] {
            for steps in [1_000, 100_000] {
                let drift = run(steps);
                let rounding = if name.ends_with("64") { 1e-15 } else { 1e-6 };
                assert!(drift.length < rounding, "{name}: {drift:?}");
                assert!(drift.momentum.is_none_or(|change| change < momentum), "{name}: {drift:?}");
                assert!(drift.energy < energy && drift.energy > 0.0, "{name}: {drift:?}");
                lines.push(cells(name, &figure(steps as f64, 1), drift));
            }
            // What `cargo xtask prove` found.
            let long = [
                ("proof", "long run"),
                ("of", name.split(',').next().unwrap()),
                ("precision", &name[name.len() - 3..]),
            ];
            let found: Vec<_> =
                rows("docs/results/proof.csv").into_iter().filter(|row| row.is(&long)).collect();
            let value = |figure: &str| {
                found
                    .iter()
                    .find(|row| row.is(&[("figure", figure)]))
                    .map(|row| row.number("value"))
            };
            let drift = Drift {
                length: value(LENGTH).unwrap(),
                momentum: value(MOMENTUM),
                energy: value(ENERGY).unwrap(),
                energy_mean: value(ENERGY_MEAN).unwrap(),
            };
            lines.push(cells(name, &figure(found[0].number("inputs"), 1), drift));
        }
        let head = ["", "steps", "length", "angular momentum", "energy", "mean energy"];
        block("docs/extremes.md", "long runs", &table(&head, &lines));
    }
}
