//! Vectors, rotation matrices and quaternions over a [`Real`].
//!
//! Every sum is written in ascending index order: `(x + y) + z`. Quaternions are scalar first, of unit length, and
//! rotate body axes into world axes.

use core::ops::{Add, Mul, Neg, Sub};

use crate::real::{Lanewise, Real, choose};
use crate::words::{WordSource, WordVisitor, Words};

/// A vector in space.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(all(feature = "defmt", target_os = "none"), derive(defmt::Format))]
pub struct Vec3<R> {
    /// First component.
    pub x: R,
    /// Second component.
    pub y: R,
    /// Third component.
    pub z: R,
}

impl<R> Vec3<R> {
    /// The vector (x, y, z).
    pub const fn new(x: R, y: R, z: R) -> Self {
        Self { x, y, z }
    }
}

impl<R: Real> Vec3<R> {
    /// The zero vector.
    pub const ZERO: Self = Self::new(R::ZERO, R::ZERO, R::ZERO);

    /// Each component rounded once from double precision.
    #[inline]
    pub fn from_f64(v: [f64; 3]) -> Self {
        Self::new(R::from_f64(v[0]), R::from_f64(v[1]), R::from_f64(v[2]))
    }

    /// The components in double precision, exact.
    #[inline]
    pub fn to_f64(self) -> [f64; 3] {
        [self.x.to_f64(), self.y.to_f64(), self.z.to_f64()]
    }

    /// `(x·x' + y·y') + z·z'`.
    #[inline(always)]
    pub fn dot(self, other: Self) -> R {
        self.x * other.x + self.y * other.y + self.z * other.z
    }

    /// The cross product.
    #[inline(always)]
    pub fn cross(self, other: Self) -> Self {
        Self::new(
            self.y * other.z - self.z * other.y,
            self.z * other.x - self.x * other.z,
            self.x * other.y - self.y * other.x,
        )
    }

    /// The unit vectors of the three axes.
    #[inline(always)]
    pub fn axes() -> [Self; 3] {
        let (o, i) = (R::ZERO, R::ONE);
        [Self::new(i, o, o), Self::new(o, i, o), Self::new(o, o, i)]
    }

    /// Two unit vectors normal to this unit vector and to each other: the first from the axis
    /// least aligned with it (ties: x, y, z).
    #[inline(always)]
    pub fn normals(self) -> [Self; 2] {
        if R::ONE_LANE { self.normals_apart() } else { self.normals_here() }
    }

    #[inline]
    fn normals_apart(self) -> [Self; 2] {
        self.normals_here()
    }

    #[inline(always)]
    fn normals_here(self) -> [Self; 2] {
        let [x, y, z] = Self::axes();
        let (least, less) = (self.x.abs(), self.y.abs());
        let of_x = least.at_most(less) & least.at_most(self.z.abs());
        let axis = choose!(R, of_x, x, choose!(R, less.at_most(self.z.abs()), y, z));
        let n = self.cross(axis);
        let n = n * n.dot(n).sqrt().reciprocal_or_zero();
        [n, self.cross(n)]
    }

    /// The component-wise product.
    #[inline(always)]
    pub fn scale(self, other: Self) -> Self {
        Self::new(self.x * other.x, self.y * other.y, self.z * other.z)
    }

    /// Whether every component is finite.
    // `x − x` is the test: 0 exactly where x is finite, NaN elsewhere.
    #[allow(clippy::eq_op)]
    #[inline(always)]
    pub fn is_finite(self) -> bool {
        (self.x - self.x) + (self.y - self.y) + (self.z - self.z) == R::ZERO
    }
}

impl<R: Real> Lanewise<R> for Vec3<R> {
    #[inline(always)]
    fn select(mask: R::Mask, then: Self, otherwise: Self) -> Self {
        Self::new(
            R::pick(mask, then.x, otherwise.x),
            R::pick(mask, then.y, otherwise.y),
            R::pick(mask, then.z, otherwise.z),
        )
    }
}

impl<R: Real> Add for Vec3<R> {
    type Output = Self;
    #[inline(always)]
    fn add(self, o: Self) -> Self {
        Self::new(self.x + o.x, self.y + o.y, self.z + o.z)
    }
}

impl<R: Real> Sub for Vec3<R> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, o: Self) -> Self {
        Self::new(self.x - o.x, self.y - o.y, self.z - o.z)
    }
}

