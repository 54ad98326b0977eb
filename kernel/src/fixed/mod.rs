//! Fixed-point geometry: near double precision on a unit for single precision.
//!
//! `positions, orientations, points in integers => exact differences => single precision`. Where
//! bodies are is stored in integers of 64 bits, metres to 2^-57 and unit quaternions to 2^-62; a rotation
//! has 30 bits after the point, a point 27. A point's place is the exact sum of products, the way between
//! two points their exact difference, rounded once to single precision. The centre of a star is placed beside where it
//! rested in B at the start: with u the way from there and e what it was to a point of B,
//! L² − L0² = (e² − L0²) − u·(2e − u), whose digits are those of u. Forces, rates and their increments
//! are `f32`, velocities sums of two words ([`crate::compensated`]), of gravity as well ([`Geometry::FALLS`]): laws,
//! sweeps, schemes are those of `f32`.
//!
//! Integers have ends, and [`LIMITS`] says where: a model is checked when a plant of it is made, a state after
//! every step ([`Cause::Extent`](crate::status::Cause)), and none ever wraps. Constants of models are made by
//! [`FixedPoint::new`], [`FixedPlace::new`], [`FixedTurn::new`] and `BodyState::<Fixed>::new`.

mod number;
mod turn;

pub use turn::FixedTurn;

use crate::compensated::{CompensatedF32, Kept};
use crate::fixed::number::{
    exact_product, from_f32, from_f64, nearest_f32, single_power, square_of, squared, to_f32,
    to_f64,
};
use crate::fixed::turn::UNIT;
use crate::geometry::{Geometry, Limits, Reach};
use crate::vector::{Rotation, Vec3};
use crate::words::{Word, WordSource, WordVisitor, Words};

/// Bits after the point of a position and of a place, metres.
pub(crate) const PLACE: i32 = 57;
/// Bits after the point of a body's points, metres.
pub(crate) const POINT: i32 = 27;

/// How far bodies and points may go. Within a step, which no guard looks into, a body may go 7 drifts beyond:
/// places are below 32 m then, ways between two of them below 64 m, which is where integers end.
pub const LIMITS: Limits = Limits { extent: 24.0, reach: 7.0, drift: 0.125, shift: 7.0 };

/// Where a body is after a drift beyond the limits: 32 m, from where no drifts of a step lead back.
const LOST: i64 = 1 << (PLACE + 5);

/// Fixed-point geometry with forces in single precision.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Fixed;

/// Where something is, metres to 2^-57.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct FixedPlace {
    /// \[2^-57 m\] world axes.
    pub at: [i64; 3],
}

/// A point of a body or of the ground, metres to 2^-27.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct FixedPoint {
    /// \[2^-27 m\] of a body within 32 bits.
    pub at: [i64; 3],
}

/// The pose of a body in fixed point.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct FixedPose {
    position: [i64; 3],
    /// \[2^-30\] rows in world axes.
    rotation: [[i32; 3]; 3],
    /// The same in single precision.
    single: Rotation<f32>,
}

/// A TSDA at rest: how far its point of B is from where the centre of its star rests in B.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Rest {
    /// \[m\] in the axes of B. Of the first of a star a multiple of 2^-27.
    way: Vec3<f32>,
    /// \[m²\] by how much its square is more than that of the free length.
    more: f32,
}

impl FixedPlace {
    /// A place \[m\] rounded once.
    #[must_use]
    pub const fn new(at: [f64; 3]) -> Self {
        let bits = PLACE as u32;
        Self { at: [from_f64(at[0], bits), from_f64(at[1], bits), from_f64(at[2], bits)] }
    }
}

impl FixedPoint {
    /// A point \[m\] rounded once.
    #[must_use]
    pub const fn new(at: [f64; 3]) -> Self {
        let bits = POINT as u32;
        Self { at: [from_f64(at[0], bits), from_f64(at[1], bits), from_f64(at[2], bits)] }
    }
}

/// Words of a vector of integers.
macro_rules! words {
    ($($name:ident)*) => {
        $(impl Words for $name {
            fn visit(&self, visitor: &mut impl WordVisitor) {
                for c in self.at {
                    visitor.word(Word::U64(c as u64));
                }
            }

            fn fill(&mut self, source: &mut impl WordSource) {
                for c in &mut self.at {
                    *c = source.take(8) as i64;
                }
            }
        })*
    };
}

words!(FixedPlace FixedPoint);

/// Bits after the point of a short way, metres: 32 bits hold it below 1/4 m.
const NEAR: i32 = 33;

/// Whether a component of a way is below 0.2 m: three squares of such fit together.
#[inline(always)]
fn is_near(c: i64) -> bool {
    const MOST: i32 = (1 << (PLACE - 32)) / 5;
    ((c >> 32) as i32).wrapping_add(MOST) as u32 <= 2 * MOST as u32
}

