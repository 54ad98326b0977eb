//! The plane: vectors of two components, moments of one, rotations about z.
//!
//! `space's z = 0 => two, one and two numbers`. A rotation is stored as its spatial quaternion about z, the scalar part
//! and z: so states, torsion angles and revolution counts of the plane are those of space, without the zeros.

use core::ops::{Add, Mul, Neg, Sub};

use crate::real::{Lanewise, Real};
use crate::space::{Linear, Moment, Space, Turn, Vector};
use crate::vector::{Quaternion, Vec3};
use crate::words::{WordSource, WordVisitor, Words};

/// The plane over a number: three degrees of freedom per body.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(all(feature = "defmt", target_os = "none"), derive(defmt::Format))]
pub struct Plane<R>(core::marker::PhantomData<R>);

impl<R: Real> Space for Plane<R> {
    type Real = R;
    type Vector = Vec2<R>;
    type Moment = Axial<R>;
    type Turn = Heading<R>;
    type Row = [R; 3];
    type Filler = Filler;

    const NAME: &'static str = "planar";
    const PLANAR: bool = true;

    #[inline(always)]
    fn row(linear: Vec2<R>, angular: Axial<R>) -> [R; 3] {
        [linear.x, linear.y, angular.z]
    }
    #[inline(always)]
    fn parts([x, y, z]: [R; 3]) -> (Vec2<R>, Axial<R>) {
        (Vec2::new(x, y), Axial::new(z))
    }
    #[inline(always)]
    fn set_mass(mass: R, inertia: Axial<R>, _: [Axial<R>; 3], block: &mut [[R; 3]; 3]) {
        let none = R::ZERO;
        *block = [[mass, none, none], [none, mass, none], [none, none, inertia.z]];
    }
    #[inline(always)]
    fn add_point(weight: R, r: Vec2<R>, [a, b, z]: &mut [[R; 3]; 3]) {
        let m = r * weight;
        (a[0], b[1]) = (a[0] + weight, b[1] + weight);
        (z[0], z[1], z[2]) = (z[0] - m.y, z[1] + m.x, z[2] + m.dot(r));
    }
    #[inline(always)]
    fn take_points(weight: R, [r, s]: [Vec2<R>; 2], [a, b, z]: &mut [[R; 3]; 3]) {
        let (m, n) = (r * weight, s * weight);
        (a[0], a[2]) = (a[0] - weight, a[2] + n.y);
        (b[1], b[2]) = (b[1] - weight, b[2] - n.x);
        (z[0], z[1], z[2]) = (z[0] + m.y, z[1] - m.x, z[2] - m.dot(s));
    }
    /// A rotation about an axis in the plane leaves it.
    #[inline(always)]
    fn add_across(_: R, _: Vec2<R>, _: &mut [[R; 3]; 3]) {}
    #[inline(always)]
    fn take_across(_: R, _: Vec2<R>, _: &mut [[R; 3]; 3]) {}
}

/// A zero-sized type with an alignment of eight: three single-precision numbers with it occupy the space of four.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(align(8))]
pub struct Filler;

/// A vector in the plane.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(all(feature = "defmt", target_os = "none"), derive(defmt::Format))]
pub struct Vec2<R> {
    /// First component.
    pub x: R,
    /// Second component.
    pub y: R,
}

impl<R> Vec2<R> {
    /// The vector (x, y).
    pub const fn new(x: R, y: R) -> Self {
        Self { x, y }
    }
}

/// A moment, an angular velocity or an inertia about z.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(all(feature = "defmt", target_os = "none"), derive(defmt::Format))]
pub struct Axial<R> {
    /// About z.
    pub z: R,
}

impl<R> Axial<R> {
    /// The moment z.
    pub const fn new(z: R) -> Self {
        Self { z }
    }
}

