//! The rotation matrix of a unit quaternion in fixed point, with error feedback of its rounding.
//!
//! `(quaternion, carry) => matrix, to 2^-30; carry`. The rounding error of an entry is added to it at the next pose
//! (error feedback: Spang & Schultheiss 1962), so that the error of a matrix is the difference of two rounding errors.
//! Forces of stiff springs are as noisy as before, but the noise at the frequencies of a mechanism is small: at a
//! frequency ω the fraction (ω·h)² of its power remains.

use crate::fixed::number::{halves, square_of_halves, sum_of_products};
use crate::words::{Word, WordSource, WordVisitor, Words};

/// 1 with 60 bits after the point.
const ONE: i64 = 1 << 60;
/// Bits that an entry loses, of 59 after the point.
const LOST: u32 = 29;
/// Mask of these bits.
const ALL: u32 = (1 << LOST) - 1;

/// The rounding errors of a matrix's entries, row by row \[2^-59\].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(all(feature = "defmt", target_os = "none"), derive(defmt::Format))]
pub(super) struct Carry {
    lost: [[u32; 3]; 3],
}

impl Carry {
    /// For a pose without a predecessor: its entries are rounded to nearest.
    pub(super) const NEAREST: Self = Self { lost: [[ALL >> 1; 3]; 3] };

    /// The carry before a matrix was computed, from the carry after it, up to whole units: the same matrix results
    /// again.
    #[inline(always)]
    fn before(&self) -> Self {
        Self { lost: self.lost.map(|row| row.map(|lost| ALL - lost)) }
    }

    /// An entry of a sum with 59 bits after the point.
    #[inline(always)]
    fn entry(&mut self, row: usize, column: usize, sum: i64) -> i32 {
        let sum = sum.wrapping_add(i64::from(self.lost[row][column]));
        self.lost[row][column] = sum as u32 & ALL;
        (sum >> LOST) as i32
    }
}

/// The matrix of a pose that a body has reached in a step.
#[cfg_attr(not(target_pointer_width = "64"), inline(always))]
pub(super) fn next(w: i64, v: [i64; 3], carry: &mut Carry) -> [[i32; 3]; 3] {
    let (w, [x, y, z]) = (halves(w), v.map(halves));
    let [xx, yy, zz] = [x, y, z].map(square_of_halves);
    // Twice the products; 59 of 60 fraction bits.
    let mut pair = |[row, column]: [usize; 2], (a, b), (c, d)| {
        let (along, turned) = (sum_of_products([(a, b)]), sum_of_products([(c, d)]));
        [
            carry.entry(row, column, along.wrapping_add(turned)),
            carry.entry(column, row, along.wrapping_sub(turned)),
        ]
    };
    let [xy, yx] = pair([1, 0], (x, y), (w, z));
    let [zx, xz] = pair([0, 2], (x, z), (w, y));
    let [yz, zy] = pair([2, 1], (y, z), (w, x));
    let mut one =
        |at: usize, a: i64, b: i64| carry.entry(at, at, (ONE / 2).wrapping_sub(a.wrapping_add(b)));
    let (first, second, third) = (one(0, yy, zz), one(1, xx, zz), one(2, xx, yy));
    [[first, yx, zx], [xy, second, zy], [xz, yz, third]]
}

/// [`next`] of a pose rotated about z only: the same bits.
#[cfg_attr(not(target_pointer_width = "64"), inline(always))]
pub(super) fn next_about_z(w: i64, z: i64, carry: &mut Carry) -> [[i32; 3]; 3] {
    let (w, z) = (halves(w), halves(z));
    let turned = sum_of_products([(w, z)]);
    let (xy, yx) = (carry.entry(1, 0, turned), carry.entry(0, 1, turned.wrapping_neg()));
    let along = (ONE / 2).wrapping_sub(square_of_halves(z));
    [[carry.entry(0, 0, along), yx, 0], [xy, carry.entry(1, 1, along), 0], [0, 0, 1 << 30]]
}

/// The matrix of a body's present pose.
#[inline(always)]
pub(super) fn here(w: i64, v: [i64; 3], carry: &Carry) -> [[i32; 3]; 3] {
    next(w, v, &mut carry.before())
}

impl Words for Carry {
    fn visit(&self, visitor: &mut impl WordVisitor) {
        for lost in self.lost.as_flattened() {
            visitor.word(Word::I32(*lost as i32));
        }
    }

    fn fill(&mut self, source: &mut impl WordSource) {
        for lost in self.lost.as_flattened_mut() {
            *lost = source.take(4) as u32 & ALL;
        }
    }
}
