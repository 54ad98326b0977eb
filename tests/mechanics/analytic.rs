//! Closed forms: what the kernel computes against what is known exactly.

use dbd_kernel::energy::energy;
use dbd_kernel::{BodyIndex, BodyState, Dbd, F64, Leapfrog, Load, LoadFrame, Plant, Scheme, Vec3};
use dbd_tests::{Bench, at, run, turned};

const WORLD: BodyIndex = BodyIndex::WORLD;

/// 2 kg on a spring of 50 N/m along x, pulled out by 0.1 m.
fn oscillator(damping: f64) -> Bench<F64> {
    let mut model = Bench::new();
    let body = model.add_body(2.0, [0.1; 3], at([1.1, 0.0, 0.0])).unwrap();
    model.add_tsda([WORLD, body], [[0.0; 3]; 2], 50.0, damping, 1.0).unwrap();
    model
}

fn displacement<S: Scheme>(model: &Bench<F64>, scheme: S, h: f64, steps: u64) -> f64 {
    run(model, scheme, h, steps).bodies[0].position.x - 1.0
}

#[test]
fn mass_on_a_spring() {
    let model = oscillator(0.0);
    for steps in [100, 1_000, 10_000] {
        let exact = 0.1 * (5.0 * 1e-3 * steps as f64).cos();
        // Leapfrog: phase error (ω·h)²/24 per radian; dbd: half a step of phase.
        let phase = 5.0 * 1e-3 * steps as f64;
        let bound = 0.1 * (25e-6 / 24.0 * phase + 1e-9) * 1.1;
        let error = (displacement(&model, Leapfrog, 1e-3, steps) - exact).abs();
        assert!(error <= bound, "{error:e} {bound:e}");
        let error = (displacement(&model, Dbd::default(), 1e-3, steps) - exact).abs();
        assert!(error < 0.1 * 2.6e-3, "{error:e}");
    }
}

#[test]
fn damped_mass_on_a_spring() {
    // ζ = c/(2·√(k·m)) = 0.3: x = A·e^(−ζωt)·(cos ω_d t + ζ/√(1−ζ²)·sin ω_d t).
    let model = oscillator(6.0);
    let (omega, zeta) = (5.0_f64, 0.3_f64);
    let damped = omega * (1.0 - zeta * zeta).sqrt();
    let exact = |t: f64| {
        let (s, c) = (damped * t).sin_cos();
        0.1 * (-zeta * omega * t).exp() * (c + zeta * omega / damped * s)
    };
    for steps in [250, 1_000] {
        let t = 1e-3 * steps as f64;
        let error = (displacement(&model, Leapfrog, 1e-3, steps) - exact(t)).abs();
        assert!(error < 1e-6, "{error:e}");
        let error = (displacement(&model, Dbd::default(), 1e-3, steps) - exact(t)).abs();
        assert!(error < 3e-4, "{error:e}");
    }
}

#[test]
fn small_pendulum() {
    // A bob of 0.5 kg, its centre 1 m below a spherical tripod of stiff springs; physical
    // pendulum with I = 0.02 about the centre of mass: T = 2π·√((I + m·l²)/(m·g·l)).
    let (mass, inertia, length, g) = (0.5, 0.02, 1.0, 9.81);
    let mut model = Bench::<F64>::new();
    model.set_gravity([0.0, -g, 0.0]).unwrap();
    let tilt = 1e-3_f64;
    let state = BodyState::from_f64(
        [length * tilt.sin(), -length * tilt.cos(), 0.0],
        turned([0.0, 0.0, 1.0], tilt),
        [0.0; 3],
        [0.0; 3],
    );
    let body = model.add_body(mass, [inertia, 0.01, inertia], state).unwrap();
    let arm = 0.05;
    let arms = [[arm, length, 0.0], [0.0, length + arm, 0.0], [0.0, length, arm]];
    model
        .add_triples(dbd_kernel::builder::Triples {
            between: [WORLD, body],
            centres: &[[0.0; 3]],
            arms: &arms,
            stiffness: 1e6,
            damping: 0.0,
            free_length: arm,
            clearance: 0.0,
        })
        .unwrap();
    let period = 2.0
        * std::f64::consts::PI
        * ((inertia + mass * length * length) / (mass * g * length)).sqrt();
    let h = period / 20_000.0;
    let mut plant = Plant::new(&model, Leapfrog, h).unwrap();
    let start = plant.state().bodies[0].position.x;
    for _ in 0..20_000 {
        plant.step().unwrap();
    }
    let back = plant.state().bodies[0].position.x;
    // Over one period the bob returns; the springs' give (5 µm) and 1e-3 rad leave this much.
    assert!((back - start).abs() < 2e-5 * start.abs() + 1e-7, "{back} {start}");
    let half = run(&model, Leapfrog, h, 10_000).bodies[0].position.x;
    assert!((half + start).abs() < 1e-6, "{half}");
}

