//! The space in which bodies move: its vectors, moments and rotations.
//!
//! A vector is a difference of positions, a velocity or a force; a moment is an angular velocity, a torque or a
//! principal inertia. In space both are [`Vec3`]; a number type also represents the space over it, so that types with
//! vectors and moments of space are written with its number: `Body<f64>`. Types with a fixed layout elsewhere have
//! three components here: a plane is z = 0, its moments are along z.

use core::fmt::Debug;
use core::ops::{Add, Mul, Neg, Sub};

use crate::freedoms::Freedoms;
use crate::real::{Lanewise, Real};
use crate::vector::{Quaternion, Vec3};
use crate::words::Words;

/// The common operations of vectors and moments.
pub trait Linear:
    Copy
    + Debug
    + Default
    + PartialEq
    + Words
    + Add<Output = Self>
    + Sub<Output = Self>
    + Neg<Output = Self>
    + Mul<<Self as Linear>::Real, Output = Self>
    + Lanewise<<Self as Linear>::Real>
    + Send
    + Sync
    + 'static
{
    /// The number of its components.
    type Real: Real;

    /// Zero.
    const ZERO: Self;
    /// The number of its components.
    const DIMENSION: usize;

    /// Its components from a spatial vector, each rounded once from double precision.
    fn from_f64(v: [f64; 3]) -> Self;
    /// Whether the remaining components of a spatial vector are zero.
    fn holds(v: [f64; 3]) -> bool;
    /// As a spatial vector in double precision, exact.
    fn to_f64(self) -> [f64; 3];
    /// Its components from a spatial vector.
    fn of_space(v: Vec3<Self::Real>) -> Self;
    /// As a spatial vector.
    fn in_space(self) -> Vec3<Self::Real>;
    /// The scalar product.
    fn dot(self, other: Self) -> Self::Real;
    /// Its [`Self::DIMENSION`] unit vectors, then zeros.
    fn axes() -> [Self; 3];
    /// Whether every component is finite.
    fn is_finite(self) -> bool;

    /// Itself, or, where `mask` is set, zeros of negative sign, which change nothing when added.
    #[inline(always)]
    fn unless(self, mask: <Self::Real as Real>::Mask) -> Self {
        Self::select(mask, -Self::ZERO, self)
    }
}

/// A difference of positions \[m\], a velocity \[m/s\] or a force \[N\].
pub trait Vector: Linear {
    /// The moment of a force at a lever arm.
    type Moment;

    /// The moment `self × force`, self a lever arm.
    fn cross(self, force: Self) -> Self::Moment;
    /// Unit vectors normal to this unit vector and to each other, [`Linear::DIMENSION`] minus one, then zeros.
    fn normals(self) -> [Self; 2];
    /// The vector normal to this one and another, with the product of their lengths and the sine between them; zero
    /// where there is no such direction.
    fn across(self, other: Self) -> Self;
}

/// An angular velocity \[rad/s\], a torque \[N·m\] or the principal inertia \[kg·m²\].
pub trait Moment: Linear {
    /// Displacements and forces of the same space.
    type Vector;

    /// The velocity `self × arm`, self an angular velocity.
    fn cross(self, arm: Self::Vector) -> Self::Vector;
    /// `self × other`, zero where all rotations commute.
    fn commutator(self, other: Self) -> Self;
    /// The component-wise product.
    fn scale(self, other: Self) -> Self;
    /// `number` divided by each component.
    fn under(self, number: Self::Real) -> Self;
    /// The square root of each component.
    fn root(self) -> Self;
    /// The sum of the columns, each times its component: a matrix of columns times itself.
    fn of_columns(self, columns: [Self; 3]) -> Self;
}