/// Selection by lanes, sums, differences and multiples, component by component.
macro_rules! linear {
    ($name:ident, $($component:ident),+) => {
        impl<R: Real> Lanewise<R> for $name<R> {
            #[inline(always)]
            fn select(mask: R::Mask, then: Self, otherwise: Self) -> Self {
                Self::new($(R::pick(mask, then.$component, otherwise.$component)),+)
            }
        }
        impl<R: Real> Add for $name<R> {
            type Output = Self;
            #[inline(always)]
            fn add(self, o: Self) -> Self {
                Self::new($(self.$component + o.$component),+)
            }
        }

        impl<R: Real> Sub for $name<R> {
            type Output = Self;
            #[inline(always)]
            fn sub(self, o: Self) -> Self {
                Self::new($(self.$component - o.$component),+)
            }
        }

        impl<R: Real> Neg for $name<R> {
            type Output = Self;
            #[inline(always)]
            fn neg(self) -> Self {
                Self::new($(-self.$component),+)
            }
        }

        impl<R: Real> Mul<R> for $name<R> {
            type Output = Self;
            #[inline(always)]
            fn mul(self, s: R) -> Self {
                Self::new($(self.$component * s),+)
            }
        }

        impl<R: Real> Words for $name<R> {
            fn visit(&self, visitor: &mut impl WordVisitor) {
                $(visitor.word(self.$component.word());)+
            }

            fn fill(&mut self, source: &mut impl WordSource) {
                $(self.$component = R::from_words(source);)+
            }
        }
    };
}

linear!(Vec2, x, y);
linear!(Axial, z);

impl<R: Real> Linear for Vec2<R> {
    type Real = R;

    const ZERO: Self = Self::new(R::ZERO, R::ZERO);
    const DIMENSION: usize = 2;

    #[inline]
    fn from_f64(v: [f64; 3]) -> Self {
        Self::new(R::from_f64(v[0]), R::from_f64(v[1]))
    }
    #[inline]
    fn holds(v: [f64; 3]) -> bool {
        v[2] == 0.0
    }
    #[inline]
    fn to_f64(self) -> [f64; 3] {
        [self.x.to_f64(), self.y.to_f64(), 0.0]
    }
    #[inline(always)]
    fn of_space(v: Vec3<R>) -> Self {
        Self::new(v.x, v.y)
    }
    #[inline(always)]
    fn in_space(self) -> Vec3<R> {
        Vec3::new(self.x, self.y, R::ZERO)
    }
    #[inline(always)]
    fn dot(self, other: Self) -> R {
        self.x * other.x + self.y * other.y
    }
    #[inline(always)]
    fn axes() -> [Self; 3] {
        [Self::new(R::ONE, R::ZERO), Self::new(R::ZERO, R::ONE), Self::ZERO]
    }
    // As for a spatial vector.
    #[allow(clippy::eq_op)]
    #[inline(always)]
    fn is_finite(self) -> bool {
        (self.x - self.x) + (self.y - self.y) == R::ZERO
    }
}

impl<R: Real> Vector for Vec2<R> {
    type Moment = Axial<R>;

    #[inline(always)]
    fn cross(self, force: Self) -> Axial<R> {
        Axial::new(self.x * force.y - self.y * force.x)
    }
    #[inline(always)]
    fn normals(self) -> [Self; 2] {
        [Self::new(-self.y, self.x), Self::ZERO]
    }
    #[inline(always)]
    fn across(self, _: Self) -> Self {
        Self::ZERO
    }
}

impl<R: Real> Linear for Axial<R> {
    type Real = R;

    const ZERO: Self = Self::new(R::ZERO);
    const DIMENSION: usize = 1;

    #[inline]
    fn from_f64(v: [f64; 3]) -> Self {
        Self::new(R::from_f64(v[2]))
    }
    #[inline]
    fn holds(v: [f64; 3]) -> bool {
        v[0] == 0.0 && v[1] == 0.0
    }
    #[inline]
    fn to_f64(self) -> [f64; 3] {
        [0.0, 0.0, self.z.to_f64()]
    }
    #[inline(always)]
    fn of_space(v: Vec3<R>) -> Self {
        Self::new(v.z)
    }
    #[inline(always)]
    fn in_space(self) -> Vec3<R> {
        Vec3::new(R::ZERO, R::ZERO, self.z)
    }
    #[inline(always)]
    fn dot(self, other: Self) -> R {
        self.z * other.z
    }
    #[inline(always)]
    fn axes() -> [Self; 3] {
        [Self::new(R::ONE), Self::ZERO, Self::ZERO]
    }
    #[inline(always)]
    fn is_finite(self) -> bool {
        self.z.is_finite()
    }
}

