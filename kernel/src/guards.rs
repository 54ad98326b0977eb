//! Guards of every step: what a step must not have made of a state.
//!
//! `(states, turn counts, h) => the first fault`. One pass over the bodies; turn counts only where a
//! model has torsion springs. What costs more than a step can bear is [`crate::watch`]'s.

use crate::attitude::Attitude as _;
use crate::body::BodyState;
use crate::geometry::Geometry;
use crate::index::{BodyIndex, TorsionIndex};
use crate::model::Terms;
use crate::real::Real as _;
use crate::space::Linear as _;
use crate::status::{Cause, MOST_TURN};
use crate::words::is_finite;

/// The first body with a number in its state that is infinite or NaN or that turns too far in a
/// step, else the first turn count at its end.
#[inline]
pub(crate) fn first_fault<P: Geometry, T: Terms>(
    bodies: &[BodyState<P>],
    turns: &[i32],
    h: P::Real,
) -> Option<Cause> {
    // 1 rad: no conversion on a target without double precision.
    const { assert!(MOST_TURN == 1.0) };
    for (row, state) in bodies.iter().enumerate() {
        let body = BodyIndex(row as u16);
        let turn = P::spin(&state.angular_velocity) * h;
        let slow = turn.dot(turn) <= P::Real::ONE;
        if !is_finite(state) {
            return Some(Cause::NonFinite { body });
        }
        if !slow {
            return Some(Cause::Spin { body });
        }
    }
    if T::TORSIONS {
        let ended = turns.iter().position(|turns| matches!(*turns, i32::MIN | i32::MAX))?;
        return Some(Cause::Turns { spring: TorsionIndex(ended as u16) });
    }
    None
}

/// The first body whose orientation or place a precision of fixed point could not store.
#[inline]
pub(crate) fn first_beyond<P: Geometry>(bodies: &[BodyState<P>]) -> Option<Cause> {
    P::LIMITS?;
    for (row, state) in bodies.iter().enumerate() {
        let body = BodyIndex(row as u16);
        if state.orientation.is_lost() {
            return Some(Cause::Spin { body });
        }
        if !P::is_within(&state.position) {
            return Some(Cause::Extent { body });
        }
    }
    None
}
