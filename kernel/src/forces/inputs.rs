//! The forces and torques of inputs, added after all others, in ascending order.
//!
//! `(inputs, signals, frames) => wrenches`, torques in body axes. The wrenches without inputs are stored separately, so
//! that setting an input needs no evaluation of the pose, except in a model with gravity as an input, which acts on every
//! body. An anchor moves points instead, see [`crate::pose`].

use crate::elements::gravity;
use crate::elements::input::{Input, InputKind};
use crate::elements::load::LoadFrame;
use crate::elements::torsion_spring::gradient_between;
use crate::forces::force_pair::{ForcePair, Wrench};
use crate::geometry::Geometry;
use crate::index::BodyIndex;
use crate::model::{ModelRef, Terms};
use crate::pose::{End, Places, placed};
use crate::real::Real;
use crate::schedule::Signal;
use crate::space::{Linear as _, Vector as _};

/// The wrenches of the two bodies of each input without any input.
pub(crate) type Unpushed<S> = [Wrench<S>; 2];

/// The two bodies of an input.
#[inline(always)]
fn bodies_of<P: Geometry, T: Terms<P>>(
    model: &ModelRef<'_, P, T>,
    kind: &InputKind<P>,
) -> [BodyIndex; 2] {
    let world = BodyIndex::WORLD;
    match *kind {
        InputKind::Force { body, .. } | InputKind::Torque { body, .. } => [body, world],
        InputKind::JointTorque { a, b, .. } | InputKind::JointForce { a, b, .. } => [a, b],
        InputKind::Actuator { group, .. } => {
            model.groups.get(group.row()).map_or([world; 2], |group| [group.a, group.b])
        }
        // Others act on all bodies or on none; listed, they would leave a trap in the target's jump table.
        _ => [world; 2],
    }
}

/// Whether any input may act on a body.
pub(crate) fn acts_on<P: Geometry, T: Terms<P>>(model: &ModelRef<'_, P, T>, row: usize) -> bool {
    let bodies = |input: &Input<P>| bodies_of(model, &input.kind);
    model.inputs.iter().any(|input| bodies(input).iter().any(|body| body.row() == row))
}

/// Stores the wrenches before [`push`].
#[inline(always)]
pub(crate) fn keep<P: Geometry, T: Terms<P>>(
    model: &ModelRef<'_, P, T>,
    wrenches: &[Wrench<P::Space>],
    unpushed: &mut [Unpushed<P::Space>],
) {
    for (input, unpushed) in model.inputs.iter().zip(unpushed) {
        for (body, kept) in bodies_of(model, &input.kind).into_iter().zip(unpushed) {
            if let Some(wrench) = wrenches.get(body.row()) {
                *kept = *wrench;
            }
        }
    }
}

/// Restores the wrenches from before [`push`]; `false` where gravity is an input: its bodies' wrenches are not kept.
#[inline(always)]
pub(crate) fn take_back<P: Geometry, T: Terms<P>>(
    model: &ModelRef<'_, P, T>,
    unpushed: &[Unpushed<P::Space>],
    wrenches: &mut [Wrench<P::Space>],
) -> bool {
    for (input, unpushed) in model.inputs.iter().zip(unpushed) {
        for (body, kept) in bodies_of(model, &input.kind).into_iter().zip(unpushed) {
            if let Some(wrench) = wrenches.get_mut(body.row()) {
                *wrench = *kept;
            }
        }
    }
    !model.inputs.iter().any(|input| matches!(input.kind, InputKind::Gravity { .. }))
}

