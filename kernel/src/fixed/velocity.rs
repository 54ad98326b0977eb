//! Velocities of [`Fixed`](crate::fixed::Fixed): two single-precision numbers per component.
//!
//! `(sum, lost) + increment => (sum, lost)`: the rounding error of an addition is added at the next one.

use crate::vector::Vec3;
use crate::words::{WordSource, WordVisitor, Words};

/// A linear or angular velocity whose value is `sum − lost`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(all(feature = "defmt", target_os = "none"), derive(defmt::Format))]
pub struct FixedVelocity {
    /// \[m/s, rad/s\] the sum of the increments, rounded.
    pub sum: Vec3<f32>,
    /// \[m/s, rad/s\] the rounding error of the sum.
    pub lost: Vec3<f32>,
}

/// An addition to a number of two words (Dekker, *Numer. Math.* 18, 1971): the part below the increment's last digit
/// stays in `lost`. A compensated sum (Kahan) would round it off, often in the same direction step after step.
#[inline(always)]
fn add_to_both(sum: &mut f32, lost: &mut f32, increment: f32) {
    let new = *sum + increment;
    let owed = ((new - *sum) - increment) + *lost;
    let nearest = new - owed;
    *lost = (nearest - new) + owed;
    *sum = nearest;
}

/// A number in two words, and back.
const fn split(value: f64) -> (f32, f32) {
    let sum = value as f32;
    let lost = (sum as f64 - value) as f32;
    // A value beyond single precision loses everything and is refused.
    (sum, if lost.is_nan() || lost.is_infinite() { 0.0 } else { lost })
}

const fn joined(sum: f32, lost: f32) -> f64 {
    sum as f64 - lost as f64
}

impl FixedVelocity {
    /// A vector rounded once to two words per component.
    #[must_use]
    pub const fn from_f64(v: [f64; 3]) -> Self {
        let [x, y, z] = [split(v[0]), split(v[1]), split(v[2])];
        Self { sum: Vec3::new(x.0, y.0, z.0), lost: Vec3::new(x.1, y.1, z.1) }
    }

    /// Its value in double precision.
    #[must_use]
    pub const fn to_f64(&self) -> [f64; 3] {
        let Self { sum, lost } = self;
        [joined(sum.x, lost.x), joined(sum.y, lost.y), joined(sum.z, lost.z)]
    }

    /// `self − before`: a small difference from both words.
    #[inline(always)]
    pub(crate) fn since(&self, before: &Self) -> Vec3<f32> {
        (self.sum - before.sum) - (self.lost - before.lost)
    }

    /// Adds to both words.
    #[inline(always)]
    pub(crate) fn add_to_both(&mut self, increment: Vec3<f32>) {
        self.add_to_both_across::<3>(increment);
    }

    /// [`Self::add_to_both`] without component `AXIS`.
    #[inline(always)]
    pub(crate) fn add_to_both_across<const AXIS: usize>(&mut self, increment: Vec3<f32>) {
        let Self { sum, lost } = self;
        if AXIS != 0 {
            add_to_both(&mut sum.x, &mut lost.x, increment.x);
        }
        if AXIS != 1 {
            add_to_both(&mut sum.y, &mut lost.y, increment.y);
        }
        if AXIS != 2 {
            add_to_both(&mut sum.z, &mut lost.z, increment.z);
        }
    }
}

impl Words for FixedVelocity {
    fn visit(&self, visitor: &mut impl WordVisitor) {
        self.sum.visit(visitor);
        self.lost.visit(visitor);
    }

    fn fill(&mut self, source: &mut impl WordSource) {
        self.sum.fill(source);
        self.lost.fill(source);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The increment by gravity is added to `lost`; the last digit of the forces' increments is above it.
    #[test]
    fn both_words_keep_what_is_below_the_last_digit_of_an_increment() {
        const STEPS: i64 = 100_000;
        let unit = (-60.0_f64).exp2();
        let (pulls, apply_gravity) =
            ([0x00ff_ffff_i64 << 26, 0x00c0_0001 << 26, -0x01bf_fffe << 26], 1_i64 << 19);
        let mut velocity = FixedVelocity::from_f64([1.0; 3]);
        let mut exact = 1_i128 << 60;
        for step in 0..STEPS {
            let pull = pulls[step as usize % 3];
            let increment = Vec3::from_f64([pull as f64 * unit; 3]);
            assert_eq!(f64::from(increment.x), pull as f64 * unit);
            velocity.lost = velocity.lost - Vec3::from_f64([apply_gravity as f64 * unit; 3]);
            velocity.add_to_both(increment);
            exact += i128::from(pull + apply_gravity);
            assert!(velocity.lost.x.abs() <= f32::EPSILON / 2.0 * velocity.sum.x.abs());
        }
        let off = (velocity.to_f64()[2] / unit) as i128 - exact;
        let fallen = i128::from(STEPS * apply_gravity);
        assert!(off.abs() < fallen / 1_000, "{off} of {fallen}");
    }

    #[test]
    fn two_words_hold_what_double_precision_has_down_to_their_digits() {
        for [x, y, z] in [[1.0 / 3.0, -1e3 / 7.0, 0.0], [1e-9 / 3.0, 2.0, f64::from(f32::MAX)]] {
            let velocity = FixedVelocity::from_f64([x, y, z]);
            let double = velocity.to_f64();
            assert_eq!(FixedVelocity::from_f64(double), velocity);
            for (double, exact) in double.into_iter().zip([x, y, z]) {
                assert!((double - exact).abs() <= 4e-15 * exact.abs(), "{double} {exact}");
            }
        }
        // A value beyond single precision is infinite, which is detected.
        assert!(FixedVelocity::from_f64([1e300; 3]).to_f64()[0].is_infinite());
    }
}
