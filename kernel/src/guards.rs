//! Guards of every step: what a step must not have made of a state.
//!
//! `(states, turn counts, h) => the first fault`. One pass over the bodies; turn counts only where a
//! model has torsion springs. What costs more than a step can bear is [`crate::watch`]'s.

use crate::attitude::Attitude as _;
use crate::body::BodyState;
use crate::geometry::Geometry;
use crate::index::{BodyIndex, TorsionIndex};
use crate::model::Terms;
use crate::real::{Constant, Real as _};
use crate::space::Linear as _;
use crate::status::Cause;
use crate::words::{Sums, Words as _, is_finite};

/// The first body with a number in its state that is infinite or NaN or that turns by more than `most` in a
/// step `h`, else the first turn count at its end.
#[inline]
pub(crate) fn first_fault<P: Geometry, T: Terms<P>>(
    bodies: &[BodyState<P>],
    turns: &[i32],
    (h, most): (P::Real, Constant),
) -> Option<Cause> {
    let most = P::Real::constant(most);
    if !are_well::<P>(bodies, h, most * most)
        && let Some(cause) = first_at_fault::<P>(bodies, h, most * most)
    {
        return Some(cause);
    }
    if T::TORSIONS {
        let ended = turns.iter().position(|turns| matches!(*turns, i32::MIN | i32::MAX))?;
        return Some(Cause::Turns { spring: TorsionIndex(ended as u16) });
    }
    None
}

/// Whether all bodies are well for sure: all their numbers in one sum, all their turns in another, and one
/// comparison for both.
#[inline]
fn are_well<P: Geometry>(bodies: &[BodyState<P>], h: P::Real, most: P::Real) -> bool {
    let (mut sums, mut squares) = (Sums::ZERO, P::Real::ZERO);
    for state in bodies {
        state.position.visit(&mut sums);
        state.orientation.visit(&mut sums);
        // What of a velocity is no number or infinite is so of its value, and of a spin of its square.
        P::velocity(&state.velocity).visit(&mut sums);
        sums.end();
        let rate = P::spin(&state.angular_velocity);
        squares = squares + rate.dot(rate);
    }
    // Half of what a body may turn, so that rounding has room. Taken away, for in double precision, which
    // has its numbers in integers, taking a constant 0 away is no operation.
    let nought = P::Real::from_f64(f64::from(sums.nought()));
    sums.are_finite() && squares * (h * h) - nought <= P::Real::HALF * most
}

/// Body by body: what may be at fault need not be.
#[cold]
#[inline(never)]
fn first_at_fault<P: Geometry>(
    bodies: &[BodyState<P>],
    h: P::Real,
    most: P::Real,
) -> Option<Cause> {
    for (row, state) in bodies.iter().enumerate() {
        let body = BodyIndex(row as u16);
        let turn = P::spin(&state.angular_velocity) * h;
        let slow = turn.dot(turn) <= most;
        if !is_finite(state) {
            return Some(Cause::NonFinite { body });
        }
        if !slow {
            return Some(Cause::Spin { body });
        }
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
