//! Quaternions and Euler angles side by side: through the pole, and in every scheme.

use std::f64::consts::FRAC_PI_2;

use dbd_kernel::euler::{EulerF32, EulerF64};
use dbd_kernel::readouts::Readout;
use dbd_kernel::{
    BlanesMoanS6, BodyIndex, BodyState, Dbd, DbdP1, DbdP2, F32, F64, Geometry, Leapfrog, Pefrl,
    Plant, Quaternion, Real, Rk4, Scheme, SemiImplicitEuler, TorsionIndex, Vec3,
};
use dbd_scene::SceneModel;
use dbd_tests::page::{block, table};
use dbd_tests::{Bench, distance, hung_ring, run, scene, turned};

const INERTIA: [f64; 3] = [0.5, 0.7, 1.1];

/// The angular momentum \[kg·m²/s\] of the free body, world, from its stored words.
fn momentum<P: Geometry>(state: &BodyState<P>) -> Vec3<f64> {
    let state: BodyState<F64> = state.convert();
    let spin = Vec3::from_f64(INERTIA).scale(state.angular_velocity);
    state.orientation.rotation().to_world(spin)
}

/// The worst change of a free rotor's world angular momentum over 10 s, in parts of it. It turns
/// end over end with some 3 rad/s from a pitch of 79° and passes a pole at every half turn.
fn worst_change<P: Geometry>() -> f64 {
    let h = 1e-4;
    let mut model = Bench::<P>::new();
    let pose = turned([0.0, 1.0, 0.0], FRAC_PI_2 - 0.2);
    let state = BodyState::from_f64([0.0; 3], pose, [0.0; 3], [4e-3, 3.0, 3e-3]);
    model.add_body(1.0, INERTIA, state).unwrap();
    let mut plant = Plant::new(&model, Leapfrog, h).unwrap();
    let start = momentum(&plant.state().bodies[0]);
    let (mut worst, mut nearest) = (0.0_f64, 1.0_f64);
    for _ in 0..(10.0 / h).round() as u32 {
        plant.step().unwrap();
        let body: BodyState<F64> = plant.state().bodies[0].convert();
        let vertical = body.orientation.rotation().z;
        nearest = nearest.min(vertical.y.hypot(vertical.z));
        let change = momentum(&plant.state().bodies[0]) - start;
        worst = worst.max(change.dot(change).sqrt());
    }
    assert!(nearest < 2e-3, "the pole is to be passed closely: {nearest}");
    worst / start.dot(start).sqrt()
}

#[test]
fn through_the_pole() {
    let (quaternion, angles) = (worst_change::<F64>(), worst_change::<EulerF64>());
    assert!(quaternion < 5e-13 && angles < 5e-13, "{quaternion:e} {angles:e}");
    let (quaternion, angles) = (worst_change::<F32>(), worst_change::<EulerF32>());
    assert!(quaternion < 5e-4 && angles < 5e-4, "{quaternion:e} {angles:e}");
}

fn figure_of(change: f64) -> String {
    format!("{change:.1e}")
}

/// The worst change of a free asymmetric rotor's world angular momentum over 20 s, in parts of it,
/// in steps of `turn` \[rad\] of its spin.
fn worst_change_at<P: Geometry, S: Scheme>(scheme: S, turn: f64) -> f64 {
    let rate = Vec3::new(1.3, -0.9, 2.1);
    let h = turn / rate.dot(rate).sqrt();
    let mut model = Bench::<P>::new();
    let unturned = [1.0, 0.0, 0.0, 0.0];
    let state = BodyState::from_f64([0.0; 3], unturned, [0.0; 3], rate.to_f64());
    model.add_body(1.0, INERTIA, state).unwrap();
    let mut plant = Plant::new(&model, scheme, h).unwrap();
    let start = momentum(&plant.state().bodies[0]);
    let mut worst = 0.0_f64;
    for _ in 0..(20.0 / h).round() as u32 {
        plant.step().unwrap();
        let change = momentum(&plant.state().bodies[0]) - start;
        worst = worst.max(change.dot(change).sqrt());
    }
    worst / start.dot(start).sqrt()
}

