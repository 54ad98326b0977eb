//! Generated models in a crate that uses one of them: the others cost no warning, whatever lint
//! level the crate has.
#![deny(warnings)]

// In a module of its own and not public, as in a program.
mod models {
    include!(concat!(env!("OUT_DIR"), "/models.rs"));
}

use dbd_kernel::readouts::Reading;
use dbd_kernel::{BodyIndex, Leapfrog, Plant};
use models::cart_pendulum::{
    CART_PENDULUM_BODY_PENDULUM, CART_PENDULUM_INPUT_DRIVE, CART_PENDULUM_JOINT_PIVOT_BODIES,
    CART_PENDULUM_JOINT_PIVOT_FORCE_F32, CART_PENDULUM_JOINT_PIVOT_GROUPS, CART_PENDULUM_JOINTS,
    CART_PENDULUM_READOUT_ANGLE_F32, CartPendulumPlant,
};
use models::four_bar::{FOUR_BAR_F32, FOUR_BAR_STEP, FourBarPlantF32, plant_f32};

#[test]
fn a_program_that_uses_one_model_compiles_without_a_warning() {
    let mut plant = Plant::new(&FOUR_BAR_F32, Leapfrog, FOUR_BAR_STEP).unwrap();
    plant.step().unwrap();
}

#[test]
fn the_plant_of_one_call_is_the_one_of_its_parts() {
    let mut plant: FourBarPlantF32 = plant_f32().unwrap();
    let mut parts = Plant::new(&FOUR_BAR_F32, Leapfrog, FOUR_BAR_STEP).unwrap();
    assert!(plant.advance(10).is_ok() && parts.advance(10).is_ok());
    assert_eq!((plant.hash(), plant.state().step), (parts.hash(), 10));
}

#[test]
fn constants_name_what_the_scene_names() {
    let mut plant: CartPendulumPlant = models::cart_pendulum::plant().unwrap();
    assert_eq!(CART_PENDULUM_BODY_PENDULUM, BodyIndex(1));
    assert_eq!(CART_PENDULUM_JOINT_PIVOT_BODIES, [BodyIndex(0), BodyIndex(1)]);
    plant.set_input(CART_PENDULUM_INPUT_DRIVE, 0.5).unwrap();
    plant.advance(100).unwrap();
    let Some(Reading::Vector(force)) = plant.read(&CART_PENDULUM_JOINT_PIVOT_FORCE_F32) else {
        panic!()
    };
    // The pivot carries the pendulum's weight, 0.23 kg at 9.81 m/s², but for what vibrates.
    assert!((force.y - 2.26).abs() < 0.5, "{force:?}");
    assert!(plant.read(&CART_PENDULUM_READOUT_ANGLE_F32).and_then(Reading::scalar).is_some());
    assert_eq!((CART_PENDULUM_JOINTS[1], CART_PENDULUM_JOINT_PIVOT_GROUPS.len()), ("pivot", 1));
}
