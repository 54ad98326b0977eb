//! The names in exported source, in one place: source that was exported compiles with later versions.
//!
//! `host-sim export` and build scripts write `use dbd_kernel::generated::*;`.

pub use crate::body::{Body, BodyState};
pub use crate::elements::input::{Input, InputKind, Knot};
pub use crate::elements::load::{Load, LoadFrame};
pub use crate::elements::point_bushing::PointBushing;
pub use crate::elements::point_on_line::PointOnLine;
pub use crate::elements::revolute::Revolute;
pub use crate::elements::source::{Sensor, Source, SourceLaw};
pub use crate::elements::torsion_spring::TorsionSpring;
pub use crate::elements::tsda::Tsda;
pub use crate::elements::universal::Universal;
pub use crate::fixed::{Fixed, FixedPlace, FixedPoint, FixedTurn, FixedVelocity};
pub use crate::geometry::{F32, F64};
pub use crate::index::{BodyIndex, ClearanceIndex, DamperIndex, InputIndex, LawIndex};
pub use crate::laws::{CoordinateKind, Curve, Hinge, Ldl, Term};
pub use crate::model::{Group, Law, Model, Planned};
pub use crate::planar::{Planar32, Planar64};
pub use crate::plane::{Axial, Heading, Vec2};
pub use crate::plant::{Plant, PlantError};
pub use crate::readouts::{Readout, Slide};
pub use crate::vector::{Quaternion, Vec3};