impl<R: Real> Moment for Axial<R> {
    type Vector = Vec2<R>;

    #[inline(always)]
    fn cross(self, arm: Vec2<R>) -> Vec2<R> {
        Vec2::new(-(self.z * arm.y), self.z * arm.x)
    }
    #[inline(always)]
    fn commutator(self, _: Self) -> Self {
        Self::ZERO
    }
    #[inline(always)]
    fn scale(self, other: Self) -> Self {
        Self::new(self.z * other.z)
    }
    #[inline(always)]
    fn under(self, number: R) -> Self {
        Self::new(number / self.z)
    }
    #[inline]
    fn root(self) -> Self {
        Self::new(self.z.sqrt())
    }
    #[inline(always)]
    fn of_columns(self, [z, ..]: [Self; 3]) -> Self {
        z * self.z
    }
}

/// A rotation about z: the quaternion of unit length `w + z·k`, cosine and sine of the half angle.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(all(feature = "defmt", target_os = "none"), derive(defmt::Format))]
pub struct Heading<R> {
    /// Cosine of the half angle.
    pub w: R,
    /// Sine of the half angle.
    pub z: R,
}

impl<R> Heading<R> {
    /// The rotation `w + z·k`.
    pub const fn new(w: R, z: R) -> Self {
        Self { w, z }
    }
}

impl<R: Real> Default for Heading<R> {
    fn default() -> Self {
        Self::new(R::ONE, R::ZERO)
    }
}

impl<R: Real> Heading<R> {
    /// Cosine and sine of the whole angle.
    #[inline(always)]
    pub fn cosine_and_sine(self) -> (R, R) {
        let twice = self.z + self.z;
        (R::ONE - self.z * twice, self.w * twice)
    }

    /// As [`Quaternion::renormalised`].
    #[inline(always)]
    pub fn renormalised(self) -> Self {
        let n = self.w * self.w + self.z * self.z;
        let s = (R::ONE + R::HALF) - R::HALF * n;
        Self::new(self.w * s, self.z * s)
    }
}

impl<R: Real> Turn for Heading<R> {
    type Real = R;
    type Moment = Axial<R>;

    #[inline]
    fn from_f64(turn: [f64; 4]) -> Self {
        Self::new(R::from_f64(turn[0]), R::from_f64(turn[3]))
    }
    #[inline]
    fn to_f64(self) -> [f64; 4] {
        [self.w.to_f64(), 0.0, 0.0, self.z.to_f64()]
    }
    #[inline(always)]
    fn conjugate(self) -> Self {
        Self::new(self.w, -self.z)
    }
    #[inline(always)]
    fn product(self, other: Self) -> Self {
        Self::new(self.w * other.w - self.z * other.z, other.z * self.w + self.z * other.w)
    }
    #[inline(always)]
    fn about(self, axis: Axial<R>) -> (R, R) {
        (self.w, self.z * axis.z)
    }
    #[inline(always)]
    fn gradient(self, axis: Axial<R>, _: R, _: R) -> Axial<R> {
        axis
    }
}

impl<R: Real> From<Heading<R>> for Quaternion<R> {
    fn from(turn: Heading<R>) -> Self {
        Quaternion::new(turn.w, R::ZERO, R::ZERO, turn.z)
    }
}

impl<R: Real> Words for Heading<R> {
    fn visit(&self, visitor: &mut impl WordVisitor) {
        visitor.word(self.w.word());
        visitor.word(self.z.word());
    }

    fn fill(&mut self, source: &mut impl WordSource) {
        self.w = R::from_words(source);
        self.z = R::from_words(source);
    }
}
