//! Springs and dampers by tables, winches, friction.

use super::tests::{AXIS, BODIES, Cases, HINGE, POINTS, by_default};
use super::*;
use dbd_kernel::laws::{
    Curve, DistanceDamper, DistanceSpring, DistanceWinch, HingeDamper, HingeFriction,
    HingeFrictionLoad, HingeSpring, SlideFriction, SlideFrictionLoad,
};
use dbd_kernel::{GroupIndex, InputIndex};

/// A table with separate slopes on both sides of each knot.
fn table() -> Curve<f64, 16> {
    let mut knots = [[0.0; 2]; 16];
    knots[..4].copy_from_slice(&[[-0.5, -80.0], [-0.05, -30.0], [0.0, 0.0], [0.03, 90.0]]);
    Curve { knots, count: 4 }
}

impl Cases for DistanceSpring {
    fn cases() -> Vec<(Self, Poses)> {
        by_default([Self { bodies: BODIES, points: POINTS, free_length: 0.06, force: table() }])
    }
}

impl Cases for DistanceDamper {
    fn cases() -> Vec<(Self, Poses)> {
        by_default([Self { bodies: BODIES, points: POINTS, force: table() }])
    }
}

impl Cases for HingeSpring {
    fn cases() -> Vec<(Self, Poses)> {
        by_default([Self { bodies: BODIES, axis: HINGE, torque: table() }])
    }
}

impl Cases for HingeDamper {
    fn cases() -> Vec<(Self, Poses)> {
        by_default([Self { bodies: BODIES, axis: HINGE, torque: table() }])
    }
}

impl Cases for DistanceWinch {
    fn cases() -> Vec<(Self, Poses)> {
        let rope = |[pulls, pushes]: [f64; 2]| Self {
            bodies: BODIES,
            points: POINTS,
            input: InputIndex(0),
            stiffness: 1e5,
            damping: 50.0,
            pulls,
            pushes,
        };
        let poses = Poses { input: 0.06, ..Poses::default() };
        [[1.0, 0.0], [0.0, 1.0], [1.0, 1.0]].map(|sides| (rope(sides), poses)).into()
    }
}

impl Cases for HingeFriction {
    fn cases() -> Vec<(Self, Poses)> {
        by_default([Self {
            bodies: BODIES,
            axis: HINGE,
            coulomb: 4.0,
            breakaway: 5.0,
            stribeck: 0.05,
            give: 1e-3,
            damping: 0.1,
            viscous: 0.2,
        }])
    }
}

impl Cases for SlideFriction {
    fn cases() -> Vec<(Self, Poses)> {
        by_default([Self {
            bodies: BODIES,
            points: POINTS,
            axis: AXIS,
            coulomb: 4.0,
            breakaway: 5.0,
            stribeck: 0.01,
            give: 1e-4,
            damping: 0.1,
            viscous: 0.2,
        }])
    }
}

impl Cases for HingeFrictionLoad {
    fn cases() -> Vec<(Self, Poses)> {
        by_default([Self {
            bodies: BODIES,
            axis: HINGE,
            joint: GroupIndex(0),
            mu: 0.1,
            radius: 0.02,
            force: 300.0,
            coulomb: 0.5,
            breakaway: 0.6,
            stribeck: 0.05,
            give: 1e-3,
            damping: 0.1,
            viscous: 0.2,
        }])
    }
}

impl Cases for SlideFrictionLoad {
    fn cases() -> Vec<(Self, Poses)> {
        by_default([Self {
            bodies: BODIES,
            points: POINTS,
            axis: AXIS,
            joint: GroupIndex(0),
            mu: 0.1,
            force: 300.0,
            coulomb: 4.0,
            breakaway: 5.0,
            stribeck: 0.01,
            give: 1e-4,
            damping: 0.1,
            viscous: 0.2,
        }])
    }
}