/// The relative orientation of two bodies, as half angles, for torsion springs.
pub trait Turn: Copy + Debug + Default + PartialEq + Send + Sync + Words + 'static {
    /// The number of its components.
    type Real: Real;
    /// An axis.
    type Moment;

    /// From a unit quaternion, scalar first, each component rounded once.
    fn from_f64(turn: [f64; 4]) -> Self;
    /// The unit quaternion in double precision, scalar first, exact.
    fn to_f64(self) -> [f64; 4];
    /// The inverse rotation.
    fn conjugate(self) -> Self;
    /// `other` first in its axes, then self.
    fn product(self, other: Self) -> Self;
    /// Cosine and sine of the half angle about a unit axis: w and v·n of the quaternion (w, v).
    fn about(self, axis: Self::Moment) -> (Self::Real, Self::Real);
    /// The gradient `(w²·n + w·v×n + (v·n)·v)/(w² + (v·n)²)` of the angle about the unit axis n, given
    /// `sine`, v·n, and `norm`, the denominator.
    fn gradient(self, axis: Self::Moment, sine: Self::Real, norm: Self::Real) -> Self::Moment;
}

/// The block of a space's degrees of freedom.
pub type BlockOf<S> = <<S as Space>::Row as Freedoms>::Block;

/// A space that bodies move in, over a number.
pub trait Space: Copy + Debug + Default + PartialEq + 'static {
    /// The number in which forces and rates are computed.
    type Real: Real;
    /// Differences of positions, velocities, forces.
    type Vector: Vector<Real = Self::Real, Moment = Self::Moment>;
    /// Angular velocities, torques, inertias.
    type Moment: Moment<Real = Self::Real, Vector = Self::Vector>;
    /// Rotations of one body relative to another.
    type Turn: Turn<Real = Self::Real, Moment = Self::Moment>;
    /// One number per degree of freedom of a body.
    type Row: Freedoms<Real = Self::Real>;
    /// The padding of a wrench: none, or enough to make its length a power of two, so that indexing needs no
    /// multiplication.
    type Filler: Copy + Debug + Default + PartialEq + Send + 'static;

    /// The name users give: `spatial`, `planar`.
    const NAME: &'static str;
    /// Whether every rotation is about z.
    const PLANAR: bool;

    /// The row of a vector and a moment.
    fn row(linear: Self::Vector, angular: Self::Moment) -> Self::Row;
    /// The vector and the moment of a row.
    fn parts(row: Self::Row) -> (Self::Vector, Self::Moment);
    /// Writes a body's block: its mass, its principal inertia about axes.
    fn set_mass(
        mass: Self::Real,
        inertia: Self::Moment,
        axes: [Self::Moment; 3],
        block: &mut BlockOf<Self>,
    );
    /// Adds `Σ w·j·jᵀ`, `j = (u, r×u)` over all axes u, to the lower triangle of a block: an isotropic point stiffness
    /// at the lever arm r.
    fn add_point(weight: Self::Real, arm: Self::Vector, block: &mut BlockOf<Self>);
    /// Subtracts `Σ w·(u, r×u)·(u, s×u)ᵀ` from a block, r and s the lever arms of its rows' and columns' body.
    fn take_points(weight: Self::Real, arms: [Self::Vector; 2], block: &mut BlockOf<Self>);
    /// Adds `w·(I − e·eᵀ)` to the rotations of a symmetric block: a stiffness that aligns an axis e.
    fn add_across(weight: Self::Real, axis: Self::Vector, block: &mut BlockOf<Self>);
    /// Subtracts the same from a block of two bodies.
    fn take_across(weight: Self::Real, axis: Self::Vector, block: &mut BlockOf<Self>);
}

impl<R: Real> Space for R {
    type Real = R;
    type Vector = Vec3<R>;
    type Moment = Vec3<R>;
    type Turn = Quaternion<R>;
    type Row = [R; 6];
    type Filler = ();

    const NAME: &'static str = "spatial";
    const PLANAR: bool = false;

