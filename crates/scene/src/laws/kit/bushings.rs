//! The laws of bushings.

use super::*;
use dbd_kernel::BodyIndex;
use dbd_kernel::laws::{Bushing, BushingCurves, BushingMatrix, BushingMaxwell, Curve, Hinge, Ldl};

const BODIES: [BodyIndex; 2] = [BodyIndex(0), BodyIndex(1)];
const POINTS: [Vec3<f64>; 2] = [Vec3::new(0.02, 0.0, 0.01), Vec3::new(0.0, -0.03, 0.02)];
const X: Vec3<f64> = Vec3::new(0.8, 0.0, -0.6);
const Z: Hinge<f64> = Hinge { axis: Vec3::new(0.6, 0.0, 0.8), reference: Quaternion::IDENTITY };

#[test]
fn a_bushing_keeps_what_laws_promise() {
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
    hold(&bushing, Poses::default()).unwrap();
    let soft = Bushing { turn_stiffness_x: 0.0, damping_z: 0.0, ..bushing };
    hold(&soft, Poses::default()).unwrap();
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

#[test]
fn a_bushing_by_curves_keeps_what_laws_promise() {
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
    bushing.check().unwrap();
    hold(&bushing, Poses::default()).unwrap();
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

#[test]
fn a_bushing_by_a_matrix_keeps_what_laws_promise() {
    for rank in [1, 3, 6] {
        let bushing = BushingMatrix {
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
        bushing.check().unwrap();
        hold(&bushing, Poses::default()).unwrap();
        hold(&bushing, Poses { turn: 3.0, ..Poses::default() }).unwrap();
    }
}

#[test]
fn a_branch_of_a_bushing_keeps_what_laws_promise() {
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
    branch.check().unwrap();
    hold(&branch, Poses::default()).unwrap();
    let never = BushingMaxwell { relaxation: 0.0, ..branch };
    assert_eq!(never.check().unwrap_err().field, "relaxation");
}
