//! A pendulum on a revolute with every kind of element, written by hand.

use dbd_kernel::elements::load::{Load, LoadFrame};
use dbd_kernel::model::{Body, BodyIndex, DamperIndex, Group, Law, Model};
use dbd_kernel::{BodyState, F32, F64, PointBushing, Quaternion, TorsionSpring, Tsda, Vec3};

macro_rules! pendulum {
    ($model:ident, $table:ident, $precision:ty) => {
        /// The pendulum.
        pub type $model = Model<$precision, 2, 2, 7, 6, 1, 8, 1, 1, 1>;
        /// The pendulum.
        pub static $table: $model = Model {
            bodies: [Body {
                mass: 2.0,
                inertia: Vec3::new(0.5, 0.5, 0.25),
                inverse_mass: 0.5,
                inverse_inertia: Vec3::new(2.0, 2.0, 4.0),
                ratio: Vec3::new(0.5, 2.0, 1.0),
                inverse_ratio: Vec3::new(2.0, 0.5, 1.0),
            }; 2],
            initial: [
                BodyState {
                    position: Vec3::new(1.0, 0.0, 0.0),
                    orientation: Quaternion::new(1.0, 0.0, 0.0, 0.0),
                    velocity: Vec3::new(0.0, 0.0, 0.0),
                    angular_velocity: Vec3::new(0.0, 0.0, 0.0),
                },
                BodyState {
                    position: Vec3::new(2.0, 0.0, 0.0),
                    orientation: Quaternion::new(1.0, 0.0, 0.0, 0.0),
                    velocity: Vec3::new(0.0, 0.5, 0.0),
                    angular_velocity: Vec3::new(0.0, 0.0, 0.25),
                },
            ],
            gravity: [Vec3::new(0.0, -10.0, 0.0)],
            groups: [
                Group {
                    law: Law::Tsda,
                    a: BodyIndex::WORLD,
                    b: BodyIndex(0),
                    stars: 2,
                    arms: 3,
                    shared: true,
                    point: 0,
                    element: 0,
                    damper: DamperIndex(0),
                },
                Group {
                    law: Law::PointBushing,
                    a: BodyIndex(0),
                    b: BodyIndex(1),
                    stars: 1,
                    arms: 1,
                    shared: false,
                    point: 5,
                    element: 0,
                    damper: DamperIndex(6),
                },
            ],
            points: [
                Vec3::new(0.0, 0.0, 0.5),
                Vec3::new(0.0, 0.0, -0.5),
                Vec3::new(-0.75, 0.0, 0.0),
                Vec3::new(-1.125, 0.1875, 0.0),
                Vec3::new(-1.125, -0.1875, 0.0),
                Vec3::new(0.5, 0.0, 0.0),
                Vec3::new(-0.5, 0.0, 0.0),
            ],
            tsdas: [Tsda { stiffness: 5000.0, free_length: 0.25 }; 6],
            bushings: [PointBushing { stiffness: 5000.0 }],
            dampers: [0.5; 8],
            torsions: [TorsionSpring {
                a: BodyIndex(0),
                b: BodyIndex(1),
                axis: Vec3::new(0.0, 0.0, 1.0),
                reference: Quaternion::new(1.0, 0.0, 0.0, 0.0),
                stiffness: 4.0,
                preload: 0.0,
                damper: DamperIndex(7),
            }],
            lines: [],
            loads: [Load {
                body: BodyIndex(1),
                frame: LoadFrame::Body,
                force: Vec3::new(0.0, 1.0, 0.0),
                torque: Vec3::new(0.0, 0.0, 0.125),
                from: 0.125,
                until: 0.25,
            }],
        }
        .checked();
    };
}

pendulum!(PendulumF64, PENDULUM_F64, F64);
pendulum!(PendulumF32, PENDULUM_F32, F32);
