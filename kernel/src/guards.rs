//! Guards of every step: conditions that a state must fulfil after it.
//!
//! `(states, revolution counts, h) => the first fault`. One pass over the bodies; revolution counts only where a model
//! has torsion springs. More expensive checks are in [`crate::watch`].

use crate::attitude::Attitude as _;
use crate::body::BodyState;
use crate::geometry::Geometry;
use crate::index::{BodyIndex, TorsionIndex};
use crate::model::Terms;
use crate::real::{Constant, Real as _};
use crate::space::Linear as _;
use crate::status::Cause;
use crate::words::{Sums, Words as _, is_finite};

/// The first body with a number in its state that is infinite or NaN or that rotates by more than `most` in a step `h`,
/// else the first revolution count that overflowed.
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

/// Whether all bodies are certainly valid: all their numbers in one sum, all their rotations in another, and one
/// comparison for both.
#[inline]
fn are_well<P: Geometry>(bodies: &[BodyState<P>], h: P::Real, most: P::Real) -> bool {
    let (mut sums, mut squares) = (Sums::ZERO, P::Real::ZERO);
    for state in bodies {
        state.position.visit(&mut sums);
        state.orientation.visit(&mut sums);
        // A velocity's NaN or infinity carries over to its value, that of an angular velocity to its square.
        P::velocity(&state.velocity).visit(&mut sums);
        sums.end();
        let rate = P::spin(&state.angular_velocity);
        squares = squares + rate.dot(rate);
    }
    // Half of the allowed rotation, as a margin for rounding. Subtracted, because in double precision, which has its
    // numbers in integers, subtracting a constant 0 costs nothing.
    let nought = P::Real::from_f64(f64::from(sums.nought()));
    sums.are_finite() && squares * (h * h) - nought <= P::Real::HALF * most
}

/// Body by body: the fast check may fail without a fault.
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

/// The first body whose orientation or position is out of the fixed-point range.
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
