//! The forces and torques of inputs, added after the loads, in ascending order.
//!
//! `(inputs, signals, frames) => wrenches`. An anchor moves points instead, see [`crate::pose`].

use crate::elements::input::InputKind;
use crate::elements::load::LoadFrame;
use crate::forces::record::{Record, Wrench, apply};
use crate::geometry::Geometry;
use crate::index::BodyIndex;
use crate::model::{ModelRef, Terms};
use crate::pose::{End, Places, placed};
use crate::real::Real;
use crate::space::{Linear as _, Vector as _};

/// The forces and torques of inputs.
#[inline(always)]
pub(crate) fn push<P: Geometry, T: Terms>(
    model: &ModelRef<'_, P, T>,
    places: Places<'_, P>,
    wrenches: &mut [Wrench<P::Space>],
) {
    let turned = |body: BodyIndex, frame: LoadFrame, v: P::Vector| match frame {
        LoadFrame::World => v,
        LoadFrame::Body => End::new(model, places, body, None).to_world(v),
    };
    let turned_axis = |body: BodyIndex, frame: LoadFrame, m: P::Moment| match frame {
        LoadFrame::World => m,
        LoadFrame::Body => End::new(model, places, body, None).moment_to_world(m),
    };
    for (input, signal) in model.inputs.iter().zip(places.signals) {
        let value = signal.value;
        let zero = P::Moment::ZERO;
        match input.kind {
            InputKind::Force { body, point, direction, frame } => {
                let force = turned(body, frame, direction) * value;
                let (_, arm) = End::new(model, places, body, None).place(&point);
                let record = Record { force, torque_a: arm.cross(force), torque_b: zero };
                apply(wrenches, body.row(), BodyIndex::WORLD.row(), &record);
            }
            InputKind::Torque { body, axis, frame } => {
                let torque_a = turned_axis(body, frame, axis) * value;
                let record = Record { force: P::Vector::ZERO, torque_a, torque_b: zero };
                apply(wrenches, body.row(), BodyIndex::WORLD.row(), &record);
            }
            InputKind::JointTorque { a, b, axis } => {
                let torque = -(turned_axis(a, LoadFrame::Body, axis) * value);
                let record = Record { force: P::Vector::ZERO, torque_a: torque, torque_b: torque };
                apply(wrenches, a.row(), b.row(), &record);
            }
            InputKind::Actuator { group, element } => {
                let row = group as usize;
                let element = model
                    .groups
                    .get(row)
                    .and_then(|group| placed(model, places, (row, group), element as usize));
                let Some(element) = element else { continue };
                let d = element.stretch.displacement;
                let force = d * (value * d.dot(d).sqrt().reciprocal_or_zero());
                let torque_a = element.arm_a.cross(force);
                let record = Record { force, torque_a, torque_b: element.arm_b.cross(force) };
                apply(wrenches, element.group.a.row(), element.group.b.row(), &record);
            }
            InputKind::Anchor { .. } => {}
        }
    }
}
