//! Three angles in a sequence: their rotation, and how a rotation changes them.
//!
//! `(angles) => matrix, quaternion; (angles, rotation vector) => angles`.

use crate::arctangent::atan2;
use crate::lanes::Named;
use crate::real::Real;
use crate::vector::{Quaternion, Rotation, Vec3};
use crate::words::{Word, WordSource, WordVisitor, Words};

/// A number type with sine and cosine.
pub trait Trigonometric: Real + Named {
    /// (sin x, cos x).
    fn sin_cos(self) -> (Self, Self);
}

impl Trigonometric for f64 {
    fn sin_cos(self) -> (Self, Self) {
        libm::sincos(self)
    }
}

impl Trigonometric for f32 {
    fn sin_cos(self) -> (Self, Self) {
        libm::sincosf(self)
    }
}

/// A sequence of rotations about body axes, the first angle about z.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(all(feature = "defmt", target_os = "none"), derive(defmt::Format))]
pub enum Sequence {
    /// 3-2-1: yaw about z, pitch about y, roll about x.
    #[default]
    YawPitchRoll,
    /// 3-1-2: yaw about z, roll about x, pitch about y.
    YawRollPitch,
}

/// An orientation as three angles \[rad\] in a sequence. First and last are within ±2π, so that their halves determine
/// the sign of the quaternion, which revolution counts need.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(all(feature = "defmt", target_os = "none"), derive(defmt::Format))]
pub struct EulerAngles<R> {
    /// \[rad\] first, middle and last angle.
    pub angles: Vec3<R>,
    /// The axes they rotate about.
    pub sequence: Sequence,
}

impl<R: Trigonometric> EulerAngles<R> {
    /// The rotation matrix: six evaluations of sine and cosine.
    #[must_use]
    pub fn rotation(&self) -> Rotation<R> {
        let (s1, c1) = self.angles.x.sin_cos();
        let (s2, c2) = self.angles.y.sin_cos();
        let (s3, c3) = self.angles.z.sin_cos();
        match self.sequence {
            Sequence::YawPitchRoll => Rotation {
                x: Vec3::new(c1 * c2, c1 * s2 * s3 - s1 * c3, c1 * s2 * c3 + s1 * s3),
                y: Vec3::new(s1 * c2, s1 * s2 * s3 + c1 * c3, s1 * s2 * c3 - c1 * s3),
                z: Vec3::new(-s2, c2 * s3, c2 * c3),
            },
            Sequence::YawRollPitch => Rotation {
                x: Vec3::new(c1 * c3 - s1 * s2 * s3, -(s1 * c2), c1 * s3 + s1 * s2 * c3),
                y: Vec3::new(s1 * c3 + c1 * s2 * s3, c1 * c2, s1 * s3 - c1 * s2 * c3),
                z: Vec3::new(-(c2 * s3), s2, c2 * c3),
            },
        }
    }

    /// The unit quaternion, its sign continuous in time.
    #[must_use]
    pub fn quaternion(&self) -> Quaternion<R> {
        let zero = R::ZERO;
        let half = |angle: R| (angle * R::HALF).sin_cos();
        let ((s1, c1), (s2, c2), (s3, c3)) =
            (half(self.angles.x), half(self.angles.y), half(self.angles.z));
        let yaw = Quaternion::new(c1, zero, zero, s1);
        match self.sequence {
            Sequence::YawPitchRoll => yaw
                .product(Quaternion::new(c2, zero, s2, zero))
                .product(Quaternion::new(c3, s3, zero, zero)),
            Sequence::YawRollPitch => yaw
                .product(Quaternion::new(c2, s2, zero, zero))
                .product(Quaternion::new(c3, zero, s3, zero)),
        }
    }