#[test]
fn quaternions_keep_the_angular_momentum_to_rounding_and_angles_to_their_order() {
    let mut rows = Vec::new();
    for turn in [0.055, 0.11] {
        let [a, b] =
            [worst_change_at::<F64, _>(Leapfrog, turn), worst_change_at::<F64, _>(Pefrl, turn)];
        assert!(a < 5e-13 && b < 5e-13, "{turn}: {a:e} {b:e}");
        let [c, d] = [
            worst_change_at::<EulerF64, _>(Leapfrog, turn),
            worst_change_at::<EulerF64, _>(Pefrl, turn),
        ];
        assert!((1e-8..1e-5).contains(&c) && (1e-7..1e-4).contains(&d), "{turn}: {c:e} {d:e}");
        let cells = ["< 5e-13".into(), figure_of(c), "< 5e-13".into(), figure_of(d)];
        rows.push([format!("{turn}")].into_iter().chain(cells).collect());
    }
    let head = [
        "h·ω",
        "leapfrog, `quaternion`",
        "leapfrog, `euler-321`",
        "pefrl, `quaternion`",
        "pefrl, `euler-321`",
    ];
    block("docs/schemes-measured.md", "rotor", &table(&head, &rows));
    // Beyond the advised 0.1 rad the truncated turns of the rotor show.
    for (turn, largest) in [(0.3, 5e-13), (0.6, 2e-12), (0.95, 1e-9)] {
        for worst in
            [worst_change_at::<F64, _>(Leapfrog, turn), worst_change_at::<F64, _>(Pefrl, turn)]
        {
            assert!(worst < largest, "{turn}: {worst:e}");
        }
    }
    let single =
        [worst_change_at::<F32, _>(Leapfrog, 0.11), worst_change_at::<EulerF32, _>(Leapfrog, 0.11)];
    assert!(single.iter().all(|worst| *worst < 1e-3), "{single:?}");
}

/// The paper takes the velocity of a point from the difference of its last two positions. At
/// `coordinate` \[m\] and 1 m/s in steps of 20 µs: the root mean square and the largest error \[m/s\].
fn backward_difference<P: Geometry>(coordinate: f64) -> [f64; 2] {
    let h = 2e-5;
    let mut model = Bench::<P>::new();
    let state =
        BodyState::from_f64([coordinate; 3], [1.0, 0.0, 0.0, 0.0], [1.0, 0.7, -0.4], [0.0; 3]);
    model.add_body(1.0, INERTIA, state).unwrap();
    let mut plant = Plant::new(&model, Leapfrog, h).unwrap();
    let (mut squares, mut largest, steps) = (0.0, 0.0_f64, 2_000);
    let mut before: BodyState<F64> = plant.state().bodies[0].convert();
    for _ in 0..steps {
        plant.step().unwrap();
        let now: BodyState<F64> = plant.state().bodies[0].convert();
        for i in 0..3 {
            let rate = (now.position.to_f64()[i] - before.position.to_f64()[i]) / h;
            let error = rate - now.velocity.to_f64()[i];
            squares += error * error;
            largest = largest.max(error.abs());
        }
        before = now;
    }
    [(squares / f64::from(3 * steps)).sqrt(), largest]
}

#[test]
fn backward_differences_are_noisy() {
    for coordinate in [1.0, 2.0, 4.0] {
        let ([single, _], [double, _]) =
            (backward_difference::<F32>(coordinate), backward_difference::<F64>(coordinate));
        // A rounding of positions over a step.
        assert!((1e-3..2e-2).contains(&single) && double < 1e-9, "{single:e} {double:e}");
    }
}

/// The paper turns the world frame where a pitch comes close to ±90°, which a body that turns end
/// over end does twice a turn. Each time every coordinate of the model is rounded to new axes: how
/// far a point is off, in parts of its distance, after so many turns and as many back.
fn turned_frames<P: Geometry>(turns: u32) -> f64 {
    let point = Vec3::<f64>::new(1.3, -0.7, 0.9);
    let mut present = Vec3::<P::Real>::from_f64(point.to_f64());
    for i in 0..turns {
        for angle in [1.1 + 0.001 * f64::from(i), -1.1 - 0.001 * f64::from(i)] {
            let turn = Quaternion::<P::Real>::from_f64(turned([0.0, 0.6, 0.8], angle));
            present = turn.rotation().to_world(present);
        }
    }
    let moved = Vec3::<f64>::from_f64(present.to_f64()) - point;
    (moved.dot(moved) / point.dot(point)).sqrt()
}

#[test]
fn turning_the_world_frame_moves_what_it_holds() {
    let [once, often] = [1, 1_000].map(turned_frames::<F32>);
    let double = turned_frames::<F64>(1_000);
    assert!((1e-8..5e-7).contains(&once), "{once:e}");
    assert!(often > 3.0 * once && double < 1e-12, "{often:e} {double:e}");
}

