//! Clearance: free flight within the dead band, a springy wall beyond it, energy kept.

use dbd_kernel::builder::{LineLaw, Stars};
use dbd_kernel::energy::energy;
use dbd_kernel::{BodyIndex, BodyState, F64, Leapfrog, Plant, Vec3};
use dbd_tests::{Bench, at};

const WORLD: BodyIndex = BodyIndex::WORLD;

/// A ball within a spherical joint of clearance 1 mm, thrown at 0.1 m/s along x.
fn loose(damping: f64) -> Bench<F64> {
    let mut model = Bench::new();
    let thrown = BodyState { velocity: Vec3::new(0.1, 0.0, 0.0), ..at([0.0; 3]) };
    let body = model.add_body(1.0, [0.1; 3], thrown).unwrap();
    let arm = 0.05;
    let stars = Stars {
        between: [WORLD, body],
        centres: &[[0.0; 3]],
        arms: &[[arm, 0.0, 0.0], [0.0, arm, 0.0], [0.0, 0.0, arm]],
        stiffness: 1e5,
        damping,
        free_length: arm,
        clearance: 1e-3,
    };
    model.add_stars(stars).unwrap();
    model
}

#[test]
fn flight_is_free_within_the_band_and_bounces_at_its_edge() {
    let model = loose(0.0);
    let h = 1e-5;
    let mut plant = Plant::new(&model, Leapfrog, h).unwrap();
    let start = energy(&model, plant.state(), h).total();
    let (mut furthest, mut worst, mut turned) = (0.0_f64, 0.0_f64, false);
    for _ in 0..100_000 {
        plant.step().ok().unwrap();
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
    let model = loose(30.0);
    let h = 1e-5;
    let mut plant = Plant::new(&model, Leapfrog, h).unwrap();
    let mut before = energy(&model, plant.state(), h).kinetic;
    let start = before;
    for _ in 0..100_000 {
        let x = plant.state().bodies[0].position.x;
        plant.step().ok().unwrap();
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
