//! Driven bodies: their velocities are those of their inputs.
//!
//! `(inputs, signals, orientations) => velocities`. During a step a driven body has the velocities at the middle of the
//! step, which moves it exactly at constant velocities and otherwise to second order; between steps it has those of its
//! present signals. Several inputs of one body add up in ascending order; without inputs it keeps its velocity.

use crate::body::BodyState;
use crate::elements::input::InputKind;
use crate::geometry::Geometry;
use crate::model::{ModelRef, Terms};
use crate::real::Real as _;
use crate::schedule::{self, KnotStep, Signal, StageTime};
use crate::sources::{self, SourceStep};
use crate::space::Linear as _;

/// Sets the velocities of driven bodies to those of the present signals.
#[inline(always)]
pub(crate) fn drive<P: Geometry, T: Terms<P>>(
    model: &ModelRef<'_, P, T>,
    signals: &[Signal<P::Real>],
    bodies: &mut [BodyState<P>],
) {
    if has_motions(model) {
        set(model, |row| signals.get(row).map_or(P::Real::ZERO, |signal| signal.value), bodies);
    }
}

/// The same with those at the middle of a step: tables and sines at that time, values of a caller as they are.
#[inline(always)]
pub(crate) fn drive_midway<P: Geometry, T: Terms<P>>(
    model: &ModelRef<'_, P, T>,
    (knots, sources): (&[KnotStep<P::Real>], &[SourceStep]),
    (step, h): (u64, P::Real),
    signals: &[Signal<P::Real>],
    bodies: &mut [BodyState<P>],
) {
    if !has_motions(model) {
        return;
    }
    let at = StageTime { step, part: P::Real::HALF, h };
    let value = |row: usize| {
        let table =
            model.inputs.get(row).and_then(|input| schedule::at(input, model.knots, knots, at));
        let mut signal = table.or(signals.get(row).copied()).unwrap_or_default();
        if T::SOURCES {
            for (source, step) in model.sources.iter().zip(sources) {
                if source.input.0 as usize == row
                    && let Some(now) = sources::at(source, model.knots, knots, step, at)
                {
                    signal = now;
                }
            }
        }
        signal.value
    };
    set(model, value, bodies);
}

/// Whether any input moves a body: models of all terms mostly have none.
#[inline(always)]
fn has_motions<P: Geometry, T: Terms<P>>(model: &ModelRef<'_, P, T>) -> bool {
    let moves = |kind: &InputKind<P>| {
        matches!(kind, InputKind::Velocity { .. } | InputKind::AngularVelocity { .. })
    };
    T::INPUTS && model.inputs.iter().any(|input| moves(&input.kind))
}

/// Sets the velocities of driven bodies to the values of their inputs.
// `always` would put it into every scheme twice.
#[inline]
fn set<P: Geometry, T: Terms<P>>(
    model: &ModelRef<'_, P, T>,
    value: impl Fn(usize) -> P::Real,
    bodies: &mut [BodyState<P>],
) {
    for (row, (body, state)) in model.bodies.iter().zip(bodies).enumerate() {
        if !body.is_driven() {
            continue;
        }
        let (mut linear, mut angular) = (None, None);
        for (number, input) in model.inputs.iter().enumerate() {
            match input.kind {
                InputKind::Velocity { body, direction } if body.row() == row => {
                    let own = direction * value(number);
                    linear = Some(linear.map_or(own, |sum| sum + own));
                }
                InputKind::AngularVelocity { body, axis } if body.row() == row => {
                    let own = axis * value(number);
                    angular = Some(angular.map_or(own, |sum| sum + own));
                }
                _ => {}
            }
        }
        if let Some(linear) = linear {
            state.velocity = P::Velocity::default();
            P::accelerate(&mut state.velocity, linear);
        }
        if let Some(angular) = angular {
            let mut frame = P::Frame::default();
            P::set_frame(&mut frame, &state.position, &state.orientation);
            let spin = P::moment_to_body(&frame, angular);
            // The orientation of a restored state may be no rotation; the step then fails by itself.
            if spin.dot(spin).is_finite() {
                state.angular_velocity = P::Spin::default();
                P::spin_up(&mut state.angular_velocity, spin);
            }
        }
    }
}
