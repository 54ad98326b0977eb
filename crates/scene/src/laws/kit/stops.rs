//! Stops and contacts.

use super::tests::{AXIS, BODIES, Cases, HINGE, POINTS, by_default};
use super::*;
use dbd_kernel::laws::{
    DistanceStop, EndStop, Hinge, HingeStop, PlaneContact, SoftDistanceStop, SoftEndStop,
    SoftHingeStop, SphereContact, WheelContact,
};

/// Ranges of stops: of travel, of a distance \[m\], of an angle \[rad\].
const TRAVELS: [[f64; 2]; 2] = [[0.0, 1e30], [-0.01, 0.01]];
const DISTANCES: [[f64; 2]; 3] = [[0.0, 0.03], [0.06, 1e30], [0.03, 0.05]];
const TURN: [f64; 2] = [-0.3, 0.2];

impl Cases for EndStop {
    fn cases() -> Vec<(Self, Poses)> {
        by_default(TRAVELS.map(|[from, to]| Self {
            bodies: BODIES,
            points: POINTS,
            normal: AXIS,
            from,
            to,
            stiffness: 1e5,
            dissipation: 0.5,
        }))
    }
}

impl Cases for SoftEndStop {
    fn cases() -> Vec<(Self, Poses)> {
        by_default(TRAVELS.map(|[from, to]| Self {
            bodies: BODIES,
            points: POINTS,
            normal: AXIS,
            from,
            to,
            stiffness: 1e5,
            soft: 0.02,
            dissipation: 0.5,
        }))
    }
}

impl Cases for DistanceStop {
    fn cases() -> Vec<(Self, Poses)> {
        by_default(DISTANCES.map(|[from, to]| Self {
            bodies: BODIES,
            points: POINTS,
            from,
            to,
            stiffness: 1e5,
            dissipation: 0.5,
        }))
    }
}

impl Cases for SoftDistanceStop {
    fn cases() -> Vec<(Self, Poses)> {
        by_default(DISTANCES.map(|[from, to]| Self {
            bodies: BODIES,
            points: POINTS,
            from,
            to,
            stiffness: 1e5,
            soft: 0.02,
            dissipation: 0.5,
        }))
    }
}

impl Cases for HingeStop {
    fn cases() -> Vec<(Self, Poses)> {
        let [from, to] = TURN;
        let (stiffness, dissipation) = (2e3, 0.4);
        by_default([Self { bodies: BODIES, axis: HINGE, from, to, stiffness, dissipation }])
    }
}

impl Cases for SoftHingeStop {
    fn cases() -> Vec<(Self, Poses)> {
        let [from, to] = TURN;
        let (stiffness, soft, dissipation) = (1e5, 0.3, 0.5);
        by_default([Self { bodies: BODIES, axis: HINGE, from, to, stiffness, soft, dissipation }])
    }
}

impl Cases for PlaneContact {
    fn cases() -> Vec<(Self, Poses)> {
        let contact = Self {
            bodies: BODIES,
            points: POINTS,
            normal: AXIS,
            radius: 0.02,
            stiffness: 1e5,
            dissipation: 0.5,
            friction: 0.4,
            shear: 0.8,
            damping: 20.0,
            rolling: 1e-3,
        };
        by_default([contact, Self { radius: 0.0, friction: 0.0, ..contact }])
    }
}

impl Cases for SphereContact {
    fn cases() -> Vec<(Self, Poses)> {
        let contact = Self {
            bodies: BODIES,
            points: POINTS,
            first_radius: 0.05,
            second_radius: 0.03,
            stiffness: 1e5,
            dissipation: 0.5,
            friction: 0.4,
            shear: 0.8,
            damping: 20.0,
            rolling: 1e-3,
        };
        let point = Self { first_radius: 0.0, ..contact };
        by_default([contact, point, Self { friction: 0.0, ..contact }])
    }
}

impl Cases for WheelContact {
    fn cases() -> Vec<(Self, Poses)> {
        let wheel = Self {
            bodies: BODIES,
            points: POINTS,
            normal: AXIS,
            axis: HINGE,
            radius: 0.06,
            tread: 0.01,
            stiffness: 1e5,
            dissipation: 0.5,
            friction: 0.4,
            slip_stiffness: 2e3,
            cornering_stiffness: 1.5e3,
            shear: 0.8,
            damping: 20.0,
            rolling: 1e-3,
        };
        let sharp = Self { tread: 0.0, ..wheel };
        let round = Self { tread: 0.06, cornering_stiffness: 0.0, ..wheel };
        let lies = Self { axis: Hinge { axis: AXIS, ..HINGE }, friction: 0.0, ..wheel };
        let turns = [0.05, 3.0].map(|turn| (lies, Poses { turn, ..Poses::default() }));
        [by_default([wheel, sharp, round]), turns.into()].concat()
    }
}