/// Adds a record, torques in world axes, to wrenches whose torques are in body axes.
#[inline(always)]
fn add<P: Geometry>(
    places: Places<'_, P>,
    wrenches: &mut [Wrench<P::Space>],
    bodies: [BodyIndex; 2],
    force_pair: &ForcePair<P::Space>,
) {
    let rows = bodies.map(BodyIndex::row);
    let parts =
        [(force_pair.force, force_pair.torque_a), (-force_pair.force, -force_pair.torque_b)];
    for (row, (force, torque)) in rows.into_iter().zip(parts) {
        if let (Some(wrench), Some(frame)) = (wrenches.get_mut(row), places.frames.get(row)) {
            wrench.force = wrench.force + force;
            wrench.torque = wrench.torque + P::moment_to_body(frame, torque);
        }
    }
}

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
    let (world, zero) = (BodyIndex::WORLD, P::Moment::ZERO);
    for (input, signal) in model.inputs.iter().zip(places.signals) {
        let value = signal.value;
        let (bodies, force_pair) = match input.kind {
            InputKind::Force { body, point, direction, frame } => {
                let force = turned(body, frame, direction) * value;
                let (_, arm) = End::new(model, places, body, None).place(&point);
                ([body, world], ForcePair { force, torque_a: arm.cross(force), torque_b: zero })
            }
            InputKind::Torque { body, axis, frame } => {
                let torque_a = turned_axis(body, frame, axis) * value;
                ([body, world], ForcePair { force: P::Vector::ZERO, torque_a, torque_b: zero })
            }
            InputKind::JointTorque { a, b, axes } => {
                let axis_a = turned_axis(a, LoadFrame::Body, axes[0]);
                let axis_b = turned_axis(b, LoadFrame::Body, axes[1]);
                let torque = -(gradient_between(axis_a, axis_b) * value);
                let force = P::Vector::ZERO;
                ([a, b], ForcePair { force, torque_a: torque, torque_b: torque })
            }
            InputKind::JointForce { a, b, point, axis } => {
                let force = -(turned(a, LoadFrame::Body, axis) * value);
                let [arm_a, arm_b] = common_point(model, places, [a, b], &point);
                let (torque_a, torque_b) = (arm_a.cross(force), arm_b.cross(force));
                ([a, b], ForcePair { force, torque_a, torque_b })
            }
            InputKind::Actuator { .. } => match actuator(model, places, input.kind, value) {
                Some(force_pair) => (bodies_of(model, &input.kind), force_pair),
                None => continue,
            },
            InputKind::Gravity { direction } => {
                let field = direction * value;
                for (body, wrench) in model.bodies.iter().zip(wrenches.iter_mut()) {
                    wrench.force = wrench.force + gravity::weight(body.mass, field);
                }
                continue;
            }
            // Signals, anchors and the motion of driven bodies; as above.
            _ => continue,
        };
        add(places, wrenches, bodies, &force_pair);
    }
}

/// \[m/s²\] the model's gravity and that of its inputs, world axes.
pub(crate) fn field<P: Geometry, T: Terms<P>>(
    model: &ModelRef<'_, P, T>,
    signals: &[Signal<P::Real>],
) -> P::Vector {
    let mut field = model.gravity.first().copied().unwrap_or(P::Vector::ZERO);
    for (input, signal) in model.inputs.iter().zip(signals) {
        if let InputKind::Gravity { direction } = input.kind {
            field = field + direction * signal.value;
        }
    }
    field
}

/// \[m\] the lever arms of a point of B from the centres of mass of A, unused for the ground, and of B, world.
#[inline(always)]
fn common_point<P: Geometry, T: Terms<P>>(
    model: &ModelRef<'_, P, T>,
    places: Places<'_, P>,
    [a, b]: [BodyIndex; 2],
    point: &P::Local,
) -> [P::Vector; 2] {
    let centre = End::new(model, places, a, None).place(&P::Local::default()).0;
    let (at, arm) = End::new(model, places, b, None).place(point);
    [P::displacement(&centre, &at), arm]
}

/// The forces of an actuator of tension `value` \[N\] on the two bodies of its TSDA.
#[inline(always)]
fn actuator<P: Geometry, T: Terms<P>>(
    model: &ModelRef<'_, P, T>,
    places: Places<'_, P>,
    kind: InputKind<P>,
    value: P::Real,
) -> Option<ForcePair<P::Space>> {
    let InputKind::Actuator { group, element } = kind else { return None };
    let row = group.row();
    let element = placed(model, places, (row, model.groups.get(row)?), element as usize)?;
    let d = element.deformation.displacement;
    let force = d * (value * d.dot(d).sqrt().reciprocal_or_zero());
    let torque_a = element.arm_a.cross(force);
    Some(ForcePair { force, torque_a, torque_b: element.arm_b.cross(force) })
}

/// A group's `force` \[N\] on its first body including its actuators, world axes.
#[inline(always)]
pub(crate) fn with_actuators<P: Geometry, T: Terms<P>>(
    model: &ModelRef<'_, P, T>,
    places: Places<'_, P>,
    row: usize,
    mut force: P::Vector,
) -> P::Vector {
    for (input, signal) in model.inputs.iter().zip(places.signals) {
        if matches!(input.kind, InputKind::Actuator { group, .. } if group.row() == row)
            && let Some(force_pair) = actuator(model, places, input.kind, signal.value)
        {
            force = force + force_pair.force;
        }
    }
    force
}
