//! A fixed-point unit quaternion and its fixed-point rotation matrix.
//!
//! `(rotation in single precision, quaternion) => quaternion, to 2^-60; quaternion => matrix, to 2^-30`. The rotation
//! of a step has single precision; the quaternion it is added to keeps its own. A rotation that is not representable,
//! one of several radians, results in zero, which stays zero.

use crate::attitude::Attitude;
use crate::fixed::matrix::{self, Carry};
use crate::fixed::number::{
    from_f32, from_f64, halves, in_words, nearest_f32, product, squared, sum_of_products,
    sum_of_squares, to_f64,
};
use crate::real::Real as _;
use crate::vector::{Quaternion, Rotation, Vec3};
use crate::words::{Word, WordSource, WordVisitor, Words};

/// Fraction bits.
const BITS: i32 = 62;
/// The tolerance of unit length: below the resolution of a matrix, and not exceeded by the rotation of a step.
const LITTLE: i64 = 1 << (BITS - 48);
/// 1 with 60 fraction bits.
const ONE: i64 = 1 << 60;
/// The largest half angle that is applied at once.
const MAX: f32 = 0.25;

/// A unit quaternion, 62 fraction bits, scalar first.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(all(feature = "defmt", target_os = "none"), derive(defmt::Format))]
pub struct FixedTurn {
    /// Scalar part.
    pub w: i64,
    /// Vector part.
    pub v: [i64; 3],
    carry: Carry,
}

impl Default for FixedTurn {
    fn default() -> Self {
        Self::from_words(1 << BITS, [0; 3])
    }
}

impl FixedTurn {
    /// Each component of a unit quaternion rounded once, scalar first.
    #[must_use]
    pub const fn new(orientation: [f64; 4]) -> Self {
        let [w, x, y, z] = orientation;
        let bits = BITS as u32;
        let vector = [from_f64(x, bits), from_f64(y, bits), from_f64(z, bits)];
        Self::from_words(from_f64(w, bits), vector)
    }

    /// Scalar and vector part of a unit quaternion in stored form.
    #[must_use]
    pub const fn from_words(w: i64, v: [i64; 3]) -> Self {
        Self { w, v, carry: Carry::NEAREST }
    }

    /// The conjugate.
    #[inline(always)]
    fn conjugate(&self) -> Self {
        Self { v: self.v.map(i64::wrapping_neg), ..*self }
    }

    /// Rotates about a body axis by half the angle in two numbers, to 2^-35 of it.
    #[cfg_attr(not(target_pointer_width = "64"), inline(always))]
    pub(crate) fn turn_exactly<const AXIS: usize>(&mut self, (whole, rest): (f32, f32)) {
        let half = whole + rest;
        // The sine is valid up to a half, which no useful step reaches.
        if half.abs() <= MAX {
            self.turn_a_little::<AXIS>((whole, rest));
        } else {
            self.turn_in_parts::<AXIS>((whole, rest));
        }
    }

    /// The same in four parts, or fails where it is several radians or NaN.
    #[cold]
    #[inline(never)]
    fn turn_in_parts<const AXIS: usize>(&mut self, (whole, rest): (f32, f32)) {
        let half = whole + rest;
        if half.abs() > 1.0 || half.is_nan() {
            *self = Self::from_words(0, [0; 3]);
            return;
        }
        for _ in 0..4 {
            self.turn_a_little::<AXIS>((0.25 * whole, 0.25 * rest));
        }
    }

