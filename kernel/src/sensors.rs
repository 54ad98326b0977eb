//! Values of sensors of poses and velocities, and tables over them.
//!
//! `(sensor, model, state) => motion; tables over sensors, state => signals`, in the model's precision.

use crate::elements::source::{Sensor, SourceLaw};
use crate::geometry::Geometry;
use crate::index::{BodyIndex, TorsionIndex};
use crate::model::{FrameOf, ModelOwner, ModelRef, RealOf};
use crate::pose::{End, Places, place_bodies, torsion_angle_of};
use crate::real::Real;
use crate::schedule::{KnotStep, Signal};
use crate::sources::{over, put};
use crate::space::Linear as _;
use crate::state::State;
use crate::vector::Vec3;

/// The value of such a sensor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Motion<R> {
    /// An angle or a rate.
    Number(R),
    /// A position or a velocity, world axes.
    Vector(Vec3<R>),
}

/// The value of a sensor in a state; `None` where it refers to a part that the model lacks or the torsion angle is
/// undefined.
#[inline(always)]
pub(crate) fn motion<M: ModelOwner>(
    view: &ModelRef<'_, M::Precision, M::Terms>,
    places: Places<'_, M::Precision>,
    state: &State<M>,
    sensor: &Sensor<M::Precision>,
) -> Option<Motion<RealOf<M>>> {
    let bodies = state.bodies.as_ref();
    let end = |body: BodyIndex| End::new(view, places, body, Some(bodies));
    let there = |body: BodyIndex| bodies.get(body.row());
    let torsion_angle = |spring: TorsionIndex| {
        let turns = *RealOf::<M>::counts(state.turns.as_ref()).get(spring.row())?;
        let spring = view.torsions.get(spring.row())?;
        Some((spring, torsion_angle_of::<M::Precision>(spring, bodies, turns)?))
    };
    Some(match *sensor {
        Sensor::Angle { spring, offset } => Motion::Number(torsion_angle(spring)?.1.angle + offset),
        Sensor::Rate { spring } => {
            let (spring, torsion_angle) = torsion_angle(spring)?;
            let (a, b) = (end(spring.a), end(spring.b));
            Motion::Number(a.moment_to_axes(b.spin - a.spin).dot(torsion_angle.gradient))
        }
        Sensor::Point { body, point } => {
            let position = M::Precision::position(&there(body)?.position);
            Motion::Vector((position + end(body).place(&point).1).in_space())
        }
        Sensor::Velocity { body, point } => {
            there(body)?;
            let end = end(body);
            Motion::Vector(end.point_velocity(end.place(&point).1).in_space())
        }
    })
}

/// Samples the signals of tables over sensors in a state; returns whether any changed. An undefined torsion angle
/// leaves its signal unchanged.
pub(crate) fn sample_over<M: ModelOwner>(
    model: &M,
    state: &mut State<M>,
    knot_steps: &[KnotStep<RealOf<M>>],
) -> bool {
    let view = model.view();
    let mut changed = false;
    for source in view.sources {
        let SourceLaw::Over { sensor, weights, offset } = &source.law else { continue };
        let mut frames = model.per_body(FrameOf::<M>::default());
        place_bodies::<M::Precision>(state.bodies.as_ref(), frames.as_mut());
        let places = Places { frames: frames.as_ref(), signals: state.signals.as_ref() };
        let reading = match motion(&view, places, state, sensor) {
            Some(Motion::Number(value)) => weights[0] * value,
            Some(Motion::Vector(v)) => weights[0] * v.x + weights[1] * v.y + weights[2] * v.z,
            None => continue,
        };
        let (knots, steps) = (source.knots_of(view.knots), source.knots_of(knot_steps));
        let value = over(knots, steps, reading + *offset);
        let now = value.map(|value| Signal { value, rate: RealOf::<M>::ZERO });
        changed |= put(source, now, state.signals.as_mut());
    }
    changed
}
