//! Spring triples relative to their reference position.
//!
//! `initial poses => reference position of a triple's centre in B; poses => its offset`. The deflection of a stiff
//! joint is the difference of positions a metre apart: exact in integers, and rounded once.

use crate::elongation::{AtRest, Beside, Beyond};
use crate::fixed::number::{single_power, to_f64};
use crate::fixed::place::{
    FixedPlace, FixedPoint, LIMITS, PLACE, POINT, difference, nearest, single, sum,
};
use crate::fixed::pose::FixedPose;
use crate::vector::Vec3;

/// A TSDA in its reference state, with its part of the triple's data.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Rest {
    /// In the axes of B. The displacement of a triple's first TSDA is a multiple of 2^-27 m.
    pub(super) at: AtRest<Vec3<f32>>,
    /// \[2^-27 m\] for a triple of three, one component of the centre's reference position, negated: x, y, z.
    pub(super) less: i32,
    /// \[m²\] a sixteenth of the smallest of its triple's squared lengths.
    pub(super) near: f32,
}

/// A position in the axes of a body, to 2^-27 m; no further from its centre of mass than its points are.
fn within(frame: &FixedPose, place: &FixedPlace) -> [i64; 3] {
    let [dx, dy, dz] = difference(place.at, frame.position).map(i128::from);
    let [x, y, z] = frame.rotation.map(|row| row.map(i128::from));
    let along = |axis: usize| {
        let sum = x[axis] * dx + y[axis] * dy + z[axis] * dz;
        // 30 bits of the matrix and 57 of the position.
        let most = (LIMITS.elongation as i128) << POINT;
        (sum >> (30 + PLACE - POINT)).clamp(-most, most) as i64
    };
    [along(0), along(1), along(2)]
}

/// The reference TSDAs of a triple whose centre is at `centre`. The reference position is near it, rounded such that
/// the first displacement is representable in single precision.
pub(super) fn find(
    frame: &FixedPose,
    centre: &FixedPlace,
    endpoints: &[FixedPoint],
    free_lengths: &[f32],
    rests: &mut [Rest],
) {
    let Some(first) = endpoints.first() else { return };
    let at = within(frame, centre);
    let way = Vec3::from_f64(difference(first.at, at).map(|c| to_f64(c, POINT as u32)));
    let less = less(first, &Rest { at: AtRest { way, ..AtRest::default() }, ..Rest::default() });
    let mut near = f64::INFINITY;
    for ((rest, endpoint), free_length) in rests.iter_mut().zip(endpoints).zip(free_lengths) {
        let way = sum(endpoint.at, less.map(i64::from)).map(|c| to_f64(c, POINT as u32));
        let [x, y, z] = way;
        let (square, free) = (x * x + y * y + z * z, f64::from(*free_length));
        rest.at = AtRest {
            way: Vec3::from_f64(way),
            square: square as f32,
            more: (square - free * free) as f32,
        };
        near = near.min(square / 16.0);
    }
    for (rest, less) in rests.iter_mut().zip(less.into_iter().cycle()) {
        (rest.less, rest.near) = (less, near as f32);
    }
}

/// The reference position of a triple's centre, negated, from its first endpoint and that leg's reference.
#[inline(always)]
pub(super) fn less(endpoint: &FixedPoint, first: &Rest) -> [i32; 3] {
    // A multiple of 2^-27 in single precision is exact.
    let Vec3 { x, y, z } = first.at.way * const { single_power(POINT) };
    let [a, b, c] = endpoint.at.map(|c| c as i32);
    [(x as i32).wrapping_sub(a), (y as i32).wrapping_sub(b), (z as i32).wrapping_sub(c)]
}

/// The reference position of a triple's centre, negated.
#[inline(always)]
fn less_of<const ARMS: usize>(endpoint: &FixedPoint, rests: &[Rest; ARMS]) -> [i32; 3] {
    match rests.as_slice() {
        [x, y, z] => [x.less, y.less, z.less],
        [first, ..] => less(endpoint, first),
        [] => [0; 3],
    }
}

/// The offset of a triple's centre from its reference position. One sum of integers: A relative to B, the lever arm in
/// A, and, once the lever arm in B is computed from it, minus the reference position.
#[inline(always)]
pub(super) fn beside<const ARMS: usize>(
    apart: &[i64; 3],
    (a, centre): (Option<&FixedPose>, &FixedPoint),
    (b, endpoint): (&FixedPose, &FixedPoint),
    rests: &[Rest; ARMS],
) -> Beside<Vec3<f32>> {
    let (arm, from_b) = match a {
        Some(a) => {
            let arm = a.turned(centre.at.map(|c| c as i32), [0; 3]);
            (nearest::<PLACE>(arm), sum(*apart, arm))
        }
        None => (Vec3::ZERO, sum(*apart, centre.at.map(|c| c << (PLACE - POINT)))),
    };
    let off = b.turned(less_of(endpoint, rests), from_b);
    Beside { off: single::<PLACE>(off), arm_a: arm, arm_b: nearest::<PLACE>(from_b) }
}

/// The offset of a second triple's centre relative to that of the first.
#[inline(always)]
pub(super) fn beyond<const ARMS: usize>(
    (a, [first, second]): (Option<&FixedPose>, [&FixedPoint; 2]),
    (b, endpoint): (&FixedPose, &FixedPoint),
    [of_first, of_second]: [&[Rest; ARMS]; 2],
) -> Beyond<Vec3<f32>> {
    let way = match a {
        Some(a) => {
            let [x, y, z] = second.at.map(|c| c as i32);
            let [p, q, r] = first.at.map(|c| c as i32);
            a.turned([x.wrapping_sub(p), y.wrapping_sub(q), z.wrapping_sub(r)], [0; 3])
        }
        None => difference(second.at, first.at).map(|c| c << (PLACE - POINT)),
    };
    let [x, y, z] = less_of(endpoint, of_second);
    let [p, q, r] = less_of(endpoint, of_first);
    let off = b.turned([x.wrapping_sub(p), y.wrapping_sub(q), z.wrapping_sub(r)], way);
    Beyond { off: single::<PLACE>(off), way: nearest::<PLACE>(way) }
}