    #[inline(always)]
    fn turn_a_little<const AXIS: usize>(&mut self, (whole, rest): (f32, f32)) {
        let half = whole + rest;
        // Cosine minus 1 and sine minus the angle: Taylor polynomials.
        let square = half * half;
        let cosine = square.polynomial(&[-0.5, 1.0 / 24.0, -1.0 / 720.0]) * square;
        let sine = square.polynomial(&[-1.0 / 6.0, 1.0 / 120.0, -1.0 / 5_040.0]) * square * half;
        let (w, [x, y, z]) = (halves(self.w), self.v.map(halves));
        // The error of unit length is corrected: half of it in each component (Newton).
        let missing = ONE.wrapping_sub(sum_of_squares([w, x, y, z]));
        let cosine = halves(in_words::<32>(cosine).wrapping_add(missing << 3));
        let sine = in_words::<32>(whole).wrapping_add(in_words::<32>(rest + sine));
        let (sine, back) = (halves(sine), halves(sine.wrapping_neg()));
        // The change of a component, with the sign of another one's contribution.
        let change = |c: (i32, i32), across: (i32, i32), sine: (i32, i32)| {
            sum_of_products([((c.0, 0), cosine), (across, sine)])
        };
        if AXIS == 2 && self.is_about_z() {
            // In planar motion the others stay zero.
            self.w = self.w.wrapping_add(change(w, z, back));
            self.v[2] = self.v[2].wrapping_add(change(z, w, sine));
            return;
        }
        let (by_w, by) = match AXIS {
            0 => (change(w, x, back), [change(x, w, sine), change(y, z, sine), change(z, y, back)]),
            1 => (change(w, y, back), [change(x, z, back), change(y, w, sine), change(z, x, sine)]),
            _ => (change(w, z, back), [change(x, y, sine), change(y, x, back), change(z, w, sine)]),
        };
        self.w = self.w.wrapping_add(by_w);
        for (c, by) in self.v.iter_mut().zip(by) {
            *c = c.wrapping_add(by);
        }
    }

    /// The Hamilton product, to a few units of 2^-60.
    #[cfg_attr(not(target_pointer_width = "64"), inline(always))]
    fn product(&self, other: &Self) -> Self {
        let (a, [ax, ay, az]) = (self.w, self.v);
        let (b, [bx, by, bz]) = (other.w, other.v);
        let sum = |terms: [i64; 4]| {
            let [p, q, r, s] = terms;
            p.wrapping_add(q).wrapping_add(r).wrapping_sub(s) << 2
        };
        let opposite = |p: i64, q: i64| product(p, q).wrapping_neg();
        Self {
            w: sum([product(a, b), opposite(ax, bx), opposite(ay, by), product(az, bz)]),
            v: [
                sum([product(a, bx), product(ax, b), product(ay, bz), product(az, by)]),
                sum([product(a, by), product(ay, b), product(az, bx), product(ax, bz)]),
                sum([product(a, bz), product(az, b), product(ax, by), product(ay, bx)]),
            ],
            ..*self
        }
    }

    /// Whether it rotates about z only, as in planar motion.
    #[inline(always)]
    pub(super) fn is_about_z(&self) -> bool {
        let [x, y, _] = self.v;
        x | y == 0
    }

    /// The matrix, 30 fraction bits.
    #[inline(always)]
    pub(super) fn matrix(&self) -> [[i32; 3]; 3] {
        matrix::here(self.w, self.v, &self.carry)
    }

    /// After the rotations of a step: the matrix; its rounding error is kept for the next.
    #[inline(always)]
    pub(super) fn next_matrix(&mut self) -> [[i32; 3]; 3] {
        matrix::next(self.w, self.v, &mut self.carry)
    }

    /// [`Self::next_matrix`] where it [is about z](Self::is_about_z).
    #[inline(always)]
    pub(super) fn next_matrix_about_z(&mut self) -> [[i32; 3]; 3] {
        matrix::next_about_z(self.w, self.v[2], &mut self.carry)
    }

    /// A Newton step towards unit length, where the error exceeds 2^-48.
    #[inline(always)]
    fn lengthen(&mut self) {
        let [x, y, z] = self.v;
        // Half of the error, 62 fraction bits.
        let missing = ONE.wrapping_sub(squared(&[self.w, x, y, z])) << 1;
        if (-LITTLE..LITTLE).contains(&missing) {
            return;
        }
        if let Ok(little) = i32::try_from(missing) {
            let more = |c: i64| c.wrapping_add(((c >> 32) * i64::from(little)) >> 30);
            *self = Self { w: more(self.w), v: self.v.map(more), ..*self };
        } else {
            let more = |c: i64| c.wrapping_add(product(c, missing) << 2);
            *self = Self { w: more(self.w), v: self.v.map(more), ..*self };
        }
    }
}