/// The reach of a way that is not near. Inlined: a call costs those that are near more.
#[inline(always)]
fn far(d: &[i64; 3], free_length: f32) -> Reach<Vec3<f32>> {
    let way = nearest::<PLACE>(*d);
    // Beyond this the sums of squares end, and the way tells as well as theirs would.
    if way.dot(way) > 256.0 || free_length > 16.0 {
        return Reach { way, more: Some(way.dot(way) - free_length * free_length) };
    }
    let more = squared(d).wrapping_sub(square_of(free_length));
    Reach { way, more: Some(to_f32::<{ 2 * (PLACE - 32) }>(more)) }
}

/// A vector of integers in single precision.
#[inline(always)]
fn single<const BITS: i32>(at: [i64; 3]) -> Vec3<f32> {
    let [x, y, z] = at.map(to_f32::<BITS>);
    Vec3::new(x, y, z)
}

/// The same near zero, from both sides.
#[inline(always)]
fn nearest<const BITS: i32>(at: [i64; 3]) -> Vec3<f32> {
    let [x, y, z] = at.map(nearest_f32::<BITS>);
    Vec3::new(x, y, z)
}

#[inline(always)]
fn sum(a: [i64; 3], b: [i64; 3]) -> [i64; 3] {
    [a[0].wrapping_add(b[0]), a[1].wrapping_add(b[1]), a[2].wrapping_add(b[2])]
}

#[inline(always)]
fn difference(a: [i64; 3], b: [i64; 3]) -> [i64; 3] {
    [a[0].wrapping_sub(b[0]), a[1].wrapping_sub(b[1]), a[2].wrapping_sub(b[2])]
}

/// A place in the axes of a body, to 2^-27 m; no further from its centre of mass than its points are.
fn within(frame: &FixedPose, place: &FixedPlace) -> [i64; 3] {
    let [dx, dy, dz] = difference(place.at, frame.position).map(i128::from);
    let [x, y, z] = frame.rotation.map(|row| row.map(i128::from));
    let along = |axis: usize| {
        let sum = x[axis] * dx + y[axis] * dy + z[axis] * dz;
        // 30 bits of the matrix and 57 of the place.
        let most = (LIMITS.reach as i128) << POINT;
        (sum >> (30 + PLACE - POINT)).clamp(-most, most) as i64
    };
    [along(0), along(1), along(2)]
}

/// A displacement \[m\] below 8 m, in the units of a place.
#[inline(always)]
fn fixed(v: Vec3<f32>) -> [i64; 3] {
    [v.x, v.y, v.z].map(from_f32::<28, 29>)
}

impl Geometry for Fixed {
    type Real = f32;
    type Vector = Vec3<f32>;
    type Moment = Vec3<f32>;
    type Space = f32;
    type Position = FixedPlace;
    type Orientation = FixedTurn;
    type Velocity = Kept;
    type Spin = Kept;
    type Local = FixedPoint;
    type Location = FixedPlace;
    type Frame = FixedPose;
    type Rest = Rest;

    const NAME: &'static str = "fixed";
    const LIMITS: Option<Limits> = Some(LIMITS);

