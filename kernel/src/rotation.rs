//! Finite rotations and the free rotor: the drift of an orientation.
//!
//! `(ω, h, orientation) => orientation`, and for the free rotors, of second and of fourth order, also `ω => ω`. A
//! rotation with the half angle x is `(cos x, sin x)`, from Taylor polynomials in x² and one renormalisation per drift:
//! no trigonometric function, no root, no division. The truncated terms are below 2.7e-20 (f64) and 1e-12 (f32) at x =
//! 0.05, the recommended limit h·ω = 0.1, and below 3e-10 and 1e-7 at x = 0.5.

use crate::attitude::Attitude as _;
use crate::body::{Body, BodyState};
use crate::compositions::PEFRL;
use crate::geometry::Geometry;
use crate::real::{Mask as _, Real};
use crate::space::{Linear as _, Moment, Space as _};
use crate::vector::{Quaternion, Vec3};

/// Rotates by the rotation vector `2·half` in body axes (exponential map).
#[inline(always)]
pub fn turn_by<P: Geometry>(orientation: &mut P::Orientation, half: P::Moment) {
    P::Orientation::turn(orientation, half_turn(half));
    P::Orientation::renormalise(orientation);
}

/// The free rigid rotor over `time` \[s\]: second order, reversible; with quaternions the world's angular momentum is
/// conserved to rounding up to h·ω = 0.3, beyond that to the accuracy of the truncated rotations: within 4e-13 of it
/// over 20 s at 0.6, 3e-10 at 1.1 (`tests/mechanics/orientation.rs`).
///
/// Symmetric splitting of the kinetic energy into its three axes (McLachlan 1993; Dullweber, Leimkuhler & McLachlan
/// 1997): rotations about x, y, z, y, x by h/2, h/2, h, h/2, h/2. Each is exact, because the rate about its own axis is
/// constant. An axis with rate 0 is skipped: the rotation would change nothing.
#[inline(always)]
pub fn free_rotor<P: Geometry>(
    body: &Body<P::Space>,
    orientation: &mut P::Orientation,
    rate: &mut P::Spin,
    time: P::Real,
) {
    if P::Space::PLANAR {
        return turn_in_plane::<P>(orientation, rate, time);
    }
    turn_freely::<P>(body, orientation, rate, time);
    P::renormalise(orientation);
}

/// [`free_rotor`] in space without the final [renormalisation](Geometry::renormalise).
#[inline(always)]
pub(crate) fn turn_freely<P: Geometry>(
    body: &Body<P::Space>,
    orientation: &mut P::Orientation,
    rate: &mut P::Spin,
    time: P::Real,
) {
    let zero = P::Real::ZERO;
    let w = P::spin(rate).in_space();
    if P::Real::ONE_LANE && turns_in_plane::<P>(rate) {
        // In planar motion only the rotation about z is nonzero, so it equals all five.
        if w.z != zero {
            let turn = Turn::by(time * w.z);
            P::settle(rate);
            let half = (turn.half_cos, turn.half_sin);
            P::turn_about::<2>(orientation, rate, time, half);
        }
        return;
    }
    if P::RESTS {
        return five_turns_apart::<P>(body, orientation, rate, time);
    }
    five_turns::<P>(body, orientation, rate, time);
}

/// Whether [`turn_freely`] takes one rotation, not five: a body rotates about no other axis than z.
#[inline(always)]
pub(crate) fn turns_in_plane<P: Geometry>(rate: &P::Spin) -> bool {
    let w = P::spin(rate).in_space();
    w.x == P::Real::ZERO && w.y == P::Real::ZERO
}

/// [`free_rotor`] of bodies in space; `false`, and nothing is changed, where one of them takes one rotation. Their rotations
/// alternate: a processor computes one while that of another body waits for the rotation before it. For one lane.
#[inline(always)]
pub(crate) fn free_rotors<P: Geometry, const N: usize>(
    bodies: &[Body<P::Space>; N],
    states: &mut [BodyState<P>; N],
    time: P::Real,
) -> bool {
    if states.iter().any(|state| turns_in_plane::<P>(&state.angular_velocity)) {
        return false;
    }
    let (half, none) = (P::Real::HALF * time, P::Real::mask(false));
    macro_rules! each {
        ($about:ident, $time:expr) => {
            for (BodyState { orientation, angular_velocity, .. }, body) in
                states.iter_mut().zip(bodies)
            {
                $about::<P>(body, orientation, angular_velocity, $time, none);
            }
        };
    }
    each!(about_x, half);
    each!(about_y, half);
    each!(about_z, time);
    each!(about_y, half);
    each!(about_x, half);
    for state in states {
        P::renormalise(&mut state.orientation);
    }
    true
}

// Not inlined: integer rotations are long, and few bodies tumble.
#[inline(never)]
fn five_turns_apart<P: Geometry>(
    body: &Body<P::Space>,
    orientation: &mut P::Orientation,
    rate: &mut P::Spin,
    time: P::Real,
) {
    five_turns::<P>(body, orientation, rate, time);
}