/// The value of one unit of a fixed-point matrix.
pub(crate) const UNIT: f32 = 1.0 / (1 << 30) as f32;

/// A fixed-point matrix in single precision, in its own units: the caller scales one vector.
#[inline(always)]
pub(crate) fn in_whole(matrix: &[[i32; 3]; 3]) -> Rotation<f32> {
    let row = |[x, y, z]: [i32; 3]| Vec3::new(x as f32, y as f32, z as f32);
    let [x, y, z] = *matrix;
    Rotation { x: row(x), y: row(y), z: row(z) }
}

impl Words for FixedTurn {
    fn visit(&self, visitor: &mut impl WordVisitor) {
        visitor.word(Word::U64(self.w as u64));
        for c in self.v {
            visitor.word(Word::U64(c as u64));
        }
        self.carry.visit(visitor);
    }

    fn fill(&mut self, source: &mut impl WordSource) {
        self.w = source.take(8) as i64;
        for c in &mut self.v {
            *c = source.take(8) as i64;
        }
        self.carry.fill(source);
    }
}

impl Attitude for FixedTurn {
    type Real = f32;
    type Turn = Quaternion<f32>;

    const NAME: &'static str = "quaternion";

    #[inline(always)]
    fn rotation(&self) -> Rotation<f32> {
        let Rotation { x, y, z } = in_whole(&self.matrix());
        Rotation { x: x * UNIT, y: y * UNIT, z: z * UNIT }
    }
    // Torsion springs take their angle from it: truncation would do work of constant sign.
    #[cfg_attr(not(target_pointer_width = "64"), inline(always))]
    fn quaternion(&self) -> Quaternion<f32> {
        let [w, x, y, z] = [self.w, self.v[0], self.v[1], self.v[2]].map(nearest_f32::<BITS>);
        Quaternion::new(w, x, y, z)
    }
    #[inline(always)]
    fn since_world(&self) -> Quaternion<f32> {
        self.quaternion()
    }
    #[inline(always)]
    fn turn(&mut self, turn: Quaternion<f32>) {
        let length = turn.w * turn.w + turn.v.dot(turn.v);
        if !(0.75..1.25).contains(&length) {
            *self = Self::from_words(0, [0; 3]);
            return;
        }
        let fixed = from_f32::<30, 30>;
        let Vec3 { x, y, z } = turn.v;
        let [w, x, y, z] = [turn.w, x, y, z].map(|c| fixed(c) << 2);
        *self = self.product(&Self::from_words(w, [x, y, z]));
    }
    #[inline(always)]
    fn renormalise(&mut self) {
        self.lengthen();
        self.next_matrix();
    }
    #[inline(always)]
    fn is_lost(&self) -> bool {
        let [x, y, z] = self.v;
        // One component of a unit quaternion is at least a half.
        (self.w | x | y | z) >> 32 == 0
    }
    fn from_f64(orientation: [f64; 4]) -> Self {
        Self::new(orientation)
    }
    fn to_f64(&self) -> [f64; 4] {
        [self.w, self.v[0], self.v[1], self.v[2]].map(|c| to_f64(c, BITS as u32))
    }
    /// For nearby orientations the small components of their difference have full precision.
    #[inline(always)]
    fn relative(first: Option<&Self>, second: Option<&Self>) -> Quaternion<f32> {
        match (first, second) {
            (Some(a), Some(b)) => a.conjugate().product(b).quaternion(),
            (Some(a), None) => a.conjugate().quaternion(),
            (None, Some(b)) => b.quaternion(),
            (None, None) => Quaternion::IDENTITY,
        }
    }
}
