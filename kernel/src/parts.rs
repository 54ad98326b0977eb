//! The parts of an undamped leapfrog step, a body or a joint at a time: for who lays those of one large model
//! into lanes.
//!
//! `(state, wrench) => state, frame; (frames, joint) => record`. Each does to the bit what a
//! [`Plant`](crate::plant::Plant) does there. The order of sums is the caller's to keep: a body's wrench starts from
//! its weight, the records of the groups are added in ascending order, A before B, and only then its torque is turned
//! into body axes.

use crate::body::{Body, BodyState, Diagonal};
use crate::elements::tsda::Tsda;
pub use crate::forces::{Record, Wrench};
use crate::geometry::Geometry;
use crate::real::Real as _;
use crate::{forces, step};

/// Half a kick by a wrench with the weight, its torque in body axes.
#[inline(always)]
pub fn kick<P: Geometry>(
    state: &mut BodyState<P>,
    wrench: &Wrench<P::Space>,
    diagonal: &Diagonal<P::Space>,
) {
    step::kick_body(state, wrench, diagonal, (P::Real::HALF, None));
}

/// A drift over `time` \[s\].
#[inline(always)]
pub fn drift<P: Geometry>(state: &mut BodyState<P>, body: &Body<P::Space>, time: P::Real) {
    step::drift_body(state, body, time);
}

/// What a revolute joint of six TSDAs does to two bodies of floating-point numbers, without dampers and
/// clearance: two points of A, three of B that they share, the springs from each of the two to the three. The
/// ground is a body at the origin with the world's axes.
#[inline(always)]
pub fn revolute<P: Geometry>(
    frames: [&P::Frame; 2],
    points: (&[P::Local; 2], &[P::Local; 3]),
    springs: &[[Tsda<P::Real>; 3]; 2],
) -> Record<P::Space> {
    forces::between_bodies::<P>(frames, points, springs)
}
