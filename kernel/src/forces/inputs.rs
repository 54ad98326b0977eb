//! The forces and torques of inputs, added after the loads, in ascending order.
//!
//! `(inputs, signals, frames) => wrenches`. An anchor moves points instead, see [`crate::pose`].

use crate::elements::input::InputKind;
use crate::elements::load::LoadFrame;
use crate::elements::torsion_spring::gradient_between;
use crate::forces::record::{Record, Wrench, apply};
use crate::geometry::Geometry;
use crate::index::BodyIndex;
use crate::model::{ModelRef, Terms};
use crate::pose::{End, Places, placed};
use crate::real::Real;
use crate::space::{Linear as _, Vector as _};

/// The forces and torques of inputs.
#[inline(always)]
pub(crate) fn push<P: Geometry, T: Terms<P>>(
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
            InputKind::JointTorque { a, b, axes } => {
                let axis_a = turned_axis(a, LoadFrame::Body, axes[0]);
                let axis_b = turned_axis(b, LoadFrame::Body, axes[1]);
                let torque = -(gradient_between(axis_a, axis_b) * value);
                let record = Record { force: P::Vector::ZERO, torque_a: torque, torque_b: torque };
                apply(wrenches, a.row(), b.row(), &record);
            }
            InputKind::Actuator { group, .. } => {
                let Some(group) = model.groups.get(group as usize) else { continue };
                if let Some(record) = actuator(model, places, input.kind, value) {
                    apply(wrenches, group.a.row(), group.b.row(), &record);
                }
            }
            InputKind::Anchor { .. } => {}
        }
    }
}

/// What an actuator of the tension `value` \[N\] does to the two bodies of its TSDA.
#[inline(always)]
fn actuator<P: Geometry, T: Terms<P>>(
    model: &ModelRef<'_, P, T>,
    places: Places<'_, P>,
    kind: InputKind<P>,
    value: P::Real,
) -> Option<Record<P::Space>> {
    let InputKind::Actuator { group, element } = kind else { return None };
    let row = group as usize;
    let element = placed(model, places, (row, model.groups.get(row)?), element as usize)?;
    let d = element.stretch.displacement;
    let force = d * (value * d.dot(d).sqrt().reciprocal_or_zero());
    let torque_a = element.arm_a.cross(force);
    Some(Record { force, torque_a, torque_b: element.arm_b.cross(force) })
}

/// A group's `force` \[N\] on its first body with that of its actuators, world axes.
#[inline(always)]
pub(crate) fn with_actuators<P: Geometry, T: Terms<P>>(
    model: &ModelRef<'_, P, T>,
    places: Places<'_, P>,
    row: usize,
    mut force: P::Vector,
) -> P::Vector {
    for (input, signal) in model.inputs.iter().zip(places.signals) {
        if matches!(input.kind, InputKind::Actuator { group, .. } if group as usize == row)
            && let Some(record) = actuator(model, places, input.kind, signal.value)
        {
            force = force + record.force;
        }
    }
    force
}