#[inline(always)]
fn five_turns<P: Geometry>(
    body: &Body<P::Space>,
    orientation: &mut P::Orientation,
    rate: &mut P::Spin,
    time: P::Real,
) {
    let (half, none) = (P::Real::HALF * time, P::Real::mask(false));
    about_x::<P>(body, orientation, rate, half, none);
    about_y::<P>(body, orientation, rate, half, none);
    about_z::<P>(body, orientation, rate, time, none);
    about_y::<P>(body, orientation, rate, half, none);
    about_x::<P>(body, orientation, rate, half, none);
}

/// The free rigid rotor over `time` \[s\], which may be negative: fourth order, reversible; with quaternions the
/// world's angular momentum L is conserved to rounding as by [`free_rotor`].
///
/// A rotation about one principal axis is exact and the only one needed then. Otherwise the kinetic energy
/// `L²/2I₂ + ½(1/I₁ − 1/I₂)·L₁² + ½(1/I₃ − 1/I₂)·L₃²`, I₂ the middle inertia, is split (Touma & Wisdom 1994; Fassò
/// 2003): the first term rotates about L, exactly, and commutes with the others; those two rotate about their axes,
/// composed with the coefficients of [`crate::schemes::Pefrl`]. A body of two equal inertias needs one of them only:
/// its flow is exact, too. For one lane.
#[inline(always)]
pub fn free_rotor_of_order_four<P: Geometry>(
    body: &Body<P::Space>,
    orientation: &mut P::Orientation,
    rate: &mut P::Spin,
    time: P::Real,
) {
    if P::Space::PLANAR {
        return turn_in_plane::<P>(orientation, rate, time);
    }
    let (zero, none) = (P::Real::ZERO, P::Real::mask(false));
    let w = P::spin(rate).in_space();
    match (w.x == zero, w.y == zero, w.z == zero) {
        (false, true, true) => about_x::<P>(body, orientation, rate, time, none),
        (true, false, true) => about_y::<P>(body, orientation, rate, time, none),
        (true, true, false) => about_z::<P>(body, orientation, rate, time, none),
        (true, true, true) => return,
        _ => tumble::<P>(body, orientation, rate, time),
    }
    P::renormalise(orientation);
}

/// The free planar rotor: one exact rotation.
#[inline(always)]
fn turn_in_plane<P: Geometry>(orientation: &mut P::Orientation, rate: &P::Spin, time: P::Real) {
    turn_by::<P>(orientation, P::spin(rate) * (P::Real::HALF * time));
}

/// [`free_rotor_of_order_four`] about more than one axis.
#[inline]
fn tumble<P: Geometry>(
    body: &Body<P::Space>,
    orientation: &mut P::Orientation,
    rate: &mut P::Spin,
    time: P::Real,
) {
    let (zero, one, none) = (P::Real::ZERO, P::Real::ONE, P::Real::mask(false));
    let Vec3 { x, y, z } = body.inertia.in_space();
    let (ratio, inverse_ratio) = (body.ratio.in_space(), body.inverse_ratio.in_space());
    let lies_between =
        |b: P::Real, a: P::Real, c: P::Real| (a <= b && b <= c) || (c <= b && b <= a);
    // For each of the other axes the fraction 1 − I/I₂ of its rate, which rotates about it only.
    let (middle, (first, share), (second, other)) = if lies_between(y, x, z) {
        (y, (Axis::X, one - inverse_ratio.z), (Axis::Z, one - ratio.x))
    } else if lies_between(x, y, z) {
        (x, (Axis::Y, one - ratio.z), (Axis::Z, one - inverse_ratio.y))
    } else {
        (z, (Axis::X, one - ratio.y), (Axis::Y, one - inverse_ratio.x))
    };
    let momentum = body.inertia.scale(P::spin(rate));
    P::Orientation::turn(orientation, half_turn(momentum * (P::Real::HALF * time / middle)));
    let mut turn = |axis: Axis, time: P::Real| match axis {
        Axis::X => about_x::<P>(body, orientation, rate, time, none),
        Axis::Y => about_y::<P>(body, orientation, rate, time, none),
        Axis::Z => about_z::<P>(body, orientation, rate, time, none),
    };
    if share == zero {
        turn(second, other * time);
    } else if other == zero {
        turn(first, share * time);
    } else {
        for (i, &drift) in PEFRL.drifts.iter().enumerate() {
            turn(first, P::Real::constant(drift) * (share * time));
            if let Some(&kick) = PEFRL.kicks.get(i) {
                turn(second, P::Real::constant(kick) * (other * time));
            }
        }
    }
}

/// A principal axis.
#[derive(Clone, Copy)]
pub(crate) enum Axis {
    X,
    Y,
    Z,
}

