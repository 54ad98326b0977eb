//! The free rotor of fourth order in lanes with different branches.
//!
//! `(ω, h, orientation) => orientation, ω`, each lane with the bits of [`crate::rotation::free_rotor_of_order_four`]:
//! every branch taken by any lane is executed once, with the other lanes masked.

use crate::attitude::Attitude as _;
use crate::body::Body;
use crate::compositions::PEFRL;
use crate::geometry::Geometry;
use crate::real::{Mask as _, Real};
use crate::rotation::{Axis, MaskOf, about_x, about_y, about_z, half_turn, turn_unless};
use crate::space::{Linear as _, Moment as _};
use crate::vector::Vec3;

/// [`crate::rotation::free_rotor_of_order_four`] in lanes.
#[inline(always)]
pub(crate) fn free_rotor_of_order_four<P: Geometry>(
    body: &Body<P::Space>,
    orientation: &mut P::Orientation,
    rate: &mut P::Spin,
    time: P::Real,
) {
    let zero = P::Real::ZERO;
    let w = P::spin(rate).in_space();
    let [x, y, z] = [w.x, w.y, w.z].map(|rate| rate.equals(zero));
    let resting = x & y & z;
    if resting.all() {
        return;
    }
    let alone = [(!x) & y & z, x & (!y) & z, x & y & (!z)];
    let start = *orientation;
    for (axis, alone) in [Axis::X, Axis::Y, Axis::Z].into_iter().zip(alone) {
        turn::<P>(axis, body, orientation, rate, (time, !alone));
    }
    let others = resting | alone[0] | alone[1] | alone[2];
    if !others.all() {
        tumble::<P>(body, orientation, rate, time, others);
    }
    P::Orientation::renormalise(orientation);
    P::Orientation::keep(orientation, resting, &start);
}

/// Lanes that rotate about more than one axis.
#[inline(always)]
fn tumble<P: Geometry>(
    body: &Body<P::Space>,
    orientation: &mut P::Orientation,
    rate: &mut P::Spin,
    time: P::Real,
    others: MaskOf<P>,
) {
    let one = P::Real::ONE;
    let Vec3 { x, y, z } = body.inertia.in_space();
    let (ratio, inverse_ratio) = (body.ratio.in_space(), body.inverse_ratio.in_space());
    let lies_between = |b: P::Real, a: P::Real, c: P::Real| {
        (a.at_most(b) & b.at_most(c)) | (c.at_most(b) & b.at_most(a))
    };
    let of_y = lies_between(y, x, z);
    let of_x = (!of_y) & lies_between(x, y, z);
    let middle = P::Real::pick(of_y, y, P::Real::pick(of_x, x, z));
    let momentum = body.inertia.scale(P::spin(rate));
    let about_momentum = half_turn(momentum * (P::Real::HALF * time / middle));
    turn_unless::<P>(orientation, about_momentum, others);
    let ways = [
        (of_y, (Axis::X, one - inverse_ratio.z), (Axis::Z, one - ratio.x)),
        (of_x, (Axis::Y, one - ratio.z), (Axis::Z, one - inverse_ratio.y)),
        (!(of_x | of_y), (Axis::X, one - ratio.y), (Axis::Y, one - inverse_ratio.x)),
    ];
    for (these, first, second) in ways {
        let others = others | !these;
        if !others.all() {
            split::<P>(body, orientation, rate, time, others, [first, second]);
        }
    }
}

/// The rotations about the two axes other than the middle one.
#[inline(always)]
fn split<P: Geometry>(
    body: &Body<P::Space>,
    orientation: &mut P::Orientation,
    rate: &mut P::Spin,
    time: P::Real,
    others: MaskOf<P>,
    [(first, share), (second, other)]: [(Axis, P::Real); 2],
) {
    let zero = P::Real::ZERO;
    let no_share = share.equals(zero);
    let no_other = (!no_share) & other.equals(zero);
    turn::<P>(second, body, orientation, rate, (other * time, others | !no_share));
    turn::<P>(first, body, orientation, rate, (share * time, others | !no_other));
    let others = others | no_share | no_other;
    if others.all() {
        return;
    }
    for (i, &drift) in PEFRL.drifts.iter().enumerate() {
        let drift = P::Real::constant(drift) * (share * time);
        turn::<P>(first, body, orientation, rate, (drift, others));
        if let Some(&kick) = PEFRL.kicks.get(i) {
            let kick = P::Real::constant(kick) * (other * time);
            turn::<P>(second, body, orientation, rate, (kick, others));
        }
    }
}

/// A rotation about an axis for a time, with some lanes masked.
#[inline(always)]
fn turn<P: Geometry>(
    axis: Axis,
    body: &Body<P::Space>,
    orientation: &mut P::Orientation,
    rate: &mut P::Spin,
    (time, without): (P::Real, MaskOf<P>),
) {
    match axis {
        Axis::X => about_x::<P>(body, orientation, rate, time, without),
        Axis::Y => about_y::<P>(body, orientation, rate, time, without),
        Axis::Z => about_z::<P>(body, orientation, rate, time, without),
    }
}
