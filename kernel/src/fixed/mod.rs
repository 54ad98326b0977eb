//! Fixed-point geometry: nearly double precision with a single-precision FPU.
//!
//! `positions, orientations, points in integers => exact differences => single precision`. Positions and orientations
//! of bodies are stored in 64-bit integers, metres to 2^-57 and unit quaternions to 2^-62; a rotation matrix has 30
//! fraction bits, and its rounding error is added to the next; a point has 27. A world point is the exact sum of
//! products, the displacement between two points their exact difference, rounded once to single precision. The centre
//! of a spring triple is computed relative to its reference position in B ([`crate::elongation::AtRest`]). Forces, rates and
//! their increments are `f32`, velocities sums of two numbers ([`FixedVelocity`]), also for gravity
//! ([`Geometry::HAS_GRAVITY_STEP`]): laws, damper passes and schemes are those of `f32`.
//!
//! Integers have a limited range, see [`LIMITS`]: a model is checked when its plant is created, a state after every
//! step ([`Cause::Extent`](crate::status::Cause)), and no integer wraps. Constants of models are made by
//! [`FixedPoint::new`], [`FixedPlace::new`], [`FixedTurn::new`] and `BodyState::<Fixed>::new`.
//!
//! Long functions are inlined on processors of 32 bits only: a PC compiles every scheme, and each would contain them.

mod matrix;
mod number;
mod place;
mod turn;
mod velocity;

mod pose;
mod rest;

pub use place::{FixedPlace, FixedPoint, LIMITS};
pub(crate) use place::{PLACE, POINT};
pub use pose::FixedPose;
pub use rest::Rest;
pub use turn::FixedTurn;
pub use velocity::FixedVelocity;

use crate::elongation::{AtRest, Beside, Beyond, Elongation};
use crate::fixed::number::{exact_product, single_power, square_of, squared, to_f32, to_f64};
use crate::fixed::place::{difference, fixed, move_by, nearest, single, sum};
use crate::force_pair::ForcePair;
use crate::geometry::{Geometry, Limits};
use crate::vector::Vec3;

/// Fixed-point geometry with forces in single precision.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(all(feature = "defmt", target_os = "none"), derive(defmt::Format))]
pub struct Fixed;

/// Fraction bits of a short displacement, metres: it fits 32 bits below 1/4 m.
const NEAR: i32 = 33;

/// Whether a component of a displacement is below 0.2 m: the sum of three such squares fits.
#[inline(always)]
fn is_near(c: i64) -> bool {
    const MAX: i32 = (1 << (PLACE - 32)) / 5;
    ((c >> 32) as i32).wrapping_add(MAX) as u32 <= 2 * MAX as u32
}

/// The displacement beyond the near range. Inlined: a call would cost the near case more.
#[inline(always)]
fn far(d: &[i64; 3], free_length: f32) -> Elongation<Vec3<f32>> {
    let way = nearest::<PLACE>(*d);
    // Beyond this the sums of squares overflow, and the displacement itself is as precise.
    if way.dot(way) > 256.0 || free_length > 16.0 {
        return Elongation { way, more: Some(way.dot(way) - free_length * free_length) };
    }
    let more = squared(d).wrapping_sub(square_of(free_length));
    Elongation { way, more: Some(to_f32::<{ 2 * (PLACE - 32) }>(more)) }
}

impl Geometry for Fixed {
    type Real = f32;
    type Vector = Vec3<f32>;
    type Moment = Vec3<f32>;
    type Space = f32;
    type Position = FixedPlace;
    type Orientation = FixedTurn;
    type Velocity = FixedVelocity;
    type Spin = FixedVelocity;
    type Local = FixedPoint;
    type Location = FixedPlace;
    type Frame = FixedPose;
    type Rest = Rest;
    type Apart = [i64; 3];
    type PassSum = ();
    type Abreast = Self;

    const NAME: &'static str = "fixed";
    const LIMITS: Option<Limits> = Some(LIMITS);