/// Three bodies, tumbling, joined and hung, against their truth with quaternions.
struct Case {
    time: f64,
    reference_solution: Vec<BodyState<F64>>,
}

impl Case {
    fn new(time: f64) -> Self {
        let reference_solution = run(&hung_ring::<F64>(0.0), BlanesMoanS6, time / 8_000.0, 8_000);
        Self { time, reference_solution: reference_solution.bodies.to_vec() }
    }

    /// The error after so many steps with Euler angles, and how often a sequence changed.
    fn error<S: Scheme>(&self, scheme: S, steps: u64) -> (f64, usize) {
        let model = hung_ring::<EulerF64>(0.0);
        let mut plant = Plant::new(&model, scheme, self.time / steps as f64).unwrap();
        let mut changes = 0;
        for _ in 0..steps {
            let before = plant.state().bodies.clone();
            plant.step().unwrap();
            let pairs = before.iter().zip(&plant.state().bodies);
            changes +=
                pairs.filter(|(a, b)| a.orientation.sequence != b.orientation.sequence).count();
        }
        let end: Vec<_> = plant.state().bodies.iter().map(BodyState::convert).collect();
        (distance(&end, &self.reference_solution), changes)
    }

    fn check<S: Scheme>(&self, scheme: S, steps: u64) {
        let ((coarse, _), (fine, changes)) =
            (self.error(scheme, steps), self.error(scheme, 2 * steps));
        let order = (coarse / fine).log2();
        let name = S::NAME;
        assert!((order - f64::from(S::ORDER)).abs() < 0.1, "{name}: {order}");
        // The longer case passes one.
        assert!(self.time < 0.2 || changes > 0);
    }
}

#[test]
fn every_scheme_keeps_its_order() {
    let short = Case::new(0.1);
    short.check(Dbd::default(), 4_000);
    short.check(DbdP1::default(), 4_000);
    short.check(DbdP2::default(), 4_000);
    short.check(SemiImplicitEuler, 4_000);
    let long = Case::new(0.4);
    long.check(Leapfrog, 1_600);
    long.check(Pefrl, 800);
    long.check(BlanesMoanS6, 800);
    short.check(Rk4, 320);
}

#[test]
fn a_torsion_spring_winds_through_the_pole() {
    // The sign of the relative quaternion tells windings apart: it must not jump with the sequence.
    fn worst<P: Geometry>() -> f64 {
        let axis_b = Vec3::new(0.7, 0.7, 0.141_421_356_237_309_5);
        let mut model = Bench::<P>::new();
        let pose = turned([0.6, 0.0, 0.8], 2.5);
        let rate = (axis_b * 4.0).to_f64();
        let state = BodyState::from_f64([0.0; 3], pose, [0.0; 3], rate);
        let axis = Quaternion::from_f64(pose).rotation().to_world(axis_b).to_f64();
        let body = model.add_body(1.0, [0.25; 3], state).unwrap();
        model.add_torsion_spring([BodyIndex::WORLD, body], axis, 0.0, 0.0, 0.0).unwrap();
        let mut plant = Plant::new(&model, Pefrl, 1e-3).unwrap();
        let mut worst = 0.0_f64;
        for n in 1..=500 {
            plant.advance(10).unwrap();
            let angle = plant
                .read(&Readout::JointAngle {
                    spring: TorsionIndex(0),
                    offset: dbd_kernel::Real::ZERO,
                })
                .unwrap()
                .scalar()
                .unwrap();
            worst = worst.max((angle.to_f64() - 0.04 * f64::from(n)).abs());
        }
        worst
    }
    for worst in [worst::<F64>(), worst::<EulerF64>()] {
        assert!(worst < 1e-9, "{worst:e}");
    }
    let single_precision = worst::<EulerF32>();
    assert!(single_precision < 1e-3, "{single_precision:e}");
}

#[test]
fn mechanisms_move_alike() {
    for name in ["four-bar", "crank-slider", "3ruu"] {
        let scene = scene(name);
        let step = scene.step.unwrap();
        let by_quaternions = run(&scene.model, Leapfrog, step, 1_000);
        let model: SceneModel<EulerF64> = scene.model.convert();
        let by_angles = run(&model, Leapfrog, step, 1_000);
        let by_angles: Vec<_> = by_angles.bodies.iter().map(BodyState::convert).collect();
        let apart = distance(&by_quaternions.bodies, &by_angles);
        assert!(apart < 1e-9, "{name}: {apart:e}");
    }
}