    #[inline(always)]
    fn row(linear: Vec3<R>, angular: Vec3<R>) -> [R; 6] {
        [linear.x, linear.y, linear.z, angular.x, angular.y, angular.z]
    }
    #[inline(always)]
    fn parts([x, y, z, u, v, w]: [R; 6]) -> (Vec3<R>, Vec3<R>) {
        (Vec3::new(x, y, z), Vec3::new(u, v, w))
    }
    #[inline(always)]
    fn set_mass(mass: R, inertia: Vec3<R>, axes: [Vec3<R>; 3], block: &mut [[R; 6]; 6]) {
        let none = R::ZERO;
        let [u, v, w] = axes;
        let [a, b, c] = [u * inertia.x, v * inertia.y, w * inertia.z];
        let sum = |x: [R; 2], y: [R; 2], z: [R; 2]| x[0] * x[1] + y[0] * y[1] + z[0] * z[1];
        *block = [
            [mass, none, none, none, none, none],
            [none, mass, none, none, none, none],
            [none, none, mass, none, none, none],
            [none, none, none, sum([a.x, u.x], [b.x, v.x], [c.x, w.x]), none, none],
            [
                none,
                none,
                none,
                sum([a.y, u.x], [b.y, v.x], [c.y, w.x]),
                sum([a.y, u.y], [b.y, v.y], [c.y, w.y]),
                none,
            ],
            [
                none,
                none,
                none,
                sum([a.z, u.x], [b.z, v.x], [c.z, w.x]),
                sum([a.z, u.y], [b.z, v.y], [c.z, w.y]),
                sum([a.z, u.z], [b.z, v.z], [c.z, w.z]),
            ],
        ];
    }
    #[inline(always)]
    fn add_point(weight: R, r: Vec3<R>, block: &mut [[R; 6]; 6]) {
        let m = r * weight;
        let [a, b, c, x, y, z] = block;
        (a[0], b[1], c[2]) = (a[0] + weight, b[1] + weight, c[2] + weight);
        (x[1], x[2]) = (x[1] - m.z, x[2] + m.y);
        (y[0], y[2]) = (y[0] + m.z, y[2] - m.x);
        (z[0], z[1]) = (z[0] - m.y, z[1] + m.x);
        let (xx, yy, zz) = (m.x * r.x, m.y * r.y, m.z * r.z);
        x[3] = x[3] + (yy + zz);
        (y[3], y[4]) = (y[3] - m.x * r.y, y[4] + (xx + zz));
        (z[3], z[4], z[5]) = (z[3] - m.x * r.z, z[4] - m.y * r.z, z[5] + (xx + yy));
    }
    #[inline(always)]
    fn take_points(weight: R, [r, s]: [Vec3<R>; 2], block: &mut [[R; 6]; 6]) {
        let (m, n) = (r * weight, s * weight);
        let [a, b, c, x, y, z] = block;
        (a[0], b[1], c[2]) = (a[0] - weight, b[1] - weight, c[2] - weight);
        (a[4], a[5]) = (a[4] - n.z, a[5] + n.y);
        (b[3], b[5]) = (b[3] + n.z, b[5] - n.x);
        (c[3], c[4]) = (c[3] - n.y, c[4] + n.x);
        (x[1], x[2]) = (x[1] + m.z, x[2] - m.y);
        (y[0], y[2]) = (y[0] - m.z, y[2] + m.x);
        (z[0], z[1]) = (z[0] + m.y, z[1] - m.x);
        // (r·s)·I − s·rᵀ: the common part of r × u and s × u.
        let (xx, yy, zz) = (m.x * s.x, m.y * s.y, m.z * s.z);
        x[3] = x[3] - (yy + zz);
        (x[4], x[5]) = (x[4] + n.x * r.y, x[5] + n.x * r.z);
        (y[3], y[4], y[5]) = (y[3] + n.y * r.x, y[4] - (xx + zz), y[5] + n.y * r.z);
        (z[3], z[4], z[5]) = (z[3] + n.z * r.x, z[4] + n.z * r.y, z[5] - (xx + yy));
    }
    #[inline(always)]
    fn add_across(weight: R, e: Vec3<R>, [_, _, _, x, y, z]: &mut [[R; 6]; 6]) {
        let m = e * weight;
        x[3] = x[3] + (weight - m.x * e.x);
        (y[3], y[4]) = (y[3] - m.x * e.y, y[4] + (weight - m.y * e.y));
        (z[3], z[4]) = (z[3] - m.x * e.z, z[4] - m.y * e.z);
        z[5] = z[5] + (weight - m.z * e.z);
    }
    #[inline(always)]
    fn take_across(weight: R, e: Vec3<R>, [_, _, _, x, y, z]: &mut [[R; 6]; 6]) {
        let m = e * weight;
        let (xy, xz, yz) = (m.x * e.y, m.x * e.z, m.y * e.z);
        (x[3], x[4], x[5]) = (x[3] - (weight - m.x * e.x), x[4] + xy, x[5] + xz);
        (y[3], y[4], y[5]) = (y[3] + xy, y[4] - (weight - m.y * e.y), y[5] + yz);
        (z[3], z[4], z[5]) = (z[3] + xz, z[4] + yz, z[5] - (weight - m.z * e.z));
    }
}