    #[inline(always)]
    fn frame(position: &FixedPlace, orientation: &FixedTurn) -> FixedPose {
        let mut frame = FixedPose::default();
        Self::set_frame(&mut frame, position, orientation);
        frame
    }
    // Number by number: what is made elsewhere is copied.
    #[inline(always)]
    fn set_frame(frame: &mut FixedPose, position: &FixedPlace, orientation: &FixedTurn) {
        let FixedPose { position: at, rotation: [x, y, z], single } = frame;
        let [p, q, r] = orientation.matrix();
        for (to, from) in at.iter_mut().zip(position.at) {
            *to = from;
        }
        for (row, from) in [(x, p), (y, q), (z, r)] {
            for (to, from) in row.iter_mut().zip(from) {
                *to = from;
            }
        }
        for (row, [x, y, z]) in [(&mut single.x, p), (&mut single.y, q), (&mut single.z, r)] {
            row.x = x as f32 * UNIT;
            row.y = y as f32 * UNIT;
            row.z = z as f32 * UNIT;
        }
    }
    #[inline(always)]
    fn place(frame: &FixedPose, local: &FixedPoint) -> (FixedPlace, Vec3<f32>) {
        let point = local.at.map(|c| i64::from(c as i32));
        let turned = frame.rotation.map(|row| {
            let [x, y, z] = row.map(i64::from);
            let [px, py, pz] = point;
            (x * px).wrapping_add(y * py).wrapping_add(z * pz)
        });
        // An arm rounded in its parts would turn bodies by forces that pass it by.
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
    #[inline(always)]
    fn reach(from: &FixedPlace, to: &FixedPlace, free_length: f32) -> Reach<Vec3<f32>> {
        let d = difference(to.at, from.at);
        let [x, y, z] = d;
        if is_near(x) & is_near(y) & is_near(z) & (free_length < 0.25) {
            let [x, y, z] = d.map(|c| (c >> (PLACE - NEAR)) as i32);
            let way = Vec3::new(x as f32, y as f32, z as f32) * const { single_power(-NEAR) };
            let free = (free_length * const { single_power(NEAR) }) as i32;
            let [x, y, z, free] = [x, y, z, free].map(i64::from);
            let more = (x * x + y * y + z * z).wrapping_sub(free * free);
            return Reach { way, more: Some(to_f32::<{ 2 * NEAR }>(more)) };
        }
        far(&d, free_length)
    }
    const RESTS: bool = true;
    fn rest(
        frame: &FixedPose,
        centre: &FixedPlace,
        tip: &FixedPoint,
        first: Option<(&FixedPoint, &Rest)>,
        free_length: f32,
    ) -> Rest {
        let beside = |rests: [i64; 3]| difference(tip.at, rests).map(|c| to_f64(c, POINT as u32));
        let near = match first {
            Some((tip, rest)) => Self::centre(tip, rest),
            // Where the first's way is a number of single precision.
            None => {
                let way = Vec3::from_f64(beside(within(frame, centre)));
                Self::centre(tip, &Rest { way, more: 0.0 })
            }
        };
        let way = beside(near.at);
        let [x, y, z] = way;
        let free = f64::from(free_length);
        Rest { way: Vec3::from_f64(way), more: (x * x + y * y + z * z - free * free) as f32 }
    }
    #[inline(always)]
    fn centre(tip: &FixedPoint, rest: &Rest) -> FixedPoint {
        // What single precision holds of a multiple of 2^-27 is one.
        let Vec3 { x, y, z } = rest.way * const { single_power(POINT) };
        FixedPoint { at: difference(tip.at, [x, y, z].map(|c| i64::from(c as i32))) }
    }
    #[inline(always)]
    fn reach_at_rest(rest: &Rest, off: Vec3<f32>) -> Reach<Vec3<f32>> {
        let way = rest.way - off;
        // |a − b|² − |a|² = −b·(a + (a − b)).
        Reach { way, more: Some(rest.more - off.dot(rest.way + way)) }
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
    fn velocity(stored: &Kept) -> Vec3<f32> {
        CompensatedF32::velocity(stored)
    }
    #[inline(always)]
    fn spin(stored: &Kept) -> Vec3<f32> {
        CompensatedF32::spin(stored)
    }
    #[inline(always)]
    fn accelerate(stored: &mut Kept, increment: Vec3<f32>) {
        stored.add_to_both(increment);
    }
    const FALLS: bool = true;
    #[inline(always)]
    fn fall(stored: &mut Kept, increment: Vec3<f32>) {
        stored.lost = stored.lost - increment;
    }
    #[inline(always)]
    fn spin_up(stored: &mut Kept, increment: Vec3<f32>) {
        stored.add_to_both(increment);
    }
    // A sum is the nearest as it is.
    #[inline(always)]
    fn settle(_: &mut Kept) {}
    #[inline(always)]
    fn translate(position: &mut FixedPlace, displacement: Vec3<f32>) {
        let most = const { (LIMITS.drift * LIMITS.drift) as f32 };
        let within = displacement.dot(displacement) <= most;
        position.at = if within { sum(position.at, fixed(displacement)) } else { [LOST; 3] };
    }
    #[inline(always)]
    fn turn_about<const AXIS: usize>(
        orientation: &mut FixedTurn,
        rate: &Kept,
        time: f32,
        _: (f32, f32),
    ) {
        let Kept { sum, lost } = rate;
        let (sum, lost) = match AXIS {
            0 => (sum.x, lost.x),
            1 => (sum.y, lost.y),
            _ => (sum.z, lost.z),
        };
        orientation.turn_exactly::<AXIS>(exact_product(sum, lost, 0.5 * time));
    }
    #[inline(always)]
    fn is_within(position: &FixedPlace) -> bool {
        const EXTENT: i32 = (LIMITS.extent as i32) << (PLACE - 32);
        // One comparison for both sides.
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
    fn velocity_from_f64(velocity: [f64; 3]) -> Kept {
        CompensatedF32::velocity_from_f64(velocity)
    }
    fn velocity_to_f64(velocity: &Kept) -> [f64; 3] {
        CompensatedF32::velocity_to_f64(velocity)
    }
    fn spin_from_f64(spin: [f64; 3]) -> Kept {
        CompensatedF32::spin_from_f64(spin)
    }
    fn spin_to_f64(spin: &Kept) -> [f64; 3] {
        CompensatedF32::spin_to_f64(spin)
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
