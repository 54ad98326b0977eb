//! The laws of bushings.

use super::tests::{BODIES, Cases, HINGE as Z, POINTS, by_default};
use super::*;
use dbd_kernel::laws::{Bushing, BushingCurves, BushingMatrix, BushingMaxwell, Curve, Ldl};

const X: Vec3<f64> = Vec3::new(0.8, 0.0, -0.6);

impl Cases for Bushing {
    fn cases() -> Vec<(Self, Poses)> {
        let bushing = Bushing {
            bodies: BODIES,
            points: POINTS,
            x: X,
            z: Z,
            stiffness_x: 2e5,
            stiffness_y: 5e4,
            stiffness_z: 9e4,
            turn_stiffness_x: 300.0,
            turn_stiffness_y: 20.0,
            turn_stiffness_z: 90.0,
            damping_x: 30.0,
            damping_y: 20.0,
            damping_z: 10.0,
            turn_damping_x: 0.3,
            turn_damping_y: 0.2,
            turn_damping_z: 0.1,
        };
        by_default([bushing, Bushing { turn_stiffness_x: 0.0, damping_z: 0.0, ..bushing }])
    }
}

/// A table with other slopes on both sides and a preload.
fn table(scale: f64) -> Curve<f64, 16> {
    let mut knots = [[0.0; 2]; 16];
    for (knot, [x, y]) in
        knots.iter_mut().zip([[-0.3, -80.0], [-0.02, -30.0], [0.01, 5.0], [0.05, 5.0], [0.2, 90.0]])
    {
        *knot = [x, scale * y];
    }
    Curve { knots, count: 5 }
}

/// 0 at any x.
fn none() -> Curve<f64, 16> {
    let mut curve = table(0.0);
    curve.count = 2;
    curve
}

impl Cases for BushingCurves {
    fn cases() -> Vec<(Self, Poses)> {
        let bushing = BushingCurves {
            bodies: BODIES,
            points: POINTS,
            x: X,
            z: Z,
            force_x: table(3.0),
            force_y: none(),
            force_z: table(7.0),
            torque_x: table(0.5),
            torque_y: table(0.2),
            torque_z: none(),
            damping_x: 30.0,
            damping_y: 0.0,
            damping_z: 10.0,
            turn_damping_x: 0.0,
            turn_damping_y: 0.2,
            turn_damping_z: 0.1,
        };
        by_default([bushing])
    }
}

#[test]
fn a_falling_curve_is_refused() {
    let [(bushing, _)] = BushingCurves::cases()[..] else { panic!() };
    let falling = BushingCurves { torque_y: table(-0.2), ..bushing };
    assert_eq!(falling.check().unwrap_err().field, "torque_y");
}

/// A full matrix B·Bᵀ, its displacements scaled.
fn matrix(rank: usize) -> Ldl<f64> {
    let b = |row: usize, column: usize| {
        let size = if row < 3 { 40.0 } else { 2.0 };
        size * (((row * row * column + 5 * column * column + 2 * row + 3) % 11) as f64 - 4.7)
    };
    let entry = |i, j| (0..rank).map(|k| b(i, k) * b(j, k)).sum();
    let rows: [[f64; 6]; 6] = std::array::from_fn(|i| std::array::from_fn(|j| entry(i, j)));
    Ldl::of(&rows).unwrap()
}

impl Cases for BushingMatrix {
    fn cases() -> Vec<(Self, Poses)> {
        let bushing = |rank| BushingMatrix {
            bodies: BODIES,
            points: POINTS,
            x: X,
            z: Z,
            matrix: matrix(rank),
            damping_time: 0.01,
            preload_x: 20.0,
            preload_y: -7.0,
            preload_z: 3.0,
            turn_preload_x: 0.4,
            turn_preload_y: -2.0,
            turn_preload_z: 1.0,
        };
        let turns = [1.0, 3.0].map(|turn| Poses { turn, ..Poses::default() });
        [1, 3, 6].into_iter().flat_map(|rank| turns.map(|poses| (bushing(rank), poses))).collect()
    }
}

impl Cases for BushingMaxwell {
    fn cases() -> Vec<(Self, Poses)> {
        let branch = BushingMaxwell {
            bodies: BODIES,
            points: POINTS,
            x: X,
            z: Z,
            relaxation: 0.02,
            stiffness_x: 2e5,
            stiffness_y: 5e4,
            stiffness_z: 0.0,
            turn_stiffness_x: 300.0,
            turn_stiffness_y: 20.0,
            turn_stiffness_z: 90.0,
        };
        by_default([branch])
    }
}

#[test]
fn a_relaxation_in_no_time_is_refused() {
    let [(branch, _)] = BushingMaxwell::cases()[..] else { panic!() };
    let never = BushingMaxwell { relaxation: 0.0, ..branch };
    assert_eq!(never.check().unwrap_err().field, "relaxation");
}
