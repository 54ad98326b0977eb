//! Points and directions in space, world.

use std::ops::{Add, Mul, Neg, Sub};

use dbd_kernel::Vec3;

use crate::precise::Precise;

/// Three numbers with 32 digits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct PreciseVector {
    pub(crate) x: Precise,
    pub(crate) y: Precise,
    pub(crate) z: Precise,
}

impl PreciseVector {
    pub(crate) const ZERO: Self = Self { x: Precise::ZERO, y: Precise::ZERO, z: Precise::ZERO };

    pub(crate) fn axes() -> [Self; 3] {
        Vec3::<f64>::axes().map(Self::from)
    }

    /// Each component rounded to the nearest double.
    pub(crate) fn nearest(self) -> Vec3<f64> {
        Vec3::from_f64([self.x, self.y, self.z].map(Precise::nearest))
    }

    /// The same without signs of zeros.
    pub(crate) fn unsigned(self) -> Self {
        self + Self::ZERO
    }

    pub(crate) fn dot(self, other: Self) -> Precise {
        self.x * other.x + self.y * other.y + self.z * other.z
    }

    pub(crate) fn cross(self, other: Self) -> Self {
        Self {
            x: self.y * other.z - self.z * other.y,
            y: self.z * other.x - self.x * other.z,
            z: self.x * other.y - self.y * other.x,
        }
    }

    /// The vector with these coordinates along three axes.
    pub(crate) fn along(self, [x, y, z]: [Self; 3]) -> Self {
        x * self.x + y * self.y + z * self.z
    }

    pub(crate) fn length(self) -> Precise {
        self.dot(self).root()
    }

    /// Normalised; `None` where the square of the length underflows or is infinite.
    pub(crate) fn unit(self) -> Option<Self> {
        let length = self.length();
        let inverse = Precise::ONE / length;
        (1e-140..=1e140).contains(&length.nearest()).then(|| self * inverse)
    }

    /// Unit vectors (e1, e2) normal to this unit vector with e1 × e2 = it; e1 in the half plane of
    /// `reference`. `None` where the two are parallel within 1e-6.
    pub(crate) fn normals(self, reference: Self) -> Option<[Self; 2]> {
        let across = reference - self * reference.dot(self);
        if across.dot(across).nearest() < 1e-12 * reference.dot(reference).nearest() {
            return None;
        }
        let e1 = across.unit()?;
        Some([e1, self.cross(e1)])
    }
}

impl From<Vec3<f64>> for PreciseVector {
    fn from(v: Vec3<f64>) -> Self {
        Self { x: v.x.into(), y: v.y.into(), z: v.z.into() }
    }
}

impl From<[f64; 3]> for PreciseVector {
    fn from(v: [f64; 3]) -> Self {
        Vec3::from_f64(v).into()
    }
}

impl Add for PreciseVector {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self { x: self.x + other.x, y: self.y + other.y, z: self.z + other.z }
    }
}

impl Neg for PreciseVector {
    type Output = Self;
    fn neg(self) -> Self {
        Self { x: -self.x, y: -self.y, z: -self.z }
    }
}

impl Sub for PreciseVector {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul<Precise> for PreciseVector {
    type Output = Self;
    fn mul(self, factor: Precise) -> Self {
        Self { x: self.x * factor, y: self.y * factor, z: self.z * factor }
    }
}
