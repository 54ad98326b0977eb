//! Euler angles as the stored orientation, as the paper has it (Franco & Degani 2026, section 2.2).
//!
//! `(angles, turn) => angles`, by the kinematic equation `α̇ = E(α)·ω` over each turn's constant rate
//! (classical Runge–Kutta: schemes keep their order up to four). `E` is singular where the middle
//! angle is ±90°. With `SWITCH` the angles change from yaw–pitch–roll (3-2-1) to yaw–roll–pitch
//! (3-1-2) and back where the cosine of the middle one falls below ½: the other is then above
//! √3/2. Without it precision is lost near the pole: for comparison.
//! Everything else is that of [`Float`]. The sine and cosine are libm's in pure Rust: the same bits
//! everywhere. Unlike a quaternion the angles drift from the true turn, by O(h⁴) in all schemes.

mod angles;

pub use angles::{EulerAngles, Sequence, Trigonometric};

use core::marker::PhantomData;

use crate::arctangent::atan2;
use crate::geometry::{Float, Geometry, Pose};
use crate::real::Real;
use crate::vector::{Quaternion, Vec3};

/// Floating-point geometry with Euler angles; `SWITCH` changes between two sequences.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Euler<R, const SWITCH: bool>(PhantomData<R>);

/// Double precision, two sequences.
pub type EulerF64 = Euler<f64, true>;
/// Single precision, two sequences.
pub type EulerF32 = Euler<f32, true>;
/// Double precision, yaw–pitch–roll alone.
pub type SingleEulerF64 = Euler<f64, false>;
/// Single precision, yaw–pitch–roll alone.
pub type SingleEulerF32 = Euler<f32, false>;

/// The rotation vector of a quaternion.
fn rotation_vector<R: Real>(turn: Quaternion<R>) -> Vec3<R> {
    let length = turn.v.dot(turn.v).sqrt();
    if length == R::ZERO {
        return Vec3::ZERO;
    }
    turn.v * (R::TWO * atan2(length, turn.w) / length)
}

impl<R: Trigonometric, const SWITCH: bool> Geometry for Euler<R, SWITCH> {
    type Real = R;
    type Position = Vec3<R>;
    type Orientation = EulerAngles<R, SWITCH>;
    type Velocity = Vec3<R>;
    type Local = Vec3<R>;
    type Location = Vec3<R>;
    type Frame = Pose<R>;

    const NAME: &'static str = R::NAME;
    const ORIENTATION: &'static str = if SWITCH { "euler-321" } else { "euler-321-single" };

    fn frame(position: &Vec3<R>, orientation: &Self::Orientation) -> Pose<R> {
        Pose { position: *position, rotation: orientation.rotation() }
    }
    fn relative(
        first: Option<&Self::Orientation>,
        second: Option<&Self::Orientation>,
    ) -> Quaternion<R> {
        let (first, second) =
            (first.map(EulerAngles::quaternion), second.map(EulerAngles::quaternion));
        Float::<R>::relative(first.as_ref(), second.as_ref())
    }
    fn turn(orientation: &mut Self::Orientation, turn: Quaternion<R>) {
        orientation.turn_by(rotation_vector(turn));
    }
    fn renormalise(orientation: &mut Self::Orientation) {
        orientation.settle();
    }
    fn orientation_from_f64(orientation: [f64; 4]) -> Self::Orientation {
        let q = Quaternion::from_f64(orientation);
        let mut exact = EulerAngles::<f64, SWITCH>::of(q, Sequence::YawPitchRoll);
        if SWITCH && exact.is_near_pole() {
            exact = EulerAngles::of(q, Sequence::YawRollPitch);
        }
        EulerAngles { angles: Vec3::from_f64(exact.angles.to_f64()), sequence: exact.sequence }
    }
    fn orientation_to_f64(orientation: &Self::Orientation) -> [f64; 4] {
        let angles = Vec3::from_f64(orientation.angles.to_f64());
        EulerAngles::<f64, SWITCH> { angles, sequence: orientation.sequence }.quaternion().to_f64()
    }

