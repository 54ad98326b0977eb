//! The gains of the balancing controllers are those of the linear system that the plant gives.
//!
//! `Linear, weights => gains`: K = R⁻¹BᵀP of the algebraic Riccati equation, whose solution spans the stable subspace of
//! the Hamiltonian matrix. The subspace comes from the matrix sign function (Roberts 1980).

use dbd_plant::instance::{Blueprint, Instance, Linear, LinearOptions, Settings};
use nalgebra::DMatrix;

use crate::balance::GAINS;
use crate::robot;

/// Files that repeat the gains of the example.
const FILES: [&str; 3] = [
    "firmware/qemu/src/controllers/balance.rs",
    "crates/fmu/examples/balance.py",
    "python/examples/swing.py",
];

/// The linear system of the upright pendulum, joints by a factor stiffer than the scene's.
fn upright(stiffer: f64) -> Linear {
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/../scenes/cart-pendulum.toml");
    let changes = [
        "body.pendulum.position=[0, 0.33, 0]".to_owned(),
        "body.pendulum.orientation={axis=[0,0,1], angle=0}".to_owned(),
        format!("joint.rail.stiffness={:?}", 1e5 * stiffer),
        format!("joint.pivot.stiffness={:?}", 8e4 * stiffer),
        "step=1e-5".to_owned(),
    ];
    let scene = changes.into_iter().fold(Blueprint::load(file).unwrap(), Blueprint::with);
    let plant = Instance::new(scene, Settings::default()).unwrap();
    let states = ["cart_point.x", "angle", "cart_velocity.x", "rate"].map(str::to_owned).to_vec();
    plant.linearise(&LinearOptions { states: Some(states), ..LinearOptions::default() }).unwrap()
}

/// The gains of the linear regulator for weights of the states and of each input: a row per input.
fn regulator(linear: &Linear, states: &[f64], input: f64) -> DMatrix<f64> {
    let (a, b, count) = (&linear.a, &linear.b, states.len());
    let q = DMatrix::from_diagonal(&nalgebra::DVector::from_column_slice(states));
    let mut sign = DMatrix::zeros(2 * count, 2 * count);
    sign.view_mut((0, 0), (count, count)).copy_from(a);
    sign.view_mut((0, count), (count, count)).copy_from(&(b * b.transpose() / -input));
    sign.view_mut((count, 0), (count, count)).copy_from(&-&q);
    sign.view_mut((count, count), (count, count)).copy_from(&-a.transpose());
    for _ in 0..60 {
        sign = (&sign + sign.clone().try_inverse().unwrap()) * 0.5;
    }
    // (sign + 1) [1; P] = 0.
    sign += DMatrix::identity(2 * count, 2 * count);
    let (known, of_p) = (sign.columns(0, count), sign.columns(count, count));
    let p = of_p.svd(true, true).solve(&-known, 1e-12).unwrap();
    let residual = a.transpose() * &p + &p * a - &p * b * b.transpose() * &p / input + q;
    assert!(residual.norm() < 1e-6 * p.norm(), "{residual}");
    b.transpose() * p / input
}

#[test]
fn the_gains_of_the_balance_example_come_from_the_linear_system() {
    let off = |stiffer: f64| {
        let found = regulator(&upright(stiffer), &[20.0, 50.0, 1.0, 1.0], 0.05);
        let off = found.iter().zip(GAINS).map(|(found, gain)| ((found - gain) / gain).abs());
        let off = off.fold(0.0, f64::max);
        println!("{stiffer} times as stiff: {found:?}, off by {off}");
        off
    };
    // The example's are those of rigid joints, to four digits.
    assert!(off(1.0) < 2e-3);
    assert!(off(100.0) < 3e-4);
    let written = GAINS.map(|gain| format!("{gain:?}")).join(", ");
    for file in FILES {
        let path = format!("{}/../{file}", env!("CARGO_MANIFEST_DIR"));
        assert!(std::fs::read_to_string(path).unwrap().contains(&written), "{file}: {written}");
    }
}

/// The robot's come from its linear system as it stands, without rolling resistance, which is dry friction.
#[test]
fn the_gains_of_the_robot_come_from_the_linear_system() {
    let file =
        concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/examples/balance-robot/balance-robot.toml");
    let scene =
        ["left", "right"].into_iter().fold(Blueprint::load(file).unwrap(), |scene, side| {
            scene.with(format!("interaction.{side}_tyre.rolling=0"))
        });
    let mut plant = Instance::new(scene, Settings::default()).unwrap();
    plant.advance_to(0.2).unwrap();
    let states = Some(robot::STATES.map(str::to_owned).to_vec());
    let linear = plant.linearise(&LinearOptions { states, ..LinearOptions::default() }).unwrap();
    assert_eq!(linear.inputs, robot::MOTORS);
    let found = regulator(&linear, &[300.0, 5.0, 5.0, 10.0, 0.1, 0.1], 1.0);
    // The right motor's gains are the left one's with left and right exchanged.
    for (row, order) in [[0, 1, 2, 3, 4, 5], [0, 2, 1, 3, 5, 4]].into_iter().enumerate() {
        let off = order.map(|column| found[(row, column)]).into_iter().zip(robot::GAINS);
        for (found, gain) in off {
            assert!((found - f64::from(gain)).abs() < 5e-3, "{found} {gain}");
        }
    }
}