impl<R: Real> Linear for Vec3<R> {
    type Real = R;

    const ZERO: Self = Self::ZERO;
    const DIMENSION: usize = 3;

    #[inline]
    fn from_f64(v: [f64; 3]) -> Self {
        Vec3::from_f64(v)
    }
    #[inline]
    fn holds(_: [f64; 3]) -> bool {
        true
    }
    #[inline]
    fn to_f64(self) -> [f64; 3] {
        Vec3::to_f64(self)
    }
    #[inline(always)]
    fn of_space(v: Self) -> Self {
        v
    }
    #[inline(always)]
    fn in_space(self) -> Self {
        self
    }
    #[inline(always)]
    fn dot(self, other: Self) -> R {
        Vec3::dot(self, other)
    }
    #[inline(always)]
    fn axes() -> [Self; 3] {
        Vec3::axes()
    }
    #[inline(always)]
    fn is_finite(self) -> bool {
        Vec3::is_finite(self)
    }
}

impl<R: Real> Vector for Vec3<R> {
    type Moment = Self;

    #[inline(always)]
    fn cross(self, force: Self) -> Self {
        Vec3::cross(self, force)
    }
    #[inline(always)]
    fn normals(self) -> [Self; 2] {
        Vec3::normals(self)
    }
    #[inline(always)]
    fn across(self, other: Self) -> Self {
        Vec3::cross(self, other)
    }
}

impl<R: Real> Moment for Vec3<R> {
    type Vector = Self;

    #[inline(always)]
    fn cross(self, arm: Self) -> Self {
        Vec3::cross(self, arm)
    }
    #[inline(always)]
    fn commutator(self, other: Self) -> Self {
        Vec3::cross(self, other)
    }
    #[inline(always)]
    fn scale(self, other: Self) -> Self {
        Vec3::scale(self, other)
    }
    #[inline(always)]
    fn under(self, number: R) -> Self {
        Vec3::new(number / self.x, number / self.y, number / self.z)
    }
    #[inline]
    fn root(self) -> Self {
        Vec3::new(self.x.sqrt(), self.y.sqrt(), self.z.sqrt())
    }
    #[inline(always)]
    fn of_columns(self, [x, y, z]: [Self; 3]) -> Self {
        x * self.x + y * self.y + z * self.z
    }
}

impl<R: Real> Turn for Quaternion<R> {
    type Real = R;
    type Moment = Vec3<R>;

    #[inline]
    fn from_f64(turn: [f64; 4]) -> Self {
        Quaternion::from_f64(turn)
    }
    #[inline]
    fn to_f64(self) -> [f64; 4] {
        Quaternion::to_f64(self)
    }
    #[inline(always)]
    fn conjugate(self) -> Self {
        Quaternion::conjugate(self)
    }
    #[inline(always)]
    fn product(self, other: Self) -> Self {
        Quaternion::product(self, other)
    }
    #[inline(always)]
    fn about(self, axis: Vec3<R>) -> (R, R) {
        (self.w, self.v.dot(axis))
    }
    #[inline(always)]
    fn gradient(self, axis: Vec3<R>, sine: R, norm: R) -> Vec3<R> {
        let along = axis * (self.w * self.w) + self.v.cross(axis) * self.w + self.v * sine;
        along * (R::ONE / norm)
    }
}
