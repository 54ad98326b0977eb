//! Clearance: free flight within the dead band, a springy wall beyond it, energy kept.

use std::f64::consts::TAU;

use dbd_kernel::builder::{LineLaw, Triples};
use dbd_kernel::energy::energy;
use dbd_kernel::forces::wrenches;
use dbd_kernel::{BodyIndex, BodyState, Dbd, Explicit, F64, Leapfrog, Plant, Scheme, State, Vec3};
use dbd_tests::{Bench, at, distance};

const WORLD: BodyIndex = BodyIndex::WORLD;

/// A ball within a spherical joint of clearance 1 mm, thrown at 0.1 m/s along x.
fn approximate(damping: f64) -> Bench<F64> {
    let mut model = Bench::new();
    let thrown = BodyState { velocity: Vec3::new(0.1, 0.0, 0.0), ..at([0.0; 3]) };
    let body = model.add_body(1.0, [0.1; 3], thrown).unwrap();
    let arm = 0.05;
    let triples = Triples {
        between: [WORLD, body],
        centres: &[[0.0; 3]],
        arms: &[[arm, 0.0, 0.0], [0.0, arm, 0.0], [0.0, 0.0, arm]],
        stiffness: 1e5,
        damping,
        free_length: arm,
        clearance: 1e-3,
    };
    model.add_triples(triples).unwrap();
    model
}

#[test]
fn flight_is_free_within_the_band_and_bounces_at_its_edge() {
    let model = approximate(0.0);
    let h = 1e-5;
    let mut plant = Plant::new(&model, Leapfrog, h).unwrap();
    let start = energy(&model, plant.state(), h).total();
    let (mut furthest, mut worst, mut turned) = (0.0_f64, 0.0_f64, false);
    for _ in 0..100_000 {
        plant.step().unwrap();
        let body = plant.state().bodies[0];
        if body.position.x.abs() < 0.9e-3 {
            assert!((body.velocity.x.abs() - 0.1).abs() < 2e-4, "{:?}", body.velocity);
        }
        furthest = furthest.max(body.position.x.abs());
        turned |= body.velocity.x < -0.09;
        worst = worst.max((energy(&model, plant.state(), h).total() - start).abs());
    }
    // ½·m·v² = ½·k·x²: 0.32 mm beyond the edge. The flight bends a little, for the arms across
    // are stretched by it in second order.
    assert!(turned, "it is to come back");
    assert!((furthest - (1e-3 + 0.1 / 1e5_f64.sqrt())).abs() < 2e-5, "{furthest:e}");
    assert!(worst < 2e-2 * start, "{worst:e} of {start:e}");
}

#[test]
fn the_damper_acts_in_contact_only() {
    let model = approximate(30.0);
    let h = 1e-5;
    let mut plant = Plant::new(&model, Leapfrog, h).unwrap();
    let mut before = energy(&model, plant.state(), h).kinetic;
    let start = before;
    for _ in 0..100_000 {
        let x = plant.state().bodies[0].position.x;
        plant.step().unwrap();
        let now = energy(&model, plant.state(), h).kinetic;
        if x.abs() < 0.95e-3 && plant.state().bodies[0].position.x.abs() < 0.95e-3 {
            assert!((now - before).abs() < 1e-9 * start, "no force in flight");
        }
        before = now;
    }
    assert!(before < 0.5 * start, "every bounce takes something: {before:e} of {start:e}");
}

#[test]
fn a_point_on_a_line_has_play_across_it() {
    for free_length in [0.0, 0.02] {
        let mut model = Bench::<F64>::new();
        let body = model.add_body(1.0, [0.1; 3], at([0.3, free_length, 0.0])).unwrap();
        let law = LineLaw { stiffness: 1e4, damping: 0.0, free_length, clearance: 1e-3 };
        let line = [1.0, 0.0, 0.0];
        model.add_points_on_line([WORLD, body], [0.0; 3], line, &[[0.0; 3]], law).unwrap();
        let force = |y: f64| {
            let mut state = dbd_kernel::State::initial(&model);
            state.bodies[0].position.y = free_length + y;
            dbd_kernel::forces::wrenches(&model, &state, 1e-3).unwrap()[0].force.y
        };
        assert_eq!(force(0.9e-3), 0.0);
        assert!((force(3e-3) + 1e4 * 2e-3).abs() < 1e-9);
    }
}

/// The wrench's force on the first body with dampers, `set` putting it in its state.
fn force(model: &Bench<F64>, set: impl Fn(&mut BodyState<F64>)) -> Vec3<f64> {
    let mut state = State::initial(model);
    set(&mut state.bodies[0]);
    wrenches(model, &state, 1e-3).unwrap()[0].force
}