/// Kinetic energy and world angular momentum of a free asymmetric rotor, start and end.
fn rotor<S: Scheme>(scheme: S, h: f64, steps: u64) -> (f64, f64) {
    let inertia = [0.1, 0.2, 0.25];
    let mut model = Bench::<F64>::new();
    let rate = [0.02, 3.0, 0.01]; // close to the unstable middle axis: it tumbles
    let state = BodyState::from_f64([0.0; 3], [1.0, 0.0, 0.0, 0.0], [0.0; 3], rate);
    model.add_body(1.0, inertia, state).unwrap();
    let momentum = |state: &BodyState<F64>| {
        let spin = Vec3::from_f64(inertia).scale(state.angular_velocity);
        state.orientation.rotation().to_world(spin)
    };
    let mut plant = Plant::new(&model, scheme, h).unwrap();
    let (e0, l0) = (energy(&model, plant.state(), h).kinetic, momentum(&state));
    let (mut worst_energy, mut worst_momentum, mut tumbled) = (0.0_f64, 0.0_f64, false);
    for _ in 0..steps {
        plant.step().unwrap();
        let now = &plant.state().bodies[0];
        let e = energy(&model, plant.state(), h).kinetic;
        let d = momentum(now) - l0;
        worst_energy = worst_energy.max((e / e0 - 1.0).abs());
        worst_momentum = worst_momentum.max((d.dot(d) / l0.dot(l0)).sqrt());
        tumbled |= now.angular_velocity.y < 0.0;
    }
    assert!(tumbled, "the rotor is to turn over");
    (worst_energy, worst_momentum)
}

#[test]
fn free_asymmetric_rotor() {
    // Leapfrog: the splitting keeps the momentum to rounding, the energy to second order.
    let (energy, momentum) = rotor(Leapfrog, 1e-3, 20_000);
    assert!(momentum < 1e-11, "{momentum:e}");
    assert!(energy < 1e-5, "{energy:e}");
    let (finer, _) = rotor(Leapfrog, 5e-4, 40_000);
    assert!((energy / finer - 4.0).abs() < 0.1, "{energy:e} {finer:e}");
    // dbd is of first order in both, and the right sign of the gyroscopic term.
    let (energy, momentum) = rotor(Dbd::default(), 1e-3, 10_000);
    let (finer, finer_momentum) = rotor(Dbd::default(), 5e-4, 20_000);
    assert!(momentum < 2e-2 && energy < 4e-2, "{momentum:e} {energy:e}");
    assert!((momentum / finer_momentum - 2.0).abs() < 0.4, "{momentum:e} {finer_momentum:e}");
    assert!(finer < energy);
}

#[test]
fn a_load_accelerates_within_its_window_only() {
    let mut model = Bench::<F64>::new();
    let body = model.add_body(2.0, [0.1, 0.2, 0.25], at([0.0; 3])).unwrap();
    model
        .add_load(Load {
            body,
            frame: LoadFrame::World,
            force: Vec3::new(3.0, 0.0, 0.0),
            torque: Vec3::ZERO,
            from: 0.1,
            until: 0.3,
        })
        .unwrap();
    model
        .add_load(Load {
            body,
            frame: LoadFrame::Body,
            force: Vec3::ZERO,
            torque: Vec3::new(0.0, 0.0, 0.05),
            from: 0.0,
            until: f64::INFINITY,
        })
        .unwrap();
    for steps in [0_u64, 100, 200, 300, 1000] {
        let state = run(&model, Leapfrog, 1e-3, steps);
        let t = 1e-3 * steps as f64;
        let acting = (t - 0.1).clamp(0.0, 0.2);
        let body = &state.bodies[0];
        assert!((body.velocity.x - 1.5 * acting).abs() < 1e-12, "{t}");
        assert!((body.angular_velocity.z - 0.2 * t).abs() < 1e-12, "{t}");
        let dbd = run(&model, Dbd::default(), 1e-3, steps);
        assert!((dbd.bodies[0].velocity.x - 1.5 * acting).abs() < 1e-12, "{t}");
    }
}

#[test]
fn a_torsion_pendulum_turns_many_times_and_comes_back() {
    // I·θ̈ = −k·θ with θ(0) = 0 and θ̇(0) = 40 rad/s: θ = 40/ω·sin ω·t, ω = 2 rad/s, so ±20 rad.
    let mut model = Bench::<F64>::new();
    let state =
        BodyState::from_f64([0.0; 3], turned([0.0, 0.6, 0.8], 0.7), [0.0; 3], [0.0, 0.0, 40.0]);
    let body = model.add_body(1.0, [0.25; 3], state).unwrap();
    // The axis is the body's z axis at t = 0, in world axes.
    let axis = state.orientation.rotation().to_world(Vec3::new(0.0, 0.0, 1.0)).to_f64();
    model.add_torsion_spring([WORLD, body], axis, 1.0, 0.0, 0.0).unwrap();
    let quarter = run(&model, Leapfrog, std::f64::consts::PI / 40_000.0, 10_000);
    assert!(quarter.turns[0] == 3, "20 rad is three turns and a bit: {:?}", quarter.turns);
    assert!(quarter.bodies[0].angular_velocity.z.abs() < 1e-4);
    let whole = run(&model, Leapfrog, std::f64::consts::PI / 40_000.0, 40_000);
    assert_eq!(whole.turns[0], 0);
    assert!((whole.bodies[0].angular_velocity.z - 40.0).abs() < 1e-4);
}