    #[inline(always)]
    fn frame(position: &FixedPlace, orientation: &FixedTurn) -> FixedPose {
        let mut frame = FixedPose::default();
        Self::set_frame(&mut frame, position, orientation);
        frame
    }
    #[inline(always)]
    fn set_frame(frame: &mut FixedPose, position: &FixedPlace, orientation: &FixedTurn) {
        frame.set(position, orientation);
    }
    #[cfg_attr(not(target_pointer_width = "64"), inline(always))]
    fn place(frame: &FixedPose, local: &FixedPoint) -> (FixedPlace, Vec3<f32>) {
        let turned = frame.turned(local.at.map(|c| c as i32), [0; 3]);
        // The lever arm is rounded as a sum: rounded by parts it would make forces through the centre exert a torque.
        (FixedPlace { at: sum(frame.position, turned) }, nearest::<PLACE>(turned))
    }
    #[inline(always)]
    fn ground(local: &FixedPoint) -> FixedPlace {
        FixedPlace { at: local.at.map(|c| c << (PLACE - POINT)) }
    }
    #[inline(always)]
    fn shift(location: &FixedPlace, by: Vec3<f32>) -> FixedPlace {
        FixedPlace { at: sum(location.at, fixed(by)) }
    }
    #[inline(always)]
    fn displacement(from: &FixedPlace, to: &FixedPlace) -> Vec3<f32> {
        single::<PLACE>(difference(to.at, from.at))
    }
    #[cfg_attr(not(target_pointer_width = "64"), inline(always))]
    fn elongation(from: &FixedPlace, to: &FixedPlace, free_length: f32) -> Elongation<Vec3<f32>> {
        let d = difference(to.at, from.at);
        let [x, y, z] = d;
        if is_near(x) & is_near(y) & is_near(z) & (free_length < 0.25) {
            let [x, y, z] = d.map(|c| (c >> (PLACE - NEAR)) as i32);
            let way = Vec3::new(x as f32, y as f32, z as f32) * const { single_power(-NEAR) };
            let free = (free_length * const { single_power(NEAR) }) as i32;
            let [x, y, z, free] = [x, y, z, free].map(i64::from);
            let more = (x * x + y * y + z * z).wrapping_sub(free * free);
            return Elongation { way, more: Some(to_f32::<{ 2 * NEAR }>(more)) };
        }
        far(&d, free_length)
    }
    #[inline(always)]
    fn frames_abreast(of: impl Fn(usize) -> FixedPose) -> FixedPose {
        of(0)
    }
    #[inline(always)]
    fn points_abreast(of: impl Fn(usize) -> FixedPoint) -> FixedPoint {
        of(0)
    }
    #[inline(always)]
    fn numbers_abreast(of: impl Fn(usize) -> f32) -> f32 {
        of(0)
    }
    #[inline(always)]
    fn force_pair_of(pair: &ForcePair<f32>, _: usize) -> ForcePair<f32> {
        *pair
    }
    const RESTS: bool = true;
    fn find_rests(
        frame: &FixedPose,
        centre: &FixedPlace,
        endpoints: &[FixedPoint],
        free_lengths: &[f32],
        rests: &mut [Rest],
    ) {
        rest::find(frame, centre, endpoints, free_lengths, rests);
    }
    #[inline(always)]
    fn apart(a: Option<&FixedPose>, moved: Option<Vec3<f32>>, b: &FixedPose) -> [i64; 3] {
        let from = match (a, moved) {
            (Some(a), _) => a.position,
            (None, Some(by)) => fixed(by),
            (None, None) => [0; 3],
        };
        difference(from, b.position)
    }
    #[inline(always)]
    fn beside<const ARMS: usize>(
        apart: &[i64; 3],
        (a, centre): (Option<&FixedPose>, &FixedPoint),
        (b, endpoint): (&FixedPose, &FixedPoint),
        rests: &[Rest; ARMS],
    ) -> Beside<Vec3<f32>> {
        rest::beside(apart, (a, centre), (b, endpoint), rests)
    }
    #[inline(always)]
    fn beyond<const ARMS: usize>(
        (a, centres): (Option<&FixedPose>, [&FixedPoint; 2]),
        (b, endpoint): (&FixedPose, &FixedPoint),
        rests: [&[Rest; ARMS]; 2],
    ) -> Beyond<Vec3<f32>> {
        rest::beyond((a, centres), (b, endpoint), rests)
    }
    #[inline(always)]
    fn at_rest(rest: &Rest) -> AtRest<Vec3<f32>> {
        rest.at
    }
    #[inline(always)]
    fn near_rest(rest: &Rest) -> f32 {
        rest.near
    }
    #[inline(always)]
    fn to_world(frame: &FixedPose, v: Vec3<f32>) -> Vec3<f32> {
        frame.single.to_world(v)
    }
    #[inline(always)]
    fn to_body(frame: &FixedPose, v: Vec3<f32>) -> Vec3<f32> {
        frame.single.to_body(v)
    }
    #[inline(always)]
    fn moment_to_world(frame: &FixedPose, m: Vec3<f32>) -> Vec3<f32> {
        frame.single.to_world(m)
    }
    #[inline(always)]
    fn moment_to_body(frame: &FixedPose, m: Vec3<f32>) -> Vec3<f32> {
        frame.single.to_body(m)
    }
    #[inline(always)]
    fn position(stored: &FixedPlace) -> Vec3<f32> {
        single::<PLACE>(stored.at)
    }
    #[inline(always)]
    fn velocity(stored: &FixedVelocity) -> Vec3<f32> {
        stored.sum
    }
    #[inline(always)]
    fn spin(stored: &FixedVelocity) -> Vec3<f32> {
        stored.sum
    }
    #[inline(always)]
    fn velocity_change(from: &FixedVelocity, to: &FixedVelocity) -> Vec3<f32> {
        to.since(from)
    }
    #[inline(always)]
    fn spin_change(from: &FixedVelocity, to: &FixedVelocity) -> Vec3<f32> {
        to.since(from)
    }
    #[cfg_attr(not(target_pointer_width = "64"), inline(always))]
    fn accelerate(stored: &mut FixedVelocity, increment: Vec3<f32>) {
        stored.add_to_both(increment);
    }
    const HAS_GRAVITY_STEP: bool = true;
    #[inline(always)]
    fn apply_gravity(stored: &mut FixedVelocity, increment: Vec3<f32>) {
        stored.lost = stored.lost - increment;
    }
    #[cfg_attr(not(target_pointer_width = "64"), inline(always))]
    fn spin_up(stored: &mut FixedVelocity, increment: Vec3<f32>) {
        stored.add_to_both(increment);
    }
    // The sum is already rounded to nearest: adding 0 changes nothing.
    #[inline(always)]
    fn spin_up_across<const AXIS: usize>(stored: &mut FixedVelocity, increment: Vec3<f32>) {
        stored.add_to_both_across::<AXIS>(increment);
    }
    #[inline(always)]
    fn settle(_: &mut FixedVelocity) {}
    #[inline(always)]
    fn translate(position: &mut FixedPlace, displacement: Vec3<f32>) {
        move_by(position, displacement * const { single_power(PLACE - 32) });
    }
    // Converting the time's unit needs no multiplication of its own.
    #[inline(always)]
    fn advance_position(position: &mut FixedPlace, velocity: &FixedVelocity, time: f32) {
        move_by(position, velocity.sum * (time * const { single_power(PLACE - 32) }));
    }
    #[inline(always)]
    fn turn_about<const AXIS: usize>(
        orientation: &mut FixedTurn,
        rate: &FixedVelocity,
        time: f32,
        _: (f32, f32),
    ) {
        let FixedVelocity { sum, lost } = rate;
        let (sum, lost) = match AXIS {
            0 => (sum.x, lost.x),
            1 => (sum.y, lost.y),
            _ => (sum.z, lost.z),
        };
        orientation.turn_exactly::<AXIS>(exact_product(sum, lost, 0.5 * time));
    }
    // Rotations restore unit length themselves.
    #[inline(always)]
    fn renormalise(orientation: &mut FixedTurn) {
        orientation.next_matrix();
    }
    #[inline(always)]
    fn set_next_frame(frame: &mut FixedPose, position: &FixedPlace, orientation: &mut FixedTurn) {
        frame.set_next(position, orientation);
    }
    #[inline(always)]
    fn is_within(position: &FixedPlace) -> bool {
        const EXTENT: i32 = (LIMITS.extent as i32) << (PLACE - 32);
        // One comparison for both signs.
        let is_within =
            |c: i64| ((c >> 32) as i32).wrapping_add(EXTENT) as u32 <= 2 * EXTENT as u32;
        let [x, y, z] = position.at;
        is_within(x) & is_within(y) & is_within(z)
    }
    #[inline(always)]
    fn bears_shift(displacement: f32) -> bool {
        displacement.abs() <= const { LIMITS.shift as f32 }
    }
    fn position_from_f64(position: [f64; 3]) -> FixedPlace {
        FixedPlace::new(position)
    }
    fn position_to_f64(position: &FixedPlace) -> [f64; 3] {
        position.at.map(|c| to_f64(c, PLACE as u32))
    }
    fn velocity_from_f64(velocity: [f64; 3]) -> FixedVelocity {
        FixedVelocity::from_f64(velocity)
    }
    fn velocity_to_f64(velocity: &FixedVelocity) -> [f64; 3] {
        velocity.to_f64()
    }
    fn spin_from_f64(spin: [f64; 3]) -> FixedVelocity {
        FixedVelocity::from_f64(spin)
    }
    fn spin_to_f64(spin: &FixedVelocity) -> [f64; 3] {
        spin.to_f64()
    }
    fn local_from_f64(local: [f64; 3]) -> FixedPoint {
        FixedPoint::new(local)
    }
    fn local_to_f64(local: &FixedPoint) -> [f64; 3] {
        local.at.map(|c| to_f64(c, POINT as u32))
    }
}

#[cfg(test)]
mod tests;
