//! Drives, and friction of a load.

use super::tests::{BODIES, end_stop, hinge};
use super::*;
use dbd_kernel::laws::{
    EndStop, HingeDrive, HingeDriveDq, HingeDriveFriction, HingeFrictionLoad, HingeServo,
    SlideDrive, SlideDriveFriction, SlideFrictionLoad, SlideServo,
};
use dbd_kernel::{GroupIndex, InputIndex};

#[test]
fn drives_keep_what_laws_promise() {
    let (poses, input, points) = (Poses::default(), InputIndex(0), end_stop(0.0).points);
    let axis = Vec3::new(0.0, 0.6, 0.8);
    let (servo_stiffness, servo_damping, feed, most) = (40.0, 3.0, 0.0, 5.0);
    let turn = HingeServo {
        bodies: BODIES,
        axis: hinge(),
        input,
        servo_stiffness,
        servo_damping,
        feed,
        most,
    };
    hold(&turn, poses).unwrap();
    let travel = SlideServo {
        bodies: BODIES,
        points,
        axis,
        input,
        servo_stiffness,
        servo_damping,
        feed,
        most,
    };
    hold(&travel, poses).unwrap();
    for (play, damping) in [(0.0, 0.0), (0.0, 0.7), (0.02, 0.7)] {
        let turn = HingeDrive {
            bodies: BODIES,
            axis: hinge(),
            input,
            gain: 0.0,
            servo_stiffness,
            servo_damping,
            feed,
            most,
            lag: 0.0,
            inertia: 0.05,
            stiffness: 2e3,
            damping,
            play,
        };
        hold(&turn, poses).unwrap();
        let travel = SlideDrive {
            bodies: BODIES,
            points,
            axis,
            input,
            gain: 0.0,
            servo_stiffness,
            servo_damping,
            feed,
            most,
            lag: 0.0,
            inertia: 0.05,
            stiffness: 2e3,
            damping,
            play,
        };
        hold(&travel, poses).unwrap();
        let HingeDrive { bodies, axis, gain, lag, inertia, stiffness, .. } = turn;
        let [coulomb, viscous] = [0.3, 0.02];
        let turn = HingeDriveFriction {
            bodies,
            axis,
            input,
            gain,
            servo_stiffness,
            servo_damping,
            feed,
            most,
            lag,
            inertia,
            stiffness,
            damping,
            play,
            coulomb,
            viscous,
        };
        hold(&turn, poses).unwrap();
        let SlideDrive { axis, .. } = travel;
        let travel = SlideDriveFriction {
            bodies,
            points,
            axis,
            input,
            gain,
            servo_stiffness,
            servo_damping,
            feed,
            most,
            lag,
            inertia,
            stiffness,
            damping,
            play,
            coulomb,
            viscous,
        };
        hold(&travel, poses).unwrap();
    }
}

#[test]
fn a_machine_keeps_what_laws_promise() {
    for (play, damping, resistance) in [(0.0, 0.0, 1.2), (0.0, 0.7, 0.0), (0.02, 0.7, 1.2)] {
        let turn = HingeDriveDq {
            bodies: BODIES,
            axis: hinge(),
            input: InputIndex(0),
            d_input: InputIndex(1),
            resistance,
            inductance_d: 2e-4,
            inductance_q: 3e-4,
            flux: 0.01,
            poles: 40.0,
            most_current: 20.0,
            lag: 0.0,
            inertia: 0.05,
            stiffness: 2e3,
            damping,
            play,
            coulomb: 0.3,
            viscous: 0.02,
        };
        hold(&turn, Poses::default()).unwrap();
    }
}

#[test]
fn friction_with_a_load_keeps_what_laws_promise() {
    let EndStop { bodies, points, normal, .. } = end_stop(0.0);
    let [mu, radius, force] = [0.1, 0.02, 300.0];
    let turn = HingeFrictionLoad {
        bodies,
        axis: hinge(),
        joint: GroupIndex(0),
        mu,
        radius,
        force,
        coulomb: 0.5,
        breakaway: 0.6,
        stribeck: 0.05,
        give: 1e-3,
        damping: 0.1,
        viscous: 0.2,
    };
    hold(&turn, Poses::default()).unwrap();
    let travel = SlideFrictionLoad {
        bodies,
        points,
        axis: normal,
        joint: GroupIndex(0),
        mu,
        force,
        coulomb: 4.0,
        breakaway: 5.0,
        stribeck: 0.01,
        give: 1e-4,
        damping: 0.1,
        viscous: 0.2,
    };
    hold(&travel, Poses::default()).unwrap();
}
