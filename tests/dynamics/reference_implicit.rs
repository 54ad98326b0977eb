//! Linearly implicit Euler: its order against the truth, its calm at steps no explicit scheme takes.

use dbd_kernel::{F64, ModelOwner};
use dbd_plant::frequencies::Frequencies;
use dbd_study::reference::implicit::Implicit;
use dbd_study::reference::trajectory::{Positions, sample_times};
use dbd_study::reference::{Mechanism, Trajectory};
use dbd_tests::{hung_ring, scene};

/// The error against the truth at `samples` samples with `steps` steps between them.
fn error<M: ModelOwner<Precision = F64>>(
    model: &M,
    reference_solution: &Trajectory,
    steps: u32,
) -> f64 {
    let (mechanism, start) = Mechanism::of_model(model);
    let step = reference_solution.times[1] / f64::from(steps);
    let mut run = Implicit::new(&mechanism, start, step);
    let mut positions: Vec<Positions> = vec![run.state.positions()];
    while positions.len() < reference_solution.times.len() {
        (0..steps).for_each(|_| run.step());
        positions.push(run.state.positions());
    }
    reference_solution.error(&positions)
}

fn reference_solution<M: ModelOwner<Precision = F64>>(
    model: &M,
    window: f64,
    samples: u32,
) -> Trajectory {
    let (mechanism, start) = Mechanism::of_model(model);
    Trajectory::reference_solution_of(&mechanism, &start, sample_times(window, samples)).unwrap()
}

#[test]
fn it_converges_with_order_1_on_every_kind_of_element() {
    for damping in [0.0, 2.0] {
        let model = hung_ring::<F64>(damping);
        let reference_solution = reference_solution(&model, 0.2, 4);
        let [coarse, fine] = [2_000, 4_000].map(|steps| error(&model, &reference_solution, steps));
        assert!((coarse / fine - 2.0).abs() < 0.1, "{damping}: {coarse:e} {fine:e}");
    }
}

/// The slow motion of a stiff mechanism, at steps that do not resolve its vibration: it starts at
/// rest with every spring at its free length, so that little of it is excited.
#[test]
fn it_converges_with_order_1_at_steps_beyond_the_explicit_limit() {
    let scene = scene("crank-slider");
    let reference_solution = reference_solution(&scene.model, 0.2, 10);
    let limit = 2.0 / Frequencies::of(&scene).bound;
    assert!(0.2 / 10.0 / 20.0 > 5.0 * limit, "{limit:e}");
    let [coarse, fine] = [10, 20].map(|steps| error(&scene.model, &reference_solution, steps));
    assert!((coarse / fine - 2.0).abs() < 0.2, "{coarse:e} {fine:e}");
}

/// The explicit limit is z = 2. Slow motions stay near the truth's; where torsion springs swing
/// within a few steps, as in the four-bar, they are damped, and nothing grows.
#[test]
fn large_steps_are_calm() {
    let slow = ["hexagon", "chain-closed", "crank-slider", "3ruu"].map(|name| (name, 0.03));
    for (name, share) in slow.into_iter().chain([("four-bar", 0.4)]) {
        let scene = scene(name);
        let reference_solution = reference_solution(&scene.model, 0.2, 10);
        let steps = 10;
        let z = Frequencies::of(&scene).estimate * reference_solution.times[1] / f64::from(steps);
        let start = reference_solution.states[0].positions();
        let moved = reference_solution
            .errors(&vec![start; reference_solution.times.len()])
            .into_iter()
            .fold(0.0, f64::max);
        let error = error(&scene.model, &reference_solution, steps);
        assert!(z > 10.0 && error < share * moved, "{name}: z = {z}, {error:e} of {moved:e}");
    }
}