    // Positions, points and velocities are those of the quaternion geometry.

    #[inline(always)]
    fn place(frame: &Pose<R>, local: &Vec3<R>) -> (Vec3<R>, Vec3<R>) {
        Float::<R>::place(frame, local)
    }
    #[inline(always)]
    fn ground(local: &Vec3<R>) -> Vec3<R> {
        *local
    }
    #[inline(always)]
    fn shift(location: &Vec3<R>, by: Vec3<R>) -> Vec3<R> {
        Float::<R>::shift(location, by)
    }
    #[inline(always)]
    fn displacement(from: &Vec3<R>, to: &Vec3<R>) -> Vec3<R> {
        Float::<R>::displacement(from, to)
    }
    #[inline(always)]
    fn to_world(frame: &Pose<R>, v: Vec3<R>) -> Vec3<R> {
        Float::<R>::to_world(frame, v)
    }
    #[inline(always)]
    fn to_body(frame: &Pose<R>, v: Vec3<R>) -> Vec3<R> {
        Float::<R>::to_body(frame, v)
    }
    #[inline(always)]
    fn position(stored: &Vec3<R>) -> Vec3<R> {
        *stored
    }
    #[inline(always)]
    fn velocity(stored: &Vec3<R>) -> Vec3<R> {
        *stored
    }
    #[inline(always)]
    fn accelerate(stored: &mut Vec3<R>, increment: Vec3<R>) {
        Float::<R>::accelerate(stored, increment);
    }
    #[inline(always)]
    fn translate(position: &mut Vec3<R>, displacement: Vec3<R>) {
        Float::<R>::translate(position, displacement);
    }
    fn position_from_f64(position: [f64; 3]) -> Vec3<R> {
        Float::<R>::position_from_f64(position)
    }
    fn position_to_f64(position: &Vec3<R>) -> [f64; 3] {
        Float::<R>::position_to_f64(position)
    }
    fn velocity_from_f64(velocity: [f64; 3]) -> Vec3<R> {
        Float::<R>::velocity_from_f64(velocity)
    }
    fn velocity_to_f64(velocity: &Vec3<R>) -> [f64; 3] {
        Float::<R>::velocity_to_f64(velocity)
    }
    fn local_from_f64(local: [f64; 3]) -> Vec3<R> {
        Float::<R>::local_from_f64(local)
    }
    fn local_to_f64(local: &Vec3<R>) -> [f64; 3] {
        Float::<R>::local_to_f64(local)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::F64;
    use crate::words::{Word, WordSource, WordVisitor, Words};

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
            let both = [
                EulerF64::orientation_to_f64(&EulerF64::orientation_from_f64(q)),
                SingleEulerF64::orientation_to_f64(&SingleEulerF64::orientation_from_f64(q)),
            ];
            // At the pole the pitch of a matrix is known to the root of an ulp.
            assert!(apart(both[0], q) < 1e-15 && apart(both[1], q) < 1e-7, "{q:?} {both:?}");
            let switched = EulerF64::orientation_from_f64(q);
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
            let mut angles = EulerF64::orientation_from_f64(q.to_f64());
            let mut switches = 0;
            for _ in 0..3_000 {
                let before = angles.sequence;
                F64::turn(&mut q, turn);
                EulerF64::turn(&mut angles, turn);
                EulerF64::renormalise(&mut angles);
                F64::renormalise(&mut q);
                switches += u32::from(before != angles.sequence);
                // Signs included.
                let distance = apart(EulerF64::orientation_to_f64(&angles), q.to_f64());
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
            let stored = EulerF32::orientation_from_f64(q);
            let mut words = Bytes(std::vec::Vec::new());
            stored.visit(&mut words);
            assert_eq!(words.0.len(), 4);
            let mut back = EulerAngles::default();
            back.fill(&mut words);
            assert_eq!(stored, back);
        }
    }
}
