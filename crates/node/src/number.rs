//! Conversion of a plant's numbers to integers for registers.
//!
//! `x => nearest integer, x rounded down`. By additions only: `core` has no rounding, and libm's would be a call where
//! the FPU needs two instructions.

use dbd_kernel::Real;

/// A number that a sensor can turn into counts.
pub trait Number: Real {
    /// The nearest integer, ties to even; saturates, 0 for NaN.
    fn nearest(self) -> i32;

    /// The nearest integer as a number, ties to even.
    fn rounded(self) -> Self;

    /// The largest integer not above; saturates, 0 for NaN.
    #[inline(always)]
    fn whole_below(self) -> i32 {
        let whole = self.nearest();
        if Self::from_i32(whole) > self { whole.saturating_sub(1) } else { whole }
    }

    /// Clamps to two bounds.
    #[inline(always)]
    fn limited(self, least: Self, most: Self) -> Self {
        if self < least {
            least
        } else if self > most {
            most
        } else {
            self
        }
    }
}

impl Number for f32 {
    #[inline(always)]
    fn nearest(self) -> i32 {
        self.rounded() as i32
    }

    #[inline(always)]
    fn rounded(self) -> Self {
        // From 2^23 on every number is an integer; below, the sum's last place is 1.
        const WHOLE: f32 = 8_388_608.0;
        if (0.0..WHOLE).contains(&self) {
            (self + WHOLE) - WHOLE
        } else if (-WHOLE..0.0).contains(&self) {
            (self - WHOLE) + WHOLE
        } else {
            self
        }
    }
}

impl Number for f64 {
    #[inline(always)]
    fn nearest(self) -> i32 {
        self.rounded() as i32
    }

    #[inline(always)]
    fn rounded(self) -> Self {
        const WHOLE: f64 = 4_503_599_627_370_496.0;
        if (0.0..WHOLE).contains(&self) {
            (self + WHOLE) - WHOLE
        } else if (-WHOLE..0.0).contains(&self) {
            (self - WHOLE) + WHOLE
        } else {
            self
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn whole_numbers_are_the_nearest_and_the_lower() {
        for (x, nearest, floor) in [
            (0.0, 0, 0),
            (0.5, 0, 0),
            (1.5, 2, 1),
            (2.5, 2, 2),
            (-0.5, 0, -1),
            (-1.5, -2, -2),
            (0.75, 1, 0),
            (-0.25, 0, -1),
            (4_194_303.5, 4_194_304, 4_194_303),
            (8_388_607.0, 8_388_607, 8_388_607),
            (-16_777_216.0, -16_777_216, -16_777_216),
            (1e12, i32::MAX, i32::MAX),
            (-1e12, i32::MIN, i32::MIN),
            (f64::NAN, 0, 0),
            (f64::INFINITY, i32::MAX, i32::MAX),
        ] {
            assert_eq!((x.nearest(), x.whole_below()), (nearest, floor), "{x}");
            let single = x as f32;
            assert_eq!((single.nearest(), single.whole_below()), (nearest, floor), "{x}");
        }
        // The number just below one half, which adding one half would round up.
        assert_eq!(0.499_999_97_f32.nearest(), 0);
        assert_eq!(0.499_999_999_999_999_94_f64.nearest(), 0);
    }
}
