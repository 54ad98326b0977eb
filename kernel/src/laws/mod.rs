//! Interactions: laws between two bodies, one type per file, in this crate or in a user's.
//!
//! `(law, two ends, memory) => force pair, dampers, energy, tangent`. A law is an [`Interaction`]; its constants are
//! declared by [`law!`](crate::law), which also defines how they are read from a scene, rounded to a precision, hashed
//! and exported. A model's type lists its laws as a tuple of tables, `Model<F32, 1, …, ([EndStop<F32>; 1],)>`; laws
//! that are not listed generate no code and no memory.
//!
//! The order of sums: after all groups and torsion springs, table by table as listed, row by row. Dampers act
//! likewise, in descending order in the second half of a step.
//!
//! A law gets its two bodies as [`Seen`]: points, velocities, the rotation of one body in the other. It returns a
//! [`ForcePair`] and [`Damper`]s, each along a [`Direction`]: a unit force or a unit moment on both bodies, so action
//! equals reaction and the power of a force along it is exactly force times rate.

#[macro_use]
mod declare;

/// All laws that scenes can name: `each_law!(with)` is `with! { Coupling, EndStop, … }`.
#[doc(hidden)]
#[macro_export]
macro_rules! each_law {
    ($with:ident) => {
        $with! {
            Coupling, EndStop, HingeStop, DistanceStop, SoftEndStop, SoftHingeStop,
            SoftDistanceStop, PlaneContact, SphereContact, WheelContact, Bushing, BushingCurves,
            BushingMatrix, BushingMaxwell, DistanceSpring, DistanceDamper, DistanceWinch,
            HingeSpring, HingeDamper, HingeFriction, SlideFriction, HingeServo, SlideServo,
            HingeDrive, SlideDrive, HingeDriveFriction, SlideDriveFriction, HingeSensor,
            SlideSensor, HingeActuator, SlideActuator, HingeDriveDq, HingeFrictionLoad,
            SlideFrictionLoad,
        }
    };
}

mod actuator;
mod branch;
mod branches;
mod brush;
mod bushing;
mod bushing_curves;
mod bushing_matrix;
mod bushing_maxwell;
mod contact;
mod coordinate;
mod coupling;
mod curve;
mod deflection;
mod distance_damper;
mod distance_spring;
mod distance_stop;
mod distance_winch;
mod end;
mod end_stop;
mod friction_load;
mod gear;
mod hinge;
mod hinge_damper;
mod hinge_drive;
mod hinge_drive_dq;
mod hinge_friction;
mod hinge_servo;
mod hinge_spring;
mod hinge_stop;
mod interaction;
mod kind;
mod ldl;
mod list;
mod machine;
mod plane_contact;
mod rotor;
mod row;
mod rows;
mod sensor;
mod servo;
mod several;
mod shaft_friction;
mod slide_drive;
mod slide_friction;
mod slide_servo;
mod slip;
mod sphere_contact;
mod stop;
mod tabled;
mod term;
mod wheel_contact;

pub use actuator::{Actuated, HingeActuator, SlideActuator};
pub use branch::{Branch, MAX_BRANCHES};
pub use branches::Branches;
pub use bushing::Bushing;
pub use bushing_curves::BushingCurves;
pub use bushing_matrix::BushingMatrix;
pub use bushing_maxwell::{BushingMaxwell, Relaxed};
pub use contact::Held;
pub use coordinate::TurnPose;
pub(crate) use coordinate::travel;
pub use coupling::{Coupling, Sum};
pub use curve::Curve;
pub use distance_damper::DistanceDamper;
pub use distance_spring::DistanceSpring;
pub use distance_stop::{DistanceStop, SoftDistanceStop};
pub use distance_winch::DistanceWinch;
pub(crate) use end::Body;
pub use end::{End, Instant, Seen};
pub use end_stop::{EndStop, SoftEndStop};
pub use friction_load::{HingeFrictionLoad, Loaded, SlideFrictionLoad};
pub use gear::Rotor;
pub use hinge::{Hinge, Turns, Twisted};
pub use hinge_damper::HingeDamper;
pub use hinge_drive::{HingeDrive, HingeDriveFriction, TurnRotor};
pub use hinge_drive_dq::{HingeDriveDq, WoundRotor};
pub use hinge_friction::{HingeFriction, TurnSlip};
pub use hinge_servo::HingeServo;
pub use hinge_spring::HingeSpring;
pub use hinge_stop::{HingeStop, SoftHingeStop};
pub use interaction::{
    Constants, Damper, Inner, Interaction, Law, Need, NoStorage, Quantity, Springs, Wrong,
};
#[doc(hidden)]
pub use kind::first;
pub use kind::{
    Axis, Axle, Count, Field, FieldSink, FieldSource, JointGroup, Kind, Matrix, Normal, Number,
    Points, Signal, Table, Terms,
};
pub use ldl::Ldl;
pub use list::Laws;
pub use machine::Currents;
pub use plane_contact::PlaneContact;
pub use row::{Act, DamperPass, GroupForces, Row};
#[doc(hidden)]
pub use rows::{act, memory, row, sweep};
pub use sensor::{HingeSensor, Sensed, SlideSensor};
pub use several::Several;
pub use slide_drive::{SlideDrive, SlideDriveFriction};
pub use slide_friction::SlideFriction;
pub use slide_servo::SlideServo;
pub use slip::Slip;
pub use sphere_contact::{Facing, SphereContact};
pub use term::{CoordinateKind, MAX_TERMS, Term};
pub use wheel_contact::{Rolled, WheelContact};

pub use crate::force_pair::Direction;
pub use crate::force_pair::ForcePair;

/// The imports for a file with a user-defined law: `use dbd_kernel::laws::prelude::*;`.
pub mod prelude {
    pub use super::{
        Damper, Direction, ForcePair, Hinge, Interaction, NoStorage, Quantity, Seen, Springs,
        Turns, Wrong,
    };
    pub use crate::space::{Linear as _, Moment as _, Space, Vector as _};
    pub use crate::words::{Word, WordSource, WordVisitor, Words};
    pub use crate::{BodyIndex, F64, Geometry, InputIndex, Real};
}
