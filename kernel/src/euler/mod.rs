//! Euler angles as the stored orientation, as in the paper (Franco & Degani 2026, section 2.2).
//!
//! `(angles, rotation) => angles`, by the kinematic equation `α̇ = E(α)·ω` over each rotation's constant rate
//! (classical Runge–Kutta: schemes keep their order up to four). `E` is singular where the middle angle is ±90°. So the
//! angles change from yaw–pitch–roll (3-2-1) to yaw–roll–pitch (3-1-2) and back where the cosine of the middle one
//! falls below ½: the other is then above √3/2. Everything else is that of [`Float`]. Sine and cosine are libm's in
//! pure Rust: the same bits everywhere. Unlike a quaternion the angles drift from the exact rotation, by O(h⁴) in all
//! schemes.

mod angles;

pub use angles::{EulerAngles, Sequence, Trigonometric};

use crate::arctangent::atan2;
use crate::attitude::Attitude;
use crate::geometry::Float;
use crate::real::Real;
use crate::vector::{Quaternion, Rotation, Vec3};

/// Double precision.
pub type EulerF64 = Float<f64, EulerAngles<f64>>;
/// Single precision.
pub type EulerF32 = Float<f32, EulerAngles<f32>>;

/// The rotation vector of a quaternion.
fn rotation_vector<R: Real>(turn: Quaternion<R>) -> Vec3<R> {
    let length = turn.v.dot(turn.v).sqrt();
    if length == R::ZERO {
        return Vec3::ZERO;
    }
    turn.v * (R::TWO * atan2(length, turn.w) / length)
}

impl<R: Trigonometric> Attitude for EulerAngles<R> {
    type Real = R;
    type Turn = Quaternion<R>;

    const NAME: &'static str = "euler-321";

    fn rotation(&self) -> Rotation<R> {
        EulerAngles::rotation(self)
    }
    fn quaternion(&self) -> Quaternion<R> {
        EulerAngles::quaternion(self)
    }
    fn since_world(&self) -> Quaternion<R> {
        EulerAngles::quaternion(self)
    }
    fn turn(&mut self, turn: Quaternion<R>) {
        self.turn_by(rotation_vector(turn));
    }
    fn renormalise(&mut self) {
        self.settle();
    }
    fn from_f64(orientation: [f64; 4]) -> Self {
        let q = Quaternion::from_f64(orientation);
        let mut exact = EulerAngles::<f64>::of(q, Sequence::YawPitchRoll);
        if exact.is_near_pole() {
            exact = EulerAngles::of(q, Sequence::YawRollPitch);
        }
        EulerAngles { angles: Vec3::from_f64(exact.angles.to_f64()), sequence: exact.sequence }
    }
    fn to_f64(&self) -> [f64; 4] {
        let angles = Vec3::from_f64(self.angles.to_f64());
        let exact = EulerAngles::<f64> { angles, sequence: self.sequence };
        EulerAngles::quaternion(&exact).to_f64()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::words::{Word, WordSource, WordVisitor, Words};

    type Angles = EulerAngles<f64>;

    fn unit(q: [f64; 4]) -> [f64; 4] {
        let n = libm::sqrt(q.iter().map(|c| c * c).sum());
        q.map(|c| c / n)
    }

    fn apart(a: [f64; 4], b: [f64; 4]) -> f64 {
        a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
    }

    const POSES: [[f64; 4]; 7] = [
        [1.0, 0.0, 0.0, 0.0],
        [-1.0, 0.0, 0.0, 0.0],
        [0.3, -0.2, 0.9, 0.4],
        [-0.3, 0.2, -0.9, -0.4],
        // Pitch of +90° and −90°, yawed, and roll of 90°.
        [1.0, 0.0, 1.0, 0.0],
        [0.3, 0.4, -0.3, 0.4],
        [0.7, 0.7, 0.1, 0.1],
    ];

    #[test]
    fn a_quaternion_survives_the_way_through_angles_with_its_sign() {
        for q in POSES.map(unit) {
            let switched = Angles::from_f64(q);
            assert!(apart(switched.to_f64(), q) < 1e-15, "{q:?} {switched:?}");
            assert!(!switched.is_near_pole(), "{q:?} {switched:?}");
            let matrix = switched.rotation();
            let expected = Quaternion::from_f64(q).rotation();
            for (row, row_expected) in
                [matrix.x, matrix.y, matrix.z].into_iter().zip([expected.x, expected.y, expected.z])
            {
                let d = row - row_expected;
                assert!(d.dot(d) < 1e-29, "{q:?}");
            }
        }
    }

    #[test]
    fn turns_follow_the_quaternion_through_both_poles_and_every_winding() {
        let (c, s) = (libm::cos(5e-3), libm::sin(5e-3));
        for axis in [[0.0, 1.0, 0.0], [0.7, 0.7, 0.1], [1.0, 0.0, 0.0], [0.3, -0.2, 0.9]] {
            let [_, x, y, z] = unit([0.0, axis[0], axis[1], axis[2]]);
            let turn = Quaternion::new(c, s * x, s * y, s * z);
            let mut q = Quaternion::from_f64(unit([0.9, 0.1, -0.2, 0.3]));
            let mut angles = Angles::from_f64(q.to_f64());
            let mut switches = 0;
            for _ in 0..3_000 {
                let before = angles.sequence;
                q.turn(turn);
                angles.turn(turn);
                angles.renormalise();
                q.renormalise();
                switches += u32::from(before != angles.sequence);
                // Signs included.
                let distance = apart(angles.to_f64(), q.to_f64());
                assert!(distance < 1e-7, "{axis:?}: {distance:e}");
                assert!(!angles.is_near_pole());
            }
            // About an axis near y 3-1-2 has no pole to pass.
            assert!(switches >= 8 || axis[0] != 0.7, "{axis:?}: {switches}");
        }
    }

    #[test]
    fn words_read_back() {
        struct Bytes(std::vec::Vec<(u64, usize)>);
        impl WordVisitor for Bytes {
            fn word(&mut self, word: Word) {
                self.0.push((word.bits(), word.size()));
            }
        }
        impl WordSource for Bytes {
            fn take(&mut self, size: usize) -> u64 {
                let (bits, expected) = self.0.remove(0);
                assert_eq!(size, expected);
                bits
            }
        }
        for q in POSES.map(unit) {
            let stored = EulerAngles::<f32>::from_f64(q);
            let mut words = Bytes(std::vec::Vec::new());
            stored.visit(&mut words);
            assert_eq!(words.0.len(), 4);
            let mut back = EulerAngles::default();
            back.fill(&mut words);
            assert_eq!(stored, back);
        }
    }
}