/// The quaternion of a rotation by the rotation vector `2·half`.
#[inline(always)]
pub(crate) fn half_turn<M: Moment>(half: M) -> Quaternion<M::Real> {
    let x2 = half.dot(half);
    let w = x2.polynomial(M::Real::COS);
    let s = x2.polynomial(M::Real::SINC);
    Quaternion { w, v: (half * s).in_space() }
}

/// Half-angle cosine and sine, and the full angle's `1 − cos` and sine.
struct Turn<R> {
    half_cos: R,
    half_sin: R,
    versine: R,
    sine: R,
}

impl<R: Real> Turn<R> {
    #[inline(always)]
    fn by(angle: R) -> Self {
        let x = R::HALF * angle;
        let x2 = x * x;
        let half_cos = x2.polynomial(R::COS);
        let half_sin = x * x2.polynomial(R::SINC);
        let twice = half_sin + half_sin;
        Self { half_cos, half_sin, versine: twice * half_sin, sine: twice * half_cos }
    }
}

/// The mask of a geometry's number.
pub(crate) type MaskOf<P> = <<P as Geometry>::Real as Real>::Mask;

/// Rotates all except the resting lanes.
#[inline(always)]
pub(crate) fn turn_unless<P: Geometry>(
    orientation: &mut P::Orientation,
    turn: Quaternion<P::Real>,
    resting: MaskOf<P>,
) {
    let start = *orientation;
    P::Orientation::turn(orientation, turn);
    keep::<P>(orientation, resting, &start);
}

/// Rotates about an axis, with cosine and sine of half the angle, all except the resting lanes.
#[inline(always)]
fn turn_about<P: Geometry, const AXIS: usize>(
    orientation: &mut P::Orientation,
    rate: &P::Spin,
    time: P::Real,
    half: (P::Real, P::Real),
    resting: MaskOf<P>,
) {
    let start = *orientation;
    P::turn_about::<AXIS>(orientation, rate, time, half);
    keep::<P>(orientation, resting, &start);
}

/// Restores the start in resting lanes. Without resting lanes nothing is stored: masked stores are slow on x86.
#[inline(always)]
fn keep<P: Geometry>(orientation: &mut P::Orientation, resting: MaskOf<P>, start: &P::Orientation) {
    if P::Real::ONE_LANE || resting.any() {
        P::Orientation::keep(orientation, resting, start);
    }
}

// In the lanes `without` there is no rotation about the axis.
#[inline(always)]
pub(crate) fn about_x<P: Geometry>(
    body: &Body<P::Space>,
    orientation: &mut P::Orientation,
    rate: &mut P::Spin,
    time: P::Real,
    without: MaskOf<P>,
) {
    let zero = P::Real::ZERO;
    let w = P::spin(rate).in_space();
    let resting = w.x.equals(zero) | without;
    if resting.all() {
        return;
    }
    let t = Turn::by(time * w.x);
    let y = t.sine * (body.ratio.in_space().x * w.z) - t.versine * w.y;
    let z = -(t.sine * (body.inverse_ratio.in_space().x * w.y)) - t.versine * w.z;
    P::spin_up_across::<0>(rate, P::Moment::of_space(Vec3::new(zero, y, z)).unless(resting));
    turn_about::<P, 0>(orientation, rate, time, (t.half_cos, t.half_sin), resting);
}

#[inline(always)]
pub(crate) fn about_y<P: Geometry>(
    body: &Body<P::Space>,
    orientation: &mut P::Orientation,
    rate: &mut P::Spin,
    time: P::Real,
    without: MaskOf<P>,
) {
    let zero = P::Real::ZERO;
    let w = P::spin(rate).in_space();
    let resting = w.y.equals(zero) | without;
    if resting.all() {
        return;
    }
    let t = Turn::by(time * w.y);
    let z = t.sine * (body.ratio.in_space().y * w.x) - t.versine * w.z;
    let x = -(t.sine * (body.inverse_ratio.in_space().y * w.z)) - t.versine * w.x;
    P::spin_up_across::<1>(rate, P::Moment::of_space(Vec3::new(x, zero, z)).unless(resting));
    turn_about::<P, 1>(orientation, rate, time, (t.half_cos, t.half_sin), resting);
}

#[inline(always)]
pub(crate) fn about_z<P: Geometry>(
    body: &Body<P::Space>,
    orientation: &mut P::Orientation,
    rate: &mut P::Spin,
    time: P::Real,
    without: MaskOf<P>,
) {
    let zero = P::Real::ZERO;
    let w = P::spin(rate).in_space();
    let resting = w.z.equals(zero) | without;
    if resting.all() {
        return;
    }
    let t = Turn::by(time * w.z);
    let x = t.sine * (body.ratio.in_space().z * w.y) - t.versine * w.x;
    let y = -(t.sine * (body.inverse_ratio.in_space().z * w.x)) - t.versine * w.y;
    P::spin_up_across::<2>(rate, P::Moment::of_space(Vec3::new(x, y, zero)).unless(resting));
    turn_about::<P, 2>(orientation, rate, time, (t.half_cos, t.half_sin), resting);
}

#[cfg(test)]
mod tests;