    /// The angles of a unit quaternion in a sequence. At its pole the last angle is 0.
    pub(super) fn of(q: Quaternion<R>, sequence: Sequence) -> Self {
        let r = q.rotation();
        // Rounding leaves a few ulps of the cosine at the pole.
        let pole = R::from_f64(1e-6) * R::from_f64(1e-6);
        let angles = match sequence {
            Sequence::YawPitchRoll => {
                let cosine2 = r.z.y * r.z.y + r.z.z * r.z.z;
                let middle = atan2(-r.z.x, cosine2.sqrt());
                if cosine2 > pole {
                    Vec3::new(atan2(r.y.x, r.x.x), middle, atan2(r.z.y, r.z.z))
                } else {
                    Vec3::new(atan2(-r.x.y, r.y.y), middle, R::ZERO)
                }
            }
            Sequence::YawRollPitch => {
                let middle = atan2(r.z.y, (r.z.x * r.z.x + r.z.z * r.z.z).sqrt());
                Vec3::new(atan2(-r.x.y, r.y.y), middle, atan2(-r.z.x, r.z.z))
            }
        };
        let mut result = Self { angles, sequence };
        let found = result.quaternion();
        if found.w * q.w + found.v.dot(q.v) < R::ZERO {
            // One revolution more or less: the other sign of the quaternion.
            let turn = R::TWO * R::PI;
            let yaw = &mut result.angles.x;
            *yaw = if *yaw > R::ZERO { *yaw - turn } else { *yaw + turn };
        }
        result
    }

    /// Whether the cosine of the middle angle is below ½.
    pub(super) fn is_near_pole(&self) -> bool {
        self.angles.y.abs() > R::PI / (R::TWO + R::ONE)
    }

    /// Restores first and last angle to ±2π and changes the sequence near the pole.
    pub(super) fn settle(&mut self) {
        let Vec3 { x, y, z } = self.angles;
        self.angles = Vec3::new(wrapped(x), y, wrapped(z));
        if self.is_near_pole() {
            let other = match self.sequence {
                Sequence::YawPitchRoll => Sequence::YawRollPitch,
                Sequence::YawRollPitch => Sequence::YawPitchRoll,
            };
            *self = Self::of(self.quaternion(), other);
        }
    }

    /// `E(α)·ω`: the angles' rates \[rad/s\] for a rate in body axes.
    fn rates(sequence: Sequence, angles: Vec3<R>, rate: Vec3<R>) -> Vec3<R> {
        let (s2, c2) = angles.y.sin_cos();
        let (s3, c3) = angles.z.sin_cos();
        match sequence {
            Sequence::YawPitchRoll => {
                let yaw = (s3 * rate.y + c3 * rate.z) / c2;
                Vec3::new(yaw, c3 * rate.y - s3 * rate.z, rate.x + s2 * yaw)
            }
            Sequence::YawRollPitch => {
                let yaw = (c3 * rate.z - s3 * rate.x) / c2;
                Vec3::new(yaw, c3 * rate.x + s3 * rate.z, rate.y - s2 * yaw)
            }
        }
    }

    /// Rotates by a rotation vector in body axes.
    pub(super) fn turn_by(&mut self, turn: Vec3<R>) {
        let rates = |angles: Vec3<R>| Self::rates(self.sequence, angles, turn);
        let start = self.angles;
        let first = rates(start);
        let second = rates(start + first * R::HALF);
        let third = rates(start + second * R::HALF);
        let last = rates(start + third);
        let sum = first + (second + third) * R::TWO + last;
        self.angles = start + sum * (R::ONE / R::from_f64(6.0));
    }
}

impl<R: Real> Words for EulerAngles<R> {
    fn visit(&self, visitor: &mut impl WordVisitor) {
        self.angles.visit(visitor);
        visitor.word(Word::I32(self.sequence as i32));
    }

    fn fill(&mut self, source: &mut impl WordSource) {
        self.angles.fill(source);
        let switched = source.take(4) != Sequence::YawPitchRoll as u64;
        let (three_two_one, other) = (Sequence::YawPitchRoll, Sequence::YawRollPitch);
        self.sequence = if switched { other } else { three_two_one };
    }
}

/// An angle of magnitude beyond 2π minus two revolutions, which changes no quaternion.
fn wrapped<R: Real>(angle: R) -> R {
    let turn = R::TWO * R::PI;
    if angle > turn {
        angle - R::TWO * turn
    } else if angle < -turn {
        angle + R::TWO * turn
    } else {
        angle
    }
}