impl<R: Real> Neg for Vec3<R> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self::new(-self.x, -self.y, -self.z)
    }
}

impl<R: Real> Mul<R> for Vec3<R> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, s: R) -> Self {
        Self::new(self.x * s, self.y * s, self.z * s)
    }
}

impl<R: Real> Words for Vec3<R> {
    fn visit(&self, visitor: &mut impl WordVisitor) {
        for value in [self.x, self.y, self.z] {
            visitor.word(value.word());
        }
    }

    fn fill(&mut self, source: &mut impl WordSource) {
        for value in [&mut self.x, &mut self.y, &mut self.z] {
            *value = R::from_words(source);
        }
    }
}

/// A rotation matrix, rows in world axes, columns in body axes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(all(feature = "defmt", target_os = "none"), derive(defmt::Format))]
pub struct Rotation<R> {
    /// First row.
    pub x: Vec3<R>,
    /// Second row.
    pub y: Vec3<R>,
    /// Third row.
    pub z: Vec3<R>,
}

impl<R: Real> Rotation<R> {
    /// The identity rotation.
    pub const IDENTITY: Self = Self {
        x: Vec3::new(R::ONE, R::ZERO, R::ZERO),
        y: Vec3::new(R::ZERO, R::ONE, R::ZERO),
        z: Vec3::new(R::ZERO, R::ZERO, R::ONE),
    };

    /// Body axes to world axes: `R·v`.
    #[inline(always)]
    pub fn to_world(&self, v: Vec3<R>) -> Vec3<R> {
        Vec3::new(self.x.dot(v), self.y.dot(v), self.z.dot(v))
    }

    /// World axes to body axes: `Rᵀ·v`.
    #[inline(always)]
    pub fn to_body(&self, v: Vec3<R>) -> Vec3<R> {
        Vec3::new(
            self.x.x * v.x + self.y.x * v.y + self.z.x * v.z,
            self.x.y * v.x + self.y.y * v.y + self.z.y * v.z,
            self.x.z * v.x + self.y.z * v.y + self.z.z * v.z,
        )
    }
}

/// A quaternion, scalar first; of unit length wherever it represents an orientation (body → world).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(all(feature = "defmt", target_os = "none"), derive(defmt::Format))]
pub struct Quaternion<R> {
    /// Scalar part.
    pub w: R,
    /// Vector part.
    pub v: Vec3<R>,
}

impl<R> Quaternion<R> {
    /// The quaternion `w + x·i + y·j + z·k`.
    pub const fn new(w: R, x: R, y: R, z: R) -> Self {
        Self { w, v: Vec3::new(x, y, z) }
    }
}

impl<R: Real> Default for Quaternion<R> {
    fn default() -> Self {
        Self::IDENTITY
    }
}

impl<R: Real> Quaternion<R> {
    /// The identity rotation.
    pub const IDENTITY: Self = Self::new(R::ONE, R::ZERO, R::ZERO, R::ZERO);

    /// Each component rounded once from double precision, scalar first.
    #[inline]
    pub fn from_f64(q: [f64; 4]) -> Self {
        Self { w: R::from_f64(q[0]), v: Vec3::from_f64([q[1], q[2], q[3]]) }
    }

    /// The components in double precision, scalar first, exact.
    #[inline]
    pub fn to_f64(self) -> [f64; 4] {
        let v = self.v.to_f64();
        [self.w.to_f64(), v[0], v[1], v[2]]
    }

    /// The conjugate; the inverse of a unit quaternion.
    #[inline(always)]
    pub fn conjugate(self) -> Self {
        Self { w: self.w, v: -self.v }
    }

    /// The Hamilton product `self ∘ other`.
    #[inline(always)]
    pub fn product(self, other: Self) -> Self {
        let (a, b) = (self.v, other.v);
        Self { w: self.w * other.w - a.dot(b), v: (b * self.w + a * other.w) + a.cross(b) }
    }