#[test]
fn the_damped_force_is_continuous_at_the_edge_and_dissipates() {
    let clearance = 1e-3;
    let mut tsda = Bench::<F64>::new();
    let body = tsda.add_body(1.0, [0.1; 3], at([0.0; 3])).unwrap();
    let triples = Triples {
        between: [WORLD, body],
        centres: &[[0.0; 3]],
        arms: &[[0.05, 0.0, 0.0]],
        stiffness: 0.0,
        damping: 40.0,
        free_length: 0.05,
        clearance,
    };
    tsda.add_triples(triples).unwrap();
    let mut line = Bench::<F64>::new();
    let body = line.add_body(1.0, [0.1; 3], at([0.0; 3])).unwrap();
    let law = LineLaw { stiffness: 0.0, damping: 40.0, free_length: 0.0, clearance };
    let axis = [0.0, 0.0, 1.0];
    line.add_points_on_line([WORLD, body], [0.0; 3], axis, &[[0.0; 3]], law).unwrap();
    for (name, model) in [("tsda", tsda), ("line", line)] {
        let mut last = 0.0;
        for n in -40..=40 {
            for speed in [-2.0, 2.0] {
                let x = 1e-4 * f64::from(n);
                let pull = force(&model, |body| {
                    body.position.x = x;
                    body.velocity.x = speed;
                });
                let share = ((x.abs() - clearance) / clearance).clamp(0.0, 1.0);
                let law = -share * 40.0 * speed;
                assert!((pull.x - law).abs() < 1e-9, "{name} at {x}: {} {law}", pull.x);
                assert!(pull.x * speed <= 0.0, "{name} at {x}");
                if speed > 0.0 {
                    // A tenth of a clearance further, a tenth of the damper more.
                    let jump = if n == -40 { 0.0 } else { pull.x - last };
                    assert!(jump.abs() < 0.1001 * 40.0 * speed, "{name} at {x}");
                    last = pull.x;
                }
            }
        }
    }
}

/// A pendulum on a revolute joint with play, thrown about within it, and its energy.
fn rattling<S: Scheme>(scheme: S, h: f64, time: f64) -> (State<Bench<F64>>, Vec<f64>) {
    let mut model = Bench::<F64>::new();
    model.set_gravity([0.0, -9.81, 0.0]).unwrap();
    let thrown = BodyState {
        velocity: Vec3::new(0.05, 0.02, 0.03),
        angular_velocity: Vec3::new(0.0, 0.0, 2.0),
        ..at([0.0, -0.3, 0.0])
    };
    let body = model.add_body(1.0, [0.02, 0.01, 0.02], thrown).unwrap();
    let (half, ring) = (0.03, 0.06 / 2_f64.sqrt());
    let tips: [[f64; 3]; 3] = std::array::from_fn(|j| {
        let (s, c) = (TAU / 3.0 * j as f64).sin_cos();
        [ring * c, 0.3 + ring * s, 0.0]
    });
    let triples = Triples {
        between: [WORLD, body],
        centres: &[[0.0, 0.0, -half], [0.0, 0.0, half]],
        arms: &tips,
        stiffness: 2e4,
        damping: 60.0,
        free_length: (half * half + ring * ring).sqrt(),
        clearance: 5e-4,
    };
    model.add_triples(triples).unwrap();
    let mut plant = Plant::new(&model, scheme, h).unwrap();
    let mut energies = vec![energy(&model, plant.state(), h).total()];
    for _ in 0..(time / h).round() as u64 {
        plant.step().unwrap();
        energies.push(energy(&model, plant.state(), h).total());
    }
    (plant.state().clone(), energies)
}

#[test]
fn a_moving_revolute_joint_with_play_loses_energy_and_gains_none() {
    for energies in [
        rattling(Leapfrog, 2e-5, 1.0).1,
        rattling(Explicit(Leapfrog), 2e-5, 1.0).1,
        rattling(Dbd::default(), 2e-5, 1.0).1,
    ] {
        let start = energies[0];
        let (mut lowest, mut gained) = (start, 0.0_f64);
        for now in &energies {
            gained = gained.max(now - lowest);
            lowest = lowest.min(*now);
        }
        let lost = start - energies[energies.len() - 1];
        assert!(lost > 1e-3, "{lost:e}");
        // What a conservative step lends for a while at a contact's edge, of the second order.
        assert!(gained < 1e-3 * lost, "{gained:e} of {lost:e}");
    }
}

#[test]
fn sweeps_and_explicit_dampers_agree_as_the_step_shrinks() {
    let apart = |h: f64| {
        let (swept, _) = rattling(Leapfrog, h, 0.1);
        let (explicit, _) = rattling(Explicit(Leapfrog), h, 0.1);
        distance(&swept.bodies, &explicit.bodies)
    };
    let [coarse, middle, fine] = [4e-5, 1e-5, 2.5e-6].map(apart);
    assert!(coarse < 1e-4, "{coarse:e}");
    assert!(middle < 0.4 * coarse && fine < 0.4 * middle, "{coarse:e} {middle:e} {fine:e}");
}
