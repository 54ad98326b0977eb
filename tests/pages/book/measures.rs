//! Short runs that the figures are drawn from.
//!
//! `(scene, scheme, precision, step) => error, energy, growth`.

use dbd_kernel::builder::ModelBuilder;
use dbd_kernel::energy::energy;
use dbd_kernel::{BodyIndex, BodyState, F64, Geometry, Plant, Scheme, State};
use dbd_scene::{Scene, SceneModel};
use dbd_tests::{Bench, distance};

/// The largest magnitude of an eigenvalue of one step of an undamped oscillator at z = ω·h.
pub fn growth<S: Scheme>(scheme: S, z: f64) -> f64 {
    let column = |x, v| {
        let mut model: Bench<F64> = ModelBuilder::new();
        let state =
            BodyState::from_f64([x, 0.0, 0.0], [1.0, 0.0, 0.0, 0.0], [v, 0.0, 0.0], [0.0; 3]);
        let body = model.add_body(1.0, [1.0; 3], state).unwrap();
        model.add_tsda([BodyIndex::WORLD, body], [[0.0; 3]; 2], 1.0, 0.0, 0.0).unwrap();
        let mut plant = Plant::new(&model, scheme, z).unwrap();
        plant.step().unwrap();
        let body = &plant.state().bodies[0];
        (body.position.x, body.velocity.x)
    };
    let ((a, c), (b, d)) = (column(1.0, 0.0), column(0.0, 1.0));
    let (half, determinant) = ((a + d) / 2.0, a * d - b * c);
    let discriminant = half * half - determinant;
    if discriminant > 0.0 { half.abs() + discriminant.sqrt() } else { determinant.sqrt() }
}

/// Times \[s\] and the largest |E − E(0)| \[J\] since the sample before, of a run in double precision.
pub fn deviation<S: Scheme>(
    scene: &Scene,
    scheme: S,
    step: f64,
    samples: u32,
    stride: u32,
) -> Vec<(f64, f64)> {
    let model = &scene.model;
    let mut plant = Plant::new(model, scheme, step).unwrap();
    let total = |plant: &Plant<&SceneModel<F64>, S>| energy(model, plant.state(), step).total();
    let start = total(&plant);
    let mut sample = || {
        let mut most = 0.0_f64;
        for _ in 0..stride {
            plant.step().unwrap();
            most = most.max((total(&plant) - start).abs());
        }
        (plant.time(), most)
    };
    (0..samples).map(|_| sample()).collect()
}

/// The states at equal distances in time, the last at `time` \[s\].
pub fn states<P: Geometry, S: Scheme>(
    scene: &Scene,
    scheme: S,
    steps: u64,
    time: f64,
) -> Vec<State<SceneModel<P>>> {
    let model: SceneModel<P> = scene.model.convert();
    let mut plant = Plant::new(&model, scheme, time / steps as f64).unwrap();
    let mut sample = || {
        plant.advance(steps / SAMPLES).ok()?;
        Some(plant.state().clone())
    };
    (0..SAMPLES).map_while(|_| sample()).collect()
}

/// How often a run is looked at.
pub const SAMPLES: u64 = 20;

/// The largest distance \[m\] of a body from the truth over the samples; none where the run failed.
pub fn error<P: Geometry>(
    run: &[State<SceneModel<P>>],
    reference_solution: &[State<SceneModel<F64>>],
) -> Option<f64> {
    let double = |state: &State<SceneModel<P>>| -> Vec<BodyState<F64>> {
        state.bodies.iter().map(|body| at(P::position_to_f64(&body.position))).collect()
    };
    let off = run
        .iter()
        .zip(reference_solution)
        .map(|(run, reference_solution)| distance(&double(run), &reference_solution.bodies));
    (run.len() == reference_solution.len()).then(|| off.fold(0.0, f64::max))
}

fn at(position: [f64; 3]) -> BodyState<F64> {
    dbd_tests::at(position)
}
