//! The names in exported source, in one place: source that was exported compiles with later versions.
//!
//! `host-sim export` and build scripts write `use dbd_kernel::generated::*;`.

#[doc(no_inline)]
pub use crate::{
    body::{Body, BodyState},
    elements::input::{Input, InputKind, Knot},
    elements::load::{Load, LoadFrame},
    elements::point_bushing::PointBushing,
    elements::point_on_line::PointOnLine,
    elements::revolute::Revolute,
    elements::source::{Sensor, Source, SourceLaw},
    elements::torsion_spring::TorsionSpring,
    elements::tsda::Tsda,
    elements::universal::Universal,
    fixed::{Fixed, FixedPlace, FixedPoint, FixedTurn, FixedVelocity},
    geometry::{F32, F64},
    index::{
        BodyIndex, ClearanceIndex, DamperIndex, GroupIndex, InputIndex, LawIndex, TorsionIndex,
    },
    laws::{CoordinateKind, Curve, Hinge, Ldl, Term},
    model::{Group, Law, Model, Planned},
    planar::{Planar32, Planar64},
    plane::{Axial, Heading, Vec2},
    plant::{Plant, PlantError},
    readouts::{Readout, Slide},
    vector::{Quaternion, Vec3},
};
