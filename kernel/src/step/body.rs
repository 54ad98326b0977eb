//! Kick and drift of one body.
//!
//! `(state, wrench, diagonal) => velocities; (state, time) => pose`, and the frame of the pose.

use crate::body::{Body, BodyState, Diagonal, Fall};
use crate::forces::Wrench;
use crate::geometry::Geometry;
use crate::model::Terms;
use crate::real::Real as _;
use crate::rotation;

/// `scale·(h·D⁻¹)·Q` for the velocities of one body, and the increment by gravity.
#[inline(always)]
pub(crate) fn kick_body<P: Geometry>(
    state: &mut BodyState<P>,
    wrench: &Wrench<P::Space>,
    diagonal: &Diagonal<P::Space>,
    (scale, fall): (P::Real, Fall<P::Vector>),
) {
    let increment = diagonal.increment(wrench.force, wrench.torque, scale);
    if let Some(change) = fall.of(diagonal) {
        P::apply_gravity(&mut state.velocity, change);
    }
    P::accelerate(&mut state.velocity, increment.linear);
    P::spin_up(&mut state.angular_velocity, increment.angular);
}

/// Moves one body in translation, and as a free rotor of second order; a driven one about its axis of rotation.
#[inline(always)]
pub(super) fn drift_body<P: Geometry, T: Terms<P>>(
    state: &mut BodyState<P>,
    body: &Body<P::Space>,
    time: P::Real,
) {
    P::advance_position(&mut state.position, &state.velocity, time);
    if T::DRIVEN && body.is_driven() {
        let half = P::spin(&state.angular_velocity) * (P::Real::HALF * time);
        return rotation::turn_by::<P>(&mut state.orientation, half);
    }
    rotation::free_rotor::<P>(body, &mut state.orientation, &mut state.angular_velocity, time);
}

/// [`drift_body`], and the frame of the new pose.
#[inline(always)]
pub(super) fn drift_to_frame<P: Geometry, T: Terms<P>>(
    state: &mut BodyState<P>,
    body: &Body<P::Space>,
    frame: &mut P::Frame,
    time: P::Real,
) {
    if P::RESTS && !(T::DRIVEN && body.is_driven()) {
        let BodyState { position, orientation, velocity, angular_velocity } = state;
        P::advance_position(position, velocity, time);
        rotation::turn_freely::<P>(body, orientation, angular_velocity, time);
        P::set_next_frame(frame, position, orientation);
    } else {
        drift_body::<P, T>(state, body, time);
        P::set_frame(frame, &state.position, &state.orientation);
    }
}

/// Half a kick and a drift of one body, and its frame. Not inlined: the long code gets all registers.
#[inline(never)]
pub(super) fn move_apart<P: Geometry, T: Terms<P>>(
    state: &mut BodyState<P>,
    body: &Body<P::Space>,
    frame: &mut P::Frame,
    (wrench, diagonal): (&Wrench<P::Space>, &Diagonal<P::Space>),
    change: P::Vector,
    time: P::Real,
) {
    let change = if P::HAS_GRAVITY_STEP && T::GRAVITY { Some(change) } else { None };
    let fall = Fall { change, driven: T::DRIVEN };
    kick_body(state, wrench, diagonal, (P::Real::HALF, fall));
    drift_to_frame::<P, T>(state, body, frame, time);
}
