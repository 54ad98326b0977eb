//! Fixed-point positions and points, their range, and the displacements between them.
//!
//! `metres <=> integers, integers => single precision`. Values between two checks have room beyond the limits.

use crate::fixed::number::{from_f64, in_words, nearest_f32, single_power, to_f32};
use crate::geometry::Limits;
use crate::vector::Vec3;
use crate::words::{Word, WordSource, WordVisitor, Words};

/// Fraction bits of a position and of a world point, metres.
pub(crate) const PLACE: i32 = 57;
/// Fraction bits of a body's points, metres.
pub(crate) const POINT: i32 = 27;

/// The range of bodies and points. Within a step, between two checks, a body may move 7 drifts beyond: positions are
/// then below 32 m and displacements between two of them below 64 m, the limit of the integers.
pub const LIMITS: Limits = Limits { extent: 24.0, elongation: 7.0, drift: 0.125, shift: 7.0 };

/// The position of a body after a drift beyond the limits: 32 m, from where the drifts of a step cannot return.
const LOST: i64 = 1 << (PLACE + 5);

/// A position, metres to 2^-57.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(all(feature = "defmt", target_os = "none"), derive(defmt::Format))]
pub struct FixedPlace {
    /// \[2^-57 m\] world axes.
    pub at: [i64; 3],
}

/// A point of a body or of the ground, metres to 2^-27.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(all(feature = "defmt", target_os = "none"), derive(defmt::Format))]
pub struct FixedPoint {
    /// \[2^-27 m\] for a body within 32 bits.
    pub at: [i64; 3],
}

impl FixedPlace {
    /// A position \[m\] rounded once.
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

/// The words of a vector of integers.
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

/// A vector of integers in single precision.
#[inline(always)]
pub(super) fn single<const BITS: i32>(at: [i64; 3]) -> Vec3<f32> {
    let [x, y, z] = at.map(to_f32::<BITS>);
    Vec3::new(x, y, z)
}

/// [`single`], rounded symmetrically about zero.
#[inline(always)]
pub(super) fn nearest<const BITS: i32>(at: [i64; 3]) -> Vec3<f32> {
    let [x, y, z] = at.map(nearest_f32::<BITS>);
    Vec3::new(x, y, z)
}

/// `a + b`.
#[inline(always)]
pub(super) fn sum(a: [i64; 3], b: [i64; 3]) -> [i64; 3] {
    [a[0].wrapping_add(b[0]), a[1].wrapping_add(b[1]), a[2].wrapping_add(b[2])]
}

/// `a − b`.
#[inline(always)]
pub(super) fn difference(a: [i64; 3], b: [i64; 3]) -> [i64; 3] {
    [a[0].wrapping_sub(b[0]), a[1].wrapping_sub(b[1]), a[2].wrapping_sub(b[2])]
}

/// A displacement \[m\] below 8 m, in the units of a position.
#[inline(always)]
pub(super) fn fixed(v: Vec3<f32>) -> [i64; 3] {
    [v.x, v.y, v.z].map(in_words::<{ PLACE - 32 }>)
}

/// Moves a position by a displacement in units of its upper word, or beyond all limits.
#[cfg_attr(not(target_pointer_width = "64"), inline(always))]
pub(super) fn move_by(position: &mut FixedPlace, displacement: Vec3<f32>) {
    let most = const { (LIMITS.drift * LIMITS.drift) as f32 * single_power(2 * (PLACE - 32)) };
    let within = displacement.dot(displacement) <= most;
    let Vec3 { x, y, z } = displacement;
    let by = [x, y, z].map(in_words::<0>);
    position.at = if within { sum(position.at, by) } else { [LOST; 3] };
}