    /// [`Self::product`] with a rotation about one of the first factor's axes, `cos` and `sin` of half the angle:
    /// without the products of zeros, except the one that determines a zero's sign where a body rotates in a plane.
    #[inline(always)]
    pub(crate) fn turned_about<const AXIS: usize>(self, cos: R, sin: R) -> Self {
        let (w, Vec3 { x, y, z }) = (self.w, self.v);
        let zero = R::ZERO * w;
        let kept = |along: R, across: R| (zero + along * cos) + across;
        match AXIS {
            0 => Self {
                w: w * cos - x * sin,
                v: Vec3::new(sin * w + x * cos, kept(y, z * sin), kept(z, -(y * sin))),
            },
            1 => Self {
                w: w * cos - y * sin,
                v: Vec3::new(kept(x, -(z * sin)), sin * w + y * cos, kept(z, x * sin)),
            },
            _ => Self {
                w: w * cos - z * sin,
                v: Vec3::new(kept(x, y * sin), kept(y, -(x * sin)), sin * w + z * cos),
            },
        }
    }

    /// `self + s·(1 − |self|²)/2·self`: one Newton step towards unit length, no root, no division.
    #[inline(always)]
    pub fn renormalised(self) -> Self {
        let n = self.w * self.w + self.v.dot(self.v);
        let s = (R::ONE + R::HALF) - R::HALF * n;
        Self { w: self.w * s, v: self.v * s }
    }

    /// The matrix of a unit quaternion.
    #[inline(always)]
    pub fn rotation(self) -> Rotation<R> {
        let Vec3 { x, y, z } = self.v;
        let (x2, y2, z2) = (x + x, y + y, z + z);
        let (xx, yy, zz) = (x * x2, y * y2, z * z2);
        let (xy, xz, yz) = (x * y2, x * z2, y * z2);
        let (wx, wy, wz) = (self.w * x2, self.w * y2, self.w * z2);
        Rotation {
            x: Vec3::new(R::ONE - (yy + zz), xy - wz, xz + wy),
            y: Vec3::new(xy + wz, R::ONE - (xx + zz), yz - wx),
            z: Vec3::new(xz - wy, yz + wx, R::ONE - (xx + yy)),
        }
    }
}

impl<R: Real> Lanewise<R> for Quaternion<R> {
    #[inline(always)]
    fn select(mask: R::Mask, then: Self, otherwise: Self) -> Self {
        Self { w: R::pick(mask, then.w, otherwise.w), v: Vec3::select(mask, then.v, otherwise.v) }
    }
}

impl<R: Real> Words for Quaternion<R> {
    fn visit(&self, visitor: &mut impl WordVisitor) {
        visitor.word(self.w.word());
        self.v.visit(visitor);
    }

    fn fill(&mut self, source: &mut impl WordSource) {
        self.w = R::from_words(source);
        self.v.fill(source);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_matrix_of_a_product_is_the_product_of_matrices() {
        let unit = |q: [f64; 4]| {
            let n = libm::sqrt(q.iter().map(|c| c * c).sum());
            Quaternion::<f64>::from_f64(q.map(|c| c / n))
        };
        let (a, b) = (unit([0.7, -0.2, 0.4, 0.1]), unit([-0.3, 0.5, 0.5, 0.9]));
        let v = Vec3::new(0.3, -1.7, 2.2);
        let composed = a.product(b).rotation().to_world(v);
        let chained = a.rotation().to_world(b.rotation().to_world(v));
        for (p, q) in composed.to_f64().into_iter().zip(chained.to_f64()) {
            assert!((p - q).abs() < 1e-14, "{p} {q}");
        }
        let back = a.rotation().to_body(a.rotation().to_world(v));
        for (p, q) in back.to_f64().into_iter().zip(v.to_f64()) {
            assert!((p - q).abs() < 1e-14, "{p} {q}");
        }
    }

    #[test]
    fn a_quarter_turn_about_z_takes_x_to_y() {
        let h = core::f64::consts::FRAC_1_SQRT_2;
        let v = Quaternion::new(h, 0.0, 0.0, h).rotation().to_world(Vec3::new(1.0, 0.0, 0.0));
        assert!(v.x.abs() < 1e-15 && (v.y - 1.0).abs() < 1e-15 && v.z == 0.0);
    }

    #[test]
    fn finite_is_told_from_infinite_and_nan() {
        assert!(Vec3::new(1e308, -3.0, 0.0).is_finite());
        assert!(!Vec3::new(f64::NAN, 0.0, 0.0).is_finite());
        assert!(!Vec3::new(0.0, f64::INFINITY, 0.0).is_finite());
        assert!(!Vec3::new(0.0, 0.0, f32::NEG_INFINITY).is_finite());
    }
}
