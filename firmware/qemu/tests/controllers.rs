//! The controllers' own source against the plants, on this machine: noise and counts are on.

use std::cell::RefCell;

use dbd_kernel::readouts::Readout;
use dbd_kernel::{F32, Leapfrog, Plant};
use dbd_node::{BridgePin, Channel, DutyEnd, Machine as _, Node, NodeDelay, SpiEnd};
use firmware::controllers::balance::{self, Balance};
use firmware::controllers::follow::{self, Follow};
use firmware::models::cart_pendulum::{
    CART_PENDULUM_F32, CART_PENDULUM_READOUT_ANGLE_F32, CART_PENDULUM_READOUT_CART_POINT_F32,
    CART_PENDULUM_STEP,
};
use firmware::models::delta_pick_and_place as delta;
use firmware::wiring;

/// How far \[m, rad\] cart and pendulum are off at most in the last of `seconds`, truly.
fn balanced(constants: balance::Constants, seconds: u32) -> [f32; 2] {
    let motor = RefCell::new(wiring::cart_motor());
    let cart = RefCell::new(wiring::cart_encoder());
    let pendulum = RefCell::new(wiring::pendulum_encoder());
    let plant = Plant::new(&CART_PENDULUM_F32, Leapfrog, CART_PENDULUM_STEP).unwrap();
    let node = RefCell::new(Node::new(plant, (&motor, &cart, &pendulum)).unwrap());
    let mut controller = Balance::new(
        SpiEnd::new(&cart).unwrap(),
        SpiEnd::new(&pendulum).unwrap(),
        DutyEnd::new(&motor, Channel::Forwards).unwrap(),
        BridgePin::direction(&motor).unwrap(),
        constants,
    );
    let mut delay = NodeDelay::new(&node);
    let mut furthest = [0.0_f32; 2];
    for second in 0..seconds {
        furthest = [0.0; 2];
        let look = |_| {
            let node = node.borrow();
            let read = |readout: &Readout<F32>| node.machine().read(readout).unwrap();
            let x = read(&CART_PENDULUM_READOUT_CART_POINT_F32).vector().unwrap().x;
            let angle = read(&CART_PENDULUM_READOUT_ANGLE_F32).scalar().unwrap();
            let axis_error = angle + 5_f32.to_radians();
            furthest = [furthest[0].max(x.abs()), furthest[1].max(axis_error.abs())];
        };
        controller.run(&mut delay, 1_000, look).unwrap();
        assert_eq!(node.borrow().machine().steps(), 2_000 * u64::from(second + 1));
    }
    assert_eq!(delay.fault(), None);
    furthest
}

#[test]
fn the_pendulum_stays_up() {
    let [cart, axis_error] = balanced(balance::Constants::IP02, 8);
    assert!(cart < 0.02 && axis_error < 0.02, "{cart} {axis_error}");
}

#[test]
fn a_wrong_gain_lets_it_fall() {
    let mut wrong = balance::Constants::IP02;
    wrong.gains[1] = -wrong.gains[1];
    let [_, axis_error] = balanced(wrong, 2);
    assert!(axis_error > 0.5, "{axis_error}");
}

/// How far \[m\] the tool is from its path at most after the first second, truly.
fn followed(constants: follow::Constants, ticks: u32) -> f32 {
    let motors = wiring::delta_motors().map(RefCell::new);
    let encoders = wiring::delta_encoders().map(RefCell::new);
    let parts = (motors.each_ref(), encoders.each_ref());
    let model = &delta::DELTA_PICK_AND_PLACE_F32;
    let plant = Plant::new(model, Leapfrog, delta::DELTA_PICK_AND_PLACE_STEP).unwrap();
    let node = RefCell::new(Node::new(plant, parts).unwrap());
    let arms = [0, 1, 2].map(|i| {
        (
            SpiEnd::new(&encoders[i]).unwrap(),
            DutyEnd::new(&motors[i], Channel::Forwards).unwrap(),
            BridgePin::direction(&motors[i]).unwrap(),
        )
    });
    let mut controller = Follow::new(arms, constants);
    let mut delay = NodeDelay::new(&node);
    let mut furthest = 0.0_f32;
    let look = |_| {
        let node = node.borrow();
        let time = node.time();
        let tool = node.machine().read(&delta::DELTA_PICK_AND_PLACE_READOUT_TOOL_POINT_F32);
        let tool = tool.unwrap().vector().unwrap();
        let [x, y, z] = follow::path(time as f32);
        let gap = ((tool.x - x).powi(2) + (tool.y - y).powi(2) + (tool.z - z).powi(2)).sqrt();
        if time > 1.0 {
            furthest = furthest.max(gap);
        }
    };
    controller.run(&mut delay, ticks, look).unwrap();
    assert_eq!(delay.fault(), None);
    assert_eq!(node.borrow().machine().steps(), 5 * u64::from(ticks));
    furthest
}

#[test]
fn the_tool_keeps_to_its_path() {
    let furthest = followed(follow::Constants::DELTA, 6_000);
    assert!(furthest > 1e-5 && furthest < 3e-3, "{furthest}");
}

#[test]
fn a_wrong_gain_loses_the_path() {
    let wrong = follow::Constants { spring: 0.0, ..follow::Constants::DELTA };
    let furthest = followed(wrong, 5_000);
    assert!(furthest > 3e-3, "{furthest}");
}
