//! Generalised-α of the references: second order on every kind of element, also at steps beyond every explicit limit
//! and with joints of 9e8 N/m.

use dbd_kernel::{F64, ModelOwner};
use dbd_plant::frequencies::Frequencies;
use dbd_scene::Scene;
use dbd_study::reference::generalized_alpha::GeneralizedAlpha;
use dbd_study::reference::implicit::Implicit;
use dbd_study::reference::trajectory::{Positions, sample_times};
use dbd_study::reference::{Mechanism, State, Trajectory};
use dbd_tests::{hung_ring, scene};

/// Positions after each of `samples` times `steps` steps of `step` \[s\].
fn run<M: ModelOwner<Precision = F64>>(
    model: &M,
    step: f64,
    [samples, steps]: [usize; 2],
    rho: f64,
) -> Vec<Positions> {
    let (mechanism, start) = Mechanism::of_model(model);
    let mut run = GeneralizedAlpha::new(&mechanism, start, step, rho);
    let mut positions = vec![run.state.positions()];
    while positions.len() <= samples {
        (0..steps).for_each(|_| run.step());
        positions.push(run.state.positions());
    }
    positions
}

/// The error against the truth with `steps` steps between two samples.
fn error<M: ModelOwner<Precision = F64>>(
    model: &M,
    reference_solution: &Trajectory,
    steps: usize,
) -> f64 {
    let step = reference_solution.times[1] / steps as f64;
    reference_solution.error(&run(
        model,
        step,
        [reference_solution.times.len() - 1, steps],
        GeneralizedAlpha::RHO,
    ))
}

#[test]
fn it_converges_with_order_2_on_every_kind_of_element() {
    for damping in [0.0, 2.0] {
        let model = hung_ring::<F64>(damping);
        let (mechanism, start) = Mechanism::of_model(&model);
        let reference_solution =
            Trajectory::reference_solution_of(&mechanism, &start, sample_times(0.2, 4)).unwrap();
        let [coarse, fine] = [2_000, 4_000].map(|steps| error(&model, &reference_solution, steps));
        assert!((coarse / fine - 4.0).abs() < 0.2, "{damping}: {coarse:e} {fine:e}");
    }
}

/// What a halved step divides the difference to the next one by, with
/// joints of the scene's stiffness times a hundred.
#[test]
fn it_converges_with_order_2_where_joints_are_all_but_rigid() {
    // Finer steps of the crank-slider differ by 1e-10 m, less than all of them leave out of how its joints shake.
    for (name, steps) in [("four-bar", 40_u32), ("3ruu", 40), ("crank-slider", 20)] {
        let step = 0.01 / f64::from(steps);
        let stiff: Scene = scene(name).with("joint.*.stiffness=9e8").unwrap();
        let limit = 2.0 / Frequencies::of(&stiff).bound;
        assert!(step > 20.0 * limit, "{name}: {limit:e}");
        let of = |part: u32| {
            let samples = [10, (steps * part) as usize];
            run(&stiff.model, step / f64::from(part), samples, GeneralizedAlpha::RHO)
        };
        let [coarse, middle, fine] = [1, 2, 4].map(of);
        let apart = |a: &[Positions], b: &[Positions]| {
            let pairs = a.iter().flatten().zip(b.iter().flatten());
            pairs.map(|(a, b)| (a - b).norm_squared()).sum::<f64>().sqrt()
        };
        let factor = apart(&coarse, &middle) / apart(&middle, &fine);
        println!("{name}: {factor:.3} at {step} s, {:.0} times the explicit limit", step / limit);
        assert!((factor - 4.0).abs() < 0.4, "{name}: {factor}");
    }
}

/// At the same step it is nearer to the truth than linearly implicit Euler, by far.
#[test]
fn it_beats_linearly_implicit_euler() {
    for name in ["crank-slider", "3ruu"] {
        let scene = scene(name);
        let (mechanism, start) = Mechanism::of(&scene);
        let reference_solution =
            Trajectory::reference_solution_of(&mechanism, &start, sample_times(0.1, 10)).unwrap();
        let own = error(&scene.model, &reference_solution, 20);
        let step = reference_solution.times[1] / 20.0;
        let mut euler = Implicit::new(&mechanism, start.clone(), step);
        let mut positions = vec![State::positions(&start)];
        while positions.len() < reference_solution.times.len() {
            (0..20).for_each(|_| euler.step());
            positions.push(euler.state.positions());
        }
        let other = reference_solution.error(&positions);
        println!("{name}: {own:e} m, linearly implicit Euler {other:e} m, at {step} s");
        assert!(own < 0.75 * other, "{name}: {own:e} {other:e}");
    }
}

/// ρ∞ = 0 takes an unresolved vibration away in a step or two, 0.8 keeps more of it; both stay bounded.
#[test]
fn more_of_a_fast_vibration_is_left_with_a_larger_rho() {
    let scene = scene("hexagon").with("joint.*.stiffness=9e8").unwrap();
    let (mechanism, mut start) = Mechanism::of(&scene);
    // A body off its place by a micrometre: 9e8 N/m pull it back.
    start.bodies[1].position.z += 1e-6;
    let left = |rho: f64| {
        let mut run = GeneralizedAlpha::new(&mechanism, start.clone(), 1e-3, rho);
        (0..12).for_each(|_| run.step());
        run.state.bodies[1].velocity.z.abs()
    };
    let [none, half, most] = [0.0, 0.5, 0.8].map(left);
    assert!(none < half && half < most && most < 1.0, "{none:e} {half:e} {most:e}");
}
