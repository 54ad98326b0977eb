//! Servos and drives.

use super::tests::{AXIS, BODIES, Cases, HINGE, POINTS, by_default};
use super::*;
use dbd_kernel::InputIndex;
use dbd_kernel::laws::{
    HingeDrive, HingeDriveDq, HingeDriveFriction, HingeServo, SlideDrive, SlideDriveFriction,
    SlideServo,
};

const INPUT: InputIndex = InputIndex(0);
/// Play \[rad, m\] and damping of gears.
const GEARS: [(f64, f64); 3] = [(0.0, 0.0), (0.0, 0.7), (0.02, 0.7)];

impl Cases for HingeServo {
    fn cases() -> Vec<(Self, Poses)> {
        by_default([Self {
            bodies: BODIES,
            axis: HINGE,
            input: INPUT,
            servo_stiffness: 40.0,
            servo_damping: 3.0,
            feed: 0.0,
            most: 5.0,
        }])
    }
}

impl Cases for SlideServo {
    fn cases() -> Vec<(Self, Poses)> {
        by_default([Self {
            bodies: BODIES,
            points: POINTS,
            axis: AXIS,
            input: INPUT,
            servo_stiffness: 40.0,
            servo_damping: 3.0,
            feed: 0.0,
            most: 5.0,
        }])
    }
}

/// Cases of a drive, with further constants.
macro_rules! drives {
    ($($law:ident { $($place:ident: $at:expr),+ } $({ $($more:ident: $value:expr),+ })?;)+) => {
        $(impl Cases for $law {
            fn cases() -> Vec<(Self, Poses)> {
                by_default(GEARS.map(|(play, damping)| Self {
                    bodies: BODIES,
                    $($place: $at,)+
                    input: INPUT,
                    gain: 0.0,
                    servo_stiffness: 40.0,
                    servo_damping: 3.0,
                    feed: 0.0,
                    most: 5.0,
                    lag: 0.0,
                    inertia: 0.05,
                    stiffness: 2e3,
                    damping,
                    play,
                    $($($more: $value,)+)?
                }))
            }
        })+
    };
}

drives! {
    HingeDrive { axis: HINGE };
    SlideDrive { points: POINTS, axis: AXIS };
    HingeDriveFriction { axis: HINGE } { coulomb: 0.3, viscous: 0.02 };
    SlideDriveFriction { points: POINTS, axis: AXIS } { coulomb: 0.3, viscous: 0.02 };
}

impl Cases for HingeDriveDq {
    fn cases() -> Vec<(Self, Poses)> {
        let drive = |((play, damping), resistance)| Self {
            bodies: BODIES,
            axis: HINGE,
            input: INPUT,
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
        by_default(GEARS.into_iter().zip([1.2, 0.0, 1.2]).map(drive))
    }
}
